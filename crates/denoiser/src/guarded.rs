use noisefloor_frame::Variance;
use noisefloor_stats::{FAMILIES, IntervalFamily, IntervalNeed, Level, family};
use serde_json::{Map, Value};

use crate::param::{Kind, Param, check, kinds};
use crate::projection::{into_intervals, into_t_intervals};
use crate::{
    Adaptive, Bound, BuildError, Caveat, Claim, DenoiseError, Denoiser, Input, Method, MethodCard, Need,
    Output, Unit,
};

/// Projects any method's output into the confidence interval of the input mean: D' = clamp(D, low, high) per pixel and
/// channel.
///
/// With Student's t, which it takes unless told otherwise, the interval is x̄ ± t·s/√n. The proof of Theorem 3.1 in Moon et
/// al. 2013 (moon2013flash, App. A) uses nothing of the filter but that D lies in that interval, so the projected output
/// carries the same bound: P(|D'−μ| ≤ 2·t·s/√n) ≥ 1−α wherever the interval itself covers μ with probability 1−α (exactly for
/// independent normal samples).
///
/// With any other family ([`FAMILIES`]) the argument is the same: whenever μ lies in the interval, |D'−μ| ≤ high − low. That
/// length is stated as a bound of each image ([`Output::bounds`]), at the level of the intervals and without proof, as most
/// families have no theorem; where an interval has one end alone nothing is stated.
pub struct Guarded {
    inner: Box<dyn Denoiser>,
    level: Level,
    /// None: Student's t.
    other: Option<&'static dyn IntervalFamily>,
}

impl std::fmt::Debug for Guarded {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Guarded")
            .field("id", &self.card().id)
            .field("level", &self.level)
            .field("interval", &self.other.map_or(Self::DEFAULT_INTERVAL, IntervalFamily::id))
            .finish()
    }
}

impl Guarded {
    /// Level unless said otherwise: 99 %, that of the source work's second step.
    pub const DEFAULT_LEVEL: Level = Level::TWO_SIDED_99;

    /// Family of intervals unless said otherwise: Student's t, that of the source work.
    pub const DEFAULT_INTERVAL: &'static str = "t";

    /// Name of the parameter that is the level; all but this and [`Guarded::INTERVAL`] belong to the inner method.
    pub const PARAM: &'static str = "guard_level";

    /// Name of the parameter that is the family of intervals. Among a method's parameters only where it is not the default.
    pub const INTERVAL: &'static str = "guard_interval";

    /// The level as a parameter.
    #[must_use]
    pub fn param() -> Param {
        let about = "level of the interval that the output is projected into";
        let default = Self::DEFAULT_LEVEL.confidence().into();
        kinds::between(0.0, 1.0).unit("two-sided confidence").named(Self::PARAM, about, default)
    }

    /// The family of intervals as a parameter.
    #[must_use]
    pub fn interval_param() -> Param {
        let ids = FAMILIES.iter().map(|family| family.id().to_owned()).collect();
        let about = "family of the intervals that the output is projected into";
        Param::new(Kind::Choice(ids)).named(Self::INTERVAL, about, Self::DEFAULT_INTERVAL.into())
    }

    /// Both.
    #[must_use]
    pub fn params() -> [Param; 2] {
        [Self::param(), Self::interval_param()]
    }

    /// How often a method may be guarded again: once says all, and what asks for thousands is a mistake that would
    /// fill the stack.
    pub const MOST_LEVELS: usize = 8;

    /// How many combinators stand before the method in an id, closed or not.
    #[must_use]
    pub fn levels(id: &str) -> usize {
        let mut rest = id;
        let mut levels = 0;
        while let Some(inner) = rest.strip_prefix("guarded(") {
            rest = inner;
            levels += 1;
        }
        levels
    }

    /// Guards `inner` at a two-sided `level` with Student's t.
    #[must_use]
    pub fn new(inner: Box<dyn Denoiser>, level: Level) -> Self {
        Self { inner, level, other: None }
    }

    /// With intervals of another family.
    #[must_use]
    pub fn with_interval(self, family: &'static dyn IntervalFamily) -> Self {
        Self { other: (family.id() != Self::DEFAULT_INTERVAL).then_some(family), ..self }
    }

    /// Takes its own parameters out of the overrides; the rest is the inner method's.
    pub(crate) fn take_own(overrides: &mut Map<String, Value>) -> [Option<Value>; 2] {
        [Self::PARAM, Self::INTERVAL].map(|name| overrides.remove(name))
    }

