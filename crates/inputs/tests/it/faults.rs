use noisefloor_frame::{Estimate, FindingKind, Frame, Image, Reference, Sampling, Variance};
use noisefloor_inputs::{Against, Mean, among};
use noisefloor_synthetic::SampleLaw;

use crate::common::{GAUSSIAN, REFERENCE_SPP, check, first, found, reference, scene};

/// `frame` with its stated variance multiplied.
fn stated(frame: &Frame, factor: f32) -> Frame {
    let mut out = frame.clone();
    let variance = out.color.variance.take().unwrap().into_mean_variance();
    out.color.variance = Some(Variance::of_mean(variance.map(|v| v * factor)));
    out
}

fn without_halves(mut frame: Frame) -> Frame {
    frame.color.halves = None;
    frame
}

#[test]
fn a_variance_that_is_off_by_the_sample_count_is_told_from_the_reference() {
    for (law, width, height) in [(GAUSSIAN, 40, 30), (SampleLaw::Exponential, 64, 48)] {
        let scene = scene(law, width, height);
        for truth in [reference(&scene), scene.truth()] {
            for spp in [4u32, 16, 64] {
                let frame = without_halves(scene.render(spp, 5));
                for (power, words) in [(1.0, "not divided"), (-1.0, "divided by their number twice")] {
                    let factor = f64::from(spp).powf(power);
                    let told =
                        first(&truth, &stated(&frame, factor as f32), FindingKind::VarianceAgainstReference);
                    // The reference adds at most 64/256 of the frame's own variance to both sides.
                    let value = told.value.unwrap();
                    assert!((value / factor).ln().abs() < 0.35, "{told} {value} {factor}");
                    assert!(told.text.contains(words) && told.standard_errors.unwrap() > 5.0, "{told}");
                }
            }
        }
    }
}

#[test]
fn a_frame_that_is_one_percent_too_bright_is_told() {
    let scene = scene(GAUSSIAN, 96, 64);
    let truth = reference(&scene);
    // z = 0.01·√6144 / (0.5/√64) = 12.5 without the reference's noise.
    let mut frame = scene.render(64, 7);
    for image in std::iter::once(&mut frame.color.mean).chain(frame.color.halves.iter_mut().flatten()) {
        *image = image.map(|v| v * 1.01);
    }
    let told = first(&truth, &frame, FindingKind::Brightness);
    let z = told.standard_errors.unwrap();
    assert!(told.text.contains("brighter") && (9.0..15.0).contains(&z), "{told}");
}

#[test]
fn frames_that_are_together_too_bright_are_told_where_none_is_alone() {
    let scene = scene(GAUSSIAN, 64, 48);
    let truth = reference(&scene);
    let against = Against::new(&truth, Some(REFERENCE_SPP));
    // z of one = 0.007·√3072 / (0.5/√16) = 3.1; of four with the reference's noise 0.5/√256 in common: 5.5.
    let sketches: Vec<_> = (0..4)
        .map(|seed| {
            let mut frame = scene.render(16, seed);
            frame.color.mean = frame.color.mean.map(|v| v * 1.007);
            let check = against.frame(&frame, &[], Mean::OfTheReference);
            assert!(check.findings.is_empty(), "{:?}", check.findings);
            (format!("replicate {seed}"), check.sketch)
        })
        .collect();
    let found = among(&against, &sketches);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].kind == FindingKind::Brightness && found[0].text.contains("together"), "{found:?}");
}

#[test]
fn light_that_is_missing_in_a_corner_is_told_by_its_blocks() {
    let scene = scene(GAUSSIAN, 96, 64);
    let truth = reference(&scene);
    let mut frame = scene.render(64, 7);
    for c in 0..3 {
        for y in 0..16 {
            for x in 0..16 {
                let (v, other) = (frame.color.mean.get(c, x, y), frame.color.mean.get(c, 95 - x, 63 - y));
                frame.color.mean.set(c, x, y, v * 0.8);
                // As much light as is missing, so that the image's mean is the same.
                frame.color.mean.set(c, 95 - x, 63 - y, other * 1.2);
            }
        }
    }
    let told = first(&truth, &frame, FindingKind::Brightness);
    assert!(told.text.contains("blocks of 8×8"), "{told}");
}

/// A frame whose samples are the first of the reference's, as with one seed for both.
fn prefix(n: u32, long: u32) -> (Frame, Reference) {
    let scene = scene(GAUSSIAN, 64, 48);
    let reference = scene.render(long, 3);
    (scene.render(n, 3), Reference { frame: reference, parts: Vec::new() })
}

