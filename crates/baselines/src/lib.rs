//! Denoisers that the source works compare with: one folder per paper, each with its page, its algorithm in the order of the
//! paper, its parameters, and its tests.
//!
//! To add one: its folder, and its name in the list below.

use std::sync::Arc;

use noisefloor_denoiser::Factory;

/// Declares the modules and collects their factories.
macro_rules! baselines {
    ($($key:ident,)*) => {
        $(pub mod $key;)*

        /// Factories of all baselines in this order.
        #[must_use]
        pub fn methods() -> Vec<Arc<dyn Factory>> {
            vec![$($key::method()),*]
        }
    };
}

baselines! {
    dshl10,
    nfor,
}
