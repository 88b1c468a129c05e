//! Frames of an animation: what neighbours change, and what they must not.

use super::*;

/// Frames of one scene, each with noise of its own.
fn moments(count: u64, spp: u32) -> Vec<Frame> {
    let scene = gaussian_edge(0.8);
    (0..count).map(|moment| scene.render(spp, 50 + moment)).collect()
}

fn run_at(params: &Params, frames: &[Frame], at: usize) -> Output {
    let input = Input::new(&frames[at]).with_neighbors(&frames[..at], &frames[at + 1..]);
    VirtualFlash::new(params.clone()).unwrap().denoise(&input).unwrap()
}

fn with_neighbors(neighbors: usize) -> Params {
    Params { neighbors, ..Params::default() }
}

#[test]
fn one_step_and_two_conform_with_neighbors() {
    for params in steps() {
        assert_conforms(&VirtualFlash::new(Params { neighbors: 2, ..params }).unwrap());
    }
}

#[test]
fn none_are_looked_at_unless_asked_for_and_none_are_missed_where_there_are_none() {
    let frames = moments(3, 16);
    for params in steps() {
        let alone = run(params.clone(), &frames[1]);
        assert_eq!(run_at(&params, &frames, 1).image, alone.image);
        let asked = Params { neighbors: 5, ..params };
        assert_eq!(run(asked.clone(), &frames[1]).image, alone.image);
        assert_ne!(run_at(&asked, &frames, 1).image, alone.image);
        assert_eq!(VirtualFlash::new(asked).unwrap().card().neighbors, 5);
    }
}

#[test]
fn only_as_many_as_asked_for_are_looked_at() {
    let frames = moments(5, 16);
    let near = run_at(&with_neighbors(1), &frames[1..4], 1);
    assert_eq!(run_at(&with_neighbors(1), &frames, 2).image, near.image);
}

#[test]
fn errors_fall_and_change_less_from_frame_to_frame() {
    let truth = gaussian_edge(0.8).truth();
    let frames = moments(5, 8);
    let measure = |neighbors| {
        let params = with_neighbors(neighbors);
        let errors: Vec<Image> = (0..frames.len())
            .map(|at| run_at(&params, &frames, at).image.zip_map(truth.mean(), |a, b| a - b))
            .collect();
        let n = errors.len() as f64;
        let (mut squares, mut flicker) = (0.0, 0.0);
        for i in 0..errors[0].data().len() {
            let values = errors.iter().map(|e| f64::from(e.data()[i]));
            let mean = values.clone().sum::<f64>() / n;
            squares += values.clone().map(|v| v * v).sum::<f64>();
            flicker += values.map(|v| (v - mean).powi(2)).sum::<f64>();
        }
        (squares, flicker)
    };
    let (alone, one, two) = (measure(0), measure(1), measure(2));
    assert!(one.0 < 0.8 * alone.0 && two.0 < one.0, "squared error: {alone:?}, {one:?}, {two:?}");
    assert!(one.1 < 0.5 * alone.1 && two.1 < 0.7 * one.1, "flicker: {alone:?}, {one:?}, {two:?}");
}

#[test]
fn output_lies_in_the_claimed_interval_whatever_the_neighbors() {
    let mut frames: Vec<Frame> = (0..4).map(wild_frame).collect();
    frames[3].samples = Samples::uniform(3);
    for test in [TestKind::Joint, TestKind::PerChannel] {
        for params in steps() {
            let params = Params { neighbors: 3, test, ..params };
            let method = VirtualFlash::new(params.clone()).unwrap();
            let claim = method.card().claims.enclosure.remove(0);
            for at in [0, 2] {
                let out = run_at(&params, &frames, at);
                assert_ne!(out.image, run(params.clone(), &frames[at]).image);
                let variance = frames[at].color.variance.as_ref().unwrap().mean_variance();
                let samples = &frames[at].samples;
                let widths: Vec<(f64, Image)> = claim
                    .terms
                    .iter()
                    .map(|&(factor, level)| (factor, half_widths(variance, samples, level)))
                    .collect();
                for (i, (&d, &x)) in out.image.data().iter().zip(frames[at].color.mean.data()).enumerate() {
                    let width: f64 = widths.iter().map(|(k, w)| k * f64::from(w.data()[i])).sum();
                    let (d, x) = (f64::from(d), f64::from(x));
                    let allowed = width * (1.0 + 1e-6) + 8.0 * f64::from(f32::EPSILON) * x.abs().max(d.abs());
                    assert!((d - x).abs() <= allowed, "{params:?}: value {i}: |{d} − {x}| > {allowed}");
                }
            }
        }
    }
}

