//! The filter: Σ w·u / Σ w over the neighbours closer than R, weight 1 − distance/R (Listing, line 1, line 2, line 4 and lines
//! 11-15, mended).
//!
//! Pixel by pixel, the window row by row; rows add to sums per column of the window (`row.rs`), and these to each other in
//! `f64`. Both orders are fixed, so the bits depend neither on threads nor on the instruction set. Image rows are padded, so
//! that no window is cut at the left or the right.

use noisefloor_frame::Image;
use noisefloor_kernels::{InstructionSet, Vectorised};
use rayon::prelude::*;

use crate::guides::{Guides, OUTSIDE};

mod alike;
mod row;
#[cfg(test)]
mod tests;

use alike::Own;
pub(crate) use alike::Thresholds;
use row::{Columns, LANES, PLANES, Strip, TOGETHER};

/// Rows that one thread takes at a time: enough that their windows overlap; ours, for speed.
const BAND: usize = 8;

/// An image to filter, with everything that the weights depend on.
pub(crate) struct Cone<'a> {
    width: usize,
    height: usize,
    radii: &'a [f32],
    thresholds: Thresholds,
    lengths: Lengths,
    /// Values from one row to the next.
    stride: usize,
    /// Padding left of a row.
    margin: usize,
    planes: [Vec<f32>; PLANES],
    /// Albedo, if it is compared.
    albedo: Option<[Vec<f32>; 3]>,
}

impl<'a> Cone<'a> {
    /// `radii` holds R for each pixel, at most `radius_max`; the colour has three channels.
    pub fn new(
        color: &Image,
        radii: &'a [f32],
        guides: &Guides,
        thresholds: Thresholds,
        radius_max: f64,
    ) -> Self {
        let (width, height) = (color.width(), color.height());
        let lengths = Lengths::new(radius_max);
        let margin = lengths.reach;
        let stride = margin + width + margin + TOGETHER + LANES;
        let [nx, ny, nz] = &guides.normal;
        let [r, g, b] = [0, 1, 2].map(|c| color.plane(c));
        let padded = |plane: &[f32], filler: f32| {
            let mut out = vec![filler; stride * height];
            let rows = out.par_chunks_mut(stride).zip(plane.par_chunks(width));
            rows.for_each(|(out, row)| out[margin..][..width].copy_from_slice(row));
            out
        };
        let albedo = guides.albedo.as_ref().map(|planes| planes.each_ref().map(|plane| padded(plane, 0.0)));
        let planes = [
            padded(&guides.id, OUTSIDE),
            padded(&guides.depth, 0.0),
            padded(nx, 0.0),
            padded(ny, 0.0),
            padded(nz, 0.0),
            padded(r, 0.0),
            padded(g, 0.0),
            padded(b, 0.0),
        ];
        Self { width, height, radii, thresholds, lengths, stride, margin, planes, albedo }
    }

    /// The filtered image: Listing, line 1.
    pub fn filter(&self) -> Image {
        self.filter_at(InstructionSet::in_use())
    }

    /// The same with a given instruction set.
    fn filter_at(&self, level: InstructionSet) -> Image {
        let mut data = vec![0.0; 3 * self.width * self.height];
        let (r, rest) = data.split_at_mut(self.width * self.height);
        let (g, b) = rest.split_at_mut(self.width * self.height);
        let [r, g, b] = [r, g, b].map(|plane| plane.par_chunks_mut(BAND * self.width));
        r.zip(g).zip(b).enumerate().for_each(|(band, ((r, g), b))| {
            level.run(Band { cone: self, first: band * BAND, out: [r, g, b] });
        });
        Image::from_vec(self.width, self.height, 3, data).expect("three planes of the image's size")
    }

    /// A pixel with nothing of its window read yet.
    #[inline(always)]
    fn start(&self, x: usize, y: usize, pixel: &mut Pixel) {
        let index = y * self.stride + self.margin + x;
        let plane = |plane: usize| self.planes[plane][index];
        let radius = self.radii[y * self.width + x];
        // R ≤ 1 reaches no other pixel; the largest whole offset below R.
        pixel.reach = if radius <= 1.0 { 0 } else { radius.ceil() as usize - 1 };
        pixel.radius = radius;
        pixel.color = [plane(5), plane(6), plane(7)];
        pixel.own = Own {
            id: plane(0),
            depth: plane(1),
            normal: [plane(2), plane(3), plane(4)],
            albedo: match &self.albedo {
                Some([r, g, b]) => [r[index], g[index], b[index]],
                None => [0.0; 3],
            },
            inverse: 1.0 / radius, // not used where the reach is 0
        };
        pixel.columns.clear(pixel.reach);
    }

