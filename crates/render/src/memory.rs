//! How much memory an image takes, before it is taken.

use crate::plan::Plan;
use crate::planes::BYTES_PER_VALUE;
use crate::{Keep, OptionalRecord, RenderError, RenderRequest};

impl RenderRequest<'_> {
    /// Bytes of memory that [`crate::render`] and writing its frame take at most, apart from the scene; with `parts`
    /// those of [`crate::render_reference`].
    ///
    /// # Errors
    /// [`RenderError::InvalidRequest`] and [`RenderError::Unavailable`] as when rendering.
    pub fn memory(&self, parts: Option<u32>) -> Result<u64, RenderError> {
        self.check()?;
        let of_reference = parts.is_some();
        // References have no optional statistics.
        let optional = if of_reference { OptionalRecord::default() } else { self.optional.clone() };
        let request = Self { optional, ..self.clone() };
        let plan = Plan::new(&request, if of_reference { Keep::MEAN } else { Keep::ALL })?;
        Ok(request.bytes(plan.planes() + 3 * parts.unwrap_or(0) as usize))
    }

    fn bytes(&self, planes: usize) -> u64 {
        // At most 2^28 pixels by `check`.
        (self.width * self.height) as u64 * planes as u64 * BYTES_PER_VALUE
            + self.optional.tap_bytes(self.spp)
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
