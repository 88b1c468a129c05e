//! What must hold of the kernels: equal bits everywhere, the `f64` twin as the oracle, limiting cases.

mod cross_bilateral;
mod dense;
mod exp2;
mod flash_filter;
mod guided;
mod joint_nlm;
mod mirror;
mod models;
mod nlm;
mod random;
mod same_bits;
mod tiles;
