//! The same bits on every instruction set and with any number of threads.

use noisefloor_kernels::InstructionSet;

use super::*;
use crate::same_bits::{assert_bits_of_every_processor, assert_same_bits, levels};

/// One pixel, less than a vector, less than a patch, just below and above a tile, several tiles.
const SIZES: [(usize, usize); 10] =
    [(1, 1), (1, 9), (2, 3), (7, 1), (15, 16), (16, 17), (17, 5), (31, 31), (33, 32), (67, 45)];

fn bits_at(case: &Case, level: InstructionSet) -> Vec<u32> {
    let regressed = regress_at(&case.fit, &case.planes(), level).unwrap();
    let filtered = means_at(&case.fit.weighting, &case.alone(), level).unwrap();
    regressed.into_iter().chain(filtered.into_iter().flatten()).flatten().map(f32::to_bits).collect()
}

#[test]
fn every_size_gives_the_same_bits_on_every_instruction_set_and_number_of_threads() {
    for (width, height) in SIZES {
        let case = Case::random(width, height, if width % 2 == 0 { 7 } else { 4 });
        assert_same_bits(&format!("{width}x{height}"), levels(), |level| bits_at(&case, level));
    }
}

#[test]
fn bits_are_those_of_every_processor() {
    let case = Case::random(23, 17, 7);
    assert_bits_of_every_processor(|level| bits_at(&case, level), 0x610d_cd90_c1ea_f887);
}
