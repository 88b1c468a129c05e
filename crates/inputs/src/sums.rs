//! The one pass over a frame beside its reference: sums per block, of which all statistics are made.

use noisefloor_frame::{Frame, Variance};

use crate::against::Against;

/// Sums over the pixels of a block. With g the mean of the three channels, w the block's weight, and e = w(g_x − g_r):
/// channels of a pixel are one cluster.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Sums {
    /// Pixels.
    pub(crate) pixels: f64,
    pub(crate) e: f64,
    pub(crate) e2: f64,
    pub(crate) e3: f64,
    pub(crate) e4: f64,
    /// Σ w²(x−r)²/9 over channels: e² if channels were independent.
    pub(crate) apart: f64,
    /// Σ w²v/9 over channels, and of its square per pixel.
    pub(crate) stated: f64,
    pub(crate) stated2: f64,
    /// Σ w²v_r/9, and the same scaled to the samples of the frame, with its square per pixel.
    pub(crate) reference: f64,
    pub(crate) predicted: f64,
    pub(crate) predicted2: f64,
    /// Σ w·g_r and Σ w·g_x.
    pub(crate) light: f64,
    pub(crate) seen: f64,
    /// Pixels whose stated variance is zero up to rounding.
    pub(crate) silent: f64,
    /// Pixels that are constant in the reference.
    pub(crate) constant: f64,
}

impl Sums {
    pub(crate) fn add(&mut self, other: &Self) {
        for (a, b) in [
            (&mut self.pixels, other.pixels),
            (&mut self.e, other.e),
            (&mut self.e2, other.e2),
            (&mut self.e3, other.e3),
            (&mut self.e4, other.e4),
            (&mut self.apart, other.apart),
            (&mut self.stated, other.stated),
            (&mut self.stated2, other.stated2),
            (&mut self.reference, other.reference),
            (&mut self.predicted, other.predicted),
            (&mut self.predicted2, other.predicted2),
            (&mut self.light, other.light),
            (&mut self.seen, other.seen),
            (&mut self.silent, other.silent),
            (&mut self.constant, other.constant),
        ] {
            *a += b;
        }
    }

    pub(crate) fn total(all: &[Self]) -> Self {
        let mut out = Self::default();
        all.iter().for_each(|sums| out.add(sums));
        out
    }

    /// Σ(e − ē)² and Σ(e − ē)³.
    pub(crate) fn central(&self) -> (f64, f64) {
        let n = self.pixels.max(1.0);
        let mean = self.e / n;
        let second = (self.e2 - n * mean * mean).max(0.0);
        (second, self.e3 - 3.0 * mean * self.e2 + 2.0 * n * mean.powi(3))
    }

    /// How many times larger the variance of g is than if its channels were independent; from 1, by what the residuals show,
    /// up to 3.
    pub(crate) fn together(&self) -> f64 {
        if self.apart > 0.0 { (self.e2 / self.apart).clamp(1.0, 3.0) } else { 1.0 }
    }
}

/// Variances below this multiple of the squared value are rounding of single precision.
const ROUNDING: f64 = 4.0 * (f32::EPSILON as f64) * (f32::EPSILON as f64);

/// Agreement of a value that has no variance, relative: better than half precision rounds.
const SAME: f64 = 1e-3;

/// One [`Sums`] per block; `invalid` flags pixels to leave out (empty: none).
pub(crate) fn sums(against: &Against<'_>, frame: &Frame, invalid: &[bool]) -> Vec<Sums> {
    let (x, r) = (&frame.color.mean, against.reference.mean());
    let v = frame.color.variance.as_ref().map(Variance::mean_variance);
    let v_r = against.reference.frame.color.variance.as_ref().map(Variance::mean_variance);
    let scale = against.spp.zip(frame.samples.total().uniform()).map(|(long, n)| long / f64::from(n));
    let mut out = vec![Sums::default(); against.blocks.count()];
    for pixel in 0..x.pixels() {
        if !against.usable(pixel, invalid) {
            continue;
        }
        let block = against.blocks.of(pixel);
        let w = against.weights[block];
        let at = |image: &noisefloor_frame::Image| [0, 1, 2].map(|c| f64::from(image.plane(c)[pixel]));
        let (a, b) = (at(x), at(r));
        let unknown = |image: &noisefloor_frame::Image| at(image).iter().any(|value| !value.is_finite());
        if unknown(x) || v.is_some_and(unknown) || v_r.is_some_and(unknown) {
            continue;
        }
        let sum = |values: [f64; 3]| values.iter().sum::<f64>();
        let d: [f64; 3] = std::array::from_fn(|c| w * (a[c] - b[c]));
        let e = sum(d) / 3.0;
        let s = &mut out[block];
        s.pixels += 1.0;
        s.e += e;
        s.e2 += e * e;
        s.e3 += e * e * e;
        s.e4 += e * e * e * e;
        s.apart += d.iter().map(|v| v * v).sum::<f64>() / 9.0;
        s.light += w * sum(b) / 3.0;
        s.seen += w * sum(a) / 3.0;
        let rounding = |value: f64| ROUNDING * value * value;
        let magnitude = sum(a.map(f64::abs)).max(sum(b.map(f64::abs)));
        if let Some(v) = v {
            let v = sum(at(v).map(|v| v.max(0.0)));
            s.stated += w * w * v / 9.0;
            s.stated2 += (w * w * v / 9.0).powi(2);
            s.silent += f64::from(v <= rounding(magnitude));
        }
        let constant = match v_r {
            Some(v_r) => {
                let v = sum(at(v_r).map(|v| v.max(0.0)));
                let own = w * w * v / 9.0;
                let scaled = own * scale.unwrap_or(0.0);
                s.reference += own;
                s.predicted += scaled;
                s.predicted2 += scaled * scaled;
                // An exact truth has no variance anywhere: there only agreement tells a constant pixel.
                if against.exact { (e / w).abs() <= SAME * magnitude } else { v <= rounding(magnitude) }
            }
            None => (e / w).abs() <= SAME * magnitude,
        };
        s.constant += f64::from(constant);
    }
    out
}
