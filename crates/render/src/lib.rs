//! A deterministic path tracer that records frames with their statistics
