//! Sums of weighted residuals over the pixels of a block, of which statements about brightness and variance are made.

/// Three channels of one pixel, and what they are held against.
#[derive(Debug, Clone, Copy)]
pub struct PixelPair {
    /// w, the inverse of the brightness around.
    pub weight: f64,
    /// x per channel.
    pub seen: [f64; 3],
    /// r per channel.
    pub truth: [f64; 3],
    /// v per channel, the variance of x as the frame states it; absent if it states none.
    pub variance: Option<[f64; 3]>,
    /// v_r per channel, the variance of r; absent if it is unknown.
    pub truth_variance: Option<[f64; 3]>,
    /// Samples of the reference over those of the frame; absent if unknown.
    pub scale: Option<f64>,
    /// Whether r is the exact truth, so that v_r = 0 says nothing about x.
    pub exact: bool,
}

/// Sums over pixels. With g the mean of the three channels, w the weight, and e = w(g_x − g_r): channels of a pixel are one
/// cluster.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ResidualSums {
    /// Pixels.
    pub pixels: f64,
    /// Σ e.
    pub e: f64,
    /// Σ e².
    pub e2: f64,
    /// Σ e³.
    pub e3: f64,
    /// Σ e⁴.
    pub e4: f64,
    /// Σ w²(x−r)²/9 over channels: e² if channels were independent.
    pub apart: f64,
    /// Σ w²v/9 over channels.
    pub stated: f64,
    /// Σ of the square of a pixel's part in `stated`.
    pub stated2: f64,
    /// Σ w²v_r/9.
    pub reference: f64,
    /// The same scaled to the samples of the frame.
    pub predicted: f64,
    /// Σ of the square of a pixel's part in `predicted`.
    pub predicted2: f64,
    /// Σ w·g_r.
    pub light: f64,
    /// Σ w·g_x.
    pub seen: f64,
    /// Pixels whose stated variance is zero up to rounding.
    pub silent: f64,
    /// Pixels that are constant in the reference.
    pub constant: f64,
}

/// Variances below this multiple of the squared value are rounding of single precision.
const ROUNDING: f64 = 4.0 * (f32::EPSILON as f64) * (f32::EPSILON as f64);

/// Agreement of a value that has no variance, relative: better than half precision rounds.
const SAME: f64 = 1e-3;

impl ResidualSums {
    /// Adds other sums.
    pub fn add(&mut self, other: &Self) {
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

    /// The sum of all.
    #[must_use]
    pub fn total(all: &[Self]) -> Self {
        let mut out = Self::default();
        all.iter().for_each(|sums| out.add(sums));
        out
    }

    /// Adds a pixel, whose numbers are finite and whose weight is above 0.
    pub fn add_pixel(&mut self, pixel: &PixelPair) {
        let (w, a, b) = (pixel.weight, pixel.seen, pixel.truth);
        let sum = |values: [f64; 3]| values.iter().sum::<f64>();
        let d: [f64; 3] = std::array::from_fn(|c| w * (a[c] - b[c]));
        let e = sum(d) / 3.0;
        self.pixels += 1.0;
        self.e += e;
        self.e2 += e * e;
        self.e3 += e * e * e;
        self.e4 += e * e * e * e;
        self.apart += d.iter().map(|v| v * v).sum::<f64>() / 9.0;
        self.light += w * sum(b) / 3.0;
        self.seen += w * sum(a) / 3.0;
        let rounding = |value: f64| ROUNDING * value * value;
        let magnitude = sum(a.map(f64::abs)).max(sum(b.map(f64::abs)));
        if let Some(v) = pixel.variance {
            let v = sum(v.map(|v| v.max(0.0)));
            self.stated += w * w * v / 9.0;
            self.stated2 += (w * w * v / 9.0).powi(2);
            self.silent += f64::from(v <= rounding(magnitude));
        }
        let constant = match pixel.truth_variance {
            Some(v_r) => {
                let v = sum(v_r.map(|v| v.max(0.0)));
                let own = w * w * v / 9.0;
                let scaled = own * pixel.scale.unwrap_or(0.0);
                self.reference += own;
                self.predicted += scaled;
                self.predicted2 += scaled * scaled;
                // An exact truth has no variance anywhere: there only agreement tells a constant pixel.
                if pixel.exact { (e / w).abs() <= SAME * magnitude } else { v <= rounding(magnitude) }
            }
            None => (e / w).abs() <= SAME * magnitude,
        };
        self.constant += f64::from(constant);
    }

    /// Σ(e − ē)² and Σ(e − ē)³.
    #[must_use]
    pub fn central(&self) -> (f64, f64) {
        let n = self.pixels.max(1.0);
        let mean = self.e / n;
        let second = (self.e2 - n * mean * mean).max(0.0);
        (second, self.e3 - 3.0 * mean * self.e2 + 2.0 * n * mean.powi(3))
    }

    /// How many times larger the variance of g is than if its channels were independent; from 1, by what the residuals show,
    /// up to 3.
    #[must_use]
    pub fn together(&self) -> f64 {
        if self.apart > 0.0 { (self.e2 / self.apart).clamp(1.0, 3.0) } else { 1.0 }
    }

    /// Variance of S = Σ e from the spread of the blocks' sums, which knows of correlated neighbours; 0 below 30 blocks.
    #[must_use]
    pub fn between(blocks: &[Self], all: &Self) -> f64 {
        let used: Vec<&Self> = blocks.iter().filter(|b| b.pixels > 0.0).collect();
        let count = used.len() as f64;
        if count < LEAST_EFFECTIVE {
            return 0.0;
        }
        let mean = all.e / all.pixels;
        used.iter().map(|b| (b.e - b.pixels * mean).powi(2)).sum::<f64>() * count / (count - 1.0)
    }

    /// How S = Σ e spreads: the largest of what the residuals show pixel by pixel, of `between`, of what the frame states
    /// (where `states`) and of what the reference predicts, with `together` of all pixels.
    ///
    /// # Errors
    /// The effective number of pixels, (Σ w²v)²/Σ(w²v)², where it is below [`LEAST_EFFECTIVE`]; and a number below it where
    /// more pixels have a variance of zero than are constant and nothing is predicted: the frame may have missed light.
    pub fn spread(&self, states: bool, together: f64, between: f64) -> Result<Spread, f64> {
        let (second, third) = self.central();
        let n = self.pixels;
        let shown = second * n / (n - 1.0).max(1.0);
        let effective = |sum: f64, squares: f64| if squares > 0.0 { sum * sum / squares } else { 0.0 };
        let mut least = effective(self.e2, self.e4);
        let mut variance = shown.max(between);
        if states {
            least = effective(self.stated, self.stated2);
            variance = variance.max(together * (self.stated + self.reference));
        }
        let predicts = self.predicted > 0.0;
        if predicts {
            least = least.min(effective(self.predicted, self.predicted2));
            variance = variance.max(together * (self.predicted + self.reference));
        }
        let missed = states && self.silent > self.constant;
        if least < LEAST_EFFECTIVE || (missed && !predicts) {
            return Err(least.min(if missed { LEAST_EFFECTIVE - 1.0 } else { least }));
        }
        Ok(Spread { variance, reference: together * self.reference, third })
    }

    /// Degrees of freedom of S: the effective number of pixels by the stated variance (where the frame has one), else by
    /// the residuals, less one; at least 1.
    #[must_use]
    pub fn effective_freedom(&self, has_variance: bool) -> u64 {
        let effective = match has_variance && self.stated2 > 0.0 {
            true => self.stated * self.stated / self.stated2,
            false => self.e2 * self.e2 / self.e4.max(f64::MIN_POSITIVE),
        };
        effective.min(self.pixels).max(2.0) as u64 - 1
    }
}

/// Pixels among which a variance must effectively be spread.
pub const LEAST_EFFECTIVE: f64 = 30.0;

/// Variance of S = Σ e, its parts and its third moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// Of S.
    pub variance: f64,
    /// The reference's part in it.
    pub reference: f64,
    /// Third central moment of S.
    pub third: f64,
}

