//! A method's estimate of its own squared error against the squared error that was measured.

use std::collections::BTreeMap;

use noisefloor_frame::Image;
use noisefloor_study::record::{EstimateCheck, EstimateMeans, Record};

use crate::cell::{Cell, Measure, MeasureError};

/// Bins by rank of the estimate.
const BINS: usize = 10;

/// Running sums over pixel-channels.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    count: u64,
    estimated: f64,
    measured: f64,
}

impl Sums {
    fn add(&mut self, (estimated, measured): (f64, f64)) {
        self.count += 1;
        self.estimated += estimated;
        self.measured += measured;
    }

    fn means(self) -> Option<EstimateMeans> {
        let n = self.count as f64;
        (self.count > 0).then(|| EstimateMeans {
            count: self.count,
            estimated: self.estimated / n,
            measured: self.measured / n,
        })
    }
}

/// Of the image that the estimate is about: the output, unless the method says otherwise.
pub(super) fn measure(cell: &Cell<'_>, record: &mut Record) -> Result<(), MeasureError> {
    let Some(estimate) = &cell.output.error_estimate else { return Ok(()) };
    let (of, mut about) = match &cell.output.estimate_of {
        None => (None, cell.image.clone()),
        Some((name, image)) => (Some(name.clone()), image.clone()),
    };
    cell.hygiene.mark_invalid(&mut about);
    let squared = cell.measurer.squared_errors(&about)?;
    let check = cell.measure.estimate(estimate, &squared);
    record.error_estimate = check.map(|check| EstimateCheck { of, ..check });
    Ok(())
}

impl Measure<'_> {
    /// Compares an estimate with the squared errors that [`noisefloor_metrics::Measurer::squared_errors`] gives, both
    /// per pixel and channel. Pixel-channels without a measured error take no part. `None` if none are left, or if the
    /// sizes differ.
    #[must_use]
    pub fn estimate(&self, estimate: &Image, squared: &[f64]) -> Option<EstimateCheck> {
        let pixels = self.classes.of_pixel.len();
        if pixels == 0 || estimate.data().len() != squared.len() || !squared.len().is_multiple_of(pixels) {
            return None;
        }
        let mut all = Sums::default();
        let mut classes = vec![Sums::default(); self.classes.names.len()];
        let mut blocks = vec![Sums::default(); self.blocks.as_ref().map_or(0, |blocks| blocks.count())];
        let mut pairs = Vec::with_capacity(squared.len());
        let mut non_finite = 0;
        for (i, (&estimated, &measured)) in estimate.data().iter().zip(squared).enumerate() {
            let pair = (f64::from(estimated), measured);
            if !measured.is_finite() {
                continue;
            }
            if !estimated.is_finite() {
                non_finite += 1;
                continue;
            }
            let pixel = i % pixels; // planes follow each other, and there are pixels
            all.add(pair);
            classes[usize::from(self.classes.of_pixel[pixel])].add(pair);
            if let Some(of_image) = &self.blocks {
                blocks[of_image.of(pixel)].add(pair);
            }
            pairs.push(pair);
        }
        let named = self.classes.names.iter().zip(classes);
        let classes: BTreeMap<String, EstimateMeans> =
            named.filter_map(|(name, sums)| Some((name.clone(), sums.means()?))).collect();
        Some(EstimateCheck {
            all: all.means()?,
            classes,
            deciles: deciles(pairs),
            non_finite,
            within_se: ratio_se(&blocks),
            of: None,
        })
    }
}

/// Means over bins of equal size by rank of the estimate; equal estimates stay in the order of the image.
fn deciles(mut pairs: Vec<(f64, f64)>) -> Vec<EstimateMeans> {
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let edge = |bin: usize| bin * pairs.len() / BINS;
    let mean = |bin: usize| {
        let mut sums = Sums::default();
        pairs[edge(bin)..edge(bin + 1)].iter().for_each(|pair| sums.add(*pair));
        sums.means()
    };
    (0..BINS).filter_map(mean).collect()
}

/// Standard error of the logarithm of the ratio of the two totals: the spread of each block's share of the one minus
/// its share of the other, as for ratios of errors. `None` with fewer than 2 blocks or a total that is not positive.
fn ratio_se(blocks: &[Sums]) -> Option<f64> {
    let estimated: f64 = blocks.iter().map(|b| b.estimated).sum();
    let measured: f64 = blocks.iter().map(|b| b.measured).sum();
    if blocks.len() < 2 || estimated <= 0.0 || measured <= 0.0 {
        return None;
    }
    // Both totals are positive.
    let spread: f64 = blocks.iter().map(|b| (b.estimated / estimated - b.measured / measured).powi(2)).sum();
    Some((spread * blocks.len() as f64 / (blocks.len() - 1) as f64).sqrt())
}

