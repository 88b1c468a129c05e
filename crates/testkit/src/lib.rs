//! Test-only: synthetic frames, derived tolerances and the conformance suite
