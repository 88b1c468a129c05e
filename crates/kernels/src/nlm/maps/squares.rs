//! Δ² of the guide (rousselle2013rdfc, Sec. 4), of neighbours and of the mean of two.

use crate::nlm::naive::LARGEST;
use crate::nlm::{GuideDenominator, NlmParams};

/// What Δ² is made of beside values and variances.
#[derive(Clone, Copy, Debug)]
pub(super) struct Square {
    cancellation: f32,
    epsilon: f32,
    /// k² times how often the variance of the pair's first pixel stands in the denominator, and that of its second.
    first: f32,
    second: f32,
}

impl Square {
    pub fn new(params: &NlmParams) -> Self {
        let k2 = params.k * params.k;
        let (first, second) = match params.guide_denominator {
            GuideDenominator::Pair => (k2, k2),
            GuideDenominator::TwiceCenter => (2.0 * k2, 0.0),
        };
        Self { cancellation: params.cancellation, epsilon: params.epsilon, first, second }
    }

    /// Δ² of a difference; `least` is the other's part of the noise, `other` its variance.
    #[inline(always)]
    fn of(self, d: f32, variance: f32, least: f32, other: f32) -> f32 {
        let excess = d * d - self.cancellation * (variance + least);
        // At least ε.
        let square = excess / (self.epsilon + (self.first * variance + self.second * other));
        if square < LARGEST { square } else { LARGEST }
    }

    /// Δ² of a pixel and its neighbour, each (value, variance), `step` added to their difference.
    #[inline(always)]
    pub fn one(self, p: (f32, f32), q: (f32, f32), step: f32) -> f32 {
        self.of((p.0 - q.0) + step, p.1, least(p.1, q.1), q.1)
    }

    /// Δ² of a pixel and the mean of two neighbours.
    #[inline(always)]
    pub fn mean(self, p: (f32, f32), q: [(f32, f32); 2], step: f32) -> f32 {
        let d = p.0 - 0.5 * (q[0].0 + q[1].0);
        let least = 0.25 * (least(p.1, q[0].1) + least(p.1, q[1].1));
        self.of(d + step, p.1, least, 0.25 * (q[0].1 + q[1].1))
    }

    /// What a step of the pixel adds to [`Square::one`].
    #[inline(always)]
    pub fn bend_one(self, p: (f32, f32), q: (f32, f32), step: f32) -> f32 {
        self.one(p, q, step) - self.one(p, q, 0.0)
    }

    /// What a step of the difference adds to [`Square::mean`].
    #[inline(always)]
    pub fn bend_mean(self, p: (f32, f32), q: [(f32, f32); 2], step: f32) -> f32 {
        self.mean(p, q, step) - self.mean(p, q, 0.0)
    }
}

#[inline(always)]
pub(super) fn least(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// Values and variances of a row.
#[derive(Clone, Copy)]
pub(super) struct Row<'a> {
    pub value: &'a [f32],
    pub variance: &'a [f32],
}

/// Adds a row of Δ² of pixels and neighbours.
#[inline(always)]
pub(super) fn add_one(square: Square, to: &mut [f32], p: Row<'_>, q: Row<'_>) {
    let n = to.len();
    let (u, v) = (&p.value[..n], &p.variance[..n]);
    let (uq, vq) = (&q.value[..n], &q.variance[..n]);
    for i in 0..n {
        to[i] += square.one((u[i], v[i]), (uq[i], vq[i]), 0.0);
    }
}

/// Adds a row of Δ² of pixels and means of two neighbours.
#[inline(always)]
pub(super) fn add_mean(square: Square, to: &mut [f32], p: Row<'_>, [q1, q2]: [Row<'_>; 2]) {
    let n = to.len();
    let (u, v) = (&p.value[..n], &p.variance[..n]);
    let (u1, v1) = (&q1.value[..n], &q1.variance[..n]);
    let (u2, v2) = (&q2.value[..n], &q2.variance[..n]);
    for i in 0..n {
        to[i] += square.mean((u[i], v[i]), [(u1[i], v1[i]), (u2[i], v2[i])], 0.0);
    }
}
