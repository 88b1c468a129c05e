//! The fast form: prepares a tile, runs the inner loops over all offsets of the window, writes the result.

use super::hot::{GuidePair, JOINT, Offsets, PatchColumns, SEPARATE, SINGLE, Step, TileView};
use super::layout::{BLOCK, CARRIED, FACTOR, Layout, TESTED};
use super::members::{EVERYTHING, Tests, half_width};
use super::params::MAX_PATCH_RADIUS;
use super::volume::{TARGET, Volume};
use super::{Carried, FlashInputs, FlashParams, Neighbor};
use crate::engine::{Block, Copies, InstructionSet, Plane, Scratch, Tile, TileRows, Window, for_each_tile};

/// Value of source pixels outside the image. It differs from every pixel by more than any half-width, so that the
/// membership test clips the window, and stays finite in all that follows.
const OUTSIDE: f32 = 3e38;

/// One call's constants, shared by all workers.
struct Job<'a> {
    params: &'a FlashParams,
    inputs: &'a FlashInputs<'a>,
    volume: Volume,
    /// The frames of the volume, the target with its carried planes.
    frames: Vec<Neighbor<'a>>,
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
    let volume = Volume::new(params, inputs);
    let mut frames = volume.of(inputs);
    frames[TARGET].carried = carried.map(|carried| carried.parts().0);
    let tests = Tests::new(inputs, &volume);
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
        volume,
        frames,
        tests,
        layout: Layout::new(tile_size, params.window_radius, patch, volume.frames()),
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
        || Scratch::new(job.sizes().iter().sum()),
        |scratch, tile, rows| {
            job.run(scratch, tile, rows);
        },
    );
}

