//! All offsets of a window for one tile and frame.

use super::counts::Counts;
use super::exponential::exponentials;
use super::features::{FeatureRow, FeatureSquare, farther, limit_alone, limit_pair};
use super::frames::Around;
use super::guided::{Guides, Maps, Three};
use super::layout::{Layout, Place, row, row_mut};
use super::moved::Bends;
use super::offset::{Offset, both_seen, keep_only, seen};
use super::squares::Square;
use super::sums::{Sums, add_differences, add_values, limit};
use crate::engine::Vectorised;
use crate::nlm::{Pass, Rule, WeightRules};

/// A pass with what it needs beside its numbers.
#[derive(Clone, Debug)]
pub(super) struct Step {
    pub pass: Pass,
    /// Which of the different τ.
    pub floor: usize,
    /// Taps of the patches in a tile and what smoothing reaches.
    pub taps: Counts,
    /// Pixels of the boxes of smoothing in a tile.
    pub boxes: Counts,
}

impl Step {
    /// Patch radius of a pass whose derivative is a finite difference.
    #[inline(always)]
    fn differs(&self) -> Option<usize> {
        self.pass.patch.filter(|_| self.pass.derivative)
    }
}

/// A worker's memory for what lives as long as a pair of offsets, and longer.
#[derive(Clone, Debug)]
pub(super) struct Work {
    pub maps: Maps,
    pub bends: Option<Bends>,
    /// For each τ, of both neighbours.
    pub limits: Vec<[Vec<f32>; 2]>,
    pub sums: Vec<Sums>,
    features: Three,
    rows: [Vec<f32>; 2],
    moved: [Vec<f32>; 2],
}

impl Work {
    /// Room for the passes of a call with these many different τ.
    pub fn new(layout: &Layout, passes: &[Pass], floors: usize) -> Self {
        let differs = passes.iter().any(|pass| pass.derivative && pass.patch.is_some());
        let plane = || vec![0.0; layout.pixel.plane];
        let line = || vec![0.0; layout.pixel.pitch];
        Self {
            maps: Maps::new(layout),
            bends: differs.then(|| Bends::new(layout)),
            limits: (0..floors).map(|_| [plane(), plane()]).collect(),
            sums: passes.iter().map(|pass| Sums::new(layout, pass)).collect(),
            features: [line(), line(), line()],
            rows: [line(), line()],
            moved: [line(), line()],
        }
    }
}

/// What one frame adds to the sums of a tile.
pub(super) struct Sweep<'a> {
    pub layout: &'a Layout,
    pub place: Place,
    pub square: Square,
    pub feature: FeatureSquare,
    pub rules: WeightRules,
    pub floors: &'a [f32],
    /// Channels of each feature.
    pub features: &'a [usize],
    pub steps: &'a [Step],
    pub rule: Rule,
    pub here: &'a Around,
    /// Of the frame beside the target, if it is not the target itself.
    pub beside: Option<&'a Around>,
    pub work: &'a mut Work,
}

impl Vectorised for Sweep<'_> {
    type Out = ();

    #[inline(always)]
    fn run(mut self) {
        for offset in Offset::all(self.layout.reach, self.beside.is_some()) {
            if offset.is_seen(self.layout, self.rules.border) {
                self.pair(offset);
            }
        }
    }
}