    /// Neighbouring pixels of a row together, row by row of their windows, which are almost the same.
    #[inline(always)]
    fn filter_pixels<const ALBEDO: bool>(&self, x: usize, y: usize, pixels: &mut [Pixel], strip: &mut Strip) {
        let mut reach = 0;
        for (i, pixel) in pixels.iter_mut().enumerate() {
            self.start(x + i, y, pixel);
            reach = reach.max(pixel.reach);
        }
        if reach == 0 {
            return;
        }
        // Listing, line 4.
        for qy in y.saturating_sub(reach)..(y + reach + 1).min(self.height) {
            let start = qy * self.stride + self.margin + x - reach;
            strip.load(&self.planes, start, reach);
            if let Some(albedo) = self.albedo.as_ref().filter(|_| ALBEDO) {
                strip.load_tints(albedo, start, reach);
            }
            let dy = qy.abs_diff(y);
            for (i, pixel) in pixels.iter_mut().enumerate() {
                if dy > pixel.reach || pixel.reach == 0 {
                    continue;
                }
                let skipped = row::outside(pixel.reach, dy, pixel.radius);
                let left = pixel.reach - skipped;
                let distances = self.lengths.row(dy, left, row::count(left));
                let from = reach + i - left;
                strip.add::<ALBEDO>(
                    from,
                    &pixel.own,
                    &self.thresholds,
                    distances,
                    &mut pixel.columns,
                    skipped,
                );
            }
        }
    }
}

/// A pixel on the way.
#[derive(Default)]
struct Pixel {
    color: [f32; 3],
    own: Own,
    radius: f32,
    reach: usize,
    columns: Columns,
}

impl Pixel {
    /// The pixel itself counts with weight 1, whatever its features say: Listing, line 2, and in the sum of weights too, so that
    /// Listing, line 14 has nothing to guard, and Listing, line 15.
    #[inline(always)]
    fn mean(&self) -> [f32; 3] {
        if self.reach == 0 {
            return self.color;
        }
        let [sum, totals @ ..] = self.columns.totals(self.reach);
        let mean = |c: usize| ((totals[c] + f64::from(self.color[c])) / (sum + 1.0)) as f32;
        [mean(0), mean(1), mean(2)]
    }
}

/// Some rows of the image.
struct Band<'a, 'b> {
    cone: &'a Cone<'a>,
    first: usize,
    out: [&'b mut [f32]; 3],
}

impl Vectorised for Band<'_, '_> {
    type Out = ();

    #[inline(always)]
    fn run(self) {
        if self.cone.albedo.is_some() {
            self.rows::<true>();
        } else {
            self.rows::<false>();
        }
    }
}

impl Band<'_, '_> {
    #[inline(always)]
    fn rows<const ALBEDO: bool>(self) {
        let width = self.cone.width;
        let mut pixels: [Pixel; TOGETHER] = Default::default();
        let mut strip = Strip::default();
        let [out_r, out_g, out_b] = self.out;
        for y in 0..out_r.len() / width {
            for x in (0..width).step_by(TOGETHER) {
                let pixels = &mut pixels[..TOGETHER.min(width - x)];
                self.cone.filter_pixels::<ALBEDO>(x, self.first + y, pixels, &mut strip);
                for (i, pixel) in pixels.iter().enumerate() {
                    let at = y * width + x + i;
                    [out_r[at], out_g[at], out_b[at]] = pixel.mean();
                }
            }
        }
    }
}

/// Euclidean lengths of the offsets (dx, dy) with both at most `reach` pixels; infinite for no offset at all, which is not
/// a neighbour, and beyond.
struct Lengths {
    reach: usize,
    /// Rows by |dy|, columns by dx + reach.
    lengths: Vec<f32>,
}

impl Lengths {
    fn new(radius: f64) -> Self {
        let reach = radius.ceil() as usize;
        let side = Self::side(reach);
        let length = |i: usize| {
            let (dy, dx) = (i / side, (i % side).abs_diff(reach));
            match dx * dx + dy * dy {
                0 => f32::INFINITY,
                _ if i % side > 2 * reach => f32::INFINITY,
                square => (square as f32).sqrt(),
            }
        };
        Self { reach, lengths: (0..(reach + 1) * side).map(length).collect() }
    }

    fn side(reach: usize) -> usize {
        2 * reach + 1 + LANES
    }

    /// Lengths for |dy| fixed and dx from −`left` on, `count` of them.
    #[inline(always)]
    fn row(&self, dy: usize, left: usize, count: usize) -> &[f32] {
        &self.lengths[dy * Self::side(self.reach) + self.reach - left..][..count]
    }
}
