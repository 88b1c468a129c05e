//! How much memory an image takes, before it is taken.

use crate::film::Planes;
use crate::plan::Plan;
use crate::{Keep, RenderError, RenderRequest};

/// Most bytes of memory that an image may take unless [`RenderRequest::max_memory`] says otherwise: 64 GiB.
pub const MAX_MEMORY: u64 = 1 << 36;

/// A frame and its encoded file, each of at most 4 bytes per value.
const BYTES_PER_VALUE: u64 = 8;

impl RenderRequest<'_> {
    /// Bytes of memory that [`crate::render`] and writing its frame take at most, apart from the scene; with `parts`
    /// those of [`crate::render_reference`].
    ///
    /// # Errors
    /// [`RenderError::InvalidRequest`] and [`RenderError::Unavailable`] as when rendering.
    pub fn memory(&self, parts: Option<u32>) -> Result<u64, RenderError> {
        self.check()?;
        let plan = Plan::new(self, if parts.is_some() { Keep::MEAN } else { Keep::ALL })?;
        Ok(self.bytes(plan.planes() + 3 * parts.unwrap_or(0) as usize))
    }

    fn bytes(&self, planes: usize) -> u64 {
        // At most 2^28 pixels by `check`.
        (self.width * self.height) as u64 * planes as u64 * BYTES_PER_VALUE
    }

    /// Refuses an image of so many values per pixel that takes more than is allowed.
    pub(crate) fn check_memory(&self, planes: usize) -> Result<(), RenderError> {
        let bytes = self.bytes(planes);
        if bytes <= self.max_memory {
            return Ok(());
        }
        let (width, height) = (self.width, self.height);
        Err(RenderError::Memory { width, height, planes, bytes, allowed: self.max_memory })
    }
}

/// Planes of zeros; an error where the system has no memory for them.
pub(crate) fn zeros(width: usize, height: usize, planes: usize) -> Result<Planes, RenderError> {
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
