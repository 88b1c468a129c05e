//! Limits on what a study may ask for, told before any work. They lie far beyond what anybody waits for: what exceeds
//! them is a slip of the keyboard.

/// Most replicates of a level.
pub const MOST_REPLICATES: u32 = 10_000;
/// Most levels of a scene.
pub const MOST_LEVELS: usize = 256;
/// Most scenes.
pub const MOST_SCENES: usize = 10_000;
/// Most rows.
pub const MOST_ROWS: usize = 256;
/// Most confidences of the coverage table.
pub const MOST_CONFIDENCES: usize = 64;
/// Most cells: scenes × levels × replicates × rows.
pub const MOST_CELLS: u64 = 1_000_000;
/// Most runs of a cell, timed or before the clock starts.
pub const MOST_RUNS: u32 = 1000;
/// Most samples per pixel of one part of a reference.
pub const MOST_PER_PART: u32 = 1 << 20;
/// Most samples per pixel of one part of a reference that are drawn from a low-discrepancy sequence: twice the longest one
/// of the renderer.
pub const LONGEST_LOW_DISCREPANCY: u32 = 1 << 17;
/// Longest name, id or label, in characters: folders are named after them, whose names have at most 255 bytes, and
/// equal ones get a number behind them.
pub const LONGEST_NAME: usize = 200;
