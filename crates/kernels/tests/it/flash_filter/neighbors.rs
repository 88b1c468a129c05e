//! Frames of an animation: windows and patches as cubes.

use super::{Case, RULES, Rule};
use crate::random::Random;
use crate::same_bits::{levels, on_threads};
use noisefloor_kernels::InstructionSet;
use noisefloor_kernels::flash_filter::{
    Carried, Filtered, FlashFilterError, FlashInputs, Neighbor, filter, filter_carrying, filter_into,
    homogeneous_counts, homogeneous_window, naive,
};
use noisefloor_kernels::inside::flash_filter_in_tiles;

/// Rounding, as in the tests of one frame against the oracle.
const TOLERANCE: f64 = 1e-6;

/// A frame and those around it.
#[derive(Clone)]
struct Sequence {
    target: Case,
    before: Vec<Case>,
    after: Vec<Case>,
}

impl Sequence {
    /// Frames of random planes, each with its own.
    fn random(target: Case, before: usize, after: usize) -> Self {
        let n = target.params.width * target.params.height;
        let mut random = Random(77);
        let mut frame = |guided: bool| {
            let mut frame = target.clone();
            frame.source = random.planes(n, Random::uniform);
            frame.carried = random.planes(n, Random::uniform);
            let guide = random.planes(n, Random::uniform);
            let sigma_r2 = (0..n).map(|_| 0.5 / (1.0 + 29.0 * random.uniform())).collect();
            frame.guide = guided.then_some((guide, sigma_r2));
            frame
        };
        let guided = target.guide.is_some();
        let before = (0..before).map(|_| frame(guided)).collect();
        let after = (0..after).map(|_| frame(guided)).collect();
        Self { target, before, after }
    }

    /// Every frame the target's own.
    fn still(target: Case, before: usize, after: usize) -> Self {
        Self { before: vec![target.clone(); before], after: vec![target.clone(); after], target }
    }

    fn frames_mut(&mut self) -> impl Iterator<Item = &mut Case> {
        std::iter::once(&mut self.target).chain(&mut self.before).chain(&mut self.after)
    }

    fn with<T>(&self, run: impl FnOnce(&FlashInputs<'_>) -> T) -> T {
        fn neighbor(case: &Case) -> Neighbor<'_> {
            // Of the inputs source and guide are the same for a frame beside.
            let FlashInputs { source, guide, .. } = case.inputs();
            Neighbor { source, guide, carried: Some(case.carried.each_ref().map(Vec::as_slice)) }
        }
        let before: Vec<_> = self.before.iter().map(neighbor).collect();
        let after: Vec<_> = self.after.iter().map(neighbor).collect();
        run(&FlashInputs { before: &before, after: &after, ..self.target.inputs() })
    }

    fn filter_at(&self, level: InstructionSet) -> [Vec<f32>; 3] {
        let params = &self.target.params;
        let mut out = [(); 3].map(|()| vec![f32::NAN; params.width * params.height]);
        let [r, g, b] = &mut out;
        self.with(|inputs| filter_into(params, inputs, level, [r, g, b])).unwrap();
        out
    }

    fn filter(&self) -> [Vec<f32>; 3] {
        self.filter_at(InstructionSet::best())
    }

    fn carrying(&self, variances: bool) -> Filtered {
        let carried = self.target.carried(variances);
        self.with(|inputs| filter_carrying(&self.target.params, inputs, &carried)).unwrap()
    }
}

fn worst(result: &[Vec<f32>; 3], oracle: &[Vec<f64>; 3]) -> f64 {
    let pairs = result.iter().flatten().zip(oracle.iter().flatten());
    pairs.map(|(&a, &b)| (f64::from(a) - b).abs()).fold(0.0, f64::max)
}

#[track_caller]
fn agrees(sequence: &Sequence) {
    let params = &sequence.target.params;
    let oracle = sequence.with(|inputs| naive::filter_f64(params, inputs)).unwrap();
    for level in levels() {
        let worst = worst(&sequence.filter_at(level), &oracle);
        let counts = (sequence.before.len(), sequence.after.len());
        assert!(worst < TOLERANCE, "{level}, {params:?}, {counts:?}: off by {worst:e}");
    }
}

#[test]
fn agrees_with_the_double_precision_loop_for_every_rule_and_patch() {
    for rule in RULES {
        for (guided, patch_radius) in [(true, 0), (true, 1), (true, 2), (true, 3), (false, 2)] {
            let mut case = Case::random(67, 9, 2, patch_radius, rule);
            if !guided {
                case.guide = None;
            }
            agrees(&Sequence::random(case, 2, 2));
        }
    }
}

