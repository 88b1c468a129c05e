//! The fast form: prepares a tile, runs the inner loops over all offsets of the window, writes the result.

use super::hot::{Constants, HotPass, LOCAL, PENALTY, Step, TileView};
use super::layout::{KINDS, LARGEST, Layout, MOVED_LARGEST, MOVED_STEP, MOVED_WEIGHT, STEP, WEIGHT};
use super::naive::LARGEST as LARGEST_SQUARE;
use super::output::{by_tiles, floors};
use super::params::{
    Center, Denominator, Filtered, GuideDenominator, NlmInputs, NlmParams, Pass, Planes, Rule,
};
use crate::engine::{Copies, InstructionSet, Plane, Scratch, Tile, TileRows, Window};

/// One call's constants, shared by all workers.
struct Job<'a> {
    params: &'a NlmParams,
    inputs: &'a NlmInputs<'a>,
    passes: Vec<HotPass>,
    layout: Layout,
    level: InstructionSet,
    constants: Constants,
}

/// Runs checked passes. They are split into sweeps of at most two τ and one patch radius, or the radii 3 and 1: each
/// pair of radii is compiled for itself, and this is the one that rousselle2013rdfc asks for.
pub(super) fn filter(
    params: &NlmParams,
    passes: &[Pass],
    inputs: &NlmInputs<'_>,
    level: InstructionSet,
    tile_size: (usize, usize),
) -> Vec<Filtered> {
    let mut out = Vec::with_capacity(passes.len());
    let mut first = 0;
    while first < passes.len() {
        let mut end = first + 1;
        while end < passes.len() && fits(&passes[first..=end]) {
            end += 1;
        }
        out.extend(sweep(params, &passes[first..end], inputs, level, tile_size));
        first = end;
    }
    out
}

/// Whether one sweep can serve these passes.
fn fits(passes: &[Pass]) -> bool {
    let patches = patches(passes);
    (patches.len() <= 1 || patches == [3, 1]) && floors(passes).len() <= KINDS
}

/// Patch radii, the largest first.
fn patches(passes: &[Pass]) -> Vec<usize> {
    let mut patches: Vec<usize> = passes.iter().filter_map(|pass| pass.patch).collect();
    patches.sort_unstable_by(|a, b| b.cmp(a));
    patches.dedup();
    patches
}

/// One sweep over the window.
fn sweep(
    params: &NlmParams,
    passes: &[Pass],
    inputs: &NlmInputs<'_>,
    level: InstructionSet,
    tile_size: (usize, usize),
) -> Vec<Filtered> {
    let layout = Layout::new(tile_size, params.window_radius, patches(passes), passes.len(), inputs);
    let floors = floors(passes);
    let hot: Vec<HotPass> = passes
        .iter()
        .map(|pass| {
            let columns = pass.patch.and_then(|f| layout.patches.iter().position(|&g| g == f)).unwrap_or(0);
            let floor = floors.iter().position(|&floor| floor == pass.floor).unwrap_or(0);
            let taps = pass.patch.map_or(1, |f| (2 * f + 1) * (2 * f + 1));
            // Without a guide there is no patch; else at least one channel.
            let terms = (taps * layout.channels.max(1)) as f64;
            let scale = -std::f64::consts::LOG2_E / terms;
            HotPass::new(pass.patch, columns, floor, scale as f32, pass.derivative)
        })
        .collect();
    let first_again = match params.guide_denominator {
        GuideDenominator::Pair => 0.0,
        GuideDenominator::TwiceCenter => 1.0,
    };
    let job = Job {
        params,
        inputs,
        constants: Constants {
            // k is above 0.
            cancellation: -params.cancellation / (params.k * params.k),
            epsilon: params.epsilon,
            first_again,
            second: 1.0 - first_again,
            largest: LARGEST_SQUARE,
            pair: params.denominator == Denominator::Pair,
            floors: [floors[0], *floors.last().unwrap_or(&floors[0])],
            floor_count: floors.len(),
            largest_center: params.center != Center::One,
            derivative: passes.iter().any(|pass| pass.derivative && pass.patch.is_some()),
            joint: inputs.perturbation.is_some_and(|p| p.rule == Rule::Joint),
            pair_scale: feature_scale(params) as f32,
        },
        passes: hot,
        layout,
        level,
    };
    by_tiles(
        params,
        passes,
        job.layout.targets,
        tile_size,
        || job.scratch(),
        |scratch, tile, rows| job.run(scratch, tile, rows),
    )
}

