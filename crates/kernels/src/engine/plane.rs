//! Memory as the vector operations see it.

/// Values whose every access by one kernel has been vouched for. Debug builds check each of them.
#[repr(transparent)]
pub(crate) struct Plane([f32]);

impl Plane {
    /// A plane for reading.
    ///
    /// # Safety
    /// Whoever gets it loads vectors only that lie inside of `values`.
    #[inline(always)]
    pub unsafe fn vouched(values: &[f32]) -> &Self {
        // SAFETY: `Plane` is transparent.
        unsafe { &*(std::ptr::from_ref(values) as *const Self) }
    }

    /// A plane for reading and writing.
    ///
    /// # Safety
    /// As [`Plane::vouched`], for stores too.
    #[inline(always)]
    pub unsafe fn vouched_mut(values: &mut [f32]) -> &mut Self {
        // SAFETY: as above.
        unsafe { &mut *(std::ptr::from_mut(values) as *mut Self) }
    }

    /// Where `count` values to read start.
    #[inline(always)]
    pub(super) fn from(&self, at: usize, count: usize) -> *const f32 {
        debug_assert!(at + count <= self.0.len(), "reads {count} at {at} of {}", self.0.len());
        self.0.as_ptr().wrapping_add(at)
    }

    /// Where `count` values to write start.
    #[inline(always)]
    pub(super) fn to(&mut self, at: usize, count: usize) -> *mut f32 {
        debug_assert!(at + count <= self.0.len(), "writes {count} at {at} of {}", self.0.len());
        self.0.as_mut_ptr().wrapping_add(at)
    }
}
