//! Tests of the joint filter of features.

use noisefloor_kernels::InstructionSet;
use noisefloor_kernels::joint_nlm::{JointChannel, JointParams, filter, filter_at, naive};

use crate::random::Random;
use crate::same_bits::{assert_bits_of_every_processor, assert_same_bits};

/// Two flat regions and a slope, with noise; some pixels have none.
struct Case {
    params: JointParams,
    values: Vec<Vec<f32>>,
    variances: Vec<Vec<f32>>,
}

impl Case {
    fn new(width: usize, height: usize, patch_radius: usize, seed: u64) -> Self {
        let mut random = Random(seed);
        let (mut values, mut variances) = (Vec::new(), Vec::new());
        for c in 0..3 {
            let (mut value, mut variance) = (Vec::new(), Vec::new());
            for p in 0..width * height {
                let v = if random.uniform() < 0.2 { 0.0 } else { 0.01 * random.uniform() };
                let truth = if c == 2 { 0.01 * (p % width) as f32 } else { f32::from(p % width < width / 2) };
                variance.push(v);
                value.push(truth + v.sqrt() * random.normal());
            }
            values.push(value);
            variances.push(variance);
        }
        let params = JointParams {
            width,
            height,
            window_radius: 4,
            patch_radius,
            k: 0.6,
            spatial_sigma: 2.0,
            range_sigma: 1.0,
        };
        Self { params, values, variances }
    }

    fn channels(&self) -> Vec<JointChannel<'_>> {
        let sigmas = [0.8, 0.25, 0.6];
        let planes = self.values.iter().zip(&self.variances).zip(sigmas);
        planes.map(|((value, variance), sigma)| JointChannel { value, variance, sigma }).collect()
    }
}

#[test]
fn the_fast_form_is_the_formula() {
    for (width, height) in [(1, 1), (1, 8), (7, 3), (66, 18), (20, 33)] {
        for patch in 0..=3 {
            let case = Case::new(width, height, patch, 3);
            let fast = filter(&case.params, &case.channels()).unwrap();
            let slow = naive::filter_f64(&case.params, &case.channels()).unwrap();
            for (fast, slow) in fast.iter().flatten().zip(slow.iter().flatten()) {
                // Weights are right to 1e-6 times their exponent, and values are of order 1.
                assert!((f64::from(*fast) - slow).abs() < 1e-5, "{width}x{height}, {patch}: {fast}, {slow}");
            }
        }
    }
}

fn bits_at(case: &Case, level: InstructionSet) -> Vec<u32> {
    let out = filter_at(&case.params, &case.channels(), level).unwrap();
    out.into_iter().flatten().map(f32::to_bits).collect()
}

#[test]
fn every_instruction_set_and_number_of_threads_gives_the_same_bits() {
    let case = Case::new(83, 37, 3, 4);
    // One that this machine lacks runs in plain Rust.
    assert_same_bits("83x37", InstructionSet::ALL, |level| bits_at(&case, level));
}

#[test]
fn bits_are_those_of_every_processor() {
    let case = Case::new(23, 17, 3, 4);
    assert_bits_of_every_processor(|level| bits_at(&case, level), 0x2f34_ddf3_89d2_7c87);
}

#[test]
fn a_feature_without_noise_is_left_alone_but_for_what_is_equal() {
    let mut case = Case::new(40, 12, 3, 5);
    case.variances.iter_mut().for_each(|plane| plane.fill(0.0));
    let out = filter(&case.params, &case.channels()).unwrap();
    assert_eq!(out, case.values);
}

#[test]
fn the_unit_of_a_feature_and_its_sigma_change_nothing() {
    let mut case = Case::new(40, 12, 3, 6);
    let before = filter(&case.params, &case.channels()).unwrap();
    for factor in [2.0f32.powi(-15), 2.0f32.powi(15)] {
        let mut other = Case::new(40, 12, 3, 6);
        other.values[1].iter_mut().for_each(|v| *v *= factor);
        other.variances[1].iter_mut().for_each(|v| *v *= factor * factor);
        let mut channels = other.channels();
        channels[1].sigma *= factor;
        let out = filter(&case.params, &channels).unwrap();
        assert_eq!((&out[0], &out[2]), (&before[0], &before[2]));
        assert!(out[1].iter().zip(&before[1]).all(|(a, b)| *a == b * factor));
    }
    case.variances[0][0] = -1.0;
    let told = filter(&case.params, &case.channels()).unwrap_err().to_string();
    assert!(told.contains("`variance of channel 0` holds -1 at pixel (0, 0)"), "{told}");
}