#[test]
fn agrees_at_the_ends_of_a_sequence_and_where_frames_lie_beyond_the_window() {
    for (before, after) in [(0, 1), (1, 0), (0, 5), (5, 0), (1, 3), (5, 5), (8, 8)] {
        agrees(&Sequence::random(Case::random(19, 7, 1, 2, Rule::Joint), before, after));
        agrees(&Sequence::random(Case::random(17, 18, 3, 1, Rule::PerChannel), before, after));
    }
    agrees(&Sequence::random(Case::random(1, 1, 5, 3, Rule::Joint), 5, 5));
}

#[test]
fn carried_sums_agree_with_the_double_precision_loop() {
    for rule in RULES {
        let sequence = Sequence::random(Case::random(35, 9, 2, 1, rule), 2, 1);
        for variances in [true, false] {
            let carried = sequence.target.carried(variances);
            let oracle = sequence
                .with(|inputs| naive::filter_carrying_f64(&sequence.target.params, inputs, &carried))
                .unwrap();
            let result = sequence.carrying(variances);
            let worst = worst(&result.carried, &oracle.carried);
            assert!(worst < TOLERANCE, "{rule:?}: off by {worst:e}");
            assert_eq!(result.image, sequence.filter(), "{rule:?}");
        }
    }
}

#[test]
fn three_frames_of_one_pixel_are_as_by_hand() {
    let mut case = Case::random(1, 1, 1, 1, Rule::Off);
    case.params.spatial_sigma = 1.5;
    let mut sequence = Sequence::still(case, 1, 1);
    // Source, guide and σ_r² of the frame before, the target and the frame after.
    let (x, f, s) = ([1.0, 2.0, 4.0], [0.1, 0.4, 0.9], [0.2, 0.3, 0.05]);
    let order = [1, 0, 2];
    for (frame, i) in sequence.frames_mut().zip(order) {
        frame.source = [(); 3].map(|()| vec![x[i] as f32]);
        frame.guide = Some(([(); 3].map(|()| vec![f[i] as f32]), vec![s[i] as f32]));
    }
    // Rows and columns mirror into the one pixel; along time two of three taps have both frames.
    let patch = sequence.target.params.patch;
    let (middle, side) = (patch.tap(0), patch.tap(1));
    let square = |a: usize, b: usize| (f[a] - f[b]) * (f[a] - f[b]);
    let to_before: f64 = (middle * square(1, 0) + side * square(2, 1)) / (middle + side);
    let to_after: f64 = (middle * square(1, 2) + side * square(0, 1)) / (middle + side);
    let near = -1.0 / (2.0 * 1.5 * 1.5);
    let weight = [
        f64::exp(near - to_before / (2.0 * f64::min(s[0], s[1]))),
        1.0,
        f64::exp(near - to_after / (2.0 * f64::min(s[1], s[2]))),
    ];
    let expected = weight.iter().zip(x).map(|(w, x)| w * x).sum::<f64>() / weight.iter().sum::<f64>();
    for level in levels() {
        let got = f64::from(sequence.filter_at(level)[0][0]);
        assert!((got - expected).abs() < TOLERANCE, "{level}: {got} instead of {expected}");
    }
}

#[test]
fn bits_are_those_of_every_instruction_set_tile_size_and_number_of_threads() {
    let bits =
        |planes: &[Vec<f32>; 3]| -> Vec<u32> { planes.iter().flatten().map(|v| v.to_bits()).collect() };
    for rule in RULES {
        let sequence = Sequence::random(Case::random(101, 19, 3, 2, rule), 3, 5);
        let usual = bits(&sequence.filter_at(InstructionSet::Portable));
        for level in levels() {
            assert!(bits(&sequence.filter_at(level)) == usual, "{level}, {rule:?}");
            for tile in [(16, 1), (32, 5), (112, 64)] {
                let mut out = [(); 3].map(|()| vec![0.0; 101 * 19]);
                let [r, g, b] = &mut out;
                let planes = [r, g, b].map(Vec::as_mut_slice);
                let params = &sequence.target.params;
                sequence.with(|inputs| flash_filter_in_tiles(params, inputs, level, tile, planes)).unwrap();
                assert!(bits(&out) == usual, "{level}, {rule:?}, tile {tile:?}");
            }
        }
        for threads in [1, 3] {
            assert!(on_threads(threads, || bits(&sequence.filter())) == usual, "{rule:?}, {threads} threads");
        }
    }
}

#[test]
fn a_window_of_one_pixel_has_no_neighbors_in_time() {
    let sequence = Sequence::random(Case::random(40, 9, 0, 2, Rule::Joint), 3, 3);
    assert_eq!(sequence.filter(), sequence.target.filter());
}