#[cfg(test)]
mod tests {
    use noisefloor_frame::{Estimate, Frame, Reference, Samples, Sampling};

    use super::*;
    use crate::cell::PixelClasses;

    fn check(estimate: Image, squared: &[f64], within: bool) -> Option<EstimateCheck> {
        let (w, h) = (estimate.width(), estimate.height());
        let truth = Reference::exact(Image::new(w, h, 3));
        let color = Estimate { mean: Image::new(w, h, 3), variance: None, halves: None };
        let frame = Frame::from_color(color, Samples::uniform(4), Sampling::Independent);
        let classes = PixelClasses {
            names: vec!["left".into(), "right".into(), "nowhere".into()],
            of_pixel: (0..w * h).map(|p| u8::from(p % w >= w / 2)).collect(),
        };
        Measure::new(&frame, &truth, &classes, &[], within).estimate(&estimate, squared)
    }

    #[test]
    fn means_are_taken_over_the_image_its_classes_and_tenths_by_rank() {
        // Estimates 0 … 59 in mixed order; the measured error is twice the estimate.
        let order = |i: usize| (i * 37 % 60) as f32;
        let estimate = Image::from_fn(20, 1, 3, |c, x, _| order(c * 20 + x));
        let squared: Vec<f64> = estimate.data().iter().map(|&e| 2.0 * f64::from(e)).collect();
        let found = check(estimate.clone(), &squared, false).unwrap();
        assert_eq!(found.all, EstimateMeans { count: 60, estimated: 29.5, measured: 59.0 });
        assert_eq!(found.all.ratio(), Some(0.5));
        assert_eq!(found.classes.len(), 2, "a class without pixels is absent");
        assert_eq!(found.classes["left"].count, 30);
        let halves = (found.classes["left"].estimated + found.classes["right"].estimated) / 2.0;
        assert!((halves - 29.5).abs() < 1e-12, "{halves}");
        for (bin, mean) in found.deciles.iter().enumerate() {
            let expected = 6.0 * bin as f64 + 2.5;
            assert_eq!(*mean, EstimateMeans { count: 6, estimated: expected, measured: 2.0 * expected });
        }
        assert_eq!((found.deciles.len(), found.non_finite, found.within_se), (10, 0, None));
    }

    #[test]
    fn values_that_are_not_finite_are_left_out_and_counted() {
        let estimate = Image::from_fn(4, 1, 3, |_, x, _| if x == 0 { f32::NAN } else { 1.0 });
        let mut squared = vec![3.0; 12];
        squared[1] = f64::NAN;
        let found = check(estimate, &squared, false).unwrap();
        assert_eq!(found.all, EstimateMeans { count: 8, estimated: 1.0, measured: 3.0 });
        assert_eq!((found.non_finite, found.deciles.len()), (3, 8));
        assert!(check(Image::filled(2, 1, 3, f32::NAN), &[1.0; 6], false).is_none());
        assert!(check(Image::filled(2, 1, 3, 1.0), &[1.0; 5], false).is_none());
    }

    #[test]
    fn a_negative_mean_has_no_ratio_and_blocks_that_agree_have_no_spread() {
        let means = |estimated| EstimateMeans { count: 1, estimated, measured: 1.0 };
        assert_eq!((means(-0.1).ratio(), means(3.0).ratio()), (None, Some(3.0)));
        let estimate = Image::from_fn(64, 64, 3, |_, x, y| (x + y) as f32);
        let squared: Vec<f64> = estimate.data().iter().map(|&e| 0.5 * f64::from(e)).collect();
        let se = check(estimate.clone(), &squared, true).unwrap().within_se.unwrap();
        assert!(se < 1e-12, "{se}");
        // One block of four is estimated alone: shares 1, 0, 0, 0 against 1/4 each, spread √(3/4 · 4/3) = 1.
        let alone = Image::from_fn(64, 64, 3, |_, x, y| if x < 32 && y < 32 { 1.0 } else { 0.0 });
        let se = check(alone, &vec![1.0; 3 * 64 * 64], true).unwrap().within_se.unwrap();
        assert!((se - 1.0).abs() < 1e-12, "{se}");
    }
}
