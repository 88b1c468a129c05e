//! The weights of all windows of a tile.

use super::distances::{Distances, Group};
use super::job::{Job, View};
use super::params::Join;
use crate::engine::{Kernel, Simd, Tile};

/// Weights of one group of offsets.
pub(super) struct Weigh<'a, 'b> {
    pub job: &'a Job<'a>,
    pub tile: Tile,
    pub group: &'a Group,
    pub view: &'a mut View<'b>,
}

impl Kernel for Weigh<'_, '_> {
    type Out = ();

    #[inline(always)]
    fn run<S: Simd>(self, s: S) {
        match self.job.layout.weighting.patch {
            0 => self.weigh::<S, 0>(s),
            1 => self.weigh::<S, 1>(s),
            2 => self.weigh::<S, 2>(s),
            _ => self.weigh::<S, 3>(s),
        }
    }
}

impl Weigh<'_, '_> {
    #[inline(always)]
    fn weigh<S: Simd, const F: usize>(self, s: S) {
        let Self { job, tile, group, view } = self;
        let layout = &job.layout;
        let distances = Distances { layout, guide: view.guide, width: tile.width };
        distances.down::<S, F>(s, group, view.vertical);
        let reach = layout.weighting.window as isize;
        let offset = (group.dy + reach) as usize * layout.side() + (group.dx + reach) as usize;
        let joined = if job.fit.join == Join::Mean { layout.channels } else { 1 };
        for row in group.rows.clone() {
            let factor = s.splat(layout.row_factor(tile.y + row, group.dy, joined));
            for i in 0..group.count {
                let dx = group.dx + i as isize;
                let to = row * job.weights_of_row() + (offset + i) * layout.wide;
                let mut x = 0;
                while x < tile.width {
                    let mut sum = distances.patch::<S, F>(s, view.vertical, (0, i), row, x);
                    for c in 1..layout.channels {
                        let other = distances.patch::<S, F>(s, view.vertical, (c, i), row, x);
                        sum = if job.fit.join == Join::Mean { s.add(sum, other) } else { s.max(sum, other) };
                    }
                    let mut weight = distances.weight(s, sum, view.border, factor, dx, x);
                    if dx == 0 && group.dy == 0 {
                        weight = s.max(weight, s.load(view.border, layout.own() + x));
                    }
                    s.store(view.weights, to + x, weight);
                    x += S::LANES;
                }
            }
        }
    }
}
