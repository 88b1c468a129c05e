//! Projection of an image into intervals of the input mean.

use noisefloor_frame::{Frame, Image};
use noisefloor_stats::{IntervalFamily, Level};

use crate::{DenoiseError, half_widths, sample_planes};

/// Projects into x̄ ± t·s/√n; gives the number of values that moved.
pub(crate) fn into_t_intervals(image: &mut Image, frame: &Frame, variance: &Image, level: Level) -> usize {
    let widths = half_widths(variance, &frame.samples, level);
    let ends = frame.color.mean.data().iter().zip(widths.data());
    project(image, ends.map(|(&centre, &width)| [centre - width, centre, centre + width]))
}

/// Projects into the intervals of a family; gives the number of values that moved, and the lengths of the intervals, infinite
/// where an end is. `None` if the frame lacks something that the family needs.
pub(crate) fn into_intervals(
    image: &mut Image,
    frame: &Frame,
    family: &dyn IntervalFamily,
    level: Level,
) -> Result<Option<(usize, Image)>, DenoiseError> {
    let Some(planes) = sample_planes(frame) else { return Ok(None) };
    let intervals =
        family.intervals(&planes, level).map_err(|error| DenoiseError::of_kernel(family.id(), &error))?;
    let Some(intervals) = intervals else { return Ok(None) };
    let ends = || intervals.low.iter().zip(&intervals.high);
    let lengths = ends().map(|(low, high)| (high - low) as f32).collect();
    let ends = ends().zip(frame.color.mean.data()).map(|((&low, &high), &mean)| {
        // An interval need not hold the mean: then the end beside it stands for the centre.
        let (low, high) = (low as f32, high as f32);
        [low, mean.max(low).min(high), high]
    });
    let moved = project(image, ends);
    Ok(Some((moved, Image::from_vec(image.width(), image.height(), image.channels(), lengths)?)))
}

/// Projects each value between its lower and upper end, given with a centre between them.
fn project(image: &mut Image, ends: impl Iterator<Item = [f32; 3]>) -> usize {
    let mut moved = 0;
    for (value, [low, centre, high]) in image.data_mut().iter_mut().zip(ends) {
        // Written so that a NaN from the inner method becomes the centre, never NaN.
        let projected = if *value >= low && *value <= high {
            *value
        } else if *value > high {
            high
        } else if *value < low {
            low
        } else {
            centre
        };
        moved += usize::from(projected != *value);
        *value = projected;
    }
    moved
}
