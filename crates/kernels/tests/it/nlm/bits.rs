//! The same bits on every instruction set, with any tile and any number of threads.

use super::*;
use crate::same_bits::{assert_bits_of_every_processor, assert_same_bits, levels, on_threads};

fn cases() -> Vec<Case> {
    let both = Case::random(130, 37, 5, &candidates(true), &[3, 1]).with_step(Rule::Exact).with_neighbors(1);
    let mut authors = Case::random(70, 21, 10, &candidates(true), &[2]).with_step(Rule::Joint);
    authors.params.denominator = Denominator::Pair;
    authors.params.center = Center::LargestNeighbor { least: 1e-3 };
    let rules = WeightRules {
        smoothing: Smoothing::None,
        pairs: Pairs::Near,
        border: Border::Mirrored,
        taps: Taps::Clipped,
    };
    let mut program = authors.clone();
    program.params.rules = rules;
    let mut printed =
        Case::random(67, 45, 3, &candidates(true), &[1]).with_step(Rule::Exact).with_neighbors(1);
    printed.params.rules = WeightRules { pairs: Pairs::Raw, ..WeightRules::default() };
    let mut smooth = Case::random(67, 45, 4, &candidates(false), &[2]);
    smooth.params.rules = WeightRules { smoothing: Smoothing::BelowPatch, ..rules };
    let mut tiny = Case::random(1, 1, 4, &candidates(false), &[2]);
    tiny.params.rules = smooth.params.rules;
    vec![both, authors, program, printed, smooth, tiny]
}

fn bits(filtered: &[Filtered]) -> Vec<u32> {
    let planes = |f: &Filtered| {
        let mut all: Vec<f32> = f.planes.concat();
        all.extend(&f.weight_sum);
        all.extend(&f.center_share);
        all.extend(f.derivative.concat());
        all
    };
    filtered.iter().flat_map(planes).map(f32::to_bits).collect()
}

fn bits_at(case: &Case, level: InstructionSet) -> Vec<u32> {
    bits(&filter_at(&case.params, &case.passes, &case.inputs(), level).unwrap())
}

#[test]
fn every_instruction_set_gives_the_same_bits() {
    for case in cases() {
        let expected = bits_at(&case, InstructionSet::Portable);
        for level in levels() {
            assert!(bits_at(&case, level) == expected, "{level}");
        }
    }
}

/// One pixel, less than a vector, less than a patch, just below and above a tile, several tiles.
const SIZES: [(usize, usize); 10] =
    [(1, 1), (1, 9), (2, 3), (7, 1), (15, 16), (16, 17), (17, 5), (63, 31), (65, 33), (67, 45)];

#[test]
fn every_size_gives_the_same_bits_on_every_instruction_set_and_number_of_threads() {
    for (width, height) in SIZES {
        let featured = Case::random(width, height, 4, &candidates(true), &[3, 1]).with_step(Rule::Exact);
        let alone = Case::random(width, height, 6, &candidates(false), &[]);
        for case in [featured, alone] {
            assert_same_bits(&format!("{width}x{height}"), levels(), |level| bits_at(&case, level));
        }
    }
}

#[test]
fn every_number_of_threads_gives_the_same_bits() {
    for case in cases() {
        let run = |threads| on_threads(threads, || bits(&case.fast()));
        let expected = run(1);
        assert!(run(2) == expected && run(5) == expected);
    }
}

#[test]
fn every_tile_size_gives_the_same_bits() {
    for case in cases() {
        let expected = bits(&case.fast());
        for tile in [(16, 1), (32, 64), (128, 7)] {
            let got = nlm_in_tiles(&case.params, &case.passes, &case.inputs(), InstructionSet::best(), tile)
                .unwrap();
            assert!(bits(&got) == expected, "{tile:?}");
        }
    }
}

#[test]
fn passes_of_one_sweep_give_the_bits_of_each_alone() {
    for case in cases() {
        let together = case.fast();
        for (pass, expected) in case.passes.iter().zip(&together) {
            let alone = Case { passes: vec![*pass], ..case.clone() };
            assert!(bits(&alone.fast()) == bits(std::slice::from_ref(expected)));
        }
    }
}

#[test]
fn a_level_that_is_missing_is_refused() {
    for level in InstructionSet::ALL.into_iter().filter(|level| !level.is_available()) {
        let case = Case::random(3, 3, 1, &[pass(None, 1.0)], &[]);
        let error = filter_at(&case.params, &case.passes, &case.inputs(), level).unwrap_err();
        assert_eq!(error, noisefloor_kernels::KernelError::LevelUnavailable { level });
    }
}

#[test]
fn bits_are_those_of_every_processor() {
    let case = Case::random(23, 17, 4, &candidates(true), &[3, 1]).with_step(Rule::Exact);
    assert_bits_of_every_processor(|level| bits_at(&case, level), 0x59d2_f57b_fc6b_f435);
}
