//! What the recorded statistics mean, and that they do not depend on threads.

mod common;

use common::*;
use noisefloor_frame::{Estimate, FeatureId, Frame, PixelFilter, Sampling};
use noisefloor_render::{Prepared, Recorded, RenderRequest, Silent, render, render_reference};

/// The same request with every random seed of a range.
fn frames(request: &RenderRequest<'_>, seeds: std::ops::Range<u64>) -> Vec<Frame> {
    seeds.map(|seed| render(&RenderRequest { seed, ..request.clone() }, &Silent).unwrap()).collect()
}

/// Per pixel: unbiased variance over frames of one value.
fn between(values: &[Vec<f64>], pixel: usize) -> f64 {
    let n = values.len() as f64;
    let mean = values.iter().map(|v| v[pixel]).sum::<f64>() / n;
    values.iter().map(|v| (v[pixel] - mean).powi(2)).sum::<f64>() / (n - 1.0)
}

/// Sum of independent differences of expectation zero over its standard deviation.
fn z_score(differences: &[f64]) -> f64 {
    let sum: f64 = differences.iter().sum();
    let squares: f64 = differences.iter().map(|d| d * d).sum();
    sum / squares.sqrt()
}

fn plane(image: &noisefloor_frame::Image, channel: usize) -> Vec<f64> {
    image.plane(channel).iter().map(|&v| f64::from(v)).collect()
}

#[test]
fn frames_are_equal_for_any_number_of_threads() {
    let scene = Prepared::new(&cornell()).unwrap();
    for sampling in [Sampling::Independent, Sampling::LowDiscrepancy] {
        let request = RenderRequest { sampling, ..RenderRequest::new(&scene, 40, 30, 19) };
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let mut frame = render(&request, &Silent).unwrap();
                let mut reference =
                    render_reference(&RenderRequest { spp: 16, ..request.clone() }, 8, &Silent).unwrap();
                frame.provenance = Default::default();
                reference.frame.provenance = Default::default();
                (frame, reference)
            })
        };
        assert!(on(1) == on(4), "bits differ");
    }
}

#[test]
fn sample_variance_over_n_is_the_variance_between_seeds() {
    let scene = Prepared::new(&cornell()).unwrap();
    let request =
        RenderRequest { record: Recorded::color_only(), depth: 4, ..RenderRequest::new(&scene, 24, 18, 8) };
    let frames = frames(&request, 0..40);
    for channel in 0..3 {
        let means: Vec<_> = frames.iter().map(|f| plane(&f.color.mean, channel)).collect();
        let within: Vec<_> = frames
            .iter()
            .map(|f| plane(f.color.variance.as_ref().unwrap().mean_variance(), channel))
            .collect();
        let differences: Vec<f64> = (0..24 * 18)
            .map(|p| between(&means, p) - within.iter().map(|v| v[p]).sum::<f64>() / within.len() as f64)
            .collect();
        let z = z_score(&differences);
        assert!(z.abs() < 4.0, "channel {channel}: {z}");
    }
}

#[test]
fn half_buffers_agree_with_the_mean_and_are_independent() {
    let scene = Prepared::new(&cornell()).unwrap();
    for sampling in [Sampling::Independent, Sampling::LowDiscrepancy] {
        let request = RenderRequest {
            record: Recorded::color_only(),
            sampling,
            depth: 4,
            ..RenderRequest::new(&scene, 24, 18, 15)
        };
        let frames = frames(&request, 0..40);
        let halves = |f: &Frame, h: usize| plane(&f.color.halves.as_ref().unwrap()[h], 1);
        assert_eq!(frames[0].samples.halves_at(0), (8, 7));
        for f in &frames {
            let (a, b, mean) = (halves(f, 0), halves(f, 1), plane(&f.color.mean, 1));
            for p in 0..mean.len() {
                let whole = (8.0 * a[p] + 7.0 * b[p]) / 15.0;
                assert!((whole - mean[p]).abs() <= 1e-6 * mean[p].abs() + 1e-12);
            }
        }
        // Covariance of the halves over the random seeds has expectation zero in every pixel.
        let n = frames.len() as f64;
        let covariances: Vec<f64> = (0..24 * 18)
            .map(|p| {
                let (a, b): (Vec<f64>, Vec<f64>) =
                    frames.iter().map(|f| (halves(f, 0)[p], halves(f, 1)[p])).unzip();
                let (ma, mb) = (a.iter().sum::<f64>() / n, b.iter().sum::<f64>() / n);
                a.iter().zip(&b).map(|(a, b)| (a - ma) * (b - mb)).sum::<f64>() / (n - 1.0)
            })
            .collect();
        let z = z_score(&covariances);
        assert!(z.abs() < 4.0, "{sampling:?}: {z}");
    }
}

