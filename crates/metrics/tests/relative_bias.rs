//! The bias that a noisy denominator gives to relative errors: what is taken out of it, and what is left.
//!
//! Every pixel and channel of an image of constant truth and constant error is one draw of a reference, so the value over
//! an image is a mean over many references.

use noisefloor_frame::{Estimate, Frame, Image, Reference, Samples, Sampling, Variance};
use noisefloor_metrics::{EPSILON, Measured, Measurer};

const SIDE: usize = 64;
const IMAGES: u64 = 8;

/// SplitMix64.
struct Numbers(u64);

impl Numbers {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (((z ^ (z >> 31)) >> 12) as f64 + 0.5) / (1u64 << 52) as f64
    }
}

/// Distribution of the mean of a part.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Law {
    /// Normal.
    Normal,
    /// Mean of one to six exponential numbers, scaled about the mean to the relative noise.
    Exponential,
}

/// A mean that has `relative` standard deviation about 1.
fn draw(law: Law, relative: f64, numbers: &mut Numbers) -> f64 {
    match law {
        Law::Normal => {
            let radius = (-2.0 * numbers.uniform().ln()).sqrt();
            1.0 + relative * radius * (std::f64::consts::TAU * numbers.uniform()).cos()
        }
        Law::Exponential => {
            let count = (1.0 / (relative * relative)).floor().clamp(1.0, 6.0);
            let sum: f64 = (0..count as usize).map(|_| -numbers.uniform().ln()).sum();
            1.0 + (sum / count - 1.0) * relative * count.sqrt()
        }
    }
}

/// A reference around `mean` whose mean has the `relative` standard deviation, in so many parts.
fn reference(mean: f64, relative: f64, parts: usize, law: Law, seed: u64) -> Reference {
    let mut numbers = Numbers(seed);
    let of_part = relative * (parts as f64).sqrt();
    let mut part =
        || Image::from_fn(SIDE, SIDE, 3, |_, _, _| (mean * draw(law, of_part, &mut numbers)) as f32);
    Reference::from_parts((0..parts).map(|_| part()).collect(), 16, Sampling::Independent).unwrap()
}

struct Found {
    /// Bias of the value before and after the correction, and the standard error of each.
    before: f64,
    after: f64,
    error: f64,
    /// Mean of what was taken out.
    removed: f64,
    /// Least of the upper limits, if all images have one.
    limit: Option<f64>,
}

fn simulate(mean: f64, off: f64, make: impl Fn(u64) -> Reference) -> Found {
    let truth = off * off / (mean * mean + EPSILON);
    let measured: Vec<Measured> = (0..IMAGES)
        .map(|seed| {
            let reference = make(seed);
            let measurer = Measurer::new(&reference, None).unwrap();
            measurer.measure(&Image::filled(SIDE, SIDE, 3, (mean + off) as f32)).unwrap()
        })
        .collect();
    let values: Vec<f64> = measured.iter().map(|m| m.values["relmse"].unwrap()).collect();
    let n = values.len() as f64;
    let value = values.iter().sum::<f64>() / n;
    let spread = values.iter().map(|v| (v - value).powi(2)).sum::<f64>() / (n - 1.0);
    let removed = measured.iter().map(|m| m.reference["relmse"].bias).sum::<f64>() / n;
    let limits: Option<Vec<f64>> =
        measured.iter().zip(&values).map(|(m, v)| m.reference["relmse"].upper_limit(*v, None)).collect();
    Found {
        before: value + removed - truth,
        after: value - truth,
        error: (spread / n).sqrt(),
        removed,
        limit: limits.map(|all| all.into_iter().fold(f64::INFINITY, f64::min)),
    }
}

const MEANS: [f64; 5] = [0.02, 0.06, 0.15, 0.5, 2.0];
const OFF: [f64; 3] = [-0.3, 0.1, 0.5];

#[test]
fn what_is_left_of_the_bias_is_a_small_part_of_it_and_within_the_stated_size() {
    let (mut seen, mut seed) = (0, 1000);
    for parts in [4, 8, 16] {
        for relative in [0.03, 0.05, 0.1] {
            let laws = if parts == 8 { &[Law::Normal, Law::Exponential][..] } else { &[Law::Normal] };
            for &law in laws {
                for mean in MEANS {
                    for off in OFF.map(|off| off * mean) {
                        seed += 100;
                        let found = simulate(mean, off, |k| reference(mean, relative, parts, law, seed + k));
                        // The next term of the series in ρ² = v/μ²: the derivatives of 1/μ² bring factors 4·5/2 and 6·5/2
                        // at most, doubled for the few parts of a half: 30ρ² of the first one.
                        let limit = 30.0 * relative * relative * found.before.abs();
                        // 8 images give a standard error with 7 degrees of freedom: 6 of it are 99.95 %.
                        let slack = 6.0 * found.error;
                        assert!(
                            found.after.abs() < limit + slack,
                            "{parts} parts, {relative}, {law:?}, mean {mean}, off {off}: {} left of {} (± {})",
                            found.after,
                            found.before,
                            found.error
                        );
                        assert!(found.after.abs() < found.removed.abs() + slack, "within what was taken out");
                        seen += usize::from(found.before.abs() > 3.0 * slack);
                    }
                }
            }
        }
    }
    assert!(seen > 60, "the bias is visible where it is claimed to be taken out: {seen} times");
}

