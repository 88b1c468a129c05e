//! Parameters and input planes of the flash filter, and the check that both make sense. All limits are ours.

use super::FlashFilterError;
use crate::engine::first_bad;

/// Largest window radius in pixels.
pub const MAX_WINDOW_RADIUS: usize = 32;
/// Largest patch radius in pixels.
pub const MAX_PATCH_RADIUS: usize = 3;
/// Largest magnitude of a source value. Differences of two such values stay far from overflow.
pub const MAX_SOURCE: f32 = 1e30;
/// Most frames before the target, and most after it.
pub const MAX_NEIGHBORS: usize = 8;
/// Most pixels that an image may have: indices and padded tile coordinates stay far from overflow.
pub const MAX_PIXELS: usize = 1 << 31;

/// Size and shape parameters of one filter pass.
#[derive(Clone, Debug, PartialEq)]
pub struct FlashParams {
    /// Image width in pixels, at least 1.
    pub width: usize,
    /// Image height in pixels, at least 1.
    pub height: usize,
    /// Window radius r in pixels: the window has (2r+1)² pixels and is clipped at the image border. With frames beside the
    /// target it is a cube and reaches r frames to both sides, as far as they are there.
    /// 0 to [`MAX_WINDOW_RADIUS`]; moon2013flash uses 3, then 15 (Sec. 3.5).
    pub window_radius: usize,
    /// Standard deviation σ_s of the spatial Gaussian in pixels and in frames, greater than 0; infinity switches it off.
    pub spatial_sigma: f32,
    /// Weights of the patch over which guide differences are averaged; along time as in rows and columns.
    pub patch: PatchWeights,
}

/// Separable, symmetric, normalised patch weights (moon2013flash, Sec. 3.2): G(i, j) = g(|i|)·g(|j|), Σ G = 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchWeights {
    radius: usize,
    /// g(0), g(1), …, zero beyond the radius; g(0) + 2·Σ g(i≥1) = 1 and g(0) ≥ g(i).
    taps: [f64; MAX_PATCH_RADIUS + 1],
}

impl PatchWeights {
    /// Gaussian weights of standard deviation `std` pixels on (2·`radius`+1)² pixels. An infinite `std` gives equal
    /// weights.
    ///
    /// # Errors
    /// [`FlashFilterError::PatchRadius`] or [`FlashFilterError::Sigma`].
    ///
    /// ```
    /// use noisefloor_kernels::flash_filter::PatchWeights;
    /// let patch = PatchWeights::gaussian(2, 1.25)?;
    /// let sum: f64 = (-2..=2).map(|i: i32| patch.tap(i.unsigned_abs() as usize)).sum();
    /// assert!((sum - 1.0).abs() < 1e-15);
    /// # Ok::<(), noisefloor_kernels::flash_filter::FlashFilterError>(())
    /// ```
    pub fn gaussian(radius: usize, std: f32) -> Result<Self, FlashFilterError> {
        if radius > MAX_PATCH_RADIUS {
            return Err(FlashFilterError::PatchRadius { value: radius, max: MAX_PATCH_RADIUS });
        }
        if std.is_nan() || std <= 0.0 {
            return Err(FlashFilterError::Sigma { parameter: "patch standard deviation", value: std });
        }
        let two_var = 2.0 * f64::from(std) * f64::from(std);
        let mut taps = [0.0; MAX_PATCH_RADIUS + 1];
        for (i, tap) in taps.iter_mut().enumerate().take(radius + 1) {
            *tap = (-((i * i) as f64) / two_var).exp();
        }
        // At least the centre's exp(0) = 1, so the division is safe.
        let sum = taps[0] + 2.0 * taps[1..].iter().sum::<f64>();
        Ok(Self { radius, taps: taps.map(|tap| tap / sum) })
    }

    /// Equal weights on (2·`radius`+1)² pixels.
    ///
    /// # Errors
    /// [`FlashFilterError::PatchRadius`].
    pub fn uniform(radius: usize) -> Result<Self, FlashFilterError> {
        Self::gaussian(radius, f32::INFINITY)
    }

    /// Patch radius f in pixels.
    pub fn radius(&self) -> usize {
        self.radius
    }

    /// Weight g(`distance`) of one axis; 0 beyond the radius.
    pub fn tap(&self, distance: usize) -> f64 {
        self.taps.get(distance).copied().unwrap_or(0.0)
    }
}

