use crate::constants::TRIMMED_SHARE;

/// How many of so many pixels a trimmed metric drops: the largest ⌈0.1 %⌉.
#[must_use]
pub fn trimmed_count(pixels: usize) -> usize {
    (pixels as f64 * TRIMMED_SHARE).ceil() as usize
}

/// How many of so many values stay.
fn kept(values: usize) -> usize {
    values.saturating_sub(trimmed_count(values))
}

/// Positions of `values` without those of the largest ⌈0.1 %⌉, in no order; of equal values the first stay.
pub(crate) fn kept_positions(values: &[f64]) -> Vec<usize> {
    let mut positions: Vec<usize> = (0..values.len()).collect();
    let kept = kept(values.len());
    if kept < values.len() {
        positions.select_nth_unstable_by(kept, |&i, &j| values[i].total_cmp(&values[j]).then(i.cmp(&j)));
    }
    positions.truncate(kept);
    positions
}

/// Mean of `values` without the largest ⌈0.1 %⌉ of them; `None` if nothing is left. Reorders the values.
pub(crate) fn trimmed_mean(values: &mut [f64]) -> Option<f64> {
    let kept = kept(values.len());
    if kept == 0 {
        return None;
    }
    if kept < values.len() {
        values.select_nth_unstable_by(kept, f64::total_cmp);
    }
    Some(values[..kept].iter().sum::<f64>() / kept as f64) // kept ≥ 1
}

#[cfg(test)]
mod tests {
    use super::{kept_positions, trimmed_mean};

    #[test]
    fn one_in_a_thousand_is_dropped_rounded_up() {
        let with_outlier = |n: usize| {
            let mut values = vec![1.0; n];
            values[n / 2] = 1e9;
            trimmed_mean(&mut values)
        };
        assert_eq!(with_outlier(10), Some(1.0));
        assert_eq!(with_outlier(1000), Some(1.0));
        assert_eq!(with_outlier(1), None);
        let mut three = vec![1.0; 1001];
        three[..3].fill(1e9);
        // 1001 values drop two, so one outlier stays.
        assert!((trimmed_mean(&mut three).unwrap() - (998.0 + 1e9) / 999.0).abs() < 1e-3);
        assert_eq!(trimmed_mean(&mut []), None);
        let mut kept = kept_positions(&[1.0, 9.0, 1.0, 9.0]);
        kept.sort_unstable();
        assert_eq!(kept, [0, 1, 2]);
        assert!(kept_positions(&[1.0]).is_empty());
    }
}
