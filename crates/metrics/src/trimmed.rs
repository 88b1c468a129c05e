use crate::TRIMMED_SHARE;

/// How many of so many pixels a trimmed metric drops: the largest ⌈0.1 %⌉.
#[must_use]
pub fn trimmed_count(pixels: usize) -> usize {
    (pixels as f64 * TRIMMED_SHARE).ceil() as usize
}

/// Mean of `values` without the largest ⌈0.1 %⌉ of them; `None` if nothing is left. Reorders the values.
pub(crate) fn trimmed_mean(values: &mut [f64]) -> Option<f64> {
    let kept = values.len().saturating_sub(trimmed_count(values.len()));
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
    use super::trimmed_mean;

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
    }
}