#[test]
fn low_discrepancy_error_is_smaller_than_independent_error_at_equal_samples() {
    let scene = Prepared::new(&cornell()).unwrap();
    let spread = |sampling| {
        let request = RenderRequest {
            record: Recorded::color_only(),
            sampling,
            depth: 3,
            ..RenderRequest::new(&scene, 16, 12, 128)
        };
        let means: Vec<_> = frames(&request, 0..12).iter().map(|f| plane(&f.color.mean, 1)).collect();
        (0..16 * 12).map(|p| between(&means, p)).sum::<f64>()
    };
    let ratio = spread(Sampling::LowDiscrepancy) / spread(Sampling::Independent);
    assert!(ratio < 0.5, "{ratio}");
}

#[test]
fn ranges_of_samples_join_to_the_whole() {
    let scene = Prepared::new(&cornell()).unwrap();
    for sampling in [Sampling::Independent, Sampling::LowDiscrepancy] {
        let whole = RenderRequest { sampling, ..RenderRequest::new(&scene, 12, 9, 80) };
        let all = render(&whole, &Silent).unwrap();
        let first = render(&RenderRequest { spp: 33, ..whole.clone() }, &Silent).unwrap();
        let rest = render(&RenderRequest { sample_start: 33, spp: 47, ..whole.clone() }, &Silent).unwrap();
        assert_eq!((first.samples.halves_at(0), rest.samples.halves_at(0)), ((17, 16), (23, 24)));
        let join = |a: &Estimate, b: &Estimate, all: &Estimate| {
            for ((a, b), all) in a.mean.data().iter().zip(b.mean.data()).zip(all.mean.data()) {
                let joined = (f64::from(*a) * 33.0 + f64::from(*b) * 47.0) / 80.0;
                assert!((joined - f64::from(*all)).abs() <= 2e-6 * joined.abs() + 1e-7);
            }
        };
        join(&first.color, &rest.color, &all.color);
        for (id, feature) in &all.features {
            // The material is the first sample's, and visibility a ratio of two counts.
            if !matches!(id, FeatureId::Material | FeatureId::Visibility) {
                join(&first.features[id], &rest.features[id], feature);
            }
        }
    }
}

#[test]
fn a_reference_agrees_with_independent_frames() {
    let scene = Prepared::new(&cornell()).unwrap();
    let request = RenderRequest { depth: 5, ..RenderRequest::new(&scene, 16, 12, 512) };
    let reference = render_reference(&request, 8, &Silent).unwrap();
    assert_eq!((reference.parts.len(), reference.frame.samples.at(0)), (8, 512));
    assert_eq!(reference.frame.sampling, Sampling::LowDiscrepancy);
    assert!(reference.frame.features.values().all(|f| f.variance.is_none() && f.halves.is_none()));
    let frame = render(&request, &Silent).unwrap();
    let variance = |f: &Frame| plane(f.color.variance.as_ref().unwrap().mean_variance(), 0);
    let (a, b) = (plane(reference.mean(), 0), plane(&frame.color.mean, 0));
    let (va, vb) = (variance(&reference.frame), variance(&frame));
    let difference = a.iter().zip(&b).map(|(a, b)| a - b).sum::<f64>();
    let error = va.iter().zip(&vb).map(|(a, b)| a + b).sum::<f64>().sqrt();
    assert!(difference.abs() < 4.5 * error, "{difference} ± {error}");
}

#[test]
fn one_sample_has_neither_variance_nor_halves() {
    let scene = Prepared::new(&cornell()).unwrap();
    let frame = render(&RenderRequest::new(&scene, 5, 4, 1), &Silent).unwrap();
    assert!(frame.color.variance.is_none() && frame.color.halves.is_none());
    assert!(frame.features.values().all(|f| f.variance.is_none()));
}

#[test]
fn rays_through_pixel_centres_see_exact_features() {
    let scene = Prepared::new(&cornell()).unwrap();
    let request = RenderRequest { filter: PixelFilter::Point, ..RenderRequest::new(&scene, 16, 12, 6) };
    let frame = render(&request, &Silent).unwrap();
    for id in ["albedo", "normal", "depth"] {
        let feature = &frame.features[&noisefloor_frame::FeatureId::from_name(id)];
        let variance = feature.variance.as_ref().unwrap().mean_variance();
        assert!(variance.data().iter().all(|&v| v == 0.0), "{id} varies inside a point");
        assert!(feature.mean.data().iter().any(|&v| v != 0.0));
    }
}
