//! The engine as nested loops: in `f64` the oracle of the tests, in `f32` the baseline of speed ratios.
//!
//! Both use one thread, compute every patch distance from its pixels, and every derivative as the formula says. Sections and
//! equations are those of rousselle2013rdfc.

use super::{
    Center, Denominator, Filtered, GuideDenominator, NlmError, NlmInputs, NlmParams, Pass, Planes, Rule,
};
use crate::mirror::mirror;

/// Largest Δ² of one pixel pair and channel; ours: without variance Δ² would reach 1/ε and leave no digits for the others.
pub(super) const LARGEST: f32 = 1e4;

/// Column and row, or an offset of both.
type At = (isize, isize);

macro_rules! naive_twin {
    ($real:ident, $sweep:ident, $(#[$doc:meta])* $filter:ident) => {
        /// One call's constants.
        struct $sweep<'a> {
            params: &'a NlmParams,
            inputs: &'a NlmInputs<'a>,
            pass: &'a Pass,
        }

        impl $sweep<'_> {
            fn index(&self, (x, y): At) -> usize {
                mirror(y, self.params.height) * self.params.width + mirror(x, self.params.width)
            }

            /// Sec. 4: Δ²_c of two pixels of guide channel `c`, one moved by `moved` (p's and q's share).
            fn square(&self, c: usize, (p, q): (At, At), there: &Planes<'_>, moved: ($real, $real)) -> $real {
                let (a, b) = (&self.inputs.frame.guide[c], &there.guide[c]);
                let (i, j) = (self.index(p), self.index(q));
                let d = (a.value[i] as $real - b.value[j] as $real) + (moved.0 - moved.1);
                let (vp, vq) = (a.variance[i] as $real, b.variance[j] as $real);
                let k = self.params.k as $real;
                let noise = self.params.cancellation as $real * (vp + vp.min(vq));
                let both = match self.params.guide_denominator {
                    GuideDenominator::Pair => vp + vq,
                    GuideDenominator::TwiceCenter => vp + vp,
                };
                ((d * d - noise) / (self.params.epsilon as $real + k * k * both)).min(LARGEST as $real)
            }

            /// Sec. 4: d² of the patches around `p` and `q`, the exponent of Eq. 2, with the guide's channel c at p moved by `step[c]` under `rule`.
            fn patch(
                &self,
                (p, q): (At, At),
                there: &Planes<'_>,
                same_frame: bool,
                step: [$real; 3],
                rule: Rule,
            ) -> $real {
                let Some(f) = self.pass.patch else { return 0.0 };
                let (f, channels) = (f as isize, self.inputs.frame.guide.len());
                let mut sum = 0.0;
                for (ny, nx) in (-f..=f).flat_map(|y| (-f..=f).map(move |x| (y, x))) {
                    let (a, b) = ((p.0 + nx, p.1 + ny), (q.0 + nx, q.1 + ny));
                    let exchanged = same_frame && rule == Rule::Exact && b == p;
                    for c in 0..channels {
                        let by = if c < 3 { step[c] } else { 0.0 };
                        let moved = (if a == p { by } else { 0.0 }, if exchanged { by } else { 0.0 });
                        // At q = p both are the same pixel, in either rule.
                        let moved = if same_frame && a == p && b == p { (0.0, 0.0) } else { moved };
                        sum += self.square(c, (a, b), there, moved);
                    }
                }
                sum / (channels as $real * ((2 * f + 1) * (2 * f + 1)) as $real)
            }

            /// Sec. 5: largest Φ² of all features, the exponent of Eq. 3; −∞ without any.
            fn features(&self, p: usize, q: usize, there: &Planes<'_>) -> $real {
                let (k, floor) = (self.params.feature_k as $real, self.pass.floor as $real);
                let mut largest = $real::NEG_INFINITY;
                for (here, there) in self.inputs.frame.features.iter().zip(&there.features) {
                    let mut sum = 0.0;
                    for (a, b) in here.iter().zip(there) {
                        let d = a.value[p] as $real - b.value[q] as $real;
                        let (vp, vq) = (a.variance[p] as $real, b.variance[q] as $real);
                        let mut spread = (a.spread[p] as $real).max(floor);
                        if self.params.denominator == Denominator::Pair {
                            spread += (b.spread[q] as $real).max(floor);
                        }
                        sum += (d * d - (vp + vp.min(vq))) / (k * k * spread);
                    }
                    largest = largest.max(sum / here.len() as $real);
                }
                largest
            }

            /// Weights of all neighbours of `p` in all frames (Sec. 8), and its own (the text has 1).
            fn weights(&self, p: At, step: [$real; 3], rule: Rule) -> (Vec<(usize, usize, $real)>, $real) {
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
                            let d2 = d2.max(self.features(self.index(p), q, there)).max(0.0);
                            weights.push((t, q, (-d2).exp()));
                        }
                    }
                }
                let center = match self.params.center {
                    Center::One => 1.0,
                    Center::LargestNeighbor { least } => {
                        weights.iter().fold(least as $real, |largest, (_, _, w)| largest.max(*w))
                    }
                };
                (weights, center)
            }

            /// Eq. 1 as Σ w·(value − value at p)/Σ w + value at p, which keeps constants to the bit.
            fn mean(
                &self,
                (weights, center): &(Vec<(usize, usize, $real)>, $real),
                center_value: $real,
                value: impl Fn(usize, usize) -> $real,
            ) -> $real {
                let mut sum = 0.0;
                let mut total = *center;
                for (t, q, w) in weights {
                    sum += w * (value(*t, *q) - center_value);
                    total += w;
                }
                // The centre's weight is above 0.
                center_value + sum / total
            }

            fn run(&self) -> Filtered<$real> {
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
                    let weights = self.weights(p, [0.0; 3], Rule::Exact);
                    let total: $real = weights.1 + weights.0.iter().map(|(_, _, w)| w).sum::<$real>();
                    let share = weights.1 / total;
                    out.weight_sum.push(total);
                    out.center_share.push(share);
                    for (k, plane) in out.planes.iter_mut().enumerate() {
                        let center = self.inputs.frame.targets[k][i] as $real;
                        plane.push(self.mean(&weights, center, |t, q| frames[t].targets[k][q] as $real));
                    }
                    for (c, plane) in out.derivative.iter_mut().enumerate() {
                        // Sec. 6, below Eq. 5: (F at u + δ − F at u)/δ.
                        let (Some(_), Some(perturbation)) = (self.pass.patch, &self.inputs.perturbation) else {
                            plane.push(share);
                            continue;
                        };
                        let steps = perturbation.step.map(|step| step[i] as $real);
                        let delta = steps[c];
                        if delta == 0.0 {
                            plane.push(share);
                            continue;
                        }
                        let mut alone = [0.0; 3];
                        alone[c] = delta;
                        let moved = match perturbation.rule {
                            Rule::Exact => self.weights(p, alone, Rule::Exact),
                            Rule::Joint => self.weights(p, steps, Rule::Joint),
                        };
                        let center = self.inputs.frame.guide[c].value[i] as $real;
                        let value = |t: usize, q: usize| frames[t].guide[c].value[q] as $real;
                        let before = self.mean(&weights, center, value);
                        // Only the pixel itself is moved; no neighbour is it.
                        let after = self.mean(&moved, center + delta, value);
                        plane.push((after - before) / delta);
                    }
                }
                out
            }
        }

        $(#[$doc])*
        ///
        /// # Errors
        /// As [`NlmParams::check`].
        pub fn $filter(
            params: &NlmParams,
            passes: &[Pass],
            inputs: &NlmInputs<'_>,
        ) -> Result<Vec<Filtered<$real>>, NlmError> {
            params.check(passes, inputs)?;
            Ok(passes.iter().map(|pass| $sweep { params, inputs, pass }.run()).collect())
        }
    };
}

naive_twin! {
    f64, SweepF64,
    /// The engine in double precision: the oracle.
    filter_f64
}
naive_twin! {
    f32, SweepF32,
    /// The same loops in single precision: what a first implementation would be, and the baseline of speed ratios.
    filter_f32
}