#[test]
fn a_frame_whose_samples_are_in_the_reference_is_told_from_the_data() {
    for (n, long) in [(16, 256), (64, 256), (4, 256), (16, 1024)] {
        let (frame, truth) = prefix(n, long);
        let told = Against::new(&truth, Some(long.into())).frame(&frame, &[], Mean::OfTheReference).findings;
        assert_eq!(told.first().map(|f| f.kind), Some(FindingKind::Dependent), "{n} of {long}: {told:?}");
    }
    // Without half buffers the distance is too small, if the frame is not a tiny part of the reference.
    for (n, long) in [(64, 256), (64, 512)] {
        let (frame, mut truth) = prefix(n, long);
        truth.frame.color.halves = None;
        let told =
            Against::new(&truth, Some(long.into())).frame(&without_halves(frame), &[], Mean::OfTheReference);
        let told = told.findings;
        assert_eq!(told.first().map(|f| f.kind), Some(FindingKind::Dependent), "{n} of {long}: {told:?}");
    }
}

#[test]
fn a_frame_that_is_part_of_one_half_of_the_reference_is_told() {
    let scene = scene(GAUSSIAN, 64, 48);
    let frame = scene.render(16, 9);
    let mut parts: Vec<Image> = (0..8).map(|k| scene.render(64, 100 + k).color.mean).collect();
    // One part goes on from the frame's samples.
    parts[2] = scene.render(64, 9).color.mean;
    let truth = Reference::from_parts(parts, 64, Sampling::Independent).unwrap();
    first(&truth, &frame, FindingKind::Dependent);
    // Without half buffers of its own as well.
    first(&truth, &without_halves(frame), FindingKind::Dependent);
}

#[test]
fn equal_planes_are_told_before_anything_else() {
    let scene = scene(GAUSSIAN, 64, 48);
    let truth = reference(&scene);
    let mut frame = scene.render(64, 9);
    frame.color.mean = truth.parts[3].clone();
    assert!(first(&truth, &frame, FindingKind::EqualData).text.contains("part 3"));
    let mut frame = scene.render(64, 9);
    let plane = truth.mean().plane(1).to_vec();
    frame.color.mean.plane_mut(1).copy_from_slice(&plane);
    assert!(first(&truth, &frame, FindingKind::EqualData).text.contains("mean, G"));
    let mut frame = scene.render(64, 9);
    frame.color.halves = frame.color.halves.map(|[a, _]| [a.clone(), a]);
    first(&truth, &frame, FindingKind::EqualData);
    let mut twins = truth.clone();
    twins.parts[5] = twins.parts[1].clone();
    let alone = Against::new(&twins, None).alone();
    assert!(alone[0].text.contains("part 1") && alone[0].text.contains("part 5"), "{alone:?}");
}

#[test]
fn frames_that_share_samples_or_data_among_each_other_are_told() {
    let scene = scene(GAUSSIAN, 64, 48);
    let truth = reference(&scene);
    let against = Against::new(&truth, Some(REFERENCE_SPP));
    for halves in [true, false] {
        let sketch = |spp, seed| {
            let frame = scene.render(spp, seed);
            let frame = if halves { frame } else { without_halves(frame) };
            (format!("{spp} spp, seed {seed}"), against.frame(&frame, &[], Mean::OfTheReference).sketch)
        };
        let shared = among(&against, &[sketch(16, 1), sketch(64, 2), sketch(16, 2)]);
        assert_eq!(shared.len(), 1, "{shared:?}");
        assert_eq!(shared[0].kind, FindingKind::Dependent);
        assert_eq!(shared[0].subject, "64 spp, seed 2 and 16 spp, seed 2");
        let equal = among(&against, &[sketch(16, 1), sketch(16, 4), sketch(16, 1)]);
        assert_eq!(equal.iter().map(|f| f.kind).collect::<Vec<_>>(), [FindingKind::EqualData]);
    }
}

fn with_mean(frame: &Frame, edit: impl Fn(&Image) -> Image) -> Frame {
    let mut out = frame.clone();
    out.color.mean = edit(&out.color.mean);
    for half in out.color.halves.iter_mut().flatten() {
        *half = edit(half);
    }
    out
}

fn with_reference(truth: &Reference, edit: impl Fn(&Image) -> Image) -> Reference {
    let mut out = truth.clone();
    out.frame = with_mean(&truth.frame, &edit);
    out.parts = truth.parts.iter().map(edit).collect();
    out
}

fn encoded(image: &Image) -> Image {
    image.map(|v| if v <= 0.003_130_8 { 12.92 * v } else { 1.055 * v.powf(1.0 / 2.4) - 0.055 })
}

fn moved(image: &Image, from: impl Fn(usize, usize) -> (usize, usize)) -> Image {
    Image::from_fn(image.width(), image.height(), 3, |c, x, y| {
        let (x, y) = from(x, y);
        image.get(c, x.min(image.width() - 1), y.min(image.height() - 1))
    })
}

