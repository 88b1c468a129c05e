//! What an observer is told while frames are rendered.

use std::ops::ControlFlow;

use noisefloor_render::RenderError;

use crate::error::HarnessError;
use crate::observer::Observer;

/// Tells of samples that are done; whether to go on.
pub(super) fn advance(observer: &dyn Observer, samples: u64) -> ControlFlow<()> {
    observer.rendered(samples);
    if observer.cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}

/// A render error as the harness tells it.
pub(super) fn stopped(error: RenderError) -> HarnessError {
    match error {
        RenderError::Cancelled => HarnessError::Cancelled,
        other => other.into(),
    }
}
