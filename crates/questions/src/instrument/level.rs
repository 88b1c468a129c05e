//! What frames and reference of a level show of themselves: I3, I4, I5 and, where the image is known, I6.

use noisefloor_frame::{Counts, Maps, Reference, Sampling};
use noisefloor_stats::ShapeError;
use noisefloor_stats::instrument::{
    Blocks, FrameMeans, HalvedFrame, Outcome, SampledTruth, Tested, brightness, dependence,
    half_variance_ratio, smooth_weights,
};
use noisefloor_stats::{Observed, SampleCounts, Truth, normal_two_sided_p};
use noisefloor_study::check::{CheckFound, CheckKind, CheckRecord};

use super::id::ID;
use crate::answers;
use crate::cell::{Measure, MeasureError};
use crate::level::{LevelCell, LevelFound, LevelFrame};

pub(super) fn measure(level: &LevelCell<'_>, found: &mut LevelFound) -> Result<(), MeasureError> {
    if level.frames.is_empty() {
        return Ok(());
    }
    let measures: Vec<Measure<'_>> = level.measures().collect();
    let mut checks = Vec::new();
    let missing = |kind, reason| silent(level, kind, reason);
    checks.push(match halves(level, &measures)? {
        Some(check) => check,
        None => missing(CheckKind::Halves, why_no_halves(level)),
    });
    checks.push(match bright(level, &measures)? {
        Some(check) => check,
        None => missing(CheckKind::Brightness, "no frame that should be as bright states its variance"),
    });
    checks.extend(dependent(level)?);
    checks.extend(closed_form(level));
    answers::keep(&mut found.answers, ID, &checks);
    Ok(())
}

fn record(level: &LevelCell<'_>, kind: CheckKind, what: &str) -> CheckRecord {
    CheckRecord {
        kind,
        what: what.into(),
        scene: level.scene.into(),
        spp: Some(level.spp),
        found: None,
        note: String::new(),
    }
}

/// A check that was not made, with the reason: no evidence is not told as no fault.
fn silent(level: &LevelCell<'_>, kind: CheckKind, reason: &str) -> CheckRecord {
    CheckRecord { note: format!("not made: {reason}"), ..record(level, kind, kind.name()) }
}

fn why_no_halves(level: &LevelCell<'_>) -> &'static str {
    let of_rounds = |f: &LevelFrame| f.frame.provenance.rounds.is_some();
    if level.frames.iter().all(of_rounds) {
        "samples were placed by what earlier ones found"
    } else if level.frames.iter().all(|f| f.frame.sampling != Sampling::Independent) {
        "samples are not independent, and neither are their halves"
    } else if level.frames.iter().all(|f| f.frame.color.halves.is_none()) {
        "frames have no half buffers"
    } else {
        "frames state no variance"
    }
}

const TOO_FEW: &str = "too few bright samples to tell";

fn of_test(
    level: &LevelCell<'_>,
    kind: CheckKind,
    what: &str,
    outcome: Option<&Tested>,
    p: f64,
) -> CheckRecord {
    let found = outcome.map(|t| CheckFound { value: t.value, expected: t.expected, z: t.z, p });
    let note = if found.is_none() { TOO_FEW.into() } else { String::new() };
    CheckRecord { found, note, ..record(level, kind, what) }
}

fn grey(reference: &Reference, pixel: usize) -> f64 {
    let mean = reference.mean();
    [0, 1, 2].iter().map(|&c| f64::from(mean.plane(c)[pixel])).sum::<f64>() / 3.0
}

/// I3: of independent samples, with halves.
fn halves(level: &LevelCell<'_>, measures: &[Measure<'_>]) -> Result<Option<CheckRecord>, ShapeError> {
    let pairs = level.frames.iter().zip(measures);
    let of = |(f, measure): (&'_ LevelFrame, &'_ Measure<'_>)| -> Option<()> {
        let _ = (f.frame.color.halves.as_ref()?, measure.observed()?);
        Some(())
    };
    let sound =
        |f: &LevelFrame| f.frame.sampling == Sampling::Independent && f.frame.provenance.rounds.is_none();
    let usable: Vec<(&LevelFrame, &Measure<'_>)> =
        pairs.filter(|(f, m)| sound(f) && of((f, m)).is_some()).collect();
    let Some((first, _)) = usable.first() else { return Ok(None) };
    let (width, height) = (first.frame.width(), first.frame.height());
    let blocks = Blocks::new(width, height);
    let known = |p: usize| Some(grey(level.reference, p)).filter(|g| g.is_finite());
    let weights = smooth_weights(&blocks, known);
    let per_pixel: Vec<f64> = (0..width * height).map(|p| weights[blocks.of(p)].powi(2)).collect();
    let frames: Vec<HalvedFrame<'_>> = usable
        .iter()
        .filter_map(|(f, measure)| {
            let halves = f.frame.color.halves.as_ref()?;
            let in_a = match f.frame.samples.half_a() {
                Counts::Uniform(n) => SampleCounts::Uniform(*n),
                Counts::PerPixel(map) => SampleCounts::PerPixel(map),
            };
            let halves = [halves[0].data(), halves[1].data()];
            Some(HalvedFrame { observed: measure.observed()?, halves, in_a })
        })
        .collect();
    let outcome = half_variance_ratio(&frames, width, Some(&per_pixel))?;
    let tested = outcome.tested();
    let what = "spread of the halves over what the variance states";
    Ok(Some(of_test(level, CheckKind::Halves, what, tested, tested.map_or(1.0, |t| t.p))))
}

/// I4: where frames and reference should have one mean.
fn bright(level: &LevelCell<'_>, measures: &[Measure<'_>]) -> Result<Option<CheckRecord>, ShapeError> {
    let same = |f: &LevelFrame| {
        f.frame.provenance.maps() != Some(Maps::Fresh) && f.frame.provenance.rounds.is_none()
    };
    let pairs = level.frames.iter().zip(measures).filter(|(f, _)| same(f));
    let frames: Vec<Observed<'_>> = pairs.filter_map(|(_, measure)| measure.observed()).collect();
    let Some(first) = level.frames.first().filter(|_| !frames.is_empty()) else { return Ok(None) };
    let reference = &level.reference.frame;
    let stated = reference.color.variance.as_ref().map(|v| v.mean_variance().data());
    // An exact reference states that it has none.
    let exact = stated.is_some_and(|variance| variance.iter().all(|v| *v == 0.0));
    let variance = stated.filter(|_| !exact);
    let truth = SampledTruth {
        truth: Truth { mean: level.reference.mean().data(), variance },
        samples: (level.reference_spp > 0).then_some(level.reference_spp as f64),
    };
    let states = first.frame.sampling == Sampling::Independent;
    // Classes of a sampled reference are chosen by its own noise: among pixels that it calls edges it is too dark on average,
    // and frames look too bright there. Blocks are chosen by nothing.
    let groups = measures.first().map(Measure::groups).filter(|_| exact);
    let check = brightness(&frames, &truth, states, first.frame.width(), groups)?;
    let worst = check.all().filter_map(Outcome::tested).min_by(|a, b| a.p.total_cmp(&b.p));
    // All regions together are one check: the smallest p-value after Holm's rule.
    let p = check.p().unwrap_or(1.0);
    let what = "image, classes or 8×8 blocks over the reference";
    Ok(Some(of_test(level, CheckKind::Brightness, what, worst, p)))
}

