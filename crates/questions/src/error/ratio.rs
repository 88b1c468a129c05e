//! How sure a ratio of two errors is within one image, where there is no second replicate.

use std::collections::BTreeMap;

use noisefloor_frame::{Image, Reference};
use noisefloor_metrics::{ErrorKind, MetricError, error_map};

use crate::cell::Blocks;

/// Metric id to the standard error of the logarithm of error(test)/error(baseline): the spread of each block's share
/// of the one error minus its share of the other, the linear form of a bootstrap that draws the same blocks for both.
/// Only squared errors and their root; absent where an error is not positive or there are fewer than 2 blocks.
pub(crate) fn ratio_within_se(
    test: &Image,
    baseline: &Image,
    reference: &Reference,
) -> Result<BTreeMap<String, f64>, MetricError> {
    let blocks = Blocks::new(test.width(), test.height());
    let mut out = BTreeMap::new();
    for (id, kind) in [("mse", ErrorKind::Squared), ("relmse", ErrorKind::RelativeSquared)] {
        let maps = [error_map(test, reference, kind)?, error_map(baseline, reference, kind)?];
        let mut sums = vec![[0.0f64; 2]; blocks.count()];
        for pixel in 0..test.pixels() {
            let errors = [0, 1].map(|k| f64::from(maps[k].data()[pixel]));
            if errors.iter().all(|e| e.is_finite()) {
                let sum = &mut sums[blocks.of(pixel)];
                (sum[0], sum[1]) = (sum[0] + errors[0], sum[1] + errors[1]);
            }
        }
        let total = sums.iter().fold([0.0; 2], |t, s| [t[0] + s[0], t[1] + s[1]]);
        if sums.len() < 2 || total.iter().any(|t| *t <= 0.0) {
            continue;
        }
        // Both totals are positive.
        let spread: f64 = sums.iter().map(|s| (s[0] / total[0] - s[1] / total[1]).powi(2)).sum();
        let se = (spread * sums.len() as f64 / (sums.len() - 1) as f64).sqrt();
        out.insert(id.to_owned(), se);
        if id == "mse" {
            out.insert("rmse".to_owned(), 0.5 * se);
        }
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn proportional_errors_have_a_certain_ratio() {
        let truth = Reference::exact(Image::filled(128, 128, 3, 1.0));
        let off =
            |scale: f32| Image::from_fn(128, 128, 3, |_, x, y| 1.0 + scale * ((x * 7 + y * 13) % 11) as f32);
        let se = ratio_within_se(&off(0.5), &off(0.25), &truth).unwrap();
        assert!(se["mse"] < 1e-5 && se["relmse"] < 1e-5, "{se:?}");
        // The error moves from one half of the image to the other: the ratio rests on which blocks were looked at.
        let left = Image::from_fn(128, 128, 3, |_, x, _| if x < 64 { 1.5 } else { 1.1 });
        let right = Image::from_fn(128, 128, 3, |_, x, _| if x < 64 { 1.1 } else { 1.5 });
        let se = ratio_within_se(&left, &right, &truth).unwrap();
        assert!(se["mse"] > 0.3, "{se:?}");
        assert_eq!(se["rmse"], 0.5 * se["mse"]);
    }
}
