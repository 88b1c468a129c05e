//! Non-local means of channels, each with its own weights.

use super::distances::{Distances, Group};
use super::guide::{GROUP, Layout, lines, scaled_variances};
use super::params::{Alone, Weighting};
use crate::engine::{
    Copies, Grid, InstructionSet, Kernel, MAX_LANES, Plane, Scratch, Simd, Tile, TileRows, Window,
    for_each_tile,
};

/// Tile, (width, height) in pixels.
const TILE: (usize, usize) = (64, 16);

/// One call's constants, shared by all workers.
struct Job<'a> {
    channels: &'a [Alone<'a>],
    variances: Vec<Vec<f32>>,
    layout: Layout,
    /// Copies of the targets with the window around the tile.
    area: Grid,
    /// Sums of the tile: for each channel its targets, then Σ w.
    totals: Grid,
    /// Where each channel's targets start, of all.
    first: Vec<usize>,
    targets: usize,
    level: InstructionSet,
}

/// Filters checked channels: for each all its targets.
pub(super) fn filter(
    weighting: &Weighting,
    channels: &[Alone<'_>],
    level: InstructionSet,
) -> Vec<Vec<Vec<f32>>> {
    let guides: Vec<_> = channels.iter().map(|channel| &channel.guide).collect();
    let layout = Layout::new(*weighting, &guides, TILE);
    let reach = weighting.window;
    let first = channels.iter().scan(0, |next, channel| {
        let first = *next;
        *next += channel.targets.len();
        Some(first)
    });
    let job = Job {
        channels,
        variances: scaled_variances(weighting, &guides),
        area: Grid::new(reach, reach, layout.wide + 2 * reach + 2 * MAX_LANES, TILE.1 + 2 * reach),
        totals: Grid::new(0, 0, layout.wide, TILE.1),
        first: first.collect(),
        targets: channels.iter().map(|channel| channel.targets.len()).sum(),
        layout,
        level,
    };
    let size = weighting.width * weighting.height;
    let mut out: Vec<Vec<Vec<f32>>> =
        channels.iter().map(|channel| vec![vec![0.0; size]; channel.targets.len()]).collect();
    let planes = out.iter_mut().flatten().map(Vec::as_mut_slice);
    for_each_tile(
        weighting.width,
        TILE,
        planes,
        || Scratch::new(job.sizes().iter().sum()),
        |scratch, tile, rows| job.run(scratch, tile, rows),
    );
    out
}

impl Job<'_> {
    /// Values of a worker's parts: guide, vertical sums, border, targets, totals.
    fn sizes(&self) -> [usize; 5] {
        let layout = &self.layout;
        [
            lines(layout.guide_size()),
            lines(layout.sums_size()),
            lines(layout.border_size()),
            lines(self.targets * self.area.plane + MAX_LANES),
            lines((self.targets + self.channels.len()) * self.totals.plane),
        ]
    }

    fn run(&self, scratch: &mut Scratch, tile: Tile, out: Vec<TileRows<'_>>) {
        let [guide, sums, border, area, totals] = scratch.parts(self.sizes());
        let layout = &self.layout;
        let weighting = &layout.weighting;
        let copies = Copies { width: weighting.width, height: weighting.height, tile };
        let channels: Vec<_> =
            self.channels.iter().zip(&self.variances).map(|(c, v)| (&c.guide, v.as_slice())).collect();
        layout.fill_guide(&copies, &channels, guide);
        layout.fill_border(tile, border);
        for (k, target) in self.channels.iter().flat_map(|channel| &channel.targets).enumerate() {
            copies.marked(&self.area, target, &mut area[k * self.area.plane..], 0.0);
        }
        totals.fill(0.0);
        // SAFETY: the parts have the sizes of the layout, whose copies reach as far around the tile as the window and the patch
        // do, and a group of offsets and a vector more; the walk keeps offsets within the reach and rows within the tile.
        let mut view = unsafe {
            View {
                guide: Plane::vouched(guide),
                border: Plane::vouched(border),
                area: Plane::vouched(area),
                sums: Plane::vouched_mut(sums),
                totals: Plane::vouched_mut(totals),
            }
        };
        let window = Window { width: weighting.width, height: weighting.height, reach: weighting.window };
        for block in window.blocks(tile, GROUP) {
            let group = Group { rows: block.rows, dy: block.dy, dx: block.dx, count: block.count };
            self.level.launch(Step { job: self, tile, group: &group, view: &mut view });
        }
        let mut out = out.into_iter();
        for (c, channel) in self.channels.iter().enumerate() {
            let weights = (self.targets + c) * self.totals.plane;
            for k in self.first[c]..self.first[c] + channel.targets.len() {
                let Some(rows) = out.next() else { return };
                for (j, to) in rows.into_iter().enumerate() {
                    let at = j * self.totals.pitch;
                    let sum = &totals[k * self.totals.plane + at..];
                    // At least the pixel's own weight.
                    for ((to, sum), weight) in to.iter_mut().zip(sum).zip(&totals[weights + at..]) {
                        *to = sum / weight;
                    }
                }
            }
        }
    }
}

