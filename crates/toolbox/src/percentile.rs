//! Order statistics of pixels.

/// Value at `percent` of the sorted finite values (nearest rank); 0 if there is none.
#[must_use]
pub fn percentile(mut values: Vec<f32>, percent: f64) -> f64 {
    values.retain(|v| v.is_finite());
    if values.is_empty() {
        return 0.0;
    }
    let rank = (percent / 100.0 * values.len() as f64).ceil() as usize;
    let index = rank.clamp(1, values.len()) - 1;
    f64::from(*values.select_nth_unstable_by(index, f32::total_cmp).1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentile_is_the_nearest_rank_of_the_finite_values() {
        let values = || vec![3.0, f32::NAN, 1.0, 2.0, f32::INFINITY, 4.0];
        for (percent, expected) in [(0.1, 1.0), (25.0, 1.0), (25.1, 2.0), (99.9, 4.0), (100.0, 4.0)] {
            assert_eq!(percentile(values(), percent), expected, "{percent} %");
        }
        assert_eq!(percentile(vec![f32::NAN], 50.0), 0.0);
    }
}
