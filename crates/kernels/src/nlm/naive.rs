//! The engine as nested loops: in `f64` the oracle of the tests, in `f32` the baseline of speed ratios.
//!
//! Both use one thread, compute every patch distance from its pixels, and every derivative as the formula says. Sections and
//! equations are those of rousselle2013rdfc.

use std::marker::PhantomData;

use super::{
    Center, Denominator, Filtered, GuideDenominator, NlmError, NlmInputs, NlmParams, Pass, Planes, Rule,
};
use crate::engine::mirror;
use crate::real::Real;

/// Largest Δ² of one pixel pair and channel; ours: without variance Δ² would reach 1/ε and leave no digits for the others.
pub(super) const LARGEST: f32 = 1e4;

/// Column and row, or an offset of both.
type At = (isize, isize);

/// One call's constants.
struct Sweep<'a, R> {
    params: &'a NlmParams,
    inputs: &'a NlmInputs<'a>,
    pass: &'a Pass,
    precision: PhantomData<R>,
}

impl<R: Real> Sweep<'_, R> {
    fn index(&self, (x, y): At) -> usize {
        mirror(y, self.params.height) * self.params.width + mirror(x, self.params.width)
    }

    /// Sec. 4: Δ²_c of two pixels of guide channel `c`, one moved by `moved` (p's and q's share).
    fn square(&self, c: usize, (p, q): (At, At), there: &Planes<'_>, moved: (R, R)) -> R {
        let (a, b) = (&self.inputs.frame.guide[c], &there.guide[c]);
        let (i, j) = (self.index(p), self.index(q));
        let d = (R::from(a.value[i]) - R::from(b.value[j])) + (moved.0 - moved.1);
        let (vp, vq) = (R::from(a.variance[i]), R::from(b.variance[j]));
        let k = R::from(self.params.k);
        let noise = R::from(self.params.cancellation) * (vp + vp.min(vq));
        let both = match self.params.guide_denominator {
            GuideDenominator::Pair => vp + vq,
            GuideDenominator::TwiceCenter => vp + vp,
        };
        ((d * d - noise) / (R::from(self.params.epsilon) + k * k * both)).min(R::from(LARGEST))
    }

    /// Sec. 4: d² of the patches around `p` and `q`, the exponent of Eq. 2, with the guide's channel c at p moved by `step[c]` under `rule`.
    fn patch(&self, (p, q): (At, At), there: &Planes<'_>, same_frame: bool, step: [R; 3], rule: Rule) -> R {
        let Some(f) = self.pass.patch else { return R::from(0.0) };
        let (f, channels) = (f as isize, self.inputs.frame.guide.len());
        let mut sum = R::from(0.0);
        for (ny, nx) in (-f..=f).flat_map(|y| (-f..=f).map(move |x| (y, x))) {
            let (a, b) = ((p.0 + nx, p.1 + ny), (q.0 + nx, q.1 + ny));
            let exchanged = same_frame && rule == Rule::Exact && b == p;
            for c in 0..channels {
                let by = step.get(c).copied().unwrap_or(R::from(0.0));
                let moved =
                    (if a == p { by } else { R::from(0.0) }, if exchanged { by } else { R::from(0.0) });
                // At q = p both are the same pixel, in either rule.
                let moved = if same_frame && a == p && b == p { (R::from(0.0), R::from(0.0)) } else { moved };
                sum += self.square(c, (a, b), there, moved);
            }
        }
        sum / (R::round(channels as f64) * R::round(((2 * f + 1) * (2 * f + 1)) as f64))
    }

    /// Sec. 5: largest Φ² of all features, the exponent of Eq. 3; −∞ without any.
    fn features(&self, p: usize, q: usize, there: &Planes<'_>) -> R {
        let (k, floor) = (R::from(self.params.feature_k), R::from(self.pass.floor));
        let mut largest = R::LEAST;
        for (here, there) in self.inputs.frame.features.iter().zip(&there.features) {
            let mut sum = R::from(0.0);
            for (a, b) in here.iter().zip(there) {
                let d = R::from(a.value[p]) - R::from(b.value[q]);
                let (vp, vq) = (R::from(a.variance[p]), R::from(b.variance[q]));
                let mut spread = R::from(a.spread[p]).max(floor);
                if self.params.denominator == Denominator::Pair {
                    spread += R::from(b.spread[q]).max(floor);
                }
                sum += (d * d - (vp + vp.min(vq))) / (k * k * spread);
            }
            largest = largest.max(sum / R::round(here.len() as f64));
        }
        largest
    }

    /// Weights of all neighbours of `p` in all frames (Sec. 8), and its own (the text has 1).
    fn weights(&self, p: At, step: [R; 3], rule: Rule) -> (Vec<(usize, usize, R)>, R) {
        let (w, h) = (self.params.width as isize, self.params.height as isize);
        let r = self.params.window_radius as isize;
        let mut weights = Vec::new();
        let frames = std::iter::once(&self.inputs.frame).chain(&self.inputs.neighbors);
        for (t, there) in frames.enumerate() {
            for y in (p.1 - r).max(0)..=(p.1 + r).min(h - 1) {
                for x in (p.0 - r).max(0)..=(p.0 + r).min(w - 1) {
                    if t == 0 && (x, y) == p {
                        continue;
                    }
                    let q = self.index((x, y));
                    // The larger exponent is the smaller weight: Eq. 4 of Eq. 2 and Eq. 3.
                    let d2 = self.patch((p, (x, y)), there, t == 0, step, rule);
                    let d2 = d2.max(self.features(self.index(p), q, there)).max(R::from(0.0));
                    weights.push((t, q, (-d2).exp()));
                }
            }
        }
        let center = match self.params.center {
            Center::One => R::from(1.0),
            Center::LargestNeighbor { least } => {
                weights.iter().fold(R::from(least), |largest, (_, _, w)| largest.max(*w))
            }
        };
        (weights, center)
    }

    /// Eq. 1 as Σ w·(value − value at p)/Σ w + value at p, which keeps constants to the bit.
    fn mean(
        &self,
        (weights, center): &(Vec<(usize, usize, R)>, R),
        center_value: R,
        value: impl Fn(usize, usize) -> R,
    ) -> R {
        let mut sum = R::from(0.0);
        let mut total = *center;
        for (t, q, w) in weights {
            sum += *w * (value(*t, *q) - center_value);
            total += *w;
        }
        // The centre's weight is above 0.
        center_value + sum / total
    }

    fn run(&self) -> Filtered<R> {
        let (w, h) = (self.params.width as isize, self.params.height as isize);
        let frames: Vec<&Planes<'_>> =
            std::iter::once(&self.inputs.frame).chain(&self.inputs.neighbors).collect();
        let derivatives = if self.pass.derivative { 3 } else { 0 };
        let mut out = Filtered {
            planes: vec![Vec::new(); self.inputs.frame.targets.len()],
            weight_sum: Vec::new(),
            center_share: Vec::new(),
            derivative: vec![Vec::new(); derivatives],
        };
        for p in (0..h).flat_map(|y| (0..w).map(move |x| (x, y))) {
            let i = self.index(p);
            let weights = self.weights(p, [R::from(0.0); 3], Rule::Exact);
            let total: R = weights.1 + weights.0.iter().map(|(_, _, w)| *w).sum::<R>();
            let share = weights.1 / total;
            out.weight_sum.push(total);
            out.center_share.push(share);
            for (k, plane) in out.planes.iter_mut().enumerate() {
                let center = R::from(self.inputs.frame.targets[k][i]);
                plane.push(self.mean(&weights, center, |t, q| R::from(frames[t].targets[k][q])));
            }
            for (c, plane) in out.derivative.iter_mut().enumerate() {
                // Sec. 6, below Eq. 5: (F at u + δ − F at u)/δ.
                let (Some(_), Some(perturbation)) = (self.pass.patch, &self.inputs.perturbation) else {
                    plane.push(share);
                    continue;
                };
                let steps = perturbation.step.map(|step| R::from(step[i]));
                let delta = steps[c];
                if delta == R::from(0.0) {
                    plane.push(share);
                    continue;
                }
                let mut alone = [R::from(0.0); 3];
                alone[c] = delta;
                let moved = match perturbation.rule {
                    Rule::Exact => self.weights(p, alone, Rule::Exact),
                    Rule::Joint => self.weights(p, steps, Rule::Joint),
                };
                let center = R::from(self.inputs.frame.guide[c].value[i]);
                let value = |t: usize, q: usize| R::from(frames[t].guide[c].value[q]);
                let before = self.mean(&weights, center, value);
                // Only the pixel itself is moved; no neighbour is it.
                let after = self.mean(&moved, center + delta, value);
                plane.push((after - before) / delta);
            }
        }
        out
    }
}

/// All passes in one precision.
fn filter<R: Real>(
    params: &NlmParams,
    passes: &[Pass],
    inputs: &NlmInputs<'_>,
) -> Result<Vec<Filtered<R>>, NlmError> {
    params.check(passes, inputs)?;
    Ok(passes.iter().map(|pass| Sweep { params, inputs, pass, precision: PhantomData }.run()).collect())
}

/// The engine in double precision: the oracle.
///
/// # Errors
/// As [`NlmParams::check`].
pub fn filter_f64(
    params: &NlmParams,
    passes: &[Pass],
    inputs: &NlmInputs<'_>,
) -> Result<Vec<Filtered<f64>>, NlmError> {
    filter(params, passes, inputs)
}

/// The same loops in single precision: what a first implementation would be, and the baseline of speed ratios.
///
/// # Errors
/// As [`NlmParams::check`].
pub fn filter_f32(
    params: &NlmParams,
    passes: &[Pass],
    inputs: &NlmInputs<'_>,
) -> Result<Vec<Filtered<f32>>, NlmError> {
    filter(params, passes, inputs)
}
