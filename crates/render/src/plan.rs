//! From a request to the planes that are kept, and from the planes to a frame.

use std::collections::BTreeMap;

use glam::Vec3A;
use noisefloor_frame::{Estimate, FeatureId, Flash, Frame, FrameError, Image, Variance};

use crate::path::Outcome;
use crate::planes::Planes;
use crate::tally::Tally;
use crate::{Integrator, Keep, Quantity, Recorded, RenderError, RenderRequest};

/// Values in a tally without features and flash: the colour.
pub const COLOR: usize = 3;
/// Colour, then albedo, normal, depth, shadow rays that reached a light, shadow rays traced, direct.
pub const WITH_FEATURES: usize = COLOR + 12;
/// Colour, then F0, S and their sum.
pub const WITH_FLASH: usize = COLOR + 9;
/// Colour, features, flash.
pub const WITH_BOTH: usize = WITH_FEATURES + 9;
/// All of that, then BRDF, motion, caustics.
pub const WITH_ALL: usize = WITH_BOTH + 6;

/// Where the value of a plane comes from; numbers count values of a tally.
#[derive(Debug, Clone, Copy)]
enum Source {
    Mean(usize),
    Variance(usize),
    Half(usize, usize),
    /// [`REACHED`] over [`TRACED`].
    Visibility(Statistic),
    /// Covariance of the means of values `i` and `i + 3`, whose sum is value `i + 6`.
    Covariance(usize),
    Material,
}

/// Which statistic of the visibility.
#[derive(Debug, Clone, Copy)]
enum Statistic {
    Mean,
    Variance,
    Half(usize),
}

/// Value of a tally: 1 if a shadow ray from the first hit reached its light.
const REACHED: usize = 10;
/// Value of a tally: 1 if a shadow ray was traced from the first hit.
const TRACED: usize = 11;

/// What is kept.
#[derive(Debug, Clone)]
pub struct Plan {
    kept: Vec<(Quantity, Keep)>,
    color: Keep,
    sources: Vec<Source>,
    /// Whether first-hit features are gathered.
    pub features: bool,
    /// Whether the flash is gathered.
    pub flash: bool,
    /// Whether the scene or the request needs what most do not; features and flash are then gathered together.
    pub extras: bool,
}

/// Shadow rays that reached a light over shadow rays traced; zero if none was.
fn fraction(mean: &[f64]) -> f64 {
    match (mean.get(REACHED), mean.get(TRACED)) {
        (Some(reached), Some(traced)) if *traced > 0.0 => (reached / traced).min(1.0),
        _ => 0.0,
    }
}

/// Variance of the fraction R by linearisation: the residuals reached − R·traced have the sum of squares
/// n·traced·R·(1−R), so the ratio of means has R·(1−R) / ((n−1)·traced), with `traced` the mean per sample.
fn fraction_variance(mean: &[f64], samples: u64) -> f64 {
    match mean.get(TRACED) {
        Some(traced) if *traced > 0.0 && samples >= 2 => {
            let fraction = fraction(mean);
            fraction * (1.0 - fraction) / ((samples - 1) as f64 * traced)
        }
        _ => 0.0,
    }
}

/// First value and number of values of a quantity in a tally.
fn values(quantity: Quantity, features: bool) -> (usize, usize) {
    match quantity {
        Quantity::Albedo => (3, 3),
        Quantity::Normal => (6, 3),
        Quantity::Depth => (9, 1),
        Quantity::Visibility => (REACHED, 1),
        Quantity::Direct => (12, 3),
        Quantity::Material => (0, 0),
        Quantity::Flash => (if features { WITH_FEATURES } else { COLOR }, 3),
        Quantity::Brdf => (WITH_BOTH, 3),
        Quantity::Motion => (WITH_BOTH + 3, 2),
        Quantity::Caustics => (WITH_BOTH + 5, 1),
    }
}

impl Plan {
    /// Checks what is wanted against what the scene can give, and its photon maps if there are some. `limit`: the most
    /// that is kept of anything.
    pub fn new(request: &RenderRequest<'_>, limit: Keep) -> Result<Self, RenderError> {
        let (scene, record) = (request.scene, &request.record);
        let mut can = scene.available().to_vec();
        if request.photons.is_some() {
            can.push(Quantity::Caustics);
        }
        let both = |keep: Keep| Keep {
            variance: keep.variance && limit.variance,
            halves: keep.halves && limit.halves,
        };
        let kept: Vec<(Quantity, Keep)> = match record {
            Recorded::Available => can.iter().map(|q| (*q, limit)).collect(),
            Recorded::Exactly(map) => map.iter().map(|(q, keep)| (*q, both(*keep))).collect(),
        };
        if let Some((missing, _)) = kept.iter().find(|(q, _)| !can.contains(q)) {
            let names: Vec<&str> = can.iter().map(|q| q.name()).collect();
            return Err(RenderError::Unavailable {
                scene: scene.id().into(),
                quantity: missing.name(),
                available: names.join(", "),
            });
        }
        let flash = kept.iter().any(|(q, _)| *q == Quantity::Flash);
        let features = kept.iter().any(|(q, _)| *q != Quantity::Flash);
        let rare = |q: &Quantity| matches!(q, Quantity::Brdf | Quantity::Motion | Quantity::Caustics);
        let extras = request.integrator != Integrator::PathTracing
            || scene.medium.is_some()
            || !scene.bodies.is_empty()
            || kept.iter().any(|(q, _)| rare(q));
        let both = extras && !kept.is_empty();
        let (features, flash) = (features || both, flash || both);
        let mut plan = Self { kept, color: limit, sources: Vec::new(), features, flash, extras };
        plan.list_sources();
        Ok(plan)
    }