/// Factor from Φ²·D to an exponent of 2.
fn feature_scale(params: &NlmParams) -> f64 {
    -std::f64::consts::LOG2_E / f64::from(params.feature_k).powi(2)
}

impl Job<'_> {
    fn scratch(&self) -> Scratch {
        Scratch::new(self.sizes().iter().sum())
    }

    /// Values of a worker's parts: guide here, guide there, pixels, sums, area, local, columns.
    fn sizes(&self) -> [usize; 7] {
        let layout = &self.layout;
        let there = if self.inputs.neighbors.is_empty() { 0 } else { layout.guide.interleaved_size() };
        [
            layout.guide.interleaved_size(),
            there,
            layout.pixel.interleaved_size(),
            layout.sums.interleaved_size(),
            layout.area.interleaved_size(),
            LOCAL,
            layout.columns.interleaved_size(),
        ]
    }

    fn run(&self, scratch: &mut Scratch, tile: Tile, out: Vec<TileRows<'_>>) {
        let [here, there, pixel, sums, area, local, columns] = scratch.parts(self.sizes());
        let copies = Copies { width: self.params.width, height: self.params.height, tile };
        self.copy_guide(&copies, &self.inputs.frame, here);
        self.fill_pixels(&copies, pixel);
        sums.fill(0.0);
        for t in 0..=self.inputs.neighbors.len() {
            let frame = if t == 0 { &self.inputs.frame } else { &self.inputs.neighbors[t - 1] };
            self.copy_area(&copies, frame, area);
            if t > 0 {
                self.copy_guide(&copies, frame, there);
            }
            // SAFETY: the parts have the sizes of the layout, whose copies reach as far around the tile as the window and
            // the patch do, and a block and a vector more; the walk keeps offsets within the reach and rows within the tile.
            let mut view = unsafe {
                TileView {
                    layout: &self.layout,
                    passes: &self.passes,
                    width: tile.width,
                    same_frame: t == 0,
                    here: Plane::vouched(here),
                    there: Plane::vouched(if t == 0 { here } else { there }),
                    area: Plane::vouched(area),
                    pixel: Plane::vouched(pixel),
                    sums: Plane::vouched_mut(sums),
                    columns: Plane::vouched_mut(columns),
                    local: Plane::vouched_mut(local),
                    constants: self.constants,
                }
            };
            for block in self.window().blocks(tile, self.layout.block) {
                self.level.launch(Step { tile: &mut view, block: &block, group: self.layout.group });
            }
        }
        self.finish(sums, pixel, tile, out);
    }

    fn window(&self) -> Window {
        Window { width: self.params.width, height: self.params.height, reach: self.layout.reach }
    }

    /// Copies a frame's guide and variances with their surroundings, mirrored at the border. Variances are scaled by
    /// k², because that is how denominators have them; scaled values would lose what close ones differ by.
    fn copy_guide(&self, copies: &Copies, frame: &Planes<'_>, to: &mut [f32]) {
        let grid = &self.layout.guide;
        let (k, channels) = (self.params.k, self.layout.channels);
        for (c, channel) in frame.guide.iter().enumerate().take(channels) {
            copies.mirrored(grid, channel.value, &mut to[c * grid.plane..], 1.0);
            copies.mirrored(grid, channel.variance, &mut to[(channels + c) * grid.plane..], k * k);
        }
    }

    /// Copies what is read at neighbours, and marks those outside the image.
    fn copy_area(&self, copies: &Copies, frame: &Planes<'_>, to: &mut [f32]) {
        let layout = &self.layout;
        let grid = &layout.area;
        for (c, channel) in frame.features.iter().flatten().enumerate() {
            copies.mirrored(grid, channel.value, &mut to[layout.area_feature(0, c)..], 1.0);
            copies.mirrored(grid, channel.variance, &mut to[layout.area_feature(1, c)..], 1.0);
            if self.constants.pair {
                copies.mirrored(grid, channel.spread, &mut to[layout.area_feature(2, c)..], 1.0);
            }
        }
        for (k, target) in frame.targets.iter().enumerate() {
            copies.mirrored(grid, target, &mut to[layout.area_target(k)..], 1.0);
        }
        copies.mark_columns(grid, &mut to[layout.area_penalty()..], PENALTY);
    }

    /// Fills in what each pixel of the tile compares with and scales by.
    fn fill_pixels(&self, copies: &Copies, to: &mut [f32]) {
        let (layout, grid) = (&self.layout, &self.layout.pixel);
        let scale = feature_scale(self.params);
        let counts = self.inputs.frame.features.iter().flat_map(|f| f.iter().map(|_| f.len()));
        for ((c, channel), count) in self.inputs.frame.features.iter().flatten().enumerate().zip(counts) {
            copies.own(grid, channel.value, &mut to[layout.pixel_feature(0, c)..], |v| v);
            copies.own(grid, channel.variance, &mut to[layout.pixel_feature(1, c)..], |v| -v);
            for (i, floor) in self.constants.floors.into_iter().enumerate() {
                let to = &mut to[layout.pixel_feature(2 + i, c)..];
                if self.constants.pair {
                    copies.own(grid, channel.spread, to, |s| s.max(floor));
                } else {
                    // τ is above 0.
                    let scale = scale / count as f64;
                    copies.own(grid, channel.spread, to, |s| (scale / f64::from(s.max(floor))) as f32);
                }
            }
        }
        if let Some(perturbation) = self.inputs.perturbation.filter(|_| self.constants.derivative) {
            for (c, step) in perturbation.step.into_iter().enumerate() {
                copies.own(grid, step, &mut to[layout.pixel_step(c)..], |v| v);
            }
        }
    }

    /// Divides the sums and writes the tile's result.
    fn finish(&self, sums: &[f32], pixel: &[f32], tile: Tile, out: Vec<TileRows<'_>>) {
        let layout = &self.layout;
        let (grid, targets) = (&layout.sums, layout.targets);
        let area = |k: usize, j: usize| {
            // The pixels themselves, for a centre weight that is known only now.
            let first = (tile.y + j) * self.params.width + tile.x;
            &self.inputs.frame.targets[k][first..][..tile.width]
        };
        let mut out = out.into_iter();
        for (index, pass) in self.passes.iter().enumerate() {
            let row = |k: usize, j: usize| {
                &sums[layout.sums(index) + k * grid.plane + j * grid.pitch..][..tile.width]
            };
            let extra = |k: usize, j: usize| row(targets + k, j);
            // Weight of the pixel itself, and what is still missing of it in the sums.
            let center = |largest: f32| match self.params.center {
                Center::One => (1.0, 0.0),
                Center::LargestNeighbor { least } => (largest.max(least), largest.max(least)),
            };
            for k in 0..targets {
                let Some(rows) = out.next() else { return };
                for (j, to) in rows.into_iter().enumerate() {
                    let (sum, weight, largest) = (row(k, j), extra(WEIGHT, j), extra(LARGEST, j));
                    let own = area(k, j);
                    for (i, value) in to.iter_mut().enumerate() {
                        let (_, missing) = center(largest[i]);
                        // The pixel's own weight is above 0 in either sum.
                        *value = (sum[i] + missing * own[i]) / (weight[i] + missing);
                    }
                }
            }
            for share in [false, true] {
                let Some(rows) = out.next() else { return };
                for (j, to) in rows.into_iter().enumerate() {
                    let (weight, largest) = (extra(WEIGHT, j), extra(LARGEST, j));
                    for (i, value) in to.iter_mut().enumerate() {
                        let (own, missing) = center(largest[i]);
                        let total = weight[i] + missing;
                        *value = if share { own / total } else { total };
                    }
                }
            }
            for c in 0..if pass.gives_derivative() { 3 } else { 0 } {
                let Some(rows) = out.next() else { return };
                for (j, to) in rows.into_iter().enumerate() {
                    let (weight, largest) = (extra(WEIGHT, j), extra(LARGEST, j));
                    let (step, moved_step) = (extra(STEP + c, j), extra(MOVED_STEP + c, j));
                    let (moved, moved_largest) = (extra(MOVED_WEIGHT + c, j), extra(MOVED_LARGEST + c, j));
                    let delta = &pixel[layout.pixel_step(c) + j * layout.pixel.pitch..][..tile.width];
                    for (i, value) in to.iter_mut().enumerate() {
                        let (own, missing) = center(largest[i]);
                        let total = weight[i] + missing;
                        let (moved_own, moved_missing) = center(moved_largest[i]);
                        *value = if pass.finite_difference() && delta[i] > 0.0 {
                            let before = step[i] / total;
                            let after = (moved_step[i] + moved_own * delta[i]) / (moved[i] + moved_missing);
                            (after - before) / delta[i]
                        } else {
                            own / total
                        };
                    }
                }
            }
        }
    }
}
