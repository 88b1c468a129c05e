//! The same bits for every instruction set, tile size and number of threads.

use super::{Case, RULES, Rule};
use crate::same_bits::{assert_bits_of_every_processor, assert_same_bits, levels, on_threads};
use noisefloor_kernels::InstructionSet;
use noisefloor_kernels::inside::flash_filter_in_tiles;

fn bits(planes: &[Vec<f32>; 3]) -> Vec<u32> {
    planes.iter().flatten().map(|v| v.to_bits()).collect()
}

#[test]
fn every_instruction_set_gives_the_same_bits() {
    for rule in RULES {
        for (guided, patch_radius) in [(true, 0), (true, 1), (true, 2), (true, 3), (false, 2)] {
            let mut case = Case::random(83, 21, 4, patch_radius, rule);
            if !guided {
                case.guide = None;
            }
            let portable = bits(&case.filter_at(InstructionSet::Portable));
            for level in levels() {
                assert!(bits(&case.filter_at(level)) == portable, "{level}, {rule:?}, patch {patch_radius}");
            }
        }
    }
}

#[test]
fn every_instruction_set_gives_the_same_bits_where_weights_vanish() {
    // Widths so small that exponents cover all of 0 to -126 and beyond.
    let mut case = Case::random(83, 21, 4, 1, Rule::Off);
    let (_, sigma_r2) = case.guide.as_mut().unwrap();
    sigma_r2.iter_mut().for_each(|v| *v /= 100.0);
    let portable = bits(&case.filter_at(InstructionSet::Portable));
    for level in levels() {
        assert!(bits(&case.filter_at(level)) == portable, "{level}");
    }
}

#[test]
fn any_tile_size_gives_the_same_bits() {
    let case = Case::random(101, 37, 9, 2, Rule::Joint);
    for level in levels() {
        let usual = bits(&case.filter_at(level));
        for tile in [(16, 1), (16, 40), (32, 5), (64, 16), (112, 64)] {
            let mut out = [(); 3].map(|()| vec![0.0; 101 * 37]);
            let [r, g, b] = &mut out;
            let out_planes = [r, g, b].map(Vec::as_mut_slice);
            flash_filter_in_tiles(&case.params, &case.inputs(), level, tile, out_planes).unwrap();
            assert!(bits(&out) == usual, "{level}, tile {tile:?}");
        }
    }
}

/// One pixel, less than a vector, less than a patch, just below and above a tile, several tiles.
const SIZES: [(usize, usize); 10] =
    [(1, 1), (1, 9), (2, 3), (7, 1), (15, 16), (16, 17), (17, 5), (63, 15), (65, 17), (67, 45)];

#[test]
fn every_size_gives_the_same_bits_on_every_instruction_set_and_number_of_threads() {
    for (width, height) in SIZES {
        let case = Case::random(width, height, 5, 2, Rule::Joint);
        assert_same_bits(&format!("{width}x{height}"), levels(), |level| bits(&case.filter_at(level)));
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let case = Case::random(150, 70, 3, 2, Rule::PerChannel);
    let run = |threads| on_threads(threads, || bits(&case.filter()));
    let one = run(1);
    for threads in [2, 3, 7] {
        assert!(run(threads) == one, "{threads} threads");
    }
}

#[test]
fn the_best_level_is_available_and_used_by_default() {
    let case = Case::random(20, 20, 2, 1, Rule::Joint);
    assert!(levels().any(|level| level == InstructionSet::best()));
    assert_eq!(bits(&case.filter()), bits(&case.filter_at(InstructionSet::best())));
}

#[test]
fn bits_are_those_of_every_processor() {
    let case = Case::random(23, 17, 5, 2, Rule::Joint);
    assert_bits_of_every_processor(|level| bits(&case.filter_at(level)), 0xcce9_fdbc_edd4_93d3);
}
