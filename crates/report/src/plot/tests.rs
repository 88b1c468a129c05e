//! Charts as a whole: what a reader sees of an exhibit.
