use noisefloor_frame::Variance;
use noisefloor_stats::Level;
use serde_json::Value;

use crate::param::{Param, check, kinds};
use crate::{
    Adaptive, BuildError, Caveat, Claim, DenoiseError, Denoiser, Input, Method, MethodCard, Need, Output,
    Unit, half_widths,
};

/// Projects any method's output into the confidence interval of the input mean:
/// D' = clamp(D, x̄ − t·s/√n, x̄ + t·s/√n) per pixel and channel.
///
/// The proof of Theorem 3.1 in Moon et al. 2013 (moon2013flash, App. A) uses nothing of the filter but that D lies in
/// that interval, so the projected output carries the same bound: P(|D'−μ| ≤ 2·t·s/√n) ≥ 1−α wherever the
/// interval itself covers μ with probability 1−α (exactly for independent normal samples).
pub struct Guarded {
    inner: Box<dyn Denoiser>,
    level: Level,
}

impl std::fmt::Debug for Guarded {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Guarded").field("id", &self.card().id).field("level", &self.level).finish()
    }
}

impl Guarded {
    /// Level unless said otherwise: 99 %, that of the source work's second step.
    pub const DEFAULT_LEVEL: Level = Level::TWO_SIDED_99;

    /// Name of its one parameter; all others belong to the inner method.
    pub const PARAM: &'static str = "guard_level";

    /// Its one parameter.
    #[must_use]
    pub fn param() -> Param {
        let about = "level of the interval that the output is projected into";
        let default = Self::DEFAULT_LEVEL.confidence().into();
        kinds::between(0.0, 1.0).unit("two-sided confidence").named(Self::PARAM, about, default)
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

    /// Guards `inner` at a two-sided `level`.
    #[must_use]
    pub fn new(inner: Box<dyn Denoiser>, level: Level) -> Self {
        Self { inner, level }
    }

    pub(crate) fn from_parts(id: &str, inner: Method, level: Option<Value>) -> Result<Method, BuildError> {
        let value = level.unwrap_or_else(|| Self::DEFAULT_LEVEL.confidence().into());
        check(&Self::param(), &value).map_err(|error| BuildError::out_of_range(id, error))?;
        // A number above 0 and below 1 is a level.
        let level = value.as_f64().and_then(|confidence| Level::two_sided(confidence).ok());
        let level = level.unwrap_or(Self::DEFAULT_LEVEL);
        let mut params = inner.params;
        params[Self::PARAM] = level.confidence().into();
        let denoiser = Box::new(Self::new(inner.denoiser, level));
        Ok(Method { id: id.into(), params, version: inner.version, denoiser })
    }
}

impl Denoiser for Guarded {
    fn card(&self) -> MethodCard {
        let mut card = self.inner.card();
        card.id = format!("guarded({})", card.id);
        card.name = format!("guarded {}", card.name);
        for need in [Need::ColorVariance, Need::Samples(2)] {
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
        card.claims.enclosure = vec![claim("interval", 1.0, true)];
        card.claims.error_bound = vec![claim("Theorem 3.1", 2.0, true)];
        card.claims.consistent = true;
        // What the inner method estimates describes its own output, not the projected one.
        card.claims.estimates_error = false;
        // An interval of no width holds the level of an even image.
        card.caveats.retain(|(caveat, _)| *caveat != Caveat::Level);
        card.notes.push(format!(
            "projected into the {} % interval of the input mean",
            (100.0 * self.level.confidence() * 1e6).round() / 1e6
        ));
        card
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        input.check(&self.card())?;
        let mut output = self.inner.denoise(input)?;
        let frame = input.target;
        let variance = frame
            .color
            .variance
            .as_ref()
            .map(Variance::mean_variance)
            .expect("checked against the card's needs");
        let widths = half_widths(variance, &frame.samples, self.level);
        let mean = &frame.color.mean;
        output.image.expect_shape("output of the guarded method", mean.width(), mean.height(), 3)?;
        let mut moved = 0usize;
        for ((value, &centre), &width) in
            output.image.data_mut().iter_mut().zip(mean.data()).zip(widths.data())
        {
            let (low, high) = (centre - width, centre + width);
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
        // The inner method's own bound or error estimate does not describe the projected image.
        output.bounds.clear();
        output.error_estimate = None;
        output.estimate_of = None;
        output.figure("projected values", Unit::None, moved as f64);
        Ok(output)
    }

    fn adaptive(&self) -> Option<&dyn Adaptive> {
        self.inner.adaptive()
    }
}
