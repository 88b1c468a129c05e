//! What kernels look at before any work. The first thing that is out of range is the error.

use crate::engine::first_bad;
use crate::{InstructionSet, KernelError};

/// Sides of at least 1 and an area of at most `max`.
pub(crate) fn size(width: usize, height: usize, max: usize) -> Result<(), KernelError> {
    match width.checked_mul(height) {
        Some(area) if (1..=max).contains(&area) => Ok(()),
        _ => Err(KernelError::ImageSize { width, height, max }),
    }
}

/// A radius or number of things.
pub(crate) fn count(
    parameter: &'static str,
    value: usize,
    least: usize,
    most: usize,
) -> Result<(), KernelError> {
    if (least..=most).contains(&value) {
        return Ok(());
    }
    Err(KernelError::Count { parameter, value, least, most })
}

/// A number; a NaN is in no range.
pub(crate) fn real(parameter: &'static str, value: f32, least: f32, most: f32) -> Result<(), KernelError> {
    if (least..=most).contains(&value) {
        return Ok(());
    }
    Err(KernelError::Real { parameter, value, least, most })
}

/// The length of a plane of width·height values. [`size`] has been there.
pub(crate) fn length(
    plane: impl Fn() -> String,
    values: &[f32],
    (width, height): (usize, usize),
) -> Result<(), KernelError> {
    let (expected, actual) = (width * height, values.len());
    if actual == expected {
        return Ok(());
    }
    Err(KernelError::PlaneLength { plane: plane(), expected, actual })
}

/// The length of a plane and each of its values. Generic, so that the test is inlined and vectorised.
pub(crate) fn plane(
    plane: impl Fn() -> String,
    values: &[f32],
    size: (usize, usize),
    allowed: &'static str,
    good: impl Fn(f32) -> bool + Sync,
) -> Result<(), KernelError> {
    length(&plane, values, size)?;
    let Some(index) = first_bad(values, good) else { return Ok(()) };
    let (x, y) = (index % size.0, index / size.0);
    Err(KernelError::Value { plane: plane(), x, y, value: values[index], allowed })
}

/// Whether the processor has the instruction set.
pub(crate) fn available(level: InstructionSet) -> Result<(), KernelError> {
    if level.is_available() { Ok(()) } else { Err(KernelError::LevelUnavailable { level }) }
}
