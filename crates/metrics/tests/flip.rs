//! FLIP against NVIDIA's own program: `flip-evaluator` 1.7 from PyPI (its C++ behind Python 3.11, x86-64 Linux, numpy 2.4.6),
//! `evaluate(reference, test, "LDR" or "HDR", applyMagma=False)` with default parameters on the images below, whose values
//! are exact in `f32`. Recorded are the mean of the map in double precision, and the map at (0, 0), (7, 5), (w/2−1, 16) and
//! (w/2+1, 16).

use flip_rs::{DEFAULT_PPD, RgbImage, ldr_flip};
use noisefloor_frame::{Image, Reference};
use noisefloor_metrics::{METRICS, Measurer, MetricError, metric};

/// Two implementations round differently.
const TOLERANCE: f64 = 2e-6;

fn pattern(c: usize, x: usize, y: usize) -> f32 {
    ((7 * x + 13 * y + 29 * c) % 64) as f32
}

/// −8 to 7.
fn wobble(c: usize, x: usize, y: usize) -> f32 {
    ((5 * x + 3 * y + 11 * c) % 16) as f32 - 8.0
}

/// Display values: squares, one in two darker, and on the left a difference of up to an eighth.
fn ldr(width: usize, height: usize) -> [Image; 2] {
    let reference = Image::from_fn(width, height, 3, |c, x, y| {
        pattern(c, x, y) / 64.0 * if (x / 8 + y / 8) % 2 == 0 { 1.0 } else { 0.25 }
    });
    let test = Image::from_fn(width, height, 3, |c, x, y| {
        let r = reference.get(c, x, y);
        if x < width / 2 { (r + wobble(c, x, y) / 64.0).clamp(0.0, 1.0) } else { r }
    });
    [reference, test]
}

/// Radiances over nine stops, off by a factor of a half to 23/16, with some bright dots.
fn hdr(width: usize, height: usize) -> [Image; 2] {
    let reference = Image::from_fn(width, height, 3, |c, x, y| {
        (pattern(c, x, y) + 1.0) / 64.0 * (((x / 8 + y / 4) % 9) as f32 - 4.0).exp2()
    });
    let test = Image::from_fn(width, height, 3, |c, x, y| {
        let dot = x * y % 37 == 36;
        if dot { 32.0 } else { reference.get(c, x, y) * ((wobble(c, x, y) + 16.0) / 16.0) }
    });
    [reference, test]
}

fn interleaved(image: &Image) -> RgbImage<f32> {
    let n = image.pixels();
    let values = (0..3 * n).map(|i| image.data()[i % 3 * n + i / 3]).collect();
    RgbImage::new(image.width(), image.height(), values).unwrap()
}

fn hdr_flip(reference: &Image, test: &Image) -> Result<Option<f64>, MetricError> {
    let truth = Reference::exact(reference.clone());
    let measurer = Measurer::new(&truth, None)?.with(&[metric("hdr_flip")?]);
    Ok(measurer.measure(test)?.values["hdr_flip"])
}

#[track_caller]
fn assert_near(found: f64, expected: f64) {
    assert!((found - expected).abs() < TOLERANCE, "{found}, expected {expected}");
}

#[test]
fn ldr_flip_is_that_of_the_authors_program() {
    let recorded = [
        (
            48,
            32,
            0.051318832397380255,
            [0.1179361566901207, 0.09507504105567932, 0.06828441470861435, 0.032675109803676605],
        ),
        (
            64,
            17,
            0.05172896038939879,
            [0.1179361566901207, 0.09507504105567932, 0.11497831344604492, 0.03775065019726753],
        ),
    ];
    for (width, height, mean, pixels) in recorded {
        let [reference, test] = ldr(width, height);
        let map = ldr_flip(&interleaved(&reference), &interleaved(&test), DEFAULT_PPD).unwrap();
        let sum: f64 = map.pixels().iter().map(|&v| f64::from(v)).sum();
        assert_near(sum / (width * height) as f64, mean);
        let places = [(0, 0), (7, 5), (width / 2 - 1, 16), (width / 2 + 1, 16)];
        for ((x, y), expected) in places.into_iter().zip(pixels) {
            assert_near(f64::from(map.pixels()[y * width + x]), expected);
        }
    }
}

