//! The engine as nested loops: in `f64` the oracle of the tests, in `f32` the baseline of speed ratios.
//!
//! Both use one thread, compute every patch distance from its pixels, and every derivative as the formula says. Sections and
//! equations are those of rousselle2013rdfc.

use std::marker::PhantomData;

use super::{
    Border, Center, Denominator, Filtered, GuideDenominator, NlmInputs, NlmParams, PAIR_LIMIT, Pairs, Pass,
    Planes, Rule, Taps,
};
use crate::KernelError;
use crate::engine::mirror;
use crate::real::Real;

/// Largest Δ² of one pixel pair and channel; ours: without variance Δ² would reach 1/ε and leave no digits for the others.
pub(super) const LARGEST: f32 = 1e4;

/// Column and row, or an offset of both.
type At = (isize, isize);

/// What a pixel p is compared with.
#[derive(Clone, Copy)]
enum Other {
    /// The pixel at this offset.
    One(At),
    /// The mean of the pixels at this offset and at the opposite one.
    Mean(At),
}

/// Distances and weights of two opposite neighbours, and of their mean.
struct Pair<R> {
    distances: [R; 2],
    weights: [R; 2],
    mean: R,
}

impl<R: Real> Pair<R> {
    /// Share of the mean's weight: a of [`Pairs`]. Where both are not near it is `far`.
    fn share(&self, pairs: Pairs, far: R) -> R {
        let limit = R::from(PAIR_LIMIT);
        let near = self.distances[0] < limit && self.distances[1] < limit;
        if pairs == Pairs::Near && !near {
            return far;
        }
        // 0 of 0 is NaN, which the maximum drops.
        (self.mean / (self.weights[0] + self.weights[1]) - R::from(1.0)).max(R::from(0.0)).min(R::from(1.0))
    }

    /// The first neighbour's weight with this share.
    fn first(&self, share: R) -> R {
        share * self.mean + (R::from(1.0) - share) * self.weights[0]
    }
}

/// A step of the guide's three channels at one pixel.
#[derive(Clone, Copy)]
struct Move<R> {
    step: [R; 3],
    rule: Rule,
}

/// One call's constants.
struct Sweep<'a, R> {
    params: &'a NlmParams,
    inputs: &'a NlmInputs<'a>,
    pass: &'a Pass,
    precision: PhantomData<R>,
}

fn plus(a: At, b: At) -> At {
    (a.0 + b.0, a.1 + b.1)
}

fn minus(a: At, b: At) -> At {
    (a.0 - b.0, a.1 - b.1)
}

