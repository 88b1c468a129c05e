//! From planes to a frame.

use std::collections::BTreeMap;

use noisefloor_frame::{Estimate, Flash, Frame, FrameError, Image, Variance};

use crate::Keep;
use crate::plan::Plan;
use crate::table::Joined;

/// Puts the images of a plan together into `frame`, whose colour is replaced. Those of optional statistics, which come
/// last, are left.
pub fn fill(
    plan: &Plan,
    frame: &mut Frame,
    images: &mut impl Iterator<Item = Vec<f32>>,
) -> Result<(), FrameError> {
    let (width, height) = (frame.width(), frame.height());
    let mut image =
        |channels: usize| Image::from_vec(width, height, channels, images.next().unwrap_or_default());
    let mut estimate = |channels: usize, keep: Keep| -> Result<Estimate, FrameError> {
        Ok(Estimate {
            mean: image(channels)?,
            variance: if keep.variance { Some(Variance::of_mean(image(channels)?)) } else { None },
            halves: if keep.halves { Some([image(channels)?, image(channels)?]) } else { None },
        })
    };
    frame.color = estimate(3, plan.color)?;
    frame.features = BTreeMap::new();
    for column in &plan.columns.list {
        let channels = column.channels;
        let keep = if column.row.joined == Joined::First { Keep::MEAN } else { column.keep };
        let value = estimate(channels, keep)?;
        match column.row.quantity.feature() {
            Some(id) => {
                frame.features.insert(id, value);
            }
            None => {
                let light = estimate(channels, keep)?;
                let covariance =
                    if keep.variance { Some(estimate(channels, Keep::MEAN)?.mean) } else { None };
                frame.flash = Some(Flash::Parts { base: value, light, covariance });
            }
        }
    }
    frame.check()
}
