use super::each::Seen;

/// Skewness of the samples over √n, a = γ̂/√n with γ̂ = k₃/s³, from the unbiased third central moment k₃ of one sample;
/// `None` below 3 samples, where k₃ has no value, and where it is not finite.
///
/// n samples have |γ̂| ≤ √n, reached where all but one are equal (Wilkins 1944), so a lies in −1..=1; what rounding adds is
/// cut. Equal samples, s = 0, have none: 0. A third moment below the range of `f32` counts as 0, too: samples dimmer than
/// about 10⁻¹³.
pub(super) fn skewness_over_root_n(third_moment: f32, seen: &Seen) -> Option<f64> {
    if seen.n < 3 || !third_moment.is_finite() {
        return None;
    }
    if seen.standard_error == 0.0 {
        return Some(0.0);
    }
    // s³·√n = (s/√n)³·n²; the root of the least f32 cubed is far above the least f64.
    let n = f64::from(seen.n);
    let a = f64::from(third_moment) / (seen.standard_error.powi(3) * n * n);
    Some(a.clamp(-1.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_sample_that_differs_is_as_skewed_as_can_be() {
        // Of n − 1 zeros and a 1: s² = 1/n, so the standard error is 1/n, and k₃ = 1/n.
        for n in [3u32, 4, 17, 1000] {
            let seen = Seen { index: 0, mean: 0.0, standard_error: 1.0 / f64::from(n), n };
            let a = skewness_over_root_n(1.0 / n as f32, &seen).unwrap();
            assert!((a - 1.0).abs() < 1e-7, "{n}: {a}");
            assert!((skewness_over_root_n(-0.5 / n as f32, &seen).unwrap() + 0.5).abs() < 1e-7);
        }
    }

    #[test]
    fn without_a_third_moment_there_is_no_skewness() {
        let seen = |n| Seen { index: 0, mean: 0.0, standard_error: 0.0, n };
        assert_eq!(skewness_over_root_n(0.0, &seen(2)), None);
        assert_eq!(skewness_over_root_n(f32::NAN, &seen(3)), None);
        assert_eq!(skewness_over_root_n(f32::INFINITY, &seen(3)), None);
        assert_eq!(skewness_over_root_n(0.0, &seen(3)), Some(0.0));
    }
}