    pub(crate) fn from_parts(
        id: &str,
        inner: Method,
        [level, interval]: [Option<Value>; 2],
    ) -> Result<Method, BuildError> {
        let value = level.unwrap_or_else(|| Self::DEFAULT_LEVEL.confidence().into());
        check(&Self::param(), &value).map_err(|error| BuildError::out_of_range(id, error))?;
        // A number above 0 and below 1 is a level.
        let level = value.as_f64().and_then(|confidence| Level::two_sided(confidence).ok());
        let level = level.unwrap_or(Self::DEFAULT_LEVEL);
        let interval = interval.unwrap_or_else(|| Self::DEFAULT_INTERVAL.into());
        check(&Self::interval_param(), &interval).map_err(|error| BuildError::out_of_range(id, error))?;
        let mut params = inner.params;
        params[Self::PARAM] = level.confidence().into();
        let mut guarded = Self::new(inner.denoiser, level);
        if let Some(family) = interval.as_str().and_then(family) {
            guarded = guarded.with_interval(family);
        }
        if let Some(family) = guarded.other {
            params[Self::INTERVAL] = family.id().into();
        }
        Ok(Method { id: id.into(), params, version: inner.version, denoiser: Box::new(guarded) })
    }

    /// What the intervals ask of a frame.
    fn needs(&self) -> Vec<Need> {
        let further = self.other.map_or(&[][..], IntervalFamily::needs);
        let skewed = further.contains(&IntervalNeed::ThirdMoment);
        let mut needs = vec![Need::ColorVariance, Need::Samples(if skewed { 3 } else { 2 })];
        needs.extend(further.iter().filter_map(|need| match need {
            IntervalNeed::ThirdMoment => Some(Need::ThirdMoment),
            IntervalNeed::Extremes => Some(Need::Extremes),
            IntervalNeed::Neighbours => None,
        }));
        needs
    }

    /// Level in per cent, without the digits that binary fractions add.
    fn percent(&self) -> f64 {
        (100.0 * self.level.confidence() * 1e6).round() / 1e6
    }
}

impl Denoiser for Guarded {
    fn card(&self) -> MethodCard {
        let mut card = self.inner.card();
        card.id = format!("guarded({})", card.id);
        card.name = format!("guarded {}", card.name);
        for need in self.needs() {
            if !card.needs.contains(&need) {
                card.needs.push(need);
            }
        }
        let claim = |name: &'static str, factor, proven| Claim {
            name: name.into(),
            terms: vec![(factor, self.level)],
            level: self.level,
            proven,
        };
        let percent = self.percent();
        match self.other {
            None => {
                card.claims.enclosure = vec![claim("interval", 1.0, true)];
                card.claims.error_bound = vec![claim("Theorem 3.1", 2.0, true)];
                card.claims.consistent = true;
                card.notes.push(format!("projected into the {percent} % interval of the input mean"));
            }
            Some(family) => {
                // Claims are sums of t·s/√n, and what the inner method claims describes its own output.
                card.claims.enclosure.clear();
                card.claims.error_bound.clear();
                card.claims.consistent |= family.has_both_ends();
                card.notes.push(format!(
                    "projected into the {percent} % interval `{}` of the input mean (source: {}); the length of the \
                     interval is stated as a bound of each image, unproven, and the enclosure is not claimed",
                    family.id(),
                    family.source()
                ));
            }
        }
        // What the inner method estimates describes its own output, not the projected one.
        card.claims.estimates_error = false;
        // An interval of no width holds the level of an even image.
        card.caveats.retain(|(caveat, _)| *caveat != Caveat::Level);
        card
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        let card = self.card();
        input.check(&card)?;
        let mut output = self.inner.denoise(input)?;
        let frame = input.target;
        let variance = frame
            .color
            .variance
            .as_ref()
            .map(Variance::mean_variance)
            .expect("checked against the card's needs");
        let mean = &frame.color.mean;
        output.image.expect_shape("output of the guarded method", mean.width(), mean.height(), 3)?;
        // The inner method's own bound or error estimate does not describe the projected image.
        output.bounds.clear();
        output.error_estimate = None;
        output.estimate_of = None;
        let moved = match self.other {
            None => into_t_intervals(&mut output.image, frame, variance, self.level),
            Some(family) => {
                let projected = into_intervals(&mut output.image, frame, family, self.level)?;
                let (moved, half_width) = projected.ok_or_else(|| DenoiseError::MissingInputs {
                    method: card.id.clone(),
                    missing: self.needs(),
                    ways_out: Vec::new(),
                })?;
                if family.has_both_ends() {
                    let name = format!("length of interval `{}`", family.id());
                    output.bounds.push(Bound { name, level: self.level, half_width });
                }
                moved
            }
        };
        output.figure("projected values", Unit::None, moved as f64);
        Ok(output)
    }

    fn adaptive(&self) -> Option<&dyn Adaptive> {
        self.inner.adaptive()
    }
}