#[test]
fn another_picture_is_told_with_what_makes_it_fit() {
    // An image without symmetry: a ramp, edges and texture, coloured.
    let scene = scene(GAUSSIAN, 64, 48);
    let colour = |image: &Image| {
        Image::from_fn(image.width(), image.height(), 3, |c, x, y| {
            image.get(c, x, y) * [1.0, 0.6, 0.3][c] * (0.5 + x as f32 / 64.0 + (y as f32 / 48.0).powi(2))
        })
    };
    let truth = with_reference(&reference(&scene), colour);
    let (width, height) = (64, 48);
    type Edit<'a> = &'a dyn Fn(&Image) -> Image;
    for spp in [1, 4, 64] {
        let frame = with_mean(&scene.render(spp, 11), colour);
        assert!(found(&truth, &frame).is_empty(), "{spp}: {:?}", found(&truth, &frame));
        let cases: [(Edit<'_>, &str); 9] = [
            (&|i| i.map(|v| v * 0.5), "exposure −1 stop"),
            (&|i| i.map(|v| v * 4.0), "exposure +2 stops"),
            (&|i| i.map(|v| v * 1.4), "a factor of 1."),
            (&|i| encoded(i), "undoing the sRGB curve of the frame"),
            (&|i| moved(i, |x, y| (width - 1 - x, y)), "a flip from left to right"),
            (&|i| moved(i, |x, y| (x, height - 1 - y)), "a flip upside down"),
            (&|i| moved(i, |x, y| (width - 1 - x, height - 1 - y)), "a turn by 180°"),
            (&|i| moved(i, |x, y| (x + 2, y + 1)), "a shift of the reference by (-2, -1)"),
            (
                &|i| Image::from_fn(width, height, 3, |c, x, y| i.get(2 - c, x, y)),
                "the channels in the order B, G, R",
            ),
        ];
        for (edit, words) in cases {
            let told = found(&truth, &with_mean(&frame, edit));
            let told = told.first().unwrap_or_else(|| panic!("{spp} spp, {words}: nothing"));
            assert!(
                told.kind == FindingKind::DifferentPicture && told.text.contains(words),
                "{spp} spp, {words}: {told}"
            );
        }
        let told = first(&with_reference(&truth, encoded), &frame, FindingKind::DifferentPicture);
        assert!(told.text.contains("undoing the sRGB curve of the reference"), "{told}");
    }
}

#[test]
fn images_of_bad_denoisers_are_no_other_picture_and_those_of_another_exposure_are() {
    let scene = scene(GAUSSIAN, 64, 48);
    let truth = reference(&scene);
    let against = Against::new(&truth, None);
    let noisy = scene.render(4, 3).color.mean;
    let blurred = |radius: i64| {
        Image::from_fn(64, 48, 3, |c, x, y| {
            let (mut sum, mut n) = (0.0, 0.0);
            for dy in -radius..=radius {
                for dx in -radius..=radius {
                    let (x, y) = (x as i64 + dx, y as i64 + dy);
                    if (0..64).contains(&x) && (0..48).contains(&y) {
                        sum += noisy.get(c, x as usize, y as usize);
                        n += 1.0;
                    }
                }
            }
            sum / n
        })
    };
    let bad = [
        noisy.clone(),
        blurred(1),
        blurred(8),
        blurred(40),
        Image::new(64, 48, 3),
        Image::filled(64, 48, 3, 0.3),
        noisy.map(|v| v.min(0.3)),
        noisy.map(|v| v * 0.85),
        Image::from_fn(64, 48, 3, |c, x, y| f32::from((c * 31 + x * 17 + y * 7) as u8) / 255.0),
    ];
    for (k, image) in bad.iter().enumerate() {
        assert!(against.image(image).is_empty(), "{k}: {:?}", against.image(image));
    }
    for (edit, words) in [
        (&(|i: &Image| i.map(|v| v * 2.0)) as &dyn Fn(&Image) -> Image, "exposure +1 stop"),
        (&encoded, "sRGB curve of the frame"),
        (&|i| moved(i, |x, y| (63 - x, y)), "a flip"),
    ] {
        let told = against.image(&edit(&blurred(1)));
        assert!(told.len() == 1 && told[0].text.contains(words), "{words}: {told:?}");
    }
    let same = against.image(truth.mean());
    assert_eq!(same[0].kind, FindingKind::EqualData);
    assert!(against.image(&Image::new(3, 3, 3)).is_empty(), "another size is not looked at");
}

#[test]
fn invalid_pixels_and_odd_sizes_are_left_out() {
    let scene = scene(GAUSSIAN, 64, 48);
    let truth = reference(&scene);
    let mut frame = scene.render(16, 2);
    let mut invalid = vec![false; 64 * 48];
    for p in (0..64 * 48).step_by(5) {
        invalid[p] = true;
        for c in 0..3 {
            frame.color.mean.plane_mut(c)[p] = 1e6;
        }
    }
    let found = Against::new(&truth, Some(REFERENCE_SPP)).frame(&frame, &invalid, Mean::OfTheReference);
    assert!(found.findings.is_empty(), "{:?}", found.findings);
    for (width, height) in [(1, 1), (1, 7), (5, 4), (50, 1)] {
        let scene = scene.resized(width, height).unwrap();
        assert!(check(&reference(&scene), &scene.render(16, 1)).findings.is_empty());
    }
    let bare = Frame::from_color(
        Estimate::from_mean(Image::new(64, 48, 3)),
        frame.samples,
        Sampling::LowDiscrepancy,
    );
    let _ = check(&truth, &bare);
}
