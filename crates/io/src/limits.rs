//! How much a file may unfold into.

/// Most bytes of decoded values that a reader keeps unless [`crate::ReadOptions::max_decoded_bytes`] says otherwise:
/// 4 GiB.
pub const MAX_DECODED_BYTES: u64 = 1 << 32;

/// What any file may unfold into: 512 MiB.
const MODEST: u64 = 1 << 29;

/// How far larger files are expected to unfold. Noise hardly shrinks at all, and images of large even areas by factors
/// of tens; a file that claims more holds next to nothing.
const LIKELY_RATIO: u64 = 256;

/// The most bytes that a file of this size is likely to hold.
pub(crate) fn likely_bytes(file_bytes: u64) -> u64 {
    MODEST.max(file_bytes.saturating_mul(LIKELY_RATIO))
}
