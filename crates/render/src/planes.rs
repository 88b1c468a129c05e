//! Planes of values, and the memory for them.

use crate::RenderError;

/// Image planes, row by row.
pub type Planes = Vec<Vec<f32>>;

/// A frame and its encoded file, each of at most 4 bytes per value.
pub const BYTES_PER_VALUE: u64 = 8;

/// Planes of zeros; an error where the system has no memory for them.
pub fn zeros(width: usize, height: usize, planes: usize) -> Result<Planes, RenderError> {
    let count = width * height;
    let mut out = Planes::new();
    for _ in 0..planes {
        if Vec::<f32>::new().try_reserve_exact(count).is_err() {
            let bytes = count as u64 * planes as u64 * BYTES_PER_VALUE;
            let allowed = count as u64 * out.len() as u64 * 4;
            return Err(RenderError::Memory { width, height, planes, bytes, allowed });
        }
        out.push(vec![0.0; count]);
    }
    Ok(out)
}
