//! Adaptive rounds and ranges of samples make the frame that one run makes.

mod common;

use common::cornell;
use glam::Vec3;
use noisefloor_frame::{Counts, Estimate, FeatureId, Frame, Image, Sampling};
use noisefloor_render::{Prepared, Quantity, Recorded, RenderRequest, Rounds, Silent, allocate, render};
use noisefloor_scenes::Body;

const SIZE: (usize, usize) = (20, 14);

fn request(scene: &Prepared, spp: u32) -> RenderRequest<'_> {
    RenderRequest { seed: 7, ..RenderRequest::new(scene, SIZE.0, SIZE.1, spp) }
}

/// Everything but the provenance, which has times in it.
fn bare(mut frame: Frame) -> Frame {
    frame.provenance = Default::default();
    frame
}

fn pixel(image: &Image, at: usize) -> Vec<u32> {
    (0..image.channels()).map(|c| image.plane(c)[at].to_bits()).collect()
}

fn bits(estimate: &Estimate, at: usize) -> Vec<u32> {
    let variance = estimate.variance.as_ref().unwrap().mean_variance();
    let halves = estimate.halves.as_ref().unwrap();
    [&estimate.mean, variance, &halves[0], &halves[1]].into_iter().flat_map(|i| pixel(i, at)).collect()
}

#[test]
fn rounds_give_each_pixel_the_bits_of_one_run_with_its_samples() {
    let still = Prepared::new(&cornell()).unwrap();
    let mut moving = cornell();
    moving.add_body(0.8, Body { meshes: (6..12).collect(), translation: Vec3::X * 0.2, spin: None });
    let moving = Prepared::new(&moving).unwrap();
    // Each kind of record has code of its own.
    let features = [Quantity::Albedo, Quantity::Visibility];
    let both = Recorded::exactly([Quantity::Depth, Quantity::Flash]);
    for (scene, sampling, record) in [
        (&still, Sampling::Independent, Recorded::Available),
        (&still, Sampling::LowDiscrepancy, Recorded::color_only()),
        (&still, Sampling::Independent, Recorded::exactly(features)),
        (&still, Sampling::LowDiscrepancy, Recorded::exactly([Quantity::Flash])),
        (&still, Sampling::Independent, both),
        (&moving, Sampling::LowDiscrepancy, Recorded::Available),
        (&moving, Sampling::Independent, Recorded::color_only()),
    ] {
        let first = RenderRequest { sampling, record, ..request(scene, 3) };
        let mut rounds = Rounds::start(&first, &Silent).unwrap();
        let extra: Vec<u32> = (0..SIZE.0 * SIZE.1).map(|p| [0, 5, 14, 30][p % 4]).collect();
        rounds.add(&extra, &Silent).unwrap();
        let before = bare(rounds.frame().unwrap());
        assert_eq!(before, bare(rounds.frame().unwrap()), "looking changes nothing");
        rounds.add(&extra, &Silent).unwrap();
        let frame = bare(rounds.frame().unwrap());
        assert_eq!(rounds.counts(), extra.iter().map(|n| 3 + 2 * n).collect::<Vec<_>>());
        assert_eq!(*frame.samples.total(), Counts::PerPixel(rounds.counts()));
        for (class, spp) in [3, 13, 31, 63].into_iter().enumerate() {
            let whole = render(&RenderRequest { spp, ..first.clone() }, &Silent).unwrap();
            for at in (class..SIZE.0 * SIZE.1).step_by(4) {
                assert_eq!(bits(&frame.color, at), bits(&whole.color, at), "pixel {at} of {spp} samples");
                assert_eq!(frame.samples.halves_at(at), whole.samples.halves_at(at));
                for (id, feature) in frame.features.iter().filter(|(id, _)| **id != FeatureId::Material) {
                    assert_eq!(bits(feature, at), bits(&whole.features[id], at), "{id:?}");
                }
            }
        }
    }
}

