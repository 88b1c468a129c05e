use noisefloor_synthetic::{ImageKind, SampleLaw};

use super::*;
use crate::level::made::Made;

const LAW: SampleLaw = SampleLaw::Gaussian { sd: 0.3, relative: false };

#[test]
fn a_grid_has_at_most_a_thousand_pixels_and_is_as_dense_as_that_allows() {
    for (width, height) in [(1, 1), (31, 32), (48, 36), (640, 480), (100_000, 1)] {
        let chosen = thinned(width, height);
        assert!(chosen.len() <= MOST && chosen.len() * 5 > (width * height).min(MOST), "{width}×{height}");
        assert!(
            chosen.windows(2).all(|pair| pair[0] < pair[1]) && chosen.iter().all(|p| *p < width * height)
        );
    }
}

#[test]
fn a_truth_must_be_exact_or_long() {
    let told = |made: &Made| made.measure(measure).answers.contains_key(ID);
    assert!(told(&Made::of(ImageKind::Flats, LAW, 8, 4, 2)));
    // 8 parts of 128 samples are 256 times 4.
    assert!(told(&Made::of(ImageKind::Flats, LAW, 8, 4, 2).sampled(128)));
    assert!(!told(&Made::of(ImageKind::Flats, LAW, 8, 4, 2).sampled(127)));
}

#[test]
fn void_intervals_have_no_transform() {
    let mut made = Made::of(ImageKind::Flats, LAW, 8, 4, 2);
    for f in &mut made.frames {
        f.frame.sampling = noisefloor_frame::Sampling::LowDiscrepancy;
    }
    assert!(made.measure(measure).answers.is_empty());
}
