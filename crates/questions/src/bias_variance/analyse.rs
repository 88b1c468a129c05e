use noisefloor_stats as stats;
use noisefloor_study::summary::{Interval, Source, Summary};
use serde::{Deserialize, Serialize};

use super::ID;
use super::answer::{Answer, Known, RowAnswer, Split};
use crate::answers;
use crate::cell::ALL;
use crate::records::{Index, LEVEL, told};

/// Bias and variance of a row at a level.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Finding {
    pub(super) scene: String,
    pub(super) spp: u32,
    pub(super) label: String,
    pub(super) class: String,
    /// Whether relMSE's weights are in it.
    pub(super) relative: bool,
    /// Signed, mean over pixel-channels; not of classes.
    pub(super) bias: Option<Interval>,
    /// Nothing where the reference's noise is unknown; an upper limit where that noise hides it.
    pub(super) squared_bias: Option<Interval>,
    /// Of one replicate.
    pub(super) variance: Interval,
    /// Share of the squared bias in the sum of both, cut to [0, 1].
    pub(super) share: Option<Interval>,
    pub(super) shown: Shown,
}

/// What can be said of a squared bias.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Shown {
    /// Its interval lies above 0.
    Biased,
    /// It does not, and the reference has the larger part of the standard error.
    BelowReference,
    /// It does not, and the replicates have the larger part, or there are too few for an interval.
    BelowReplicates,
    /// The reference states no noise.
    Unknown,
}

pub(super) fn analyse(index: &Index<'_>, summary: &mut Summary) {
    let mut findings: Vec<Finding> = Vec::new();
    for scene in index.scenes() {
        for level in &scene.levels {
            let answer = answers::read::<Answer>(&level.answers, ID);
            for row in answer.iter().flatten() {
                findings.extend(of_row(&scene.id, level.spp, row));
            }
        }
    }
    if !findings.is_empty() {
        answers::keep(&mut summary.answers, ID, &findings);
    }
}

fn of_row(scene: &str, spp: u32, row: &RowAnswer) -> Vec<Finding> {
    let classes = row.classes.iter().map(|(class, split)| (class.as_str(), true, split));
    let all = [(ALL, true, &row.relative), (ALL, false, &row.plain)];
    let finding = |(class, relative, split): (&str, bool, &Split)| Finding {
        scene: scene.to_owned(),
        spp,
        label: row.label.clone(),
        class: class.to_owned(),
        relative,
        bias: split.bias.map(|known| interval(&known, row.replicates)),
        squared_bias: split.squared_bias.map(|known| squared(&known, row.replicates)),
        variance: interval(&split.variance, row.replicates),
        share: split.squared_bias.and_then(|bias| share(&bias, &split.variance, row.replicates)),
        shown: shown(split.squared_bias.as_ref(), row.replicates),
    };
    all.into_iter().chain(classes).map(finding).collect()
}

/// A value with its standard error, if there is one.
fn with_error(value: f64, error: Option<f64>, replicates: u32) -> stats::Interval {
    match error {
        Some(error) if replicates >= 2 => {
            stats::Interval::symmetric(value, error, LEVEL, Some(u64::from(replicates) - 1), replicates)
        }
        _ => stats::Interval { n: replicates, ..stats::Interval::point(value, LEVEL) },
    }
}

fn measured(known: &Known, replicates: u32) -> stats::Interval {
    let Known(value, own, reference) = *known;
    with_error(value, own.map(|own| own.hypot(reference)), replicates)
}

fn interval(known: &Known, replicates: u32) -> Interval {
    told(measured(known, replicates), Source::Replicates, None)
}

fn squared(known: &Known, replicates: u32) -> Interval {
    let measured = measured(known, replicates);
    told(measured, Source::Replicates, measured.below(known.2))
}

fn shown(squared_bias: Option<&Known>, replicates: u32) -> Shown {
    let Some(known) = squared_bias else { return Shown::Unknown };
    let Known(value, own, reference) = *known;
    if measured(known, replicates).low.is_some_and(|low| low > 0.0) {
        return Shown::Biased;
    }
    // Without an interval over replicates, the reference alone can tell that it hides the bias.
    let larger = own.map_or(value < reference, |own| reference >= own);
    if reference > 0.0 && larger { Shown::BelowReference } else { Shown::BelowReplicates }
}

/// b/(b+v). Its standard error is at most (|v|·se_b + |b|·se_v)/(b+v)², which holds however both depend on each other.
/// Nothing where the sum is not positive.
fn share(bias: &Known, variance: &Known, replicates: u32) -> Option<Interval> {
    let (b, v) = (bias.0, variance.0);
    let sum = b + v;
    if !(sum > 0.0 && sum.is_finite()) {
        return None;
    }
    let errors = bias.1.map(|own| own.hypot(bias.2)).zip(variance.1);
    let error = errors.map(|(of_bias, of_variance)| (v * of_bias + b.abs() * of_variance) / (sum * sum));
    let cut = |end: Option<f64>| end.map(|end| end.clamp(0.0, 1.0));
    let raw = with_error((b / sum).clamp(0.0, 1.0), error, replicates);
    Some(told(stats::Interval { low: cut(raw.low), high: cut(raw.high), ..raw }, Source::Replicates, None))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bias_that_the_reference_hides_is_told_as_such() {
        let word = |b: f64, own: Option<f64>, reference: f64| shown(Some(&Known(b, own, reference)), 4);
        // t(95 %, 3) = 3.18.
        assert_eq!(word(4.0, Some(1.0), 0.0), Shown::Biased);
        assert_eq!(word(3.0, Some(1.0), 0.0), Shown::BelowReplicates);
        assert_eq!(word(3.0, Some(0.5), 1.0), Shown::BelowReference);
        assert_eq!(word(0.5, None, 1.0), Shown::BelowReference);
        assert_eq!(word(0.5, None, 0.0), Shown::BelowReplicates);
        assert_eq!(shown(None, 4), Shown::Unknown);
        let hidden = squared(&Known(0.5, Some(0.1), 1.0), 4);
        assert!(hidden.below.is_some_and(|limit| limit > 1.0), "{hidden:?}");
    }

    #[test]
    fn a_share_lies_between_none_and_all() {
        let of = |b: f64, v: f64| share(&Known(b, Some(0.1), 0.0), &Known(v, Some(0.1), 0.0), 4);
        let half = of(1.0, 1.0).unwrap();
        assert_eq!((half.value, half.standard_error), (0.5, Some(0.05)));
        let none = of(-0.5, 1.0).unwrap();
        assert_eq!((none.value, none.low), (0.0, Some(0.0)));
        assert_eq!(of(-2.0, 1.0), None);
        assert_eq!(share(&Known(1.0, None, 0.0), &Known(1.0, None, 0.0), 2).unwrap().low, None);
    }
}