impl<R: Real> Sweep<'_, R> {
    fn index(&self, (x, y): At) -> usize {
        mirror(y, self.params.height) * self.params.width + mirror(x, self.params.width)
    }

    fn inside(&self, (x, y): At) -> bool {
        (0..self.params.width as isize).contains(&x) && (0..self.params.height as isize).contains(&y)
    }

    /// Whether the window sees this place.
    fn seen(&self, at: At) -> bool {
        self.params.rules.border == Border::Mirrored || self.inside(at)
    }

    /// Sec. 4: Δ²_c of pixel `p` and another (or the mean of two) of guide channel `c`, p and the others moved by `moved`.
    fn square(&self, c: usize, p: At, other: Other, there: &Planes<'_>, moved: (R, [R; 2])) -> R {
        let (a, b) = (&self.inputs.frame.guide[c], &there.guide[c]);
        let i = self.index(p);
        let vp = R::from(a.variance[i]);
        let (half, quarter) = (R::from(0.5), R::from(0.25));
        let at = |q: At, moved: R| {
            let j = self.index(q);
            let vq = R::from(b.variance[j]);
            (R::from(b.value[j]), moved, vp.min(vq), vq)
        };
        let (q, step, least, vq) = match other {
            Other::One(d) => at(plus(p, d), moved.1[0]),
            Other::Mean(d) => {
                let (q1, q2) = (at(plus(p, d), moved.1[0]), at(minus(p, d), moved.1[1]));
                let mean = |a: R, b: R| half * (a + b);
                (mean(q1.0, q2.0), mean(q1.1, q2.1), quarter * (q1.2 + q2.2), quarter * (q1.3 + q2.3))
            }
        };
        let d = (R::from(a.value[i]) - q) + (moved.0 - step);
        let k = R::from(self.params.k);
        let noise = R::from(self.params.cancellation) * (vp + least);
        let both = match self.params.guide_denominator {
            GuideDenominator::Pair => vp + vq,
            GuideDenominator::TwiceCenter => vp + vp,
        };
        ((d * d - noise) / (R::from(self.params.epsilon) + k * k * both)).min(R::from(LARGEST))
    }

    /// Sec. 4: d² of the patches around `p` and another pixel, the exponent of Eq. 2, with the guide at p moved.
    fn patch(&self, p: At, other: Other, there: &Planes<'_>, same_frame: bool, moved: Move<R>) -> R {
        let Some(f) = self.pass.patch else { return R::from(0.0) };
        let (f, channels) = (f as isize, self.inputs.frame.guide.len());
        let mut sum = R::from(0.0);
        let mut taps = 0;
        for n in (-f..=f).flat_map(|y| (-f..=f).map(move |x| (x, y))) {
            let a = plus(p, n);
            if self.params.rules.taps == Taps::Clipped && !self.inside(a) {
                continue;
            }
            taps += 1;
            let exchanged = |q: At| same_frame && moved.rule == Rule::Exact && q == p;
            let (first, second) = match other {
                Other::One(d) => (exchanged(plus(a, d)), false),
                Other::Mean(d) => (exchanged(plus(a, d)), exchanged(minus(a, d))),
            };
            for c in 0..channels {
                let by = moved.step.get(c).copied().unwrap_or(R::from(0.0));
                let when = |yes: bool| if yes { by } else { R::from(0.0) };
                sum += self.square(c, a, other, there, (when(a == p), [when(first), when(second)]));
            }
        }
        sum / (R::round(channels as f64) * R::round(f64::from(taps)))
    }

    /// Sec. 5: Φ² of one feature, an exponent of Eq. 3.
    fn feature(&self, j: usize, p: At, other: Other, there: &Planes<'_>) -> R {
        let (k, floor) = (R::from(self.params.feature_k), R::from(self.pass.floor));
        let (half, quarter) = (R::from(0.5), R::from(0.25));
        let here = &self.inputs.frame.features[j];
        let i = self.index(p);
        let mut sum = R::from(0.0);
        for (a, b) in here.iter().zip(&there.features[j]) {
            let vp = R::from(a.variance[i]);
            let at = |q: At| {
                let q = self.index(q);
                (R::from(b.value[q]), vp.min(R::from(b.variance[q])), R::from(b.spread[q]).max(floor))
            };
            let (q, least, spread) = match other {
                Other::One(d) => at(plus(p, d)),
                Other::Mean(d) => {
                    let (q1, q2) = (at(plus(p, d)), at(minus(p, d)));
                    (half * (q1.0 + q2.0), quarter * (q1.1 + q2.1), quarter * (q1.2 + q2.2))
                }
            };
            let d = R::from(a.value[i]) - q;
            let own = R::from(a.spread[i]).max(floor);
            let both = match self.params.denominator {
                Denominator::Center => own,
                Denominator::Pair => own + spread,
            };
            sum += (d * d - (vp + least)) / (k * k * both);
        }
        sum / R::round(here.len() as f64)
    }

    /// Eq. 2: weight of the guide, smoothed.
    fn guided(&self, p: At, other: Other, there: &Planes<'_>, same_frame: bool, moved: Move<R>) -> R {
        let radius = self.pass.patch.map_or(0, |f| self.params.rules.smoothing.radius(f)) as isize;
        let mut sum = R::from(0.0);
        let mut count = 0;
        for n in (-radius..=radius).flat_map(|y| (-radius..=radius).map(move |x| (x, y))) {
            let at = plus(p, n);
            if self.inside(at) {
                sum += exponential(self.patch(at, other, there, same_frame, moved));
                count += 1;
            }
        }
        sum / R::round(f64::from(count))
    }

    /// The guide's weight of the neighbour at `d`, which the opposite one shares.
    fn paired(&self, p: At, d: At, there: &Planes<'_>, same_frame: bool, moved: Move<R>) -> R {
        let opposite = (-d.0, -d.1);
        let pairs = self.params.rules.pairs;
        let fixed = Move { step: [R::from(0.0); 3], ..moved };
        let pair = |at: At, moved: Move<R>, smoothed: bool| {
            let weight = |other: Other| {
                if smoothed {
                    self.guided(at, other, there, same_frame, moved)
                } else {
                    exponential(self.patch(at, other, there, same_frame, moved))
                }
            };
            Pair {
                distances: [d, opposite].map(|d| self.patch(at, Other::One(d), there, same_frame, moved)),
                weights: [d, opposite].map(|d| weight(Other::One(d))),
                mean: weight(Other::Mean(d)),
            }
        };
        if pairs == Pairs::Near {
            let pair = |moved: Move<R>| pair(p, moved, true);
            // The program leaves a pair that the step takes beyond the limit the share that it had.
            let far = match moved.rule {
                Rule::Joint => pair(fixed).share(pairs, R::from(0.0)),
                Rule::Exact => R::from(0.0),
            };
            let pair = pair(moved);
            return pair.first(pair.share(pairs, far));
        }
        let radius = self.pass.patch.map_or(0, |f| self.params.rules.smoothing.radius(f)) as isize;
        let mut sum = R::from(0.0);
        let mut count = 0;
        for n in (-radius..=radius).flat_map(|y| (-radius..=radius).map(move |x| (x, y))) {
            let at = plus(p, n);
            if !self.inside(at) {
                continue;
            }
            count += 1;
            if self.seen(plus(at, d)) && self.seen(minus(at, d)) {
                let pair = pair(at, moved, false);
                sum += pair.first(pair.share(pairs, R::from(0.0)));
            } else {
                sum += exponential(self.patch(at, Other::One(d), there, same_frame, moved));
            }
        }
        sum / R::round(f64::from(count))
    }

    /// Eq. 4: the smaller of Eq. 2 and Eq. 3.
    fn weight(&self, p: At, d: At, there: &Planes<'_>, same_frame: bool, moved: Move<R>) -> R {
        let pairs = self.params.rules.pairs;
        // The pixel itself has no opposite.
        let shared = pairs != Pairs::None && d != (0, 0);
        let both = shared && self.seen(plus(p, d)) && self.seen(minus(p, d));
        let mut least = R::from(1.0);
        if self.pass.patch.is_some() {
            // Raw pairs are shared before smoothing, pixel by pixel.
            least = if both || (shared && pairs == Pairs::Raw) {
                self.paired(p, d, there, same_frame, moved)
            } else {
                self.guided(p, Other::One(d), there, same_frame, moved)
            };
        }
        for j in 0..self.inputs.frame.features.len() {
            let distance = |other: Other| self.feature(j, p, other, there);
            let own = distance(Other::One(d));
            if !both {
                least = least.min(exponential(own));
                continue;
            }
            let distances = [own, distance(Other::One((-d.0, -d.1)))];
            let weights = distances.map(exponential);
            let pair = Pair { distances, weights, mean: exponential(distance(Other::Mean(d))) };
            least = least.min(pair.first(pair.share(pairs, R::from(0.0))));
        }
        least
    }

    /// Weights of all neighbours of `p` in all frames (Sec. 8), and its own (the text has 1).
    fn weights(&self, p: At, step: [R; 3], rule: Rule) -> (Vec<(usize, usize, R)>, R) {
        let r = self.params.window_radius as isize;
        let mut weights = Vec::new();
        let frames = std::iter::once(&self.inputs.frame).chain(&self.inputs.neighbors);
        for (t, there) in frames.enumerate() {
            for d in (-r..=r).flat_map(|y| (-r..=r).map(move |x| (x, y))) {
                let q = plus(p, d);
                if (t == 0 && d == (0, 0)) || !self.seen(q) {
                    continue;
                }
                weights.push((t, self.index(q), self.weight(p, d, there, t == 0, Move { step, rule })));
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

/// Weight of a distance (Eq. 2 and Eq. 3): negative ones count as 0.
fn exponential<R: Real>(distance: R) -> R {
    (-distance.max(R::from(0.0))).exp()
}

/// All passes in one precision.
fn filter<R: Real>(
    params: &NlmParams,
    passes: &[Pass],
    inputs: &NlmInputs<'_>,
) -> Result<Vec<Filtered<R>>, KernelError> {
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
) -> Result<Vec<Filtered<f64>>, KernelError> {
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
) -> Result<Vec<Filtered<f32>>, KernelError> {
    filter(params, passes, inputs)
}
