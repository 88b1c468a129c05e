//! What the two filters of first-order regression are timed with: colour as guide and target, seven feature channels.

use noisefloor_frame::{FeatureId, Frame, Variance};
use noisefloor_kernels::regression::dense::{
    Alone, Channel, Fit, Join, Planes, Solver, Weighting, means, naive, regress,
};

fn weighting(frame: &Frame, patch: usize) -> Weighting {
    let (width, height) = (frame.width(), frame.height());
    Weighting { width, height, window: 9, patch, k: 1.0, scale: 1.0, epsilon: 1e-7 }
}

fn guide(frame: &Frame) -> Vec<Channel<'_>> {
    let variance = frame.color.variance.as_ref().map(Variance::mean_variance).expect("a variance");
    let channels = frame.color.mean.planes().zip(variance.planes());
    channels.map(|(value, variance)| Channel { value, variance }).collect()
}

fn of_regression(frame: &Frame) -> (Fit, Planes<'_>) {
    let fit =
        Fit { weighting: weighting(frame, 3), join: Join::Minimum, solver: Solver::Dropped, positions: true };
    let features = [FeatureId::Albedo, FeatureId::Normal, FeatureId::Depth];
    let features = features.iter().filter_map(|id| frame.feature(id)).flat_map(|f| f.mean.planes()).collect();
    let image = [0, 1, 2].map(|c| frame.color.mean.plane(c));
    (fit, Planes { guide: guide(frame), features, image })
}

fn of_means(frame: &Frame) -> Vec<Alone<'_>> {
    let channels = guide(frame).into_iter().zip(frame.color.mean.planes());
    channels.map(|(guide, target)| Alone { guide, targets: vec![target] }).collect()
}

/// Fits and predicts the colour of `frame` once.
pub fn regression(frame: &Frame) {
    let (fit, planes) = of_regression(frame);
    std::hint::black_box(regress(&fit, &planes).expect("valid input"));
}

/// What [`regression`] does, by plain loops in `f64`.
pub fn naive_regression(frame: &Frame) {
    let (fit, planes) = of_regression(frame);
    std::hint::black_box(naive::regress(&fit, &planes).expect("valid input"));
}

/// Filters the colour of `frame` once, each channel by itself, with patches of 3×3 pixels.
pub fn patch_means(frame: &Frame) {
    std::hint::black_box(means(&weighting(frame, 1), &of_means(frame)).expect("valid input"));
}

/// What [`patch_means`] does, by plain loops in `f64`.
pub fn naive_patch_means(frame: &Frame) {
    std::hint::black_box(naive::means(&weighting(frame, 1), &of_means(frame)).expect("valid input"));
}
