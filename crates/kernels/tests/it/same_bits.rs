//! The same bits on every instruction set and with any number of threads.

use noisefloor_kernels::InstructionSet;

/// The instruction sets of this machine.
pub fn levels() -> impl Iterator<Item = InstructionSet> {
    InstructionSet::ALL.into_iter().filter(|level| level.is_available())
}

/// What comes out where there are so many threads.
pub fn on_threads<T: Send>(threads: usize, run: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(run)
}

/// Holds the bits that `run` gives on each of `levels`, with one thread and with three, to those of plain code and one
/// thread. `what` tells the case.
pub fn assert_same_bits(
    what: &str,
    levels: impl IntoIterator<Item = InstructionSet>,
    run: impl Fn(InstructionSet) -> Vec<u32> + Sync,
) {
    let expected = on_threads(1, || run(InstructionSet::Portable));
    for level in levels {
        for threads in [1, 3] {
            assert!(on_threads(threads, || run(level)) == expected, "{what}, {level}, {threads} threads");
        }
    }
}

/// Holds what plain code gives to the hash (FNV-1a) of what it gave on x86-64: on other processors it is the same.
pub fn assert_bits_of_every_processor(run: impl Fn(InstructionSet) -> Vec<u32>, expected: u64) {
    let bytes = run(InstructionSet::Portable).into_iter().flat_map(u32::to_le_bytes);
    let found = bytes
        .fold(0xcbf2_9ce4_8422_2325u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3));
    assert_eq!(found, expected, "{found:#018x}");
}
