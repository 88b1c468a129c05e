//! Memory as the vector operations see it.

/// Values whose every access by one kernel has been vouched for. Debug builds check each of them.
#[repr(transparent)]
pub(crate) struct Plane<T = f32>([T]);

impl<T: Copy> Plane<T> {
    /// A plane for reading.
    ///
    /// # Safety
    /// Whoever gets it loads vectors only that lie inside of `values`.
    #[inline(always)]
    pub unsafe fn vouched(values: &[T]) -> &Self {
        // SAFETY: `Plane` is transparent.
        unsafe { &*(std::ptr::from_ref(values) as *const Self) }
    }

    /// A plane for reading and writing.
    ///
    /// # Safety
    /// As [`Plane::vouched`], for stores too.
    #[inline(always)]
    pub unsafe fn vouched_mut(values: &mut [T]) -> &mut Self {
        // SAFETY: as above.
        unsafe { &mut *(std::ptr::from_mut(values) as *mut Self) }
    }

    /// Where `count` values to read start.
    #[inline(always)]
    pub(super) fn from(&self, at: usize, count: usize) -> *const T {
        debug_assert!(at + count <= self.0.len(), "reads {count} at {at} of {}", self.0.len());
        self.0.as_ptr().wrapping_add(at)
    }

    /// Where `count` values to write start.
    #[inline(always)]
    pub(super) fn to(&mut self, at: usize, count: usize) -> *mut T {
        debug_assert!(at + count <= self.0.len(), "writes {count} at {at} of {}", self.0.len());
        self.0.as_mut_ptr().wrapping_add(at)
    }

    /// One value.
    #[inline(always)]
    pub fn get(&self, at: usize) -> T {
        self.0[at]
    }

    /// Writes one value.
    #[inline(always)]
    pub fn set(&mut self, at: usize, value: T) {
        self.0[at] = value;
    }

    /// Reads `N` values.
    #[inline(always)]
    pub(super) fn read<const N: usize>(&self, at: usize) -> [T; N] {
        // SAFETY: the plane is vouched for; an array needs no more alignment than one value.
        unsafe { self.from(at, N).cast::<[T; N]>().read() }
    }

    /// Writes `N` values.
    #[inline(always)]
    pub(super) fn write<const N: usize>(&mut self, at: usize, values: [T; N]) {
        // SAFETY: as in `read`, writable.
        unsafe { self.to(at, N).cast::<[T; N]>().write(values) }
    }
}
