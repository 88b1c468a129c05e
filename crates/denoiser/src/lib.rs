//! The Denoiser trait, method cards, registry entries, errors and the Guarded combinator
