//! The fast form: prepares a tile, runs the inner loops over all offsets of the window, writes the result.

use super::hot::{self, Block, JOINT, SEPARATE, SINGLE, TileView};
use super::layout::{BLOCK, Layout};
use super::members::{EVERYTHING, Tests, half_width};
use super::params::MAX_PATCH_RADIUS;
use super::{Carried, FlashInputs, FlashParams};
use crate::InstructionSet;
use crate::grid::Grid;
use crate::mirror::mirror;
use crate::simd::Portable;
#[cfg(target_arch = "x86_64")]
use crate::simd::{Avx2, Avx512};
use crate::tiles::{Tile, TileRows, for_each_tile};

/// Tile of the fast form, (width, height) in pixels.
pub(super) const TILE: (usize, usize) = (64, 16);

/// Value of source pixels outside the image. It differs from every pixel by more than any half-width, so that the
/// membership test clips the window, and stays finite in all that follows.
const OUTSIDE: f32 = 3e38;

/// One call's constants, shared by all workers.
struct Job<'a> {
    params: &'a FlashParams,
    inputs: &'a FlashInputs<'a>,
    tests: Tests<'a>,
    layout: Layout,
    level: InstructionSet,
    rule: usize,
    taps: [f32; MAX_PATCH_RADIUS + 1],
    carried: Option<&'a Carried<'a>>,
    /// Over σ_r²: the factor from unscaled patch sums to an exponent of 2.
    range: f64,
    /// Factor from squared offset to an exponent of 2.
    spatial: f64,
}

/// Filters checked inputs into planes of the right size: three, and three more if planes are carried along.
pub(crate) fn filter<'o>(
    params: &FlashParams,
    inputs: &FlashInputs<'_>,
    carried: Option<&Carried<'_>>,
    level: InstructionSet,
    tile_size: (usize, usize),
    out: impl IntoIterator<Item = &'o mut [f32]>,
) {
    let tests = Tests::new(inputs);
    let rule = match &tests {
        Tests::PerChannel(_) => SEPARATE,
        Tests::Shared(tests) if tests.len() == 1 => SINGLE,
        Tests::Shared(_) => JOINT,
    };
    // A patch without a guide is never read.
    let patch = if inputs.guide.is_some() { params.patch.radius() } else { 0 };
    let center = params.patch.tap(0);
    let mut taps = [0.0; MAX_PATCH_RADIUS + 1];
    for (i, tap) in taps.iter_mut().enumerate() {
        // The middle tap is the largest and at least 1/7.
        *tap = (params.patch.tap(i) / center) as f32;
    }
    let sigma = f64::from(params.spatial_sigma);
    let job = Job {
        params,
        inputs,
        tests,
        layout: Layout::new(tile_size, params.window_radius, patch),
        level,
        rule,
        taps,
        carried,
        range: -std::f64::consts::LOG2_E * center * center / 6.0,
        spatial: -std::f64::consts::LOG2_E / (2.0 * sigma * sigma),
    };
    for_each_tile(
        params.width,
        tile_size,
        out,
        || Scratch::new(&job.layout),
        |scratch, tile, rows| {
            job.run(scratch, tile, rows);
        },
    );
}

/// One worker's memory.
struct Scratch {
    memory: Vec<f32>,
    /// Index of the first cache line that starts in `memory`.
    start: usize,
}

impl Scratch {
    fn new(layout: &Layout) -> Self {
        let planes = 8 * layout.source.plane
            + 3 * layout.guide.plane
            + 12 * layout.pixel.plane
            + BLOCK * layout.columns.plane;
        let memory = vec![0.0f32; planes + 16];
        // `align_offset` may give up and say usize::MAX; alignment is for speed only.
        let start = memory.as_ptr().align_offset(64).min(16);
        Self { memory, start }
    }
}