#[test]
fn hdr_flip_is_that_of_the_authors_program() {
    let recorded = [(48, 32, 0.2315973377893291), (64, 17, 0.2169812567264992)];
    for (width, height, mean) in recorded {
        let [reference, test] = hdr(width, height);
        assert_near(hdr_flip(&reference, &test).unwrap().unwrap(), mean);
        assert_eq!(hdr_flip(&reference, &reference), Ok(Some(0.0)));
    }
}

#[test]
fn pixels_that_are_not_finite_are_left_out_and_show_their_neighbours_the_reference() {
    let [reference, test] = hdr(48, 32);
    let truth = Reference::exact(reference.clone());
    let measurer = Measurer::new(&truth, None).unwrap().with(&[metric("hdr_flip").unwrap()]);
    let mut broken = test.clone();
    (0..3).for_each(|c| broken.set(c, 12, 9, [f32::NAN, f32::INFINITY, -1.0][c]));
    let mut mended = test.clone();
    (0..3).for_each(|c| mended.set(c, 12, 9, reference.get(c, 12, 9)));
    let [broken, mended] = [broken, mended].map(|image| measurer.measure(&image).unwrap());
    assert_eq!((broken.pixels, broken.pixels_of, broken.non_finite_values), (1535, 1536, 2));
    let [broken, mended] =
        [(broken, 1535.0), (mended, 1536.0)].map(|(m, n)| m.values["hdr_flip"].unwrap() * n);
    // Beside it, what the neighbours spread there.
    assert!(broken <= mended && mended - broken < 1.0, "{broken} {mended}");
    let nothing = test.map(|_| f32::NAN);
    assert_eq!(hdr_flip(&reference, &nothing), Err(MetricError::NoCommonPixel { pixels: 1536 }));
    // A reference with a hole is black there, in both.
    let mut hole = reference.clone();
    hole.set(0, 12, 9, f32::NAN);
    assert!(hdr_flip(&hole, &test).unwrap().unwrap() > 0.2);
}

#[test]
fn negative_values_are_black_and_a_black_reference_has_no_exposure() {
    let [reference, test] = hdr(48, 32);
    let [black, negative] = [0.0, -3.0].map(|value| {
        let mut image = test.clone();
        (0..3).for_each(|c| (5..9).for_each(|x| image.set(c, x, 20, value)));
        hdr_flip(&reference, &image).unwrap().unwrap()
    });
    assert_eq!(black, negative);
    for darkness in [0.0, 1e-9, -1.0] {
        assert_eq!(hdr_flip(&Image::filled(8, 8, 3, darkness), &Image::filled(8, 8, 3, 1.0)), Ok(None));
    }
    // However bright or small, there is a number.
    for (width, value) in [(1, 1e-5), (3, 1e4), (9, 1e20)] {
        let value = hdr_flip(&Image::filled(width, 1, 3, value), &Image::filled(width, 1, 3, 0.0)).unwrap();
        assert!(value.is_some_and(|v| (0.0..=1.0).contains(&v)), "{value:?}");
    }
}

#[test]
fn bits_do_not_depend_on_threads() {
    let [reference, test] = hdr(200, 160);
    let [one, three] = [1, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| hdr_flip(&reference, &test)).unwrap().unwrap()
    });
    assert_eq!(one.to_bits(), three.to_bits());
}

#[test]
fn it_is_measured_on_request_only() {
    assert!(METRICS.iter().all(|metric| metric.id != "hdr_flip"));
    let [reference, test] = hdr(16, 16);
    let measured = Measurer::new(&Reference::exact(reference), None).unwrap().measure(&test).unwrap();
    assert_eq!(measured.values.len(), METRICS.len());
}