/// Which neighbours q may contribute to pixel p (moon2013flash, Eq. 2). A pixel always belongs to its own set.
///
/// The half-widths are confidence-interval half-widths t·s_p/√n_p at the *centre* pixel p: at least 0, and
/// infinity lets every neighbour pass. A neighbour passes a test on the values v if
/// |v_q − v_p| ≤ half-width + 4·eps·max(|v_p|, |v_q|), see [`super::half_width`] for the rounding allowance.
#[derive(Clone, Copy, Debug)]
pub enum Membership<'a> {
    /// One set for all channels: a neighbour must pass the test in each of the three channels.
    Joint([&'a [f32]; 3]),
    /// A set of its own for each channel, hence a weight sum for each.
    PerChannel([&'a [f32]; 3]),
    /// One set for all channels, tested on Rec. 709 luminance against a half-width of luminance.
    Luminance(&'a [f32]),
    /// No test: the whole window.
    Off,
}

/// The image that range weights are computed from.
#[derive(Clone, Copy, Debug)]
pub struct Guide<'a> {
    /// Three planes of finite values. Squared differences that overflow `f32` give weight 0.
    pub planes: [&'a [f32]; 3],
    /// σ_r² that each pixel's own noise asks for, greater than 0; infinity asks for no range weight. A pair of pixels
    /// takes the smaller of its two values.
    pub sigma_r2: &'a [f32],
}

/// Planes of the target that are summed along with the source, over the same sets and with the same weights. Finite values.
/// Frames beside the target bring theirs in [`Neighbor::carried`].
#[derive(Clone, Copy, Debug)]
pub enum Carried<'a> {
    /// v, for Σ w·v / Σ w: what the filter makes of another image.
    Values([&'a [f32]; 3]),
    /// v ≥ 0, for Σ w²·v / (Σ w)²: with v the variances of independent source values, the variance of their mean.
    Variances([&'a [f32]; 3]),
}

impl<'a> Carried<'a> {
    /// The planes, and whether the weights are squared.
    pub(super) fn parts(&self) -> ([&'a [f32]; 3], bool) {
        match *self {
            Self::Values(planes) => (planes, false),
            Self::Variances(planes) => (planes, true),
        }
    }
}

/// Result of a pass that carries planes along: three planes each.
#[derive(Clone, Debug, PartialEq)]
pub struct Filtered<T = f32> {
    /// The filtered source.
    pub image: [Vec<T>; 3],
    /// What [`Carried`] asks for. A sum of variances that overflows is infinite.
    pub carried: [Vec<T>; 3],
}

/// Input planes, each of width·height values in rows.
#[derive(Clone, Copy, Debug)]
pub struct FlashInputs<'a> {
    /// What is tested and averaged: finite, magnitude at most [`MAX_SOURCE`].
    pub source: [&'a [f32]; 3],
    /// The membership test with its half-widths.
    pub membership: Membership<'a>,
    /// The guide; without one every range weight is 1.
    pub guide: Option<Guide<'a>>,
    /// Frames before the target in time order, the earliest first; at most [`MAX_NEIGHBORS`], and none for a still image.
    pub before: &'a [Neighbor<'a>],
    /// Frames after the target in time order; at most [`MAX_NEIGHBORS`].
    pub after: &'a [Neighbor<'a>],
}

/// A frame of an animation beside the target (moon2013flash, Sec. 4), in planes as large as the target's and with the same
/// limits.
#[derive(Clone, Copy, Debug)]
pub struct Neighbor<'a> {
    /// What is tested and averaged.
    pub source: [&'a [f32]; 3],
    /// The guide: there if the target has one, and only then.
    pub guide: Option<Guide<'a>>,
    /// What a pass that carries planes along sums of this frame; of the kind that [`Carried`] says of the target. Needed by
    /// such passes only.
    pub carried: Option<[&'a [f32]; 3]>,
}

impl<'a> FlashInputs<'a> {
    /// The frame `time` after the target, which is at 0.
    pub(super) fn frame(&self, time: isize) -> Option<Neighbor<'a>> {
        match time {
            0 => Some(Neighbor { source: self.source, guide: self.guide, carried: None }),
            1.. => self.after.get(time as usize - 1).copied(),
            _ => Some(self.before[self.before.len().checked_sub(time.unsigned_abs())?]),
        }
    }
}

impl FlashParams {
    /// Checks the parameters and every input value.
    ///
    /// # Errors
    /// The first thing that is out of range; see [`FlashFilterError`].
    pub fn check(&self, inputs: &FlashInputs<'_>) -> Result<(), FlashFilterError> {
        let (width, height) = (self.width, self.height);
        if !width.checked_mul(height).is_some_and(|n| (1..=MAX_PIXELS).contains(&n)) {
            return Err(FlashFilterError::ImageSize { width, height, max: MAX_PIXELS });
        }
        if self.window_radius > MAX_WINDOW_RADIUS {
            return Err(FlashFilterError::WindowRadius { value: self.window_radius, max: MAX_WINDOW_RADIUS });
        }
        if self.spatial_sigma.is_nan() || self.spatial_sigma <= 0.0 {
            return Err(FlashFilterError::Sigma { parameter: "spatial sigma", value: self.spatial_sigma });
        }
        self.check_source(inputs.source)?;
        let half_widths = |name, plane| self.check_plane(name, plane, "0 to infinity", |v| v >= 0.0);
        match inputs.membership {
            Membership::Joint(planes) | Membership::PerChannel(planes) => {
                for (name, plane) in ["half-width 0", "half-width 1", "half-width 2"].into_iter().zip(planes)
                {
                    half_widths(name, plane)?;
                }
            }
            Membership::Luminance(plane) => half_widths("half-width of luminance", plane)?,
            Membership::Off => {}
        }
        if let Some(guide) = inputs.guide {
            self.check_guide(guide)?;
        }
        for (side, frames) in [("before", inputs.before), ("after", inputs.after)] {
            if frames.len() > MAX_NEIGHBORS {
                return Err(FlashFilterError::Neighbors { side, value: frames.len(), max: MAX_NEIGHBORS });
            }
        }
        each_neighbor(inputs, |neighbor| {
            self.check_source(neighbor.source)?;
            match (inputs.guide, neighbor.guide) {
                (None, None) => Ok(()),
                (Some(_), Some(guide)) => self.check_guide(guide),
                _ => Err(FlashFilterError::Unlike { planes: "guide" }),
            }
        })
    }

    /// Checks planes that are carried along, those of the frames beside the target too.
    ///
    /// # Errors
    /// As [`FlashParams::check`].
    pub fn check_carried(
        &self,
        inputs: &FlashInputs<'_>,
        carried: &Carried<'_>,
    ) -> Result<(), FlashFilterError> {
        let (planes, variances) = carried.parts();
        self.check_sums(planes, variances)?;
        each_neighbor(inputs, |neighbor| match neighbor.carried {
            Some(planes) => self.check_sums(planes, variances),
            None => Err(FlashFilterError::Unlike { planes: "carried" }),
        })
    }

    fn check_source(&self, source: [&[f32]; 3]) -> Result<(), FlashFilterError> {
        for (name, plane) in ["source 0", "source 1", "source 2"].into_iter().zip(source) {
            self.check_plane(name, plane, "a magnitude of at most 1e30", |v| v.abs() <= MAX_SOURCE)?;
        }
        Ok(())
    }

    fn check_guide(&self, guide: Guide<'_>) -> Result<(), FlashFilterError> {
        for (name, plane) in ["guide 0", "guide 1", "guide 2"].into_iter().zip(guide.planes) {
            self.check_plane(name, plane, "any finite value", |v| v.is_finite())?;
        }
        self.check_plane("sigma_r2", guide.sigma_r2, "greater than 0", |v| v > 0.0)
    }

    fn check_sums(&self, planes: [&[f32]; 3], variances: bool) -> Result<(), FlashFilterError> {
        for (name, plane) in ["carried 0", "carried 1", "carried 2"].into_iter().zip(planes) {
            if variances {
                self.check_plane(name, plane, "finite and at least 0", |v| (0.0..=f32::MAX).contains(&v))?;
            } else {
                self.check_plane(name, plane, "any finite value", |v| v.is_finite())?;
            }
        }
        Ok(())
    }

    /// Checks the length of one plane and each of its values. Generic, so that the test is inlined and vectorised.
    fn check_plane(
        &self,
        plane: &'static str,
        values: &[f32],
        allowed: &'static str,
        ok: impl Fn(f32) -> bool + Sync,
    ) -> Result<(), FlashFilterError> {
        let expected = self.width * self.height;
        if values.len() != expected {
            return Err(FlashFilterError::PlaneLength { plane, expected, actual: values.len() });
        }
        let Some(index) = first_bad(values, ok) else { return Ok(()) };
        let (x, y) = (index % self.width, index / self.width);
        Err(FlashFilterError::Value { plane, x, y, value: values[index], allowed })
    }
}

/// Checks the frames beside the target; the first error says which frame has it.
fn each_neighbor(
    inputs: &FlashInputs<'_>,
    check: impl Fn(&Neighbor<'_>) -> Result<(), FlashFilterError>,
) -> Result<(), FlashFilterError> {
    let before = inputs.before.iter().zip(-(inputs.before.len() as isize)..);
    for (neighbor, time) in before.chain(inputs.after.iter().zip(1..)) {
        check(neighbor).map_err(|error| FlashFilterError::Neighbor { time, error: Box::new(error) })?;
    }
    Ok(())
}
