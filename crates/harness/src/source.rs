//! Where the frames and the reference of a scene come from: rendered here, drawn from a known law, or imported.

mod folder;
mod frame;
mod opened;
mod probe;
mod quantities;
mod rendered;
mod scene;
mod synthetic;

pub(crate) use frame::{FrameKind, FrameSpec};
pub(crate) use quantities::recorded;
pub(crate) use scene::Scene;