impl Job<'_> {
    /// Values of a worker's parts: frames, guides, half-widths, sums, columns.
    fn sizes(&self) -> [usize; 5] {
        let Layout { frames, pixel, columns, .. } = self.layout;
        let guides = if self.inputs.guide.is_some() { frames * self.layout.guide_frame() } else { 0 };
        [frames * self.layout.frame(), guides, 3 * pixel.plane, 9 * pixel.plane, BLOCK * columns.plane]
    }

    fn run(&self, scratch: &mut Scratch, tile: Tile, out: Vec<TileRows<'_>>) {
        let [frames, guide, half_width, sums, columns] = scratch.parts(self.sizes());
        let guided = self.inputs.guide.is_some();
        let copies = Copies { width: self.params.width, height: self.params.height, tile };
        for (_, place) in self.volume.window() {
            self.copy_frame(&copies, place, &mut frames[place * self.layout.frame()..]);
        }
        for (frame, to) in self.frames.iter().zip(guide.chunks_exact_mut(self.layout.guide_frame())) {
            self.copy_guide(&copies, frame, to);
        }
        self.fill_half_widths(tile, half_width);
        sums.fill(0.0);
        let plane = self.layout.source.plane;
        // SAFETY: the parts have the sizes of the layout, whose copies reach as far around the tile as the window and the
        // patch do, and a vector more, for each frame of the volume; the walk keeps offsets within the reach and rows within
        // the tile, and places of frames come from the volume.
        let mut view = unsafe {
            TileView {
                layout: &self.layout,
                width: tile.width,
                source: Plane::vouched(frames),
                guide: guided.then(|| Plane::vouched(guide)),
                half_width: Plane::vouched(half_width),
                factor: Plane::vouched(&frames[FACTOR * plane..]),
                carried: self.carried.map(|_| Plane::vouched(&frames[CARRIED * plane..])),
                squared: self.squared(),
                sums: Plane::vouched_mut(sums),
                columns: Plane::vouched_mut(columns),
                taps: self.taps,
            }
        };
        let (width, height) = (self.params.width, self.params.height);
        for (time, place) in self.volume.window() {
            let pairs = self.pairs(time);
            for block in (Window { width, height, reach: self.layout.reach }).blocks(tile, BLOCK) {
                let offsets = self.offsets(block, time, place);
                if guided {
                    self.level.launch(PatchColumns { tile: &mut view, offsets: &offsets, pairs: &pairs });
                }
                self.level.launch(Step { tile: &mut view, offsets: &offsets, rule: self.rule });
            }
        }
        self.finish(frames, sums, tile, out);
    }

    /// What the patches of pixels and their neighbours `time` later compare; nothing to list for the target alone.
    fn pairs(&self, time: isize) -> Vec<GuidePair> {
        if self.layout.frames == 1 {
            return Vec::new();
        }
        let start = |place: usize| place * self.layout.guide_frame();
        let slabs = self.volume.slabs(time).into_iter();
        let pairs = slabs.map(|slab| GuidePair {
            here: start(slab.here),
            there: start(slab.there),
            weight: slab.weight as f32,
        });
        // A weight that vanishes would make no number of a square that overflows.
        pairs.filter(|pair| pair.weight > 0.0).collect()
    }

    fn squared(&self) -> bool {
        self.carried.is_some_and(|carried| carried.parts().1)
    }

    /// A block with what it holds for each offset: the exponent of the spatial weight, or without a guide the weight itself.
    /// Along time the distance counts in frames as along rows in pixels (Sec. 4).
    fn offsets(&self, block: Block, time: isize, place: usize) -> Offsets {
        let mut spatial = [0.0; BLOCK];
        for (o, value) in spatial.iter_mut().enumerate().take(block.count) {
            let squared = block.dy.pow(2) + (block.dx + o as isize).pow(2) + time.pow(2);
            let exponent = if squared == 0 { 0.0 } else { squared as f64 * self.spatial };
            *value = match self.inputs.guide {
                Some(_) => exponent as f32,
                None => exponent.exp2() as f32,
            };
        }
        Offsets { block, frame: place * self.layout.frame(), spatial }
    }

    /// Copies what is read at neighbours in one frame.
    fn copy_frame(&self, copies: &Copies, place: usize, to: &mut [f32]) {
        let (grid, frame) = (&self.layout.source, &self.frames[place]);
        // The source and the tested plane, outside the image `OUTSIDE`.
        for (plane, to) in frame.source.into_iter().zip(to.chunks_exact_mut(grid.plane)) {
            copies.marked(grid, plane, to, OUTSIDE);
        }
        if let (SINGLE, Tests::Shared(tests)) = (self.rule, &self.tests) {
            copies.marked(grid, &tests[0].values[place], &mut to[TESTED * grid.plane..], OUTSIDE);
        }
        self.copy_factor(copies, frame, &mut to[FACTOR * grid.plane..][..grid.plane]);
        // Carried planes, outside the image 0.
        if let Some(carried) = frame.carried.filter(|_| self.carried.is_some()) {
            let to = to[CARRIED * grid.plane..].chunks_exact_mut(grid.plane);
            for (plane, to) in carried.into_iter().zip(to) {
                copies.marked(grid, plane, to, 0.0);
            }
        }
    }

    /// Copies a guide with its surroundings, mirrored at the border of the image.
    fn copy_guide(&self, copies: &Copies, frame: &Neighbor<'_>, to: &mut [f32]) {
        let Some(guide) = frame.guide else { return };
        let grid = &self.layout.guide;
        for (plane, to) in guide.planes.into_iter().zip(to.chunks_exact_mut(grid.plane)) {
            copies.mirrored(grid, plane, to, 1.0);
        }
    }

    /// Copies the factors that the guide's widths give. Pixels outside the image get that of 1, as their weight is 0
    /// whatever it is.
    fn copy_factor(&self, copies: &Copies, frame: &Neighbor<'_>, to: &mut [f32]) {
        let Some(guide) = frame.guide else { return };
        copies.marked(&self.layout.source, guide.sigma_r2, to, 1.0);
        for value in to {
            // Finite, so that distance 0 gives exponent 0 whatever the width.
            *value = (self.range / f64::from(*value)).max(f64::from(f32::MIN)) as f32;
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
                let (tolerance, center) = (&tolerance[first..], &test.values[TARGET][first..]);
                for ((value, &tolerance), &center) in row.iter_mut().zip(tolerance).zip(center) {
                    *value = half_width(tolerance, center);
                }
            }
        }
    }

    /// Divides the sums and writes the tile's result.
    fn finish(&self, centers: &[f32], sums: &[f32], tile: Tile, out: Vec<TileRows<'_>>) {
        let (source, pixel) = (&self.layout.source, &self.layout.pixel);
        for (plane, rows) in out.into_iter().enumerate() {
            let c = plane % 3;
            let set = if self.rule == SEPARATE { c } else { 0 };
            for (j, row) in rows.into_iter().enumerate() {
                let here = j * pixel.pitch;
                let weights = &sums[(3 + set) * pixel.plane + here..][..tile.width];
                if plane >= 3 {
                    let sums = &sums[(6 + c) * pixel.plane + here..][..tile.width];
                    for ((value, sum), weight) in row.iter_mut().zip(sums).zip(weights) {
                        *value = if self.squared() { sum / (weight * weight) } else { sum / weight };
                    }
                    continue;
                }
                let sums = &sums[c * pixel.plane + here..][..tile.width];
                let center = &centers[c * source.plane + source.origin() + j * source.pitch..][..tile.width];
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
