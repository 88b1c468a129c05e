/// p-values adjusted for the whole family by Holm's step-down rule (Holm 1979), in the order given: rejecting
/// where the adjusted value is at most α keeps the chance of any false rejection at α, whatever the
/// dependence.
#[must_use]
pub fn holm_adjusted(p: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..p.len()).collect();
    order.sort_by(|&a, &b| p[a].total_cmp(&p[b]));
    let mut adjusted = vec![0.0; p.len()];
    let mut largest = 0.0f64;
    for (rank, &i) in order.iter().enumerate() {
        largest = largest.max(((p.len() - rank) as f64 * p[i]).min(1.0));
        adjusted[i] = largest;
    }
    adjusted
}

#[cfg(test)]
mod tests {
    use super::holm_adjusted;

    #[test]
    fn matches_the_step_down_rule_by_hand() {
        let adjusted = holm_adjusted(&[0.04, 0.01, 0.03, 0.5]);
        for (a, b) in adjusted.iter().zip([0.09, 0.04, 0.09, 0.5]) {
            assert!((a - b).abs() < 1e-12, "{adjusted:?}");
        }
        assert_eq!(holm_adjusted(&[0.9, 0.8]), [1.0, 1.0]);
        assert!(holm_adjusted(&[]).is_empty());
    }
}
