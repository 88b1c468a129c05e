//! Whole-workspace benchmarks; see the files beside this package.
