//! One window of robust first-order regression, fast and with its hat matrix.

use noisefloor_kernels::InstructionSet;
use noisefloor_kernels::regression::models::{Distances, Field, Planes, Rules, Start, Window, naive::Twin};

use crate::method_frame;

/// Hands over two calls that do the same work: a window of radius 10 with one bandwidth and two steps of its error, by
/// moments and by the n×n hat matrix.
pub fn one_model(timed: impl FnOnce(&mut dyn FnMut(), &mut dyn FnMut())) {
    let frame = method_frame(64, 64, false);
    let color = &frame.color.mean;
    let (m, v) = ([0, 1, 2].map(|c| color.plane(c)), vec![0.0025f32; 64 * 64]);
    let ones = vec![1.0f32; 64 * 64];
    let features = frame.features.values().flat_map(|f| f.mean.planes()).take(7).collect();
    let planes = Planes {
        guide: m,
        guide_variance: [&v, &v, &v],
        target: m,
        variance: &v,
        importance: &ones,
        features,
    };
    let rules =
        Rules { patch_radius: 3, range_sigma: 1.0, bandwidths: vec![2.0], least_weight: 1e-6, ridge: 1e-3 };
    let field = Field::new(64, 64, &planes, rules.clone()).expect("sound planes");
    let (mut window, level) = (Window::new(&field, 10), InstructionSet::in_use());
    let mut by_moments = || {
        window.open(&field, (32, 32), 10, &Distances::default(), level);
        window.weigh(&field, 0, level);
        window.step(&field, 0, Start::First, level);
        window.step(&field, 0, Start::Own, level);
        window.fit(&field, 0, false, level);
    };
    let mut by_hat_matrix = || {
        let twin = Twin::new((64, 64), &planes, &rules, (32, 32), 10, 2.0);
        let mut variance = vec![0.0025; twin.pixels.len()];
        for _ in 0..2 {
            for plane in m {
                let y: Vec<f64> = twin.pixels.iter().map(|p| f64::from(plane[*p])).collect();
                std::hint::black_box(twin.times(&y));
            }
            variance = twin.variance(&variance);
        }
        std::hint::black_box(variance);
    };
    timed(&mut by_moments, &mut by_hat_matrix);
}
