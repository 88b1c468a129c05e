//! Planted faults are named and sound frames are silent, on frames with exactly known truth.

mod common;
mod faults;
mod sound;
