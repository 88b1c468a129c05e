//! What may be asked for at most.

use crate::RenderError;

/// Deepest path that may be asked for.
pub const DEEPEST: u32 = 1024;

/// Longest low-discrepancy sequence of one randomisation.
pub const LONGEST_SEQUENCE: u32 = 1 << 16;

/// Most bytes of memory that an image may take unless [`crate::RenderRequest::max_memory`] says otherwise: 64 GiB.
pub const MAX_MEMORY: u64 = 1 << 36;

/// Checks an image size.
pub(crate) fn check_size(width: usize, height: usize) -> Result<(), RenderError> {
    // 2^28 pixels of three planes take 3 GiB: more is a typing error.
    match width.checked_mul(height) {
        Some(pixels) if (1..=1 << 28).contains(&pixels) => Ok(()),
        _ => Err(RenderError::InvalidRequest {
            parameter: "width × height",
            value: format!("{width}×{height}"),
            expected: "1 to 2^28 pixels".into(),
        }),
    }
}
