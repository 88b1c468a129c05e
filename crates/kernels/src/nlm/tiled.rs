//! The fast form: prepares a tile, runs the inner loops over all offsets of the window, writes the result.

use super::hot::{self, Block, Constants, HotPass, LOCAL, PENALTY, TileView};
use super::layout::{KINDS, LARGEST, Layout, MOVED_LARGEST, MOVED_STEP, MOVED_WEIGHT, STEP, WEIGHT};
use super::naive::LARGEST as LARGEST_SQUARE;
use super::params::{
    Center, Denominator, Filtered, GuideDenominator, NlmInputs, NlmParams, Pass, Planes, Rule,
};
use crate::InstructionSet;
use crate::grid::Grid;
use crate::mirror::mirror;
use crate::simd::Portable;
#[cfg(target_arch = "x86_64")]
use crate::simd::{Avx2, Avx512};
use crate::tiles::{Tile, TileRows, for_each_tile};

/// Tile of the fast form, (width, height) in pixels.
pub(super) const TILE: (usize, usize) = (64, 16);

/// One call's constants, shared by all workers.
struct Job<'a> {
    params: &'a NlmParams,
    inputs: &'a NlmInputs<'a>,
    passes: Vec<HotPass>,
    layout: Layout,
    level: InstructionSet,
    constants: Constants,
    /// Horizontal offsets per block.
    group: usize,
}

/// Runs checked passes. They are split into sweeps of at most two τ and one patch radius, or the radii 3 and 1: each
/// pair of radii is compiled for itself, and this is the one that rousselle2013rdfc asks for.
pub(crate) fn filter(
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

/// The different τ.
fn floors(passes: &[Pass]) -> Vec<f32> {
    let mut floors: Vec<f32> = Vec::new();
    for pass in passes {
        if !floors.contains(&pass.floor) {
            floors.push(pass.floor);
        }
    }
    floors
}

/// One sweep over the window.
fn sweep(
    params: &NlmParams,
    passes: &[Pass],
    inputs: &NlmInputs<'_>,
    level: InstructionSet,
    tile_size: (usize, usize),
) -> Vec<Filtered> {
    let layout = Layout::new(tile_size, params.window_radius, patches(passes), inputs);
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
        group: group(2 * params.window_radius + 1),
        passes: hot,
        layout,
        level,
    };
    let size = params.width * params.height;
    let plane = || vec![0.0f32; size];
    let mut out: Vec<Filtered> = passes
        .iter()
        .map(|pass| Filtered {
            planes: (0..job.layout.targets).map(|_| plane()).collect(),
            weight_sum: plane(),
            center_share: plane(),
            derivative: (0..if pass.derivative { 3 } else { 0 }).map(|_| plane()).collect(),
        })
        .collect();
    let planes = out.iter_mut().flat_map(|f| {
        let (targets, derivative) = (f.planes.iter_mut(), f.derivative.iter_mut());
        targets.chain([&mut f.weight_sum, &mut f.center_share]).chain(derivative).map(Vec::as_mut_slice)
    });
    for_each_tile(
        params.width,
        tile_size,
        planes,
        || Scratch::new(&job),
        |scratch, tile, rows| job.run(scratch, tile, rows),
    );
    out
}

/// Horizontal offsets per block for a window of `side` columns: the number that wastes the least.
fn group(side: usize) -> usize {
    let waste = |g: usize| side.div_ceil(g) * g - side;
    // Wider blocks first: they load each pixel's own values less often.
    [7, 6, 3].into_iter().min_by_key(|&g| waste(g)).unwrap_or(7)
}

/// Factor from Φ²·D to an exponent of 2.
fn feature_scale(params: &NlmParams) -> f64 {
    -std::f64::consts::LOG2_E / f64::from(params.feature_k).powi(2)
}

/// One worker's memory.
struct Scratch {
    memory: Vec<f32>,
    /// Index of the first cache line that starts in `memory`.
    start: usize,
}

impl Scratch {
    fn new(job: &Job<'_>) -> Self {
        let layout = &job.layout;
        let frames = if job.inputs.neighbors.is_empty() { 1 } else { 2 };
        let planes = frames * layout.guide_size()
            + layout.area_size()
            + layout.pixel_size()
            + layout.sums(job.passes.len())
            + layout.columns_size()
            + LOCAL;
        // Room to align, and for the vectors that start on the last values.
        let memory = vec![0.0f32; planes + 64];
        // `align_offset` may give up and say usize::MAX; alignment is for speed only.
        let start = memory.as_ptr().align_offset(64).min(16);
        Self { memory, start }
    }
}

