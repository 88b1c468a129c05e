//! Whole-workspace tests; see the files beside this package.
