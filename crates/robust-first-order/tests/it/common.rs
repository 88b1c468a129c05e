//! The method with given parameters.

use noisefloor_conformance::outputs;
use noisefloor_denoiser::Output;
use noisefloor_frame::Frame;
use noisefloor_robust_first_order::{Params, RobustFirstOrder};

pub fn run(params: &Params, frame: &Frame) -> Output {
    outputs::run(&RobustFirstOrder::new(params.clone()).unwrap(), frame)
}

pub fn diagnose(params: &Params, frame: &Frame) -> Output {
    outputs::diagnose(&RobustFirstOrder::new(params.clone()).unwrap(), frame)
}