impl Job<'_> {
    fn run(&self, scratch: &mut Scratch, tile: Tile, out: Vec<TileRows<'_>>) {
        let layout = &self.layout;
        let memory = &mut scratch.memory[scratch.start..];
        let (here, memory) = memory.split_at_mut(layout.guide_size());
        let other = if self.inputs.neighbors.is_empty() { 0 } else { layout.guide_size() };
        let (there, memory) = memory.split_at_mut(other);
        let (pixel, memory) = memory.split_at_mut(layout.pixel_size());
        let (sums, memory) = memory.split_at_mut(layout.sums(self.passes.len()));
        let (area, memory) = memory.split_at_mut(layout.area_size());
        let (local, columns) = memory.split_at_mut(LOCAL);
        self.copy_guide(tile, &self.inputs.frame, here);
        self.fill_pixels(tile, pixel);
        sums.fill(0.0);
        for t in 0..=self.inputs.neighbors.len() {
            let frame = if t == 0 { &self.inputs.frame } else { &self.inputs.neighbors[t - 1] };
            self.copy_area(tile, frame, area);
            if t > 0 {
                self.copy_guide(tile, frame, there);
            }
            let mut view = TileView {
                layout,
                passes: &self.passes,
                width: tile.width,
                here,
                there: if t == 0 { here } else { there },
                area,
                pixel,
                sums,
                columns,
                local,
                constants: self.constants,
            };
            self.search(&mut view, tile, t == 0);
        }
        self.finish(sums, pixel, tile, out);
    }

    /// Copies a frame's guide and variances with their surroundings, mirrored at the border. Variances are scaled by
    /// k², because that is how denominators have them; scaled values would lose what close ones differ by.
    fn copy_guide(&self, tile: Tile, frame: &Planes<'_>, to: &mut [f32]) {
        let grid = &self.layout.guide;
        let (k, channels) = (self.params.k, self.layout.channels);
        for (c, channel) in frame.guide.iter().enumerate().take(channels) {
            self.copy(tile, grid, channel.value, &mut to[c * grid.plane..], 1.0);
            self.copy(tile, grid, channel.variance, &mut to[(channels + c) * grid.plane..], k * k);
        }
    }

    /// Copies what is read at neighbours, and marks those outside the image.
    fn copy_area(&self, tile: Tile, frame: &Planes<'_>, to: &mut [f32]) {
        let layout = &self.layout;
        let grid = &layout.area;
        for (c, channel) in frame.features.iter().flatten().enumerate() {
            self.copy(tile, grid, channel.value, &mut to[layout.area_feature(0, c)..], 1.0);
            self.copy(tile, grid, channel.variance, &mut to[layout.area_feature(1, c)..], 1.0);
            if self.constants.pair {
                self.copy(tile, grid, channel.spread, &mut to[layout.area_feature(2, c)..], 1.0);
            }
        }
        for (k, target) in frame.targets.iter().enumerate() {
            self.copy(tile, grid, target, &mut to[layout.area_target(k)..], 1.0);
        }
        let penalty = &mut to[layout.area_penalty()..][..grid.rows * grid.pitch];
        for row in penalty.chunks_exact_mut(grid.pitch) {
            for (i, value) in row.iter_mut().enumerate() {
                let inside = (tile.x + i).checked_sub(grid.left).is_some_and(|x| x < self.params.width);
                *value = if inside { 0.0 } else { PENALTY };
            }
        }
    }

    /// Copies the part of a plane that a grid shows, mirrored at the border of the image.
    fn copy(&self, tile: Tile, grid: &Grid, from: &[f32], to: &mut [f32], factor: f32) {
        let (width, height) = (self.params.width, self.params.height);
        let start = tile.x as isize - grid.left as isize;
        let inside = start >= 0 && start as usize + grid.columns <= width;
        for (j, row) in to[..grid.rows * grid.pitch].chunks_exact_mut(grid.pitch).enumerate() {
            let row = &mut row[..grid.columns];
            let y = mirror(tile.y as isize + j as isize - grid.above as isize, height);
            let from = &from[y * width..][..width];
            if inside {
                for (value, from) in row.iter_mut().zip(&from[start as usize..]) {
                    *value = from * factor;
                }
            } else {
                for (i, value) in row.iter_mut().enumerate() {
                    *value = from[mirror(start + i as isize, width)] * factor;
                }
            }
        }
    }

    /// Fills in what each pixel of the tile compares with and scales by.
    fn fill_pixels(&self, tile: Tile, to: &mut [f32]) {
        let (layout, grid) = (&self.layout, &self.layout.pixel);
        let mut rows = |plane: usize, from: &[f32], map: &dyn Fn(f32) -> f32| {
            for j in 0..tile.height {
                let first = (tile.y + j) * self.params.width + tile.x;
                let row = &mut to[plane + j * grid.pitch..][..tile.width];
                for (value, &from) in row.iter_mut().zip(&from[first..]) {
                    *value = map(from);
                }
            }
        };
        let scale = feature_scale(self.params);
        let counts = self.inputs.frame.features.iter().flat_map(|f| f.iter().map(|_| f.len()));
        for ((c, channel), count) in self.inputs.frame.features.iter().flatten().enumerate().zip(counts) {
            rows(layout.pixel_feature(0, c), channel.value, &|v| v);
            rows(layout.pixel_feature(1, c), channel.variance, &|v| -v);
            for (i, floor) in self.constants.floors.into_iter().enumerate() {
                let plane = layout.pixel_feature(2 + i, c);
                if self.constants.pair {
                    rows(plane, channel.spread, &|s| s.max(floor));
                } else {
                    // τ is above 0.
                    let scale = scale / count as f64;
                    rows(plane, channel.spread, &|s| (scale / f64::from(s.max(floor))) as f32);
                }
            }
        }
        if let Some(perturbation) = self.inputs.perturbation.filter(|_| self.constants.derivative) {
            for (c, step) in perturbation.step.into_iter().enumerate() {
                rows(layout.pixel_step(c), step, &|v| v);
            }
        }
    }

    /// Runs over the window, row by row, each row in blocks of offsets: the same order for every pixel.
    fn search(&self, view: &mut TileView<'_>, tile: Tile, same_frame: bool) {
        let reach = self.layout.reach as isize;
        let (width, height) = (self.params.width as isize, self.params.height as isize);
        let (x, y) = (tile.x as isize, tile.y as isize);
        let last = (x + tile.width as isize - 1, y + tile.height as isize - 1);
        // Offsets for which some pixel of the tile has its neighbour inside the image.
        let (left, right) = ((-reach).max(-last.0), reach.min(width - 1 - x));
        let (top, bottom) = ((-reach).max(-last.1), reach.min(height - 1 - y));
        for dy in top..=bottom {
            let rows = (-dy - y).max(0) as usize..(height - dy - y).min(tile.height as isize) as usize;
            let mut dx = left;
            while dx <= right {
                let count = ((right - dx + 1) as usize).min(self.group);
                let near = same_frame && self.near(dy, dx);
                self.dispatch(view, &Block { rows: rows.clone(), dy, dx, count, same_frame, near });
                dx += self.group as isize;
            }
        }
    }

    /// Whether some offset of a block is so small that p is a tap of its neighbour's patch, and that counts.
    fn near(&self, dy: isize, dx: isize) -> bool {
        let patch = self.layout.patches.first().map_or(-1, |&f| f as isize);
        let (constants, last) = (&self.constants, dx + self.group as isize - 1);
        constants.derivative && !constants.joint && dy.abs() <= patch && dx <= patch && last >= -patch
    }

    fn dispatch(&self, view: &mut TileView<'_>, block: &Block) {
        // SAFETY: the callers of `filter` refuse levels that this machine lacks; views are made by `run` in the sizes
        // of the layout; `search` keeps offsets within the reach and rows within the tile.
        unsafe {
            match self.level {
                #[cfg(target_arch = "x86_64")]
                InstructionSet::Avx512 => pass_avx512(view, block, self.group),
                #[cfg(target_arch = "x86_64")]
                InstructionSet::Avx2 => pass_avx2(view, block, self.group),
                _ => hot::pass::<Portable>(view, block, self.group),
            }
        }
    }

    /// Divides the sums and writes the tile's result.
    fn finish(&self, sums: &[f32], pixel: &[f32], tile: Tile, out: Vec<TileRows<'_>>) {
        let layout = &self.layout;
        let (grid, targets) = (&layout.pixel, layout.targets);
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
                    let delta = &pixel[layout.pixel_step(c) + j * grid.pitch..][..tile.width];
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

/// # Safety
/// As [`hot::pass`].
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq")]
unsafe fn pass_avx512(view: &mut TileView<'_>, block: &Block, group: usize) {
    // SAFETY: passed on unchanged.
    unsafe { hot::pass::<Avx512>(view, block, group) }
}

/// # Safety
/// As [`hot::pass`].
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
unsafe fn pass_avx2(view: &mut TileView<'_>, block: &Block, group: usize) {
    // SAFETY: passed on unchanged.
    unsafe { hot::pass::<Avx2>(view, block, group) }
}
