//! Intervals, coverage, bounds, slopes and comparisons: numbers in, numbers out