#[test]
fn every_kind_of_guide_test_and_spread_takes_neighbors() {
    let frames = moments(3, 16);
    for guide in [GuideKind::Flash, GuideKind::Color, GuideKind::None] {
        for test in [TestKind::Joint, TestKind::PerChannel, TestKind::Luminance] {
            for second_spread in SPREADS {
                let params = Params { guide, test, second_spread, ..with_neighbors(1) };
                let out = run_at(&params, &frames, 1).image;
                assert_ne!(out, run(params.clone(), &frames[1]).image, "{params:?}");
                assert!(out.data().iter().all(|v| v.is_finite()), "{params:?}");
            }
        }
    }
}

#[test]
fn a_power_of_two_of_exposure_scales_the_output_exactly() {
    let frames = moments(3, 16);
    let k = 4096.0;
    let scaled = |e: &Estimate| Estimate {
        mean: e.mean.map(|v| v * k),
        variance: e.variance.clone().map(|v| Variance::of_mean(v.into_mean_variance().map(|v| v * k * k))),
        halves: e.halves.clone().map(|h| h.map(|h| h.map(|v| v * k))),
    };
    let brighter: Vec<Frame> = frames
        .iter()
        .map(|frame| {
            let mut brighter = frame.clone();
            brighter.color = scaled(&frame.color);
            let Some(Flash::Parts { base, light, covariance }) = &frame.flash else {
                panic!("the scene has a flash")
            };
            brighter.flash = Some(Flash::Parts {
                base: scaled(base),
                light: scaled(light),
                covariance: covariance.as_ref().map(|c| c.map(|v| v * k * k)),
            });
            brighter
        })
        .collect();
    let params = with_neighbors(1);
    assert_eq!(run_at(&params, &brighter, 1).image, run_at(&params, &frames, 1).image.map(|v| v * k));
}

#[test]
fn diagnostics_show_the_sets_of_every_frame_one_below_the_other() {
    let frames = moments(5, 16);
    let params = with_neighbors(2);
    let plain = run_at(&params, &frames, 1);
    let input = Input::new(&frames[1])
        .with_neighbors(&frames[..1], &frames[2..])
        .with_diagnostics(Diagnostics::On { probe: Some((20, 11)) });
    let full = VirtualFlash::new(params).unwrap().denoise(&input).unwrap();
    assert_eq!(full.image, plain.image);
    let find = |name: &str| &full.diagnostics.iter().find(|d| d.name == name).unwrap().image;
    for (step, side) in [("step 1", 7), ("step 2", 31)] {
        let set = find(&format!("homogeneous set of the probe, {step}"));
        let counts = find(&format!("homogeneous pixels, {step}"));
        // One frame before the target and two after it.
        assert_eq!((set.width(), set.height()), (side, 4 * side));
        assert_eq!(set.get(0, side / 2, side + side / 2), 1.0);
        assert_eq!(set.plane(0).iter().sum::<f32>(), counts.get(0, 20, 11));
    }
    assert!(find("after step 1").same_shape(&frames[1].color.mean));
}

#[test]
fn a_neighbor_without_an_input_or_an_answer_is_refused() {
    let frames = moments(2, 16);
    let refused = |change: &dyn Fn(&mut Frame)| {
        let mut frames = frames.clone();
        change(&mut frames[1]);
        let input = Input::new(&frames[0]).with_neighbors(&[], &frames[1..]);
        let alone = VirtualFlash::default().denoise(&input);
        assert!(alone.is_ok(), "it is looked at only where asked for");
        VirtualFlash::new(with_neighbors(1)).unwrap().denoise(&input).unwrap_err()
    };
    let error = refused(&|frame| frame.flash = None);
    assert!(matches!(&error, DenoiseError::MissingInputs { missing, .. } if missing.contains(&Need::Flash)));
    let error = refused(&|frame| frame.color.mean.set(1, 5, 3, f32::NAN)).to_string();
    assert!(error.contains("colour of a neighbouring frame") && error.contains("(5, 3)"), "{error}");
}