/// I5: where the reference has halves.
fn dependent(level: &LevelCell<'_>) -> Result<Option<CheckRecord>, ShapeError> {
    let reference = level.reference;
    let (Some(halves), Some(first)) = (&reference.frame.color.halves, level.frames.first()) else {
        return Ok(None);
    };
    let blocks = Blocks::new(first.frame.width(), first.frame.height());
    let frames: Vec<FrameMeans<'_>> = level
        .frames
        .iter()
        .filter(|f| f.frame.provenance.rounds.is_none())
        .map(|f| FrameMeans {
            mean: f.frame.color.mean.data(),
            halves: f.frame.color.halves.as_ref().map(|halves| [halves[0].data(), halves[1].data()]),
        })
        .collect();
    let mean = reference.mean().data();
    let found = dependence(&frames, mean, [halves[0].data(), halves[1].data()], &blocks, None)?;
    let all = found.centres.iter().chain(found.halves.iter().flatten());
    let worst = all.filter_map(Outcome::tested).min_by(|a, b| a.p.total_cmp(&b.p));
    let what = "correlation of the errors of frames and reference";
    Ok(Some(of_test(level, CheckKind::Dependence, what, worst, worst.map_or(1.0, |t| t.adjusted))))
}

/// Rounding of single precision in a mean, relative: no image mean is known better.
const ROUNDING: f64 = 1e-6;

/// I6: the mean over image, channels and replicates of a scene whose every pixel is known.
fn closed_form(level: &LevelCell<'_>) -> Option<CheckRecord> {
    let expected = level.known_mean?;
    let (mut sum, mut variance, mut count) = (0.0, 0.0, 0.0);
    for f in level.frames {
        let stated = f.frame.color.variance.as_ref().map(|v| v.mean_variance());
        let mean = &f.frame.color.mean;
        for p in 0..mean.pixels() {
            // Channels of a pixel may share their noise: their standard deviations add at worst.
            let of = |plane: &dyn Fn(usize) -> f64| (0..mean.channels()).map(plane).sum::<f64>();
            sum += of(&|c| f64::from(mean.plane(c)[p]));
            let sd = stated.map_or(0.0, |v| of(&|c| f64::from(v.plane(c)[p]).max(0.0).sqrt()));
            variance += sd * sd;
        }
        count += (mean.pixels() * mean.channels()) as f64;
    }
    if count == 0.0 || !sum.is_finite() {
        return Some(silent(level, CheckKind::ClosedForm, "a value of a frame is not finite"));
    }
    let value = sum / count;
    let standard_error = (variance.sqrt() / count).hypot(ROUNDING * expected.abs()).max(f64::MIN_POSITIVE);
    let z = (value - expected) / standard_error;
    let found = CheckFound { value, expected, z, p: normal_two_sided_p(z) };
    let what = "mean of the image against its formula";
    Some(CheckRecord { found: Some(found), ..record(level, CheckKind::ClosedForm, what) })
}

#[cfg(test)]
mod tests;