#[test]
fn uniform_rounds_are_one_run() {
    let scene = Prepared::new(&cornell()).unwrap();
    let mut rounds = Rounds::start(&request(&scene, 8), &Silent).unwrap();
    rounds.add(&[13; SIZE.0 * SIZE.1], &Silent).unwrap();
    assert_eq!(bare(rounds.frame().unwrap()), bare(render(&request(&scene, 21), &Silent).unwrap()));
}

#[test]
fn four_ranges_make_one_run() {
    let scene = Prepared::new(&cornell()).unwrap();
    // Blocks of 16: aligned ranges have equal bits, others the rounding of f64 (below one step of f32 almost everywhere).
    for (length, exact) in [(32, true), (24, false), (7, false)] {
        let part = |k: u32| {
            let range = RenderRequest { sample_start: k * length, ..request(&scene, length) };
            Rounds::start(&range, &Silent).unwrap()
        };
        let mut joined = part(0);
        for k in 1..4 {
            joined.append(&part(k)).unwrap();
        }
        let (joined, whole) =
            (joined.frame().unwrap(), render(&request(&scene, 4 * length), &Silent).unwrap());
        assert_eq!(joined.samples, whole.samples);
        let variance = |f: &Frame| f.color.variance.as_ref().unwrap().mean_variance().clone();
        if exact {
            assert_eq!(joined.color.mean, whole.color.mean);
            assert_eq!(variance(&joined), variance(&whole));
        }
        let halves = |f: &Frame| f.color.halves.clone().unwrap();
        let pairs = [
            (joined.color.mean.clone(), whole.color.mean.clone()),
            (variance(&joined), variance(&whole)),
            (halves(&joined)[0].clone(), halves(&whole)[0].clone()),
            (halves(&joined)[1].clone(), halves(&whole)[1].clone()),
        ];
        for (a, b) in pairs {
            for (a, b) in a.data().iter().zip(b.data()) {
                assert!((a - b).abs() <= f32::EPSILON * a.abs().max(b.abs()), "{a} and {b}");
            }
        }
    }
}

#[test]
fn rounds_are_equal_for_any_number_of_threads() {
    let scene = Prepared::new(&cornell()).unwrap();
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut rounds = Rounds::start(&request(&scene, 4), &Silent).unwrap();
            let noisy = rounds.frame().unwrap();
            let variance = noisy.color.variance.as_ref().unwrap().mean_variance().plane(1).to_vec();
            let density: Vec<f64> = variance.into_iter().map(f64::from).collect();
            let extra = allocate(&density, 8 * density.len() as u64, 0..=64).unwrap();
            rounds.add(&extra, &Silent).unwrap();
            assert_eq!(rounds.density().unwrap().data().iter().sum::<f32>(), 12.0 * density.len() as f32);
            bare(rounds.frame().unwrap())
        })
    };
    assert!(on(1) == on(4), "bits differ");
}

#[test]
fn what_does_not_fit_is_refused() {
    let scene = Prepared::new(&cornell()).unwrap();
    let told = |r: Result<(), _>| r.map_err(|e: noisefloor_render::RenderError| e.to_string()).unwrap_err();
    assert!(told(Rounds::start(&request(&scene, 1), &Silent).map(|_| ())).contains("at least 2"));
    let mut rounds = Rounds::start(&request(&scene, 2), &Silent).unwrap();
    assert!(told(rounds.add(&[1; 3], &Silent)).contains("one per pixel"));
    let mut many = vec![0; SIZE.0 * SIZE.1];
    many[5] = u32::MAX;
    assert!(told(rounds.add(&many, &Silent)).contains("in pixel 5"));
    let gap = RenderRequest { sample_start: 4, ..request(&scene, 2) };
    assert!(told(rounds.append(&Rounds::start(&gap, &Silent).unwrap())).contains("where pixel 0 ends"));
    let other = RenderRequest { sample_start: 2, seed: 8, ..request(&scene, 2) };
    assert!(told(rounds.append(&Rounds::start(&other, &Silent).unwrap())).contains("random seed"));
    assert_eq!(rounds.counts(), [2; SIZE.0 * SIZE.1]);
}