/// A worker's planes.
struct View<'a> {
    guide: &'a Plane,
    border: &'a Plane,
    area: &'a Plane,
    sums: &'a mut Plane,
    totals: &'a mut Plane,
}

/// Adds the neighbours of one group of offsets.
struct Step<'a, 'b> {
    job: &'a Job<'a>,
    tile: Tile,
    group: &'a Group,
    view: &'a mut View<'b>,
}

impl Kernel for Step<'_, '_> {
    type Out = ();

    #[inline(always)]
    fn run<S: Simd>(self, s: S) {
        match self.job.layout.weighting.patch {
            0 => self.add::<S, 0>(s),
            1 => self.add::<S, 1>(s),
            2 => self.add::<S, 2>(s),
            _ => self.add::<S, 3>(s),
        }
    }
}

impl Step<'_, '_> {
    #[inline(always)]
    fn add<S: Simd, const F: usize>(self, s: S) {
        let Self { job, tile, group, view } = self;
        let View { guide, border, area, sums, totals } = view;
        let distances = Distances { layout: &job.layout, guide, width: tile.width };
        distances.down::<S, F>(s, group, sums);
        for row in group.rows.clone() {
            let factor = s.splat(job.layout.row_factor(tile.y + row, group.dy, 1));
            let start = (row as isize + group.dy) * job.area.pitch as isize + group.dx;
            let from = job.area.origin().wrapping_add_signed(start);
            for (c, channel) in job.channels.iter().enumerate() {
                let mut x = 0;
                while x < tile.width {
                    let at = row * job.totals.pitch + x;
                    let mut weights = [s.zero(); GROUP];
                    for (i, weight) in weights.iter_mut().enumerate().take(group.count) {
                        let dx = group.dx + i as isize;
                        let sum = distances.patch::<S, F>(s, sums, (c, i), row, x);
                        *weight = distances.weight(s, sum, border, factor, dx, x);
                        if dx == 0 && group.dy == 0 {
                            *weight = s.max(*weight, s.load(border, job.layout.own() + x));
                        }
                    }
                    let to = (job.targets + c) * job.totals.plane + at;
                    let total = weights.iter().fold(s.load(totals, to), |sum, weight| s.add(sum, *weight));
                    s.store(totals, to, total);
                    for k in job.first[c]..job.first[c] + channel.targets.len() {
                        let to = k * job.totals.plane + at;
                        let mut sum = s.load(totals, to);
                        for (i, weight) in weights.iter().enumerate() {
                            sum = s.fma(*weight, s.load(area, k * job.area.plane + from + x + i), sum);
                        }
                        s.store(totals, to, sum);
                    }
                    x += S::LANES;
                }
            }
        }
    }
}
