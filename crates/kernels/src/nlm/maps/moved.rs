//! Weights after a step of the guide at p (rousselle2013rdfc, Sec. 6, below Eq. 5), by the rules of the weights before it.

use super::counts::Counts;
use super::exponential::exponential;
use super::guided::{Guides, Maps, Three};
use super::layout::{Layout, row, row_mut};
use super::offset::{both_seen, keep_only};
use super::pairs::{near, share, shared};
use crate::nlm::{Pairs, Rule, Taps};

/// Channels that move.
const CHANNELS: usize = 3;

/// What a step adds to the sums over patches.
#[derive(Clone, Debug)]
pub(super) struct Bends {
    /// Through p as the centre of its own patch, for each channel; the first for all if they move at once.
    own: [Three; CHANNELS],
    /// Through p as a tap of its neighbours' patches.
    exchanged: [Three; CHANNELS],
    /// Steps of the tile's pixels.
    pub steps: [Vec<f32>; CHANNELS],
    /// Distances after the step.
    distances: Three,
    mean: Vec<f32>,
}

impl Bends {
    /// Room for those of one pair of offsets.
    pub fn new(layout: &Layout) -> Self {
        let plane = || vec![0.0; layout.pixel.plane];
        let three = || [plane(), plane(), plane()];
        Self {
            own: [three(), three(), three()],
            exchanged: [three(), three(), three()],
            steps: three(),
            distances: three(),
            mean: plane(),
        }
    }

    /// Bends of a pair of offsets, for all passes.
    #[inline(always)]
    pub fn fill(&mut self, guides: &Guides<'_>, rule: Rule) {
        let Guides { layout, square, offset, here, there, .. } = *guides;
        let (grid, n) = (&layout.pixel, guides.place.tile.width);
        for y in 0..guides.place.tile.height as isize {
            for c in 0..CHANNELS {
                let p = here.guide(layout, c, (0, y), n);
                let [q1, q2] = [0, 1].map(|side| {
                    let (dx, dy) = offset.side(side);
                    there.guide(layout, c, (dx, y + dy), n)
                });
                let step = row(&self.steps[c], grid, (0, y), n);
                let [first, second, mean] = &mut self.own[if rule == Rule::Joint { 0 } else { c }];
                let first = row_mut(first, grid, (0, y), n);
                let second = row_mut(second, grid, (0, y), n);
                let mean = row_mut(mean, grid, (0, y), n);
                if c == 0 || rule == Rule::Exact {
                    first.fill(0.0);
                    second.fill(0.0);
                    mean.fill(0.0);
                }
                for i in 0..n {
                    let (u, a, b) = (
                        (p.value[i], p.variance[i]),
                        (q1.value[i], q1.variance[i]),
                        (q2.value[i], q2.variance[i]),
                    );
                    first[i] += square.bend_one(u, a, step[i]);
                    second[i] += square.bend_one(u, b, step[i]);
                    mean[i] += square.bend_mean(u, [a, b], step[i]);
                }
            }
        }
    }

    /// Bends through p as a tap of its neighbours' patches, within the frame itself.
    #[inline(always)]
    pub fn exchange(&mut self, guides: &Guides<'_>) {
        let Guides { layout, square, offset, here, place, rules, .. } = *guides;
        let (grid, n) = (&layout.pixel, place.tile.width);
        for y in 0..place.tile.height as isize {
            for c in 0..CHANNELS {
                let p = here.guide(layout, c, (0, y), n);
                let beside =
                    |times: isize| here.guide(layout, c, (times * offset.dx, y + times * offset.dy), n);
                let [first, second, mean] = &mut self.exchanged[c];
                let step = row(&self.steps[c], grid, (0, y), n);
                row_mut(mean, grid, (0, y), n).fill(0.0);
                // p is the neighbour of what lies at the opposite offset, and the opposite neighbour of what lies at it.
                for (kind, to) in [(0, first), (1, second)] {
                    let away = if kind == 0 { -1 } else { 1 };
                    let (center, next) = (beside(away), beside(2 * away));
                    let to = row_mut(to, grid, (0, y), n);
                    let mean = row_mut(mean, grid, (0, y), n);
                    let taps = match rules.taps {
                        Taps::Mirrored => 0..n,
                        Taps::Clipped if place.has_row(y + away * offset.dy) => {
                            place.columns(away * offset.dx, n)
                        }
                        Taps::Clipped => 0..0,
                    };
                    keep_only(to, taps.clone());
                    for i in taps {
                        let (a, u) = ((center.value[i], center.variance[i]), (p.value[i], p.variance[i]));
                        let other = (next.value[i], next.variance[i]);
                        to[i] = square.bend_one(a, u, -step[i]);
                        mean[i] += square.bend_mean(a, [u, other], -0.5 * step[i]);
                    }
                }
            }
        }
    }

    /// Writes a row of weights of both neighbours after channel `c` has moved (or all have). `exchanged` says whether p is a
    /// tap of its neighbours' patches.
    #[inline(always)]
    pub fn weights(
        &mut self,
        guides: &Guides<'_>,
        (maps, taps): (&Maps, &Counts),
        (c, y): (usize, isize),
        (rule, exchanged): (Rule, bool),
        to: &mut [Vec<f32>; 2],
    ) {
        let (layout, n) = (guides.layout, guides.place.tile.width);
        let terms = layout.channels as f32 * taps.rows(y);
        for kind in 0..3 {
            let before = row(&maps.distances[kind], &layout.map, (0, y), n);
            let bends = row(&self.own[c][kind], &layout.pixel, (0, y), n);
            let after = &mut self.distances[kind][..n];
            for (((after, before), bend), columns) in
                after.iter_mut().zip(before).zip(bends).zip(taps.own_columns())
            {
                *after = before + bend / (terms * columns);
            }
            if exchanged {
                let bends = row(&self.exchanged[c][kind], &layout.pixel, (0, y), n);
                for ((after, bend), columns) in after.iter_mut().zip(bends).zip(taps.own_columns()) {
                    *after += bend / (terms * columns);
                }
            }
        }
        let [first, second] = to;
        let (first, second) = (&mut first[..n], &mut second[..n]);
        for (weight, distance) in first.iter_mut().zip(&self.distances[0]) {
            *weight = exponential(*distance);
        }
        for (weight, distance) in second.iter_mut().zip(&self.distances[1]) {
            *weight = exponential(*distance);
        }
        if !guides.shares() {
            return;
        }
        for (weight, distance) in self.mean[..n].iter_mut().zip(&self.distances[2]) {
            *weight = exponential(*distance);
        }
        let both = both_seen(&guides.place, guides.rules.border, (0, y), guides.offset, n);
        let all = guides.rules.pairs == Pairs::Raw;
        // The program leaves a pair that the step takes beyond the limit the share that it had.
        let keeps = if rule == Rule::Joint { 1.0 } else { 0.0 };
        let shares = row(&maps.shares, &layout.map, (0, y), n);
        let [d1, d2, _] = &self.distances;
        let (d1, d2, mean, shares) =
            (&d1[both.clone()], &d2[both.clone()], &self.mean[both.clone()], &shares[both.clone()]);
        let weights = first[both.clone()].iter_mut().zip(&mut second[both]);
        for ((((w1, w2), mean), (d1, d2)), had) in weights.zip(mean).zip(d1.iter().zip(d2)).zip(shares) {
            let a = share(*w1, *w2, *mean);
            let a = if near(*d1, *d2) | all { a } else { keeps * had };
            *w1 = shared(a, *w1, *mean);
            *w2 = shared(a, *w2, *mean);
        }
    }
}