    /// In the order in which [`Plan::frame`] takes the planes.
    fn list_sources(&mut self) {
        let mut sources = Vec::new();
        let mut estimate = |first: usize, count: usize, keep: Keep| {
            if first == REACHED && self.features {
                sources.push(Source::Visibility(Statistic::Mean));
                sources.extend(keep.variance.then_some(Source::Visibility(Statistic::Variance)));
                if keep.halves {
                    sources.extend([0, 1].map(|half| Source::Visibility(Statistic::Half(half))));
                }
                return;
            }
            let range = first..first + count;
            sources.extend(range.clone().map(Source::Mean));
            if keep.variance {
                sources.extend(range.clone().map(Source::Variance));
            }
            if keep.halves {
                for half in [0, 1] {
                    sources.extend(range.clone().map(|i| Source::Half(half, i)));
                }
            }
        };
        estimate(0, 3, self.color);
        let mut last = Vec::new();
        for (quantity, keep) in &self.kept {
            let (first, count) = values(*quantity, self.features);
            match quantity {
                Quantity::Material => last.push(Source::Material),
                Quantity::Flash => {
                    estimate(first, count, *keep);
                    estimate(first + 3, count, *keep);
                    if keep.variance {
                        last.extend((first..first + 3).map(Source::Covariance));
                    }
                }
                _ => estimate(first, count, *keep),
            }
        }
        sources.extend(last);
        self.sources = sources;
    }

    /// Planes of a frame.
    pub fn planes(&self) -> usize {
        self.sources.len()
    }

    /// Writes everything about a pixel, one value per plane.
    pub fn write<const C: usize>(&self, tally: &mut Tally<C>, material: i32, out: &mut [f32]) {
        let total = tally.total();
        let mean = total.mean();
        let variance = total.mean_variance().unwrap_or([0.0; C]);
        let halves = [tally.half_mean(0), tally.half_mean(1)];
        for (slot, source) in out.iter_mut().zip(&self.sources) {
            *slot = match *source {
                Source::Mean(i) => mean[i],
                Source::Variance(i) => variance[i],
                Source::Half(half, i) => halves[half][i],
                // Polarisation: the f64 rounding of the variances is far below any covariance that matters.
                Source::Covariance(i) => 0.5 * (variance[i + 6] - variance[i] - variance[i + 3]),
                Source::Visibility(Statistic::Mean) => fraction(&mean),
                Source::Visibility(Statistic::Half(half)) => fraction(&halves[half]),
                Source::Visibility(Statistic::Variance) => fraction_variance(&mean, total.count()),
                Source::Material => f64::from(material),
            } as f32;
        }
    }

    /// Puts the planes together into `frame`, whose colour is replaced.
    pub fn fill(
        &self,
        frame: &mut Frame,
        planes: Planes,
        width: usize,
        height: usize,
    ) -> Result<(), FrameError> {
        let mut planes = planes.into_iter();
        let mut image = |channels: usize| {
            let parts: Vec<Vec<f32>> = planes.by_ref().take(channels).collect();
            Image::from_vec(width, height, channels, parts.concat())
        };
        let mut estimate = |channels: usize, keep: Keep| -> Result<Estimate, FrameError> {
            Ok(Estimate {
                mean: image(channels)?,
                variance: if keep.variance { Some(Variance::of_mean(image(channels)?)) } else { None },
                halves: if keep.halves { Some([image(channels)?, image(channels)?]) } else { None },
            })
        };
        frame.color = estimate(3, self.color)?;
        let mut features: BTreeMap<FeatureId, Estimate> = BTreeMap::new();
        let mut flash = None;
        for (quantity, keep) in &self.kept {
            match quantity.feature() {
                Some(FeatureId::Material) => {}
                Some(id) => {
                    features.insert(id, estimate(values(*quantity, self.features).1, *keep)?);
                }
                None => flash = Some((estimate(3, *keep)?, estimate(3, *keep)?, keep.variance)),
            }
        }
        for (quantity, _) in &self.kept {
            match quantity {
                Quantity::Material => {
                    features.insert(FeatureId::Material, Estimate::from_mean(image(1)?));
                }
                Quantity::Flash => {
                    if let Some((base, light, covariance)) = flash.take() {
                        let covariance = if covariance { Some(image(3)?) } else { None };
                        frame.flash = Some(Flash::Parts { base, light, covariance });
                    }
                }
                _ => {}
            }
        }
        frame.features = features;
        frame.check()
    }
}

/// The values of a tally in their order, and whether all are finite; if not, they are zero.
#[inline(always)]
pub fn tally_values<const FEATURES: bool, const FLASH: bool, const EXTRAS: bool, const C: usize>(
    o: &Outcome,
) -> ([f32; C], bool) {
    let mut sum = o.color;
    let mut out = [0.0; C];
    let mut at = 0;
    let mut put = |v: Vec3A, count: usize| {
        let v = v.to_array();
        out[at..at + count].copy_from_slice(&v[..count]);
        at += count;
    };
    put(o.color, 3);
    if FEATURES {
        sum += o.albedo + o.normal + o.direct + Vec3A::splat(o.depth);
        put(o.albedo, 3);
        put(o.normal, 3);
        put(Vec3A::new(o.depth, o.reached, o.traced), 3);
        put(o.direct, 3);
    }
    if FLASH {
        let both = o.flash_base + o.eye_light;
        sum += both;
        put(o.flash_base, 3);
        put(o.eye_light, 3);
        put(both, 3);
    }
    if EXTRAS && FEATURES && FLASH {
        let [x, y] = o.motion;
        sum += o.brdf + Vec3A::new(x, y, o.caustics);
        put(o.brdf, 3);
        put(Vec3A::new(x, y, o.caustics), 3);
    }
    if sum.is_finite() { (out, true) } else { ([0.0; C], false) }
}
