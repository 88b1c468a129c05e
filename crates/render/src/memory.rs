//! How much memory an image takes, before it is taken.

use crate::plan::Plan;
use crate::planes::BYTES_PER_VALUE;
use crate::{Keep, RenderError, RenderRequest};

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
