//! From a request to the values of a pixel and to the planes that are kept.

use crate::columns::{COLOR, Column, Columns};
use crate::planes::Sheet;
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
    /// The values of a pixel: what a [`Summary`] has, then what is derived from it; and the planes.
    pub sheet: Sheet,
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
        let mut plan = Self { columns, color: limit, extras, sheet: Sheet::default(), derived: Vec::new() };
        plan.lay_out();
        Ok(plan)
    }

    /// Lists the planes, image by image in the order in which a frame is put together.
    fn lay_out(&mut self) {
        let Columns { accumulated, all, list } = self.columns.clone();
        let part = |part: usize, first: usize, channels: usize| {
            let first = part * accumulated + first;
            first..first + channels
        };
        let mut derived = |value: Derived| {
            self.derived.push(value);
            3 * accumulated + all + self.derived.len() - 1
        };
        let sheet = &mut self.sheet;
        let estimate = |sheet: &mut Sheet, first: usize, channels: usize, keep: Keep| {
            let parts = [(0, true), (1, keep.variance), (2, keep.halves), (3, keep.halves)];
            for (number, _) in parts.iter().filter(|(_, kept)| *kept) {
                sheet.image(part(*number, first, channels));
            }
        };
        estimate(sheet, 0, COLOR, self.color);
        for Column { row, keep, first, channels } in list {
            match row.joined {
                Joined::Mean => estimate(sheet, first, channels, keep),
                Joined::Pair => {
                    estimate(sheet, first, channels, keep);
                    estimate(sheet, first + channels, channels, keep);
                    if keep.variance {
                        let covariance = (0..channels).map(|c| {
                            let of = |k: usize| accumulated + first + k * channels + c;
                            derived(Derived::Covariance([of(0), of(1), of(2)]))
                        });
                        sheet.image(covariance.collect::<Vec<_>>());
                    }
                }
                Joined::Ratio => {
                    let of = |number: usize| (number * accumulated + first, number * accumulated + first + 1);
                    let ((a, b), (even_a, even_b), (odd_a, odd_b)) = (of(0), of(2), of(3));
                    sheet.image([derived(Derived::Ratio(a, b))]);
                    if keep.variance {
                        sheet.image([derived(Derived::RatioVariance(a, b))]);
                    }
                    if keep.halves {
                        sheet.image([derived(Derived::Ratio(even_a, even_b))]);
                        sheet.image([derived(Derived::Ratio(odd_a, odd_b))]);
                    }
                }
                Joined::First => sheet.image(part(3, first, channels)),
            }
        }
        sheet.values = 3 * accumulated + all + self.derived.len();
    }

    /// Planes of a frame.
    pub fn planes(&self) -> usize {
        self.sheet.sources.len()
    }

    /// A tally of what is recorded.
    pub fn tally(&self) -> Tally {
        Tally::new(self.columns.accumulated, self.columns.all)
    }

    /// Room for what such a tally comes to.
    pub fn summary(&self) -> Summary {
        Summary::new(self.columns.accumulated, self.columns.all)
    }

    /// The means of a tally, and what its first sample had: a sample like those that it has seen.
    pub fn means(&self, summary: &Summary) -> Vec<f32> {
        let Columns { accumulated, .. } = self.columns;
        let values = summary.values[..accumulated].iter().chain(&summary.values[4 * accumulated..]);
        values.map(|value| *value as f32).collect()
    }

    /// Writes all values of a pixel.
    #[inline]
    pub fn write(&self, tally: &Tally, summary: &mut Summary, out: &mut [f32]) {
        tally.summarise(summary);
        let values = &summary.values;
        let (plain, derived) = out.split_at_mut(values.len());
        for (out, value) in plain.iter_mut().zip(values) {
            *out = *value as f32;
        }
        for (out, source) in derived.iter_mut().zip(&self.derived) {
            *out = match *source {
                Derived::Ratio(a, b) => ratio(values[a], values[b]),
                Derived::RatioVariance(a, b) => ratio_variance(values[a], values[b], summary.samples),
                // Polarisation: the f64 rounding of the variances is far below any covariance that matters.
                Derived::Covariance([a, b, sum]) => 0.5 * (values[sum] - values[a] - values[b]),
            } as f32;
        }
    }
}
