//! Growth of the squared error of every pixel from input to output.

use noisefloor_frame::{Image, Reference, Variance};
use noisefloor_study::BASELINE;
use noisefloor_study::record::Record;
use serde::{Deserialize, Serialize};

use super::ID;
use crate::answers;
use crate::cell::{Cell, MeasureError};

/// Standard deviations of the reference's noise beyond which growth is sure.
const SURE: f64 = 3.0;

/// What is kept of a cell.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Answer {
    /// Pixels that are finite in input, output and reference.
    pub(super) pixels: u64,
    /// Of those: pixels whose squared error grew.
    pub(super) grew: u64,
    /// Of those: by more than the reference's noise explains. Nothing where it does not state its variance.
    pub(super) surely: Option<u64>,
    /// Sum of the growth where it is positive, over the squared error of the input.
    pub(super) added: f64,
    /// Sum of the shrinking where it is negative, over the same.
    pub(super) removed: f64,
}

/// Of every row but the input itself.
pub(super) fn measure(cell: &Cell<'_>, record: &mut Record) -> Result<(), MeasureError> {
    if cell.method == BASELINE {
        return Ok(());
    }
    let found = growth(&cell.frame.color.mean, cell.image, cell.reference);
    if let Some(found) = found {
        answers::keep(&mut record.answers, ID, &found);
    }
    Ok(())
}

/// Nothing where images differ in shape, no pixel can be compared, or the input has no error.
fn growth(input: &Image, output: &Image, reference: &Reference) -> Option<Answer> {
    let truth = reference.mean();
    if !output.same_shape(truth) || !input.same_shape(truth) {
        return None;
    }
    let variance = reference.frame.color.variance.as_ref().map(Variance::mean_variance);
    let (mut out, mut before, mut surely) = (Answer::default(), 0.0, 0);
    for pixel in 0..truth.pixels() {
        let at = |image: &Image, c: usize| f64::from(image.plane(c)[pixel]);
        let (mut grown, mut noise, mut squared) = (0.0, 0.0, 0.0);
        for c in 0..truth.channels() {
            let (x, d, r) = (at(input, c), at(output, c), at(truth, c));
            // The product form: no difference of two nearly equal squares.
            grown += (d - x) * ((d - r) + (x - r));
            squared += (x - r) * (x - r);
            // Channels share their noise, so standard deviations add at worst. NaN without a right variance: not sure.
            noise += 2.0 * (d - x).abs() * variance.map_or(f64::NAN, |v| at(v, c).sqrt());
        }
        if !(grown.is_finite() && squared.is_finite()) {
            continue;
        }
        out.pixels += 1;
        before += squared;
        if grown > 0.0 {
            out.grew += 1;
            surely += u64::from(grown > SURE * noise);
            out.added += grown;
        } else {
            out.removed -= grown;
        }
    }
    // An input without any error has nothing to be divided by.
    (before > 0.0 && before.is_finite()).then(|| Answer {
        added: out.added / before,
        removed: out.removed / before,
        surely: variance.map(|_| surely),
        ..out
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn growth_is_where_the_output_is_farther_from_the_truth() {
        let truth = Image::filled(4, 1, 3, 1.0);
        let input = Image::from_fn(4, 1, 3, |_, x, _| if x < 2 { 1.5 } else { 1.0 });
        // Mended, made worse, left alone, spoilt; squared errors 0.25 → 0, 0.25 → 1, 0 → 0, 0 → 4 per channel.
        let output = Image::from_fn(4, 1, 3, |_, x, _| [1.0, 2.0, 1.0, 3.0][x]);
        let found = growth(&input, &output, &Reference::exact(truth.clone())).unwrap();
        assert_eq!((found.pixels, found.grew, found.surely), (4, 2, Some(2)));
        assert!((found.added - (0.75 + 4.0) / 0.5).abs() < 1e-12 && (found.removed - 0.5).abs() < 1e-12);
        let mut holed = output;
        holed.set(1, 3, 0, f32::NAN);
        assert_eq!(growth(&input, &holed, &Reference::exact(truth.clone())).unwrap().pixels, 3);
        assert_eq!(growth(&truth, &input, &Reference::exact(truth.clone())), None, "an input without error");
    }

    #[test]
    fn growth_within_the_noise_of_the_reference_is_not_sure() {
        let mut reference = Reference::exact(Image::filled(2, 1, 3, 1.0));
        reference.frame.color.variance = Some(Variance::of_mean(Image::filled(2, 1, 3, 0.01)));
        let input = Image::filled(2, 1, 3, 1.1);
        // Growth 3·0.3·0.5 = 0.45 beside 3·(3·2·0.3·0.1) = 0.54 for channels that share their noise (if each had its own,
        // 0.31); and 3·0.9·1.1 = 2.97 beside 1.62.
        let output = Image::from_fn(2, 1, 3, |_, x, _| [1.4, 2.0][x]);
        let found = growth(&input, &output, &reference).unwrap();
        assert_eq!((found.grew, found.surely), (2, Some(1)));
        let broken = Image::from_fn(2, 1, 3, |_, x, _| [0.01, f32::NAN][x]);
        reference.frame.color.variance = Some(Variance::of_mean(broken));
        let found = growth(&input, &output, &reference).unwrap();
        assert_eq!((found.pixels, found.grew, found.surely), (2, 2, Some(0)));
    }

    #[test]
    fn without_a_variance_of_the_reference_nothing_is_said_to_be_sure() {
        let mut reference = Reference::exact(Image::filled(2, 1, 3, 1.0));
        reference.frame.color.variance = None;
        let (input, output) = (Image::filled(2, 1, 3, 1.1), Image::filled(2, 1, 3, 2.0));
        let found = growth(&input, &output, &reference).unwrap();
        assert_eq!((found.grew, found.surely), (2, None));
    }
}
