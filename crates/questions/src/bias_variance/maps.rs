//! Pictures for the viewer: one channel, so that values with a sign can be shown.

use noisefloor_frame::Image;
use noisefloor_stats::{Level, ShapeError, coverage_of_pixels};

use crate::cell::Measure;
use crate::level::{LevelCell, Map};

/// D̄ − r, mean over channels; not a number where a channel is not.
pub(super) fn bias(label: &str, truth: &Image, bias: &[f64]) -> Map {
    let (width, channels) = (truth.width(), truth.channels().max(1));
    let image = Image::from_fn(width, truth.height(), 1, |_, x, y| {
        let own = bias.iter().skip(y * width + x).step_by(truth.pixels().max(1));
        (own.sum::<f64>() / channels as f64) as f32
    });
    Map { label: label.to_owned(), name: "bias, mean over replicates".into(), image }
}

/// Share of replicates and channels whose interval at the study's lowest confidence misses the truth, allowing for the noise
/// of the reference; a pixel whose samples all missed its light is a miss. Nothing where no interval means anything, nor in
/// pixels without one.
pub(super) fn misses(level: &LevelCell<'_>) -> Result<Option<Map>, ShapeError> {
    let lowest = level.study.coverage.iter().copied().reduce(f64::min);
    let Some(confidence) = lowest.and_then(|c| Level::two_sided(c).ok()) else { return Ok(None) };
    let (width, height) = (level.reference.mean().width(), level.reference.mean().height());
    let mut counts = vec![[0u64; 2]; width * height];
    let measures: Vec<Measure<'_>> = level.measures().collect();
    for measure in &measures {
        let Some(observed) = measure.intervals() else { continue };
        let Some(planes) = measure.intervals_at(&observed, confidence)? else { continue };
        let tallies = coverage_of_pixels(&planes, &observed, &measure.truth, confidence)?;
        for ([missed, all], tally) in counts.iter_mut().zip(tallies) {
            *missed += tally.all() - tally.covered - tally.constant;
            *all += tally.all();
        }
    }
    let share = |[missed, all]: [u64; 2]| if all > 0 { missed as f64 / all as f64 } else { f64::NAN };
    let any = counts.iter().any(|[_, all]| *all > 0);
    Ok(any.then(|| Map {
        label: level.input_label().to_owned(),
        name: "share of intervals that miss".into(),
        image: Image::from_fn(width, height, 1, |_, x, y| share(counts[y * width + x]) as f32),
    }))
}
