//! The same bits on every instruction set, with any number of threads, and whatever else is in the call.

use noisefloor_kernels::InstructionSet;

use super::*;
use crate::same_bits::{assert_bits_of_every_processor, assert_same_bits};

/// One pixel, less than a vector, just below and above a tile, several tiles.
const SIZES: [(usize, usize); 10] =
    [(1, 1), (1, 9), (2, 3), (7, 1), (15, 16), (16, 17), (17, 5), (63, 15), (65, 33), (67, 45)];

fn bits(out: &[Filtered]) -> Vec<u32> {
    out.iter().flat_map(|of| of.planes.iter().chain([&of.weights])).flatten().map(|v| v.to_bits()).collect()
}

fn bits_at(case: &Case, level: InstructionSet) -> Vec<u32> {
    bits(&filter_at(&case.params, &case.guides(), &case.planes(), &case.bank, level).unwrap())
}

#[test]
fn every_size_gives_the_same_bits_on_every_instruction_set_and_number_of_threads() {
    for (i, (width, height)) in SIZES.into_iter().enumerate() {
        let case = Case::random(width, height, [7, 0, 1, 4][i % 4], 1 + i % 6);
        // One that this machine lacks runs in plain Rust.
        assert_same_bits(&format!("{width}x{height}"), InstructionSet::ALL, |level| bits_at(&case, level));
    }
}

#[test]
fn bits_are_those_of_every_processor() {
    let case = Case::random(23, 17, 4, 2);
    assert_bits_of_every_processor(|level| bits_at(&case, level), 0x62a2_fa0f_6a5b_9d8d);
}

#[test]
fn a_filter_and_a_plane_give_the_same_bits_alone_and_with_others() {
    let case = Case::random(67, 20, 5, 5);
    let together = case.filter();
    for (spatial, of) in case.bank.iter().zip(&together) {
        let alone = Case { bank: vec![*spatial], ..case.clone() }.filter();
        assert_eq!(bits(&alone), bits(std::slice::from_ref(of)), "{spatial:?}");
    }
    for (k, plane) in case.planes.iter().enumerate() {
        let alone = Case { planes: vec![plane.clone()], ..case.clone() }.filter();
        for (alone, together) in alone.iter().zip(&together) {
            assert_eq!((&alone.planes[0], &alone.weights), (&together.planes[k], &together.weights), "{k}");
        }
    }
}

#[test]
fn a_power_of_two_goes_through_without_rounding() {
    let case = Case::random(40, 21, 3, 2);
    let before = case.filter();
    for factor in [-1.0, 2.0f32.powi(-20), 2.0f32.powi(15)] {
        let mut scaled = case.clone();
        scaled.planes[1].iter_mut().for_each(|v| *v *= factor);
        for (after, before) in scaled.filter().iter().zip(&before) {
            assert_eq!((&after.planes[0], &after.weights), (&before.planes[0], &before.weights));
            for (after, before) in after.planes[1].iter().zip(&before.planes[1]) {
                assert_eq!(after.to_bits(), (before * factor).to_bits());
            }
        }
    }
}