/// z of `s` with `variance` and third central moment, shrunk for skewness where that moves it towards zero (Hall 1992, "On
/// the removal of skewness by transformation").
#[must_use]
pub fn shrunk(s: f64, variance: f64, third: f64) -> f64 {
    if variance <= 0.0 {
        return if s == 0.0 { 0.0 } else { f64::INFINITY.copysign(s) };
    }
    let z = s / variance.sqrt();
    let skew = third / variance.powf(1.5);
    // Monotone in z, so that large differences stay large whatever their skewness.
    let hall = z + skew * z * z / 3.0 + skew * skew * z.powi(3) / 27.0 + skew / 6.0;
    if hall * z <= 0.0 { 0.0 } else { z.abs().min(hall.abs()).copysign(z) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pixel(seen: [f64; 3], truth: [f64; 3], variance: f64) -> PixelPair {
        PixelPair {
            weight: 2.0,
            seen,
            truth,
            variance: Some([variance; 3]),
            truth_variance: None,
            scale: None,
            exact: false,
        }
    }

    #[test]
    fn equal_channels_spread_three_times_as_much_as_independent_ones() {
        let mut sums = ResidualSums::default();
        sums.add_pixel(&pixel([1.5; 3], [1.0; 3], 0.0));
        assert_eq!((sums.e, sums.e2, sums.together()), (1.0, 1.0, 3.0));
        let mut sums = ResidualSums::default();
        sums.add_pixel(&pixel([1.5, 1.0, 1.0], [1.0; 3], 0.0));
        assert!((sums.together() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn silent_pixels_and_a_few_bright_ones_tell_nothing() {
        let mut sums = ResidualSums::default();
        (0..100).for_each(|k| {
            sums.add_pixel(&pixel([1.0 + 0.1 * f64::from(k % 3 - 1); 3], [1.0; 3], 0.01));
        });
        assert!(sums.spread(true, 3.0, 0.0).is_ok());
        assert_eq!(sums.effective_freedom(true), 99);
        // A pixel that has no variance although it differs from the reference has missed something.
        sums.add_pixel(&pixel([0.0; 3], [1.0; 3], 0.0));
        let constant = (0..100).filter(|k| k % 3 == 1).count() as f64;
        assert_eq!((sums.silent, sums.constant), (1.0, constant));
        sums.constant = 0.0;
        assert_eq!(sums.spread(true, 3.0, 0.0), Err(29.0));
        sums.silent = 0.0;
        sums.add_pixel(&pixel([1.0; 3], [1.0; 3], 10.0));
        assert!(sums.spread(true, 3.0, 0.0).unwrap_err() < 2.0, "one pixel has all the variance");
    }

    #[test]
    fn skewness_only_ever_shrinks() {
        assert_eq!(shrunk(2.0, 1.0, 0.0), 2.0);
        for (z, third) in [(2.0, 0.6), (-2.0, 0.6), (-2.0, -0.6), (0.05, -0.6), (9.0, 0.9)] {
            let found = shrunk(z, 1.0, third);
            assert!(found.abs() <= f64::abs(z) && found * z >= 0.0, "{z} {third}: {found}");
        }
        assert!(shrunk(-2.0, 1.0, 0.6) > -1.7);
        assert_eq!((shrunk(0.0, 0.0, 0.0), shrunk(1.0, 0.0, 0.0)), (0.0, f64::INFINITY));
    }
}
