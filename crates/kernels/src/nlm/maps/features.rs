//! Weights of features (rousselle2013rdfc, Sec. 5, Eq. 3), shared by opposite neighbours.

use super::exponential::exponential;
use super::pairs::{near, share, shared};
use super::squares::least;
use crate::nlm::{Denominator, NlmParams, Pairs};

/// What Φ² is made of beside values, variances and spreads.
#[derive(Clone, Copy, Debug)]
pub(super) struct FeatureSquare {
    k2: f32,
    /// How often the other pixel's D stands in the denominator.
    second: f32,
}

/// A row of a feature channel.
#[derive(Clone, Copy)]
pub(super) struct FeatureRow<'a> {
    pub value: &'a [f32],
    pub variance: &'a [f32],
    pub spread: &'a [f32],
}

impl FeatureRow<'_> {
    #[inline(always)]
    fn at(&self, i: usize, floor: f32) -> (f32, f32, f32) {
        let spread = self.spread[i];
        (self.value[i], self.variance[i], if spread > floor { spread } else { floor })
    }

    #[inline(always)]
    fn first(self, n: usize) -> Self {
        Self { value: &self.value[..n], variance: &self.variance[..n], spread: &self.spread[..n] }
    }
}

impl FeatureSquare {
    pub fn new(params: &NlmParams) -> Self {
        let second = if params.denominator == Denominator::Pair { 1.0 } else { 0.0 };
        Self { k2: params.feature_k * params.feature_k, second }
    }

    #[inline(always)]
    fn of(self, d: f32, (variance, own): (f32, f32), least: f32, other: f32) -> f32 {
        // D is at least τ, which is above 0.
        (d * d - (variance + least)) / (self.k2 * (own + self.second * other))
    }

    /// Adds a row of Φ² of pixels and neighbours.
    #[inline(always)]
    pub fn add_one(self, to: &mut [f32], p: FeatureRow<'_>, q: FeatureRow<'_>, floor: f32) {
        let n = to.len();
        let (p, q) = (p.first(n), q.first(n));
        for (i, to) in to.iter_mut().enumerate() {
            let (p, q) = (p.at(i, floor), q.at(i, floor));
            *to += self.of(p.0 - q.0, (p.1, p.2), least(p.1, q.1), q.2);
        }
    }

    /// Adds a row of Φ² of pixels and means of two neighbours.
    #[inline(always)]
    pub fn add_mean(self, to: &mut [f32], p: FeatureRow<'_>, q: [FeatureRow<'_>; 2], floor: f32) {
        let n = to.len();
        let (p, q1, q2) = (p.first(n), q[0].first(n), q[1].first(n));
        for (i, to) in to.iter_mut().enumerate() {
            let (p, q1, q2) = (p.at(i, floor), q1.at(i, floor), q2.at(i, floor));
            let d = p.0 - 0.5 * (q1.0 + q2.0);
            let least = 0.25 * (least(p.1, q1.1) + least(p.1, q2.1));
            *to += self.of(d, (p.1, p.2), least, 0.25 * (q1.2 + q2.2));
        }
    }
}

/// Raises a row of distances to those by a feature of `channels`, with its sums of Φ².
#[inline(always)]
pub(super) fn farther(distances: &mut [f32], sums: &[f32], channels: f32) {
    for (distance, sum) in distances.iter_mut().zip(sums) {
        let own = sum / channels;
        *distance = if own > *distance { own } else { *distance };
    }
}

/// Lowers a row of weights of two opposite neighbours to what a feature of `channels` allows each by itself.
#[inline(always)]
pub(super) fn limit_alone(limits: [&mut [f32]; 2], sums: [&[f32]; 2], channels: f32) {
    for (limits, sums) in limits.into_iter().zip(sums) {
        for (limit, sum) in limits.iter_mut().zip(sums) {
            *limit = least(exponential(sum / channels), *limit);
        }
    }
}

/// Lowers a row of weights of two opposite neighbours to what a feature of `channels` allows, with the sums of Φ² of
/// each and of their mean.
#[inline(always)]
pub(super) fn limit_pair(
    [first, second]: [&mut [f32]; 2],
    [sums1, sums2, means]: [&[f32]; 3],
    channels: f32,
    pairs: Pairs,
) {
    let all = pairs == Pairs::Raw;
    let limits = first.iter_mut().zip(second);
    for ((limits, (d1, d2)), mean) in limits.zip(sums1.iter().zip(sums2)).zip(means) {
        let (d1, d2) = (d1 / channels, d2 / channels);
        let (w1, w2, mean) = (exponential(d1), exponential(d2), exponential(mean / channels));
        let a = if near(d1, d2) | all { share(w1, w2, mean) } else { 0.0 };
        *limits.0 = least(shared(a, w1, mean), *limits.0);
        *limits.1 = least(shared(a, w2, mean), *limits.1);
    }
}