impl Sweep<'_> {
    /// Everything for one pair of offsets.
    #[inline(always)]
    fn pair(&mut self, offset: Offset) {
        let guides = Guides {
            layout: self.layout,
            place: self.place,
            square: self.square,
            rules: self.rules,
            here: self.here,
            there: self.beside.unwrap_or(self.here),
            offset,
        };
        for floor in 0..self.floors.len() {
            self.limits(&guides, floor);
        }
        if self.layout.channels > 0 {
            guides.squares(&mut self.work.maps);
        }
        let reach = self.steps.iter().filter_map(Step::differs).max();
        let mut exchanges = false;
        if let (Some(reach), Some(bends)) = (reach, &mut self.work.bends) {
            bends.fill(&guides, self.rule);
            exchanges = self.rule == Rule::Exact && self.beside.is_none() && offset.distance() <= reach;
            if exchanges {
                bends.exchange(&guides);
            }
        }
        for k in 0..self.steps.len() {
            self.add(&guides, k, exchanges);
        }
    }

    /// Weights of features with one τ.
    #[inline(always)]
    fn limits(&mut self, guides: &Guides<'_>, floor: usize) {
        let (grid, n, shares) = (&self.layout.pixel, self.place.tile.width, guides.shares());
        let Work { limits, features: sums, .. } = &mut *self.work;
        let [first, second] = &mut limits[floor];
        for y in 0..self.place.tile.height as isize {
            let (first, second) = (row_mut(first, grid, (0, y), n), row_mut(second, grid, (0, y), n));
            // Where nothing is shared the largest distance is enough, and one weight is made of it.
            let none = if shares { 1.0 } else { 0.0 };
            first.fill(none);
            second.fill(none);
            let both = both_seen(&self.place, self.rules.border, (0, y), guides.offset, n);
            let mut channel = 0;
            for &channels in self.features {
                sums.iter_mut().for_each(|sums| sums[..n].fill(0.0));
                for c in channel..channel + channels {
                    let p = feature_row(self.here, self.layout, c, (0, y), n);
                    let q = [0, 1].map(|side| {
                        let (dx, dy) = guides.offset.side(side);
                        feature_row(guides.there, self.layout, c, (dx, y + dy), n)
                    });
                    self.feature.add_one(&mut sums[0][..n], p, q[0], self.floors[floor]);
                    self.feature.add_one(&mut sums[1][..n], p, q[1], self.floors[floor]);
                    if shares {
                        self.feature.add_mean(&mut sums[2][..n], p, q, self.floors[floor]);
                    }
                }
                channel += channels;
                let (channels, sums) = (channels as f32, sums.each_ref().map(|sums| &sums[..n]));
                if !shares {
                    farther(first, sums[0], channels);
                    farther(second, sums[1], channels);
                    continue;
                }
                for alone in [0..both.start, both.end..n] {
                    let limits = [&mut first[alone.clone()], &mut second[alone.clone()]];
                    limit_alone(limits, [&sums[0][alone.clone()], &sums[1][alone]], channels);
                }
                let limits = [&mut first[both.clone()], &mut second[both.clone()]];
                limit_pair(limits, sums.map(|sums| &sums[both.clone()]), channels, self.rules.pairs);
            }
            if !shares {
                exponentials(first);
                exponentials(second);
            }
        }
    }

    /// What one pass adds to its sums.
    #[inline(always)]
    fn add(&mut self, guides: &Guides<'_>, k: usize, exchanges: bool) {
        let (layout, n) = (self.layout, self.place.tile.width);
        let step = &self.steps[k];
        let Work { maps, bends, limits, sums, rows, moved, .. } = &mut *self.work;
        let (sums, limits) = (&mut sums[k], &limits[step.floor]);
        if let Some(patch) = step.pass.patch {
            guides.weights(maps, patch, &step.taps, &step.boxes);
        }
        for y in 0..self.place.tile.height as isize {
            let seen = [0, 1].map(|side| {
                let own = side == 1 && !guides.offset.has_opposite();
                if own {
                    0..0
                } else {
                    seen(&self.place, self.rules.border, (0, y), guides.offset.side(side), n)
                }
            });
            let limits = [0, 1].map(|side| row(&limits[side], &layout.pixel, (0, y), n));
            for side in 0..2 {
                let to = &mut rows[side][..n];
                to.copy_from_slice(limits[side]);
                if step.pass.patch.is_some() {
                    limit(to, row(&maps.weights[side], &layout.map, (0, y), n));
                }
                keep_only(to, seen[side].clone());
            }
            let weights = [&rows[0][..n], &rows[1][..n]];
            let at = |side: usize| {
                let (dx, dy) = guides.offset.side(side);
                (dx, y + dy)
            };
            sums.weights.add(&layout.pixel, y, weights);
            for (t, sum) in sums.targets.iter_mut().enumerate() {
                let values = [0, 1].map(|side| guides.there.target(layout, t, at(side), n));
                add_values(row_mut(sum, &layout.pixel, (0, y), n), weights, values);
            }
            let (Some(patch), Some(bends)) = (step.differs(), &mut *bends) else { continue };
            let exchanged = exchanges && guides.offset.distance() <= patch;
            for c in 0..3 {
                let own = guides.here.guide(layout, c, (0, y), n).value;
                let values = [0, 1].map(|side| guides.there.guide(layout, c, at(side), n).value);
                let sum = row_mut(&mut sums.step[c], &layout.pixel, (0, y), n);
                add_differences(sum, weights, values, own);
                if c == 0 || self.rule == Rule::Exact {
                    bends.weights(guides, (&*maps, &step.taps), (c, y), (self.rule, exchanged), moved);
                    for side in 0..2 {
                        let to = &mut moved[side][..n];
                        limit(to, limits[side]);
                        keep_only(to, seen[side].clone());
                    }
                    sums.moved[c].add(&layout.pixel, y, [&moved[0][..n], &moved[1][..n]]);
                }
                let sum = row_mut(&mut sums.moved_step[c], &layout.pixel, (0, y), n);
                add_differences(sum, [&moved[0][..n], &moved[1][..n]], values, own);
            }
        }
    }
}

/// A row of a feature channel.
#[inline(always)]
fn feature_row<'a>(
    from: &'a Around,
    layout: &Layout,
    channel: usize,
    at: (isize, isize),
    length: usize,
) -> FeatureRow<'a> {
    let row = |kind: usize| from.feature(layout, (kind, channel), at, length);
    FeatureRow { value: row(0), variance: row(1), spread: row(2) }
}