impl Job<'_> {
    fn run(&self, scratch: &mut Scratch, tile: Tile, out: Vec<TileRows<'_>>) {
        let layout = &self.layout;
        let memory = &mut scratch.memory[scratch.start..];
        let (source, memory) = memory.split_at_mut(4 * layout.source.plane);
        let (guide, memory) = memory.split_at_mut(3 * layout.guide.plane);
        let (half_width, memory) = memory.split_at_mut(3 * layout.pixel.plane);
        let (factor, memory) = memory.split_at_mut(layout.source.plane);
        let (carried, memory) = memory.split_at_mut(3 * layout.source.plane);
        let (sums, columns) = memory.split_at_mut(9 * layout.pixel.plane);
        let guided = self.inputs.guide.is_some();
        self.copy_source(tile, source);
        self.copy_guide(tile, guide);
        self.copy_factor(tile, factor);
        self.copy_carried(tile, carried);
        self.fill_half_widths(tile, half_width);
        sums.fill(0.0);
        let mut view = TileView {
            layout,
            width: tile.width,
            source,
            guide: if guided { guide } else { &[] },
            half_width,
            factor: if guided { factor } else { &[] },
            carried: if self.carried.is_some() { carried } else { &[] },
            squared: self.carried.is_some_and(|carried| carried.parts().1),
            sums,
            columns,
            taps: self.taps,
        };
        self.sweep(&mut view, tile);
        self.finish(&view, tile, out);
    }

    /// Copies one plane with its surroundings on the source's grid, outside the image `outside`.
    fn copy_plane(&self, tile: Tile, from: &[f32], to: &mut [f32], outside: f32) {
        let grid = &self.layout.source;
        for (j, row) in to[..grid.rows * grid.pitch].chunks_exact_mut(grid.pitch).enumerate() {
            let row = &mut row[..grid.columns];
            let y = (tile.y + j).checked_sub(grid.above).filter(|&y| y < self.params.height);
            let Some(y) = y else {
                row.fill(outside);
                continue;
            };
            let from = &from[y * self.params.width..][..self.params.width];
            // Columns of the image that the row shows, and where they start in it.
            let first = tile.x.saturating_sub(grid.left);
            let skip = grid.left.saturating_sub(tile.x);
            let count = (from.len() - first).min(row.len() - skip);
            row[..skip].fill(outside);
            row[skip..skip + count].copy_from_slice(&from[first..first + count]);
            row[skip + count..].fill(outside);
        }
    }

    /// Copies the source and the tested plane, outside the image [`OUTSIDE`].
    fn copy_source(&self, tile: Tile, to: &mut [f32]) {
        let mut planes = to.chunks_exact_mut(self.layout.source.plane);
        for (plane, to) in self.inputs.source.into_iter().zip(&mut planes) {
            self.copy_plane(tile, plane, to, OUTSIDE);
        }
        if let (SINGLE, Tests::Shared(tests), Some(to)) = (self.rule, &self.tests, planes.next()) {
            self.copy_plane(tile, &tests[0].values, to, OUTSIDE);
        }
    }

    /// Copies the factors that the guide's widths give. Pixels outside the image get that of 1, as their weight is 0
    /// whatever it is.
    fn copy_factor(&self, tile: Tile, to: &mut [f32]) {
        let Some(guide) = self.inputs.guide else { return };
        self.copy_plane(tile, guide.sigma_r2, to, 1.0);
        for value in to {
            // Finite, so that distance 0 gives exponent 0 whatever the width.
            *value = (self.range / f64::from(*value)).max(f64::from(f32::MIN)) as f32;
        }
    }

    /// Copies carried planes, outside the image 0.
    fn copy_carried(&self, tile: Tile, to: &mut [f32]) {
        let Some(carried) = self.carried else { return };
        let planes = to.chunks_exact_mut(self.layout.source.plane);
        for (plane, to) in carried.parts().0.into_iter().zip(planes) {
            self.copy_plane(tile, plane, to, 0.0);
        }
    }

    /// Copies the guide with its surroundings, mirrored at the border of the image.
    fn copy_guide(&self, tile: Tile, to: &mut [f32]) {
        let Some(guide) = self.inputs.guide else { return };
        let grid: &Grid = &self.layout.guide;
        let (width, height) = (self.params.width, self.params.height);
        let start = tile.x as isize - grid.left as isize;
        let inside = start >= 0 && start as usize + grid.columns <= width;
        for (c, from) in guide.planes.into_iter().enumerate() {
            let to = &mut to[c * grid.plane..][..grid.rows * grid.pitch];
            for (j, row) in to.chunks_exact_mut(grid.pitch).enumerate() {
                let row = &mut row[..grid.columns];
                let y = mirror(tile.y as isize + j as isize - grid.above as isize, height);
                let from = &from[y * width..][..width];
                if inside {
                    row.copy_from_slice(&from[start as usize..][..grid.columns]);
                } else {
                    for (i, value) in row.iter_mut().enumerate() {
                        *value = from[mirror(start + i as isize, width)];
                    }
                }
            }
        }
    }

    /// Fills in what each pixel of the tile compares with.
    fn fill_half_widths(&self, tile: Tile, half_widths: &mut [f32]) {
        let grid = &self.layout.pixel;
        let tests = match &self.tests {
            Tests::Shared(tests) => tests.as_slice(),
            Tests::PerChannel(tests) => tests.as_slice(),
        };
        for j in 0..tile.height {
            let first = (tile.y + j) * self.params.width + tile.x;
            for (c, test) in tests.iter().enumerate() {
                let row = &mut half_widths[c * grid.plane + j * grid.pitch..][..tile.width];
                let Some(tolerance) = test.tolerance else {
                    row.fill(EVERYTHING);
                    continue;
                };
                let (tolerance, center) = (&tolerance[first..], &test.values[first..]);
                for ((value, &tolerance), &center) in row.iter_mut().zip(tolerance).zip(center) {
                    *value = half_width(tolerance, center);
                }
            }
        }
    }

    /// Runs over the window, row by row, each row in blocks of offsets: the same order for every pixel.
    fn sweep(&self, view: &mut TileView<'_>, tile: Tile) {
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
                let count = ((right - dx + 1) as usize).min(BLOCK);
                let mut spatial = [0.0; BLOCK];
                for (o, value) in spatial.iter_mut().enumerate().take(count) {
                    *value = self.spatial(dy, dx + o as isize);
                }
                let block = Block { rows: rows.clone(), dy, dx, count, spatial };
                self.dispatch(view, &block);
                dx += BLOCK as isize;
            }
        }
    }

    /// What a block holds for one offset: the exponent of the spatial weight, or without a guide the weight itself.
    fn spatial(&self, dy: isize, dx: isize) -> f32 {
        let squared = dy.pow(2) + dx.pow(2);
        let exponent = if squared == 0 { 0.0 } else { squared as f64 * self.spatial };
        match self.inputs.guide {
            Some(_) => exponent as f32,
            None => exponent.exp2() as f32,
        }
    }

    fn dispatch(&self, view: &mut TileView<'_>, block: &Block) {
        // SAFETY: `filter_into` refused levels that this machine lacks; views are made by `run` in the sizes of
        // the layout; `sweep` keeps offsets within the reach and rows within the tile.
        unsafe {
            match self.level {
                #[cfg(target_arch = "x86_64")]
                InstructionSet::Avx512 => pass_avx512(view, block, self.rule),
                #[cfg(target_arch = "x86_64")]
                InstructionSet::Avx2 => pass_avx2(view, block, self.rule),
                _ => hot::pass::<Portable>(view, block, self.rule),
            }
        }
    }

    /// Divides the sums and writes the tile's result.
    fn finish(&self, view: &TileView<'_>, tile: Tile, out: Vec<TileRows<'_>>) {
        let (source, pixel) = (&self.layout.source, &self.layout.pixel);
        for (plane, rows) in out.into_iter().enumerate() {
            let c = plane % 3;
            let set = if self.rule == SEPARATE { c } else { 0 };
            for (j, row) in rows.into_iter().enumerate() {
                let here = j * pixel.pitch;
                let weights = &view.sums[(3 + set) * pixel.plane + here..][..tile.width];
                if plane >= 3 {
                    let sums = &view.sums[(6 + c) * pixel.plane + here..][..tile.width];
                    for ((value, sum), weight) in row.iter_mut().zip(sums).zip(weights) {
                        *value = if view.squared { sum / (weight * weight) } else { sum / weight };
                    }
                    continue;
                }
                let sums = &view.sums[c * pixel.plane + here..][..tile.width];
                let center =
                    &view.source[c * source.plane + source.origin() + j * source.pitch..][..tile.width];
                for (i, value) in row.iter_mut().enumerate() {
                    // Eq. 1. The pixel itself has weight 1, so the weight sum is at least 1. Its own step of 0 also keeps
                    // the mean step a relative 1/n below the largest of n steps, hence below the half-width, by
                    // more than rounding can add: no clamp is needed to honour the bound.
                    *value = center[i] + sums[i] / weights[i];
                }
            }
        }
    }
}

/// # Safety
/// As [`hot::pass`].
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq")]
unsafe fn pass_avx512(view: &mut TileView<'_>, block: &Block, rule: usize) {
    // SAFETY: passed on unchanged.
    unsafe { hot::pass::<Avx512>(view, block, rule) }
}

/// # Safety
/// As [`hot::pass`].
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
unsafe fn pass_avx2(view: &mut TileView<'_>, block: &Block, rule: usize) {
    // SAFETY: passed on unchanged.
    unsafe { hot::pass::<Avx2>(view, block, rule) }
}