#[test]
fn frames_that_no_pixel_is_homogeneous_with_change_no_bit() {
    for rule in [Rule::Joint, Rule::PerChannel, Rule::Luminance] {
        let mut case = Case::random(40, 9, 3, 2, rule);
        case.guide = None;
        let mut sequence = Sequence::random(case, 2, 3);
        for frame in sequence.before.iter_mut().chain(&mut sequence.after) {
            frame.source.iter_mut().flatten().for_each(|v| *v += 10.0);
        }
        assert_eq!(sequence.filter(), sequence.target.filter(), "{rule:?}");
        assert_eq!(sequence.carrying(true), {
            let case = &sequence.target;
            filter_carrying(&case.params, &case.inputs(), &case.carried(true)).unwrap()
        });
    }
}

#[test]
fn frames_beyond_window_and_patch_are_not_looked_at() {
    let near = Sequence::random(Case::random(40, 9, 1, 2, Rule::Joint), 3, 3);
    let mut far = near.clone();
    far.before.insert(0, near.target.clone());
    far.after.push(near.target.clone());
    assert_eq!(far.filter(), near.filter());
}

#[test]
fn a_still_sequence_keeps_the_image_and_divides_the_variance_by_its_frames() {
    for rule in RULES {
        let mut case = Case::random(40, 9, 3, 2, rule);
        // All frames count alike.
        case.params.spatial_sigma = f32::INFINITY;
        let sequence = Sequence::still(case, 3, 2);
        let (one, all) = (sequence.target.carrying_at(InstructionSet::best(), true), sequence.carrying(true));
        for (a, b) in all.image.iter().flatten().zip(one.image.iter().flatten()) {
            assert!((a - b).abs() < 2e-6, "{rule:?}: {a} and {b}");
        }
        for (a, b) in all.carried.iter().flatten().zip(one.carried.iter().flatten()) {
            assert!((6.0 * a / b - 1.0).abs() < 1e-4, "{rule:?}: {a} and {b}");
        }
    }
}

#[test]
fn time_may_run_backwards() {
    let sequence = Sequence::random(Case::random(40, 9, 2, 2, Rule::Joint), 2, 4);
    let mut reversed = sequence.clone();
    (reversed.before, reversed.after) = (reversed.after, reversed.before);
    reversed.before.reverse();
    reversed.after.reverse();
    for (a, b) in sequence.filter().iter().flatten().zip(reversed.filter().iter().flatten()) {
        assert!((a - b).abs() < 1e-6, "{a} and {b}");
    }
}

#[test]
fn constant_source_is_unchanged() {
    for rule in RULES {
        let mut sequence = Sequence::random(Case::random(70, 20, 2, 2, rule), 2, 2);
        for frame in sequence.frames_mut() {
            frame.source = [0.1, 7.0, 1e6].map(|v| vec![v; 70 * 20]);
        }
        assert_eq!(sequence.filter(), sequence.target.source, "{rule:?}");
    }
}

#[test]
fn result_stays_within_the_half_width_in_every_tested_channel() {
    for rule in [Rule::Joint, Rule::PerChannel] {
        let mut sequence = Sequence::random(Case::random(75, 35, 3, 2, rule), 3, 3);
        let mut random = Random(5);
        for frame in sequence.frames_mut() {
            frame.source = random.planes(75 * 35, |random| {
                let value = -(1.0 - random.uniform()).ln();
                if random.uniform() < 0.01 { 1e6 * value } else { value }
            });
        }
        sequence.target.half_width = random.planes(75 * 35, |random| match random.uniform() {
            u if u < 0.1 => 0.0,
            u if u < 0.15 => f32::INFINITY,
            u if u < 0.2 => 1e6 * random.uniform(),
            _ => 0.5 * random.uniform(),
        });
        let case = &sequence.target;
        let result = sequence.filter();
        assert_ne!(result, case.filter());
        for (c, plane) in result.iter().enumerate() {
            for (i, &d) in plane.iter().enumerate() {
                let (x, bound) = (f64::from(case.source[c][i]), f64::from(case.half_width[c][i]));
                let allowed = bound * (1.0 + 1e-6) + 8.0 * f64::from(f32::EPSILON) * x.abs();
                let moved = (f64::from(d) - x).abs();
                assert!(moved <= allowed, "{rule:?} channel {c} pixel {i}: {moved} > {allowed}");
            }
        }
    }
}

#[test]
fn values_at_their_limits_give_finite_results() {
    let mut sequence = Sequence::random(Case::random(40, 9, 2, 2, Rule::Joint), 2, 2);
    for frame in sequence.frames_mut() {
        frame.half_width[0].fill(f32::INFINITY);
        let (planes, sigma_r2) = frame.guide.as_mut().unwrap();
        for (i, v) in frame.source.iter_mut().flatten().enumerate() {
            *v = [1e30, -1e30, 0.0, 1.0][i % 4];
        }
        for (i, v) in planes.iter_mut().flatten().enumerate() {
            *v = [1e30, -f32::MAX, 0.0, f32::MAX][i % 4];
        }
        for (i, v) in sigma_r2.iter_mut().enumerate() {
            *v = [f32::INFINITY, 1.0, f32::from_bits(1), f32::MAX][i % 4];
        }
    }
    for level in levels() {
        assert!(sequence.filter_at(level).iter().flatten().all(|v| v.is_finite()), "{level}");
    }
}

