//! The one slice of built-in methods, chained with a user's own
