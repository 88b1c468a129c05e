//! Tiny frames whose bits stand for what draws them.

/// Size of the tiny frames whose bits stand for the renderer in keys: they change whenever it gives other numbers, in
/// any plane that a frame carries, so that nobody has to remember to raise a version.
pub(super) const PROBE: [usize; 2] = [24, 18];

/// Their samples per pixel: more than two of the blocks that are merged into one.
pub(super) const PROBE_SPP: u32 = 33;
