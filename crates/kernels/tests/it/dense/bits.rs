//! The same bits on every instruction set and with any number of threads.

use super::*;

/// One pixel, less than a vector, less than a patch, just below and above a tile, several tiles.
const SIZES: [(usize, usize); 10] =
    [(1, 1), (1, 9), (2, 3), (7, 1), (15, 16), (16, 17), (17, 5), (31, 31), (33, 32), (67, 45)];

#[test]
fn every_size_gives_the_same_bits_on_every_instruction_set_and_number_of_threads() {
    for (width, height) in SIZES {
        let case = Case::random(width, height, if width % 2 == 0 { 7 } else { 4 });
        let run = |level, threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let (regressed, filtered) = pool.install(|| {
                let regressed = regress_at(&case.fit, &case.planes(), level).unwrap();
                (regressed, means_at(&case.fit.weighting, &case.alone(), level).unwrap())
            });
            let planes = regressed.into_iter().chain(filtered.into_iter().flatten());
            planes.flatten().map(f32::to_bits).collect::<Vec<_>>()
        };
        let expected = run(InstructionSet::Portable, 1);
        for level in InstructionSet::ALL.into_iter().filter(|level| level.is_available()) {
            for threads in [1, 3] {
                assert!(run(level, threads) == expected, "{width}x{height}, {level}, {threads} threads");
            }
        }
    }
}
