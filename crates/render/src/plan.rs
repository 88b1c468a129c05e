//! From a request to the values of a pixel and to the planes that are kept.

use crate::columns::{COLOR, Column, Columns};
use crate::optional::OptionalPlan;
use crate::table::Joined;
use crate::tally::{Summary, Tally};
use crate::{Integrator, Keep, Quantity, Recorded, RenderError, RenderRequest};

/// What is recorded, and what is kept of it.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The recorded quantities.
    pub columns: Columns,
    /// What is kept of the colour.
    pub color: Keep,
    /// Whether the scene or the request needs what most do not.
    pub extras: bool,
    /// Planes of each image that a frame is put together from, in order.
    pub images: Vec<usize>,
    /// For each plane the value that it has: of those of a [`Summary`], behind them of those derived from it, then of
    /// optional statistics.
    sources: Vec<usize>,
    /// Optional statistics, if some are asked for.
    pub optional: Option<OptionalPlan>,
    derived: Vec<Derived>,
}

/// A value that is made of others.
#[derive(Debug, Clone, Copy)]
enum Derived {
    /// Of the means at two indices, 0 where the second is 0.
    Ratio(usize, usize),
    /// Variance of that.
    RatioVariance(usize, usize),
    /// Of two means, by the indices of their variances and of that of their sum.
    Covariance([usize; 3]),
}

/// Shadow rays that reached a light over shadow rays traced; zero if none was.
fn ratio(reached: f64, traced: f64) -> f64 {
    if traced > 0.0 { (reached / traced).min(1.0) } else { 0.0 }
}

/// Variance of the ratio R by linearisation: the residuals reached − R·traced have the sum of squares n·traced·R·(1−R), so
/// the ratio of means has R·(1−R) / ((n−1)·traced), with `traced` the mean per sample.
fn ratio_variance(reached: f64, traced: f64, samples: u64) -> f64 {
    if traced > 0.0 && samples >= 2 {
        let ratio = ratio(reached, traced);
        ratio * (1.0 - ratio) / ((samples - 1) as f64 * traced)
    } else {
        0.0
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
        let extras = request.integrator != Integrator::PathTracing
            || scene.medium.is_some()
            || !scene.bodies.is_empty();
        let columns = Columns::new(&kept);
        let (images, sources, derived) = (Vec::new(), Vec::new(), Vec::new());
        let optional = OptionalPlan::new(request);
        let mut plan = Self { columns, color: limit, extras, images, sources, optional, derived };
        plan.lay_out();
        Ok(plan)
    }

    /// Lists the planes, image by image in the order in which a frame is put together.
    fn lay_out(&mut self) {
        let Columns { accumulated, list, .. } = self.columns.clone();
        self.estimate(0, COLOR, self.color);
        for Column { row, keep, first, channels } in list {
            match row.joined {
                Joined::Mean => self.estimate(first, channels, keep),
                Joined::First => self.image(3 * accumulated + first..3 * accumulated + first + channels),
                Joined::Ratio => {
                    let pair = |part: usize| (part * accumulated + first, part * accumulated + first + 1);
                    let ratio = |part: usize| Derived::Ratio(pair(part).0, pair(part).1);
                    self.derive([ratio(0)]);
                    if keep.variance {
                        self.derive([Derived::RatioVariance(pair(0).0, pair(0).1)]);
                    }
                    if keep.halves {
                        self.derive([ratio(2)]);
                        self.derive([ratio(3)]);
                    }
                }
                Joined::Pair => {
                    self.estimate(first, channels, keep);
                    self.estimate(first + channels, channels, keep);
                    if keep.variance {
                        let of = |k: usize, c: usize| accumulated + first + k * channels + c;
                        self.derive(
                            (0..channels).map(|c| Derived::Covariance([of(0, c), of(1, c), of(2, c)])),
                        );
                    }
                }
            }
        }
        // Last: they lie behind all that is derived.
        let first = self.behind() + self.derived.len();
        for image in 0..self.optional_images() {
            self.image(first + image * COLOR..first + (image + 1) * COLOR);
        }
    }

    /// Index behind the last value of a summary that a tally gives.
    fn behind(&self) -> usize {
        3 * self.columns.accumulated + self.columns.all
    }

    /// Images of optional statistics, which come last.
    fn optional_images(&self) -> usize {
        self.optional.as_ref().map_or(0, OptionalPlan::images)
    }

    /// Adds an image of these values.
    fn image(&mut self, sources: impl IntoIterator<Item = usize>) {
        let before = self.sources.len();
        self.sources.extend(sources);
        self.images.push(self.sources.len() - before);
    }

    /// Adds an image of values that are made of others.
    fn derive(&mut self, derived: impl IntoIterator<Item = Derived>) {
        let before = self.derived.len();
        self.derived.extend(derived);
        self.image(self.behind() + before..self.behind() + self.derived.len());
    }

    /// Adds what is kept of some values: four images at most.
    fn estimate(&mut self, first: usize, channels: usize, keep: Keep) {
        let parts = [true, keep.variance, keep.halves, keep.halves];
        for part in (0..4).filter(|part| parts[*part]) {
            let first = part * self.columns.accumulated + first;
            self.image(first..first + channels);
        }
    }

    /// Planes of a frame.
    pub fn planes(&self) -> usize {
        self.sources.len()
    }

    /// A tally of what is recorded.
    pub fn tally(&self) -> Tally {
        let optional = self.optional.as_ref().map(OptionalPlan::pixel);
        Tally::new(self.columns.accumulated, self.columns.all, optional)
    }

    /// Room for what such a tally comes to.
    pub fn summary(&self) -> Summary {
        let more = self.derived.len() + self.optional_images() * COLOR;
        Summary::new(self.columns.accumulated, self.columns.all, more)
    }

    /// The means of a tally, and what its first sample had: a sample like those that it has seen.
    pub fn means(&self, summary: &Summary) -> Vec<f32> {
        let Columns { accumulated, all, .. } = self.columns;
        let first = 4 * accumulated..3 * accumulated + all;
        let values = summary.values[..accumulated].iter().chain(&summary.values[first]);
        values.map(|value| *value as f32).collect()
    }

    /// Writes all values of a pixel, one per plane.
    #[inline]
    pub fn write<'a>(&self, tally: &Tally, summary: &mut Summary, planes: impl Iterator<Item = &'a mut f32>) {
        tally.summarise(summary);
        let (values, more) = summary.values.split_at_mut(self.behind());
        let (derived, optional) = more.split_at_mut(self.derived.len());
        for (out, source) in derived.iter_mut().zip(&self.derived) {
            *out = match *source {
                Derived::Ratio(a, b) => ratio(values[a], values[b]),
                Derived::RatioVariance(a, b) => ratio_variance(values[a], values[b], summary.samples),
                // Polarisation: the f64 rounding of the variances is far below any covariance that matters.
                Derived::Covariance([a, b, sum]) => 0.5 * (values[sum] - values[a] - values[b]),
            };
        }
        if let Some(pixel) = tally.optional() {
            pixel.finish(optional);
        }
        for (out, source) in planes.zip(&self.sources) {
            *out = summary.values[*source] as f32;
        }
    }
}