/// Leaves halves and the variance, which is that of the parts.
fn without_parts(mut reference: Reference) -> Reference {
    reference.parts.clear();
    reference
}

fn halves_only(reference: Reference) -> Reference {
    let mut reference = without_parts(reference);
    reference.frame.color.variance = None;
    reference
}

fn variance_only(reference: Reference) -> Reference {
    let mut reference = without_parts(reference);
    reference.frame.color.halves = None;
    reference
}

#[test]
fn without_parts_the_expansion_takes_the_same_bias_out() {
    let mut seed = 90_000;
    for strip in [without_parts, halves_only, variance_only] {
        for (law, relative) in [(Law::Normal, 0.1), (Law::Normal, 0.05), (Law::Exponential, 0.05)] {
            for mean in MEANS {
                for off in OFF.map(|off| off * mean) {
                    seed += 100;
                    let found = simulate(mean, off, |k| strip(reference(mean, relative, 8, law, seed + k)));
                    // As above. A skewed law moves the variance with the mean, and the numerator of a variance alone
                    // with its third moment (γ·ρ³ ≤ 2ρ⁴·√n/… of a mean of exponentials): of the same order as the next
                    // term, with ρ² of the squared truth.
                    let limit = 30.0 * relative * relative * found.before.abs()
                        + 10.0 * relative.powi(4) * mean * mean / (mean * mean + EPSILON);
                    let slack = 6.0 * found.error;
                    assert!(
                        found.after.abs() < limit + slack,
                        "{relative}, {law:?}, mean {mean}, off {off}: {} left of {} (± {})",
                        found.after,
                        found.before,
                        found.error
                    );
                }
            }
        }
    }
}

#[test]
fn a_reference_that_is_too_noisy_for_the_correction_gives_upper_limits_above_the_truth() {
    let mut seed = 500_000;
    for strip in [|r| r, without_parts, halves_only, variance_only] {
        for (law, relative) in
            [(Law::Normal, 0.25), (Law::Normal, 0.5), (Law::Exponential, 0.25), (Law::Exponential, 0.5)]
        {
            for mean in [0.15, 0.5, 2.0] {
                for off in OFF.map(|off| off * mean) {
                    seed += 100;
                    let found = simulate(mean, off, |k| strip(reference(mean, relative, 4, law, seed + k)));
                    let truth = off * off / (mean * mean + EPSILON);
                    let limit =
                        found.limit.unwrap_or_else(|| panic!("{relative} {law:?} {mean} {off}: no limit"));
                    assert!(
                        limit > truth,
                        "{relative}, {law:?}, mean {mean}, off {off}: {limit} below {truth}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_good_reference_is_corrected_and_not_limited() {
    // As long references are: 1 % of noise. The bias is 3ρ² + 4ρ²/δ of the value.
    let found = simulate(0.5, 0.1, |k| reference(0.5, 0.01, 8, Law::Normal, 7 + k));
    assert_eq!(found.limit, None);
    let truth = 0.01 / 0.26;
    assert!(found.removed > 0.0 && found.removed < 0.003 * truth, "{}", found.removed);
}

#[test]
fn an_exact_truth_has_nothing_to_take_out() {
    let truth = Reference::exact(Image::filled(4, 4, 3, 0.5));
    let measurer = Measurer::new(&truth, None).unwrap();
    assert_eq!(measurer.bias_correction(), "");
    assert!(measurer.measure(&Image::filled(4, 4, 3, 0.25)).unwrap().reference.is_empty());
    // A reference that states no noise cannot be corrected, and says so.
    let color = Estimate { mean: Image::filled(4, 4, 3, 0.5), variance: None, halves: None };
    let frame = Frame::from_color(color, Samples::uniform(4), Sampling::Independent);
    let bare = Reference { frame, parts: Vec::new() };
    let measurer = Measurer::new(&bare, None).unwrap();
    assert_eq!((measurer.bias_correction(), measurer.correction().starts_with("none")), ("", true));
    let variance = Variance::of_mean(Image::filled(4, 4, 3, f32::MAX));
    let mut wild = bare.clone();
    wild.frame.color.variance = Some(variance);
    let measured = Measurer::new(&wild, None).unwrap().measure(&Image::filled(4, 4, 3, 0.25)).unwrap();
    assert!(measured.values["relmse"].is_none_or(f64::is_finite));
}
