//! The simple geometric denoiser of a hobby path tracer, as written and corrected