#[test]
fn windows_and_counts_tell_of_every_frame() {
    for rule in RULES {
        let sequence = Sequence::random(Case::random(21, 13, 2, 2, rule), 1, 3);
        let params = &sequence.target.params;
        let result = sequence.filter();
        let counts = sequence.with(|inputs| homogeneous_counts(params, inputs, 0)).unwrap();
        for (x, y) in [(0usize, 0usize), (20, 12), (10, 6)] {
            let window = sequence.with(|inputs| homogeneous_window(params, inputs, x, y)).unwrap();
            assert_eq!((window.side, window.frames, window.target), (5, 4, 1));
            assert_eq!((window.member[0][37], window.weight[0][37]), (true, 1.0));
            assert_eq!(window.member[0].iter().filter(|&&m| m).count(), counts[y * 21 + x] as usize);
            let (mut sum, mut total) = (0.0, 0.0);
            for (cell, &weight) in window.weight[0].iter().enumerate().filter(|(_, weight)| **weight > 0.0) {
                let frame = match cell / 25 {
                    0 => &sequence.before[0],
                    1 => &sequence.target,
                    later => &sequence.after[later - 2],
                };
                let (qx, qy) = (x + cell % 5 - 2, y + cell % 25 / 5 - 2);
                sum += f64::from(weight) * f64::from(frame.source[0][qy * 21 + qx]);
                total += f64::from(weight);
            }
            let error = (f64::from(result[0][y * 21 + x]) - sum / total).abs();
            assert!(error < 2e-6, "{rule:?} ({x}, {y}): off by {error:e}");
        }
    }
}

#[test]
fn a_frame_that_does_not_fit_is_refused_with_its_place_in_time() {
    let good = Sequence::random(Case::random(8, 8, 2, 1, Rule::Joint), 2, 2);
    let refusal = |change: &dyn Fn(&mut Sequence)| {
        let mut sequence = good.clone();
        change(&mut sequence);
        let params = &sequence.target.params;
        let error = sequence.with(|inputs| filter(params, inputs)).unwrap_err().to_string();
        assert_eq!(sequence.with(|inputs| naive::filter_f64(params, inputs)).unwrap_err().to_string(), error);
        error
    };
    assert_eq!(
        refusal(&|s| s.before[0].source[1][19] = 2e30),
        "frame -2 from the target: plane `source 1` holds 2000000000000000000000000000000 at pixel (3, 2): allowed is a \
         magnitude of at most 1e30"
    );
    assert_eq!(
        refusal(&|s| s.after[0].source[2].truncate(63)),
        "frame +1 from the target: plane `source 2` holds 63 values, the image has 64 pixels"
    );
    assert_eq!(
        refusal(&|s| s.after[1].guide = None),
        "frame +2 from the target: planes `guide` must be there in all frames or in none"
    );
    assert!(refusal(&|s| s.target.guide = None).contains("planes `guide`"));
    assert!(refusal(&|s| s.before[1].guide.as_mut().unwrap().1[0] = 0.0).contains("frame -1"));
    assert_eq!(
        refusal(&|s| s.after = vec![s.target.clone(); 9]),
        "9 frames after the target: allowed 0 to 8"
    );
}

#[test]
fn carried_planes_must_be_there_in_every_frame() {
    let case = Case::random(8, 8, 2, 1, Rule::Joint);
    let sequence = Sequence::still(case.clone(), 1, 0);
    let refusal = |carried: Option<[&[f32]; 3]>| {
        sequence.with(|inputs| {
            let before = [Neighbor { carried, ..inputs.before[0] }];
            let inputs = FlashInputs { before: &before, ..*inputs };
            filter_carrying(&case.params, &inputs, &case.carried(true)).unwrap_err()
        })
    };
    let unlike = Box::new(FlashFilterError::Unlike { planes: "carried" });
    assert_eq!(refusal(None), FlashFilterError::Neighbor { time: -1, error: unlike });
    let negative = [-1.0; 64];
    assert!(
        refusal(Some([&negative; 3])).to_string().contains("frame -1 from the target: plane `carried 0`")
    );
    // Values may be negative.
    sequence.with(|inputs| {
        let before = [Neighbor { carried: Some([&negative; 3]), ..inputs.before[0] }];
        let inputs = FlashInputs { before: &before, ..*inputs };
        let values = Carried::Values(case.carried.each_ref().map(Vec::as_slice));
        assert!(filter_carrying(&case.params, &inputs, &values).is_ok());
    });
}
