use std::ops::Bound;

use noisefloor_denoiser::{ParamError, Parameters, choices, parameters};
use noisefloor_kernels::flash_filter::{MAX_PATCH_RADIUS, MAX_WINDOW_RADIUS};
use noisefloor_stats::Level;

choices! {
    /// The image that range weights come from.
    pub enum GuideKind {
        /// The virtual flash image and its variance (Sec. 3.1).
        Flash = "flash",
        /// The noisy colour mean and its variance: for frames without a flash image.
        Color = "color",
        /// No range weights: homogeneous pixels under a spatial Gaussian.
        None = "none",
    }
}

choices! {
    /// What a neighbour is compared by (Eq. 2 is written for one number per pixel).
    pub enum TestKind {
        /// All three channels must pass; one set for all.
        Joint = "joint",
        /// A set of its own for each channel.
        PerChannel = "per-channel",
        /// Luminance alone, with a standard deviation as if the channels were fully correlated (an upper bound of the true one).
        Luminance = "luminance",
    }
}

choices! {
    /// Which standard error step 2 tests with; Sec. 3.5 does not say.
    pub enum SpreadKind {
        /// The smaller of `Raw` and `Propagated`, per pixel and channel.
        Least = "least",
        /// s_p/√n_p of the input, as in step 1.
        Raw = "raw",
        /// √(Σ w̄²·s_q²/n_q) with the normalised weights of step 1, as if its inputs were not shared between pixels: too small
        /// where they are alike, and above the input's own where neighbours are noisier.
        Propagated = "propagated",
        /// Both half buffers filtered with the weights of step 1, their squared difference as the variance; t keeps n_p−1
        /// degrees of freedom.
        Halves = "halves",
    }
}

/// Most frames on each side: those that the source work looks at (Sec. 4).
const MAX_NEIGHBORS: usize = 5;

parameters! {
    /// Parameters of `virtual-flash`. Defaults are the source work's where it gives a value, and else ours.
    pub struct Params {
        // A section says where the value is printed; lines without one say that it is ours.
        /// 2: both steps; 1: one step with the settings `second_…`.
        steps: u8 = 2, integer(1..=2).section("Sec. 3.5, Fig. 7");
        /// The image that range weights come from.
        guide: GuideKind = GuideKind::Flash, choice::<GuideKind>().symbol("F").section("Eq. 1");
        /// Whether only homogeneous pixels count; off is an ablation that voids every claim.
        homogeneous: bool = true, flag().section("Sec. 3.3");
        /// What homogeneous pixels are compared by (default ours).
        test: TestKind = TestKind::Joint, choice::<TestKind>().section("Eq. 2");
        /// Standard error of the test in step 2, which the source does not state (default ours).
        second_spread: SpreadKind = SpreadKind::Least, choice::<SpreadKind>();
        /// Frames on each side that windows and patches take in; 5 is the source work's for animations.
        neighbors: usize = 0, integer(0..=MAX_NEIGHBORS).unit("frames").section("Sec. 4");
        /// Radius of the window in step 1: 3 is 7×7.
        first_window_radius_px: usize = 3, integer(0..=MAX_WINDOW_RADIUS).unit("px").symbol("Ω").section("Sec. 3.5");
        /// Level of step 1.
        first_confidence: f64 = 0.998, between(0.0, 1.0).unit("two-sided").symbol("1−α").section("Sec. 3.5");
        /// σ_s of step 1 over the window's width (ours: the source states that of step 2).
        first_sigma_ratio: f64 = 1.0 / 3.0, number(0.001..=1000.0);
        /// Radius of the window in step 2: 15 is 31×31.
        second_window_radius_px: usize = 15, integer(0..=MAX_WINDOW_RADIUS).unit("px").symbol("Ω").section("Sec. 3.5");
        /// Level of step 2.
        second_confidence: f64 = 0.99, between(0.0, 1.0).unit("two-sided").symbol("1−α").section("Sec. 3.5");
        /// σ_s of step 2 over the window's width.
        second_sigma_ratio: f64 = 1.0 / 3.0, number(0.001..=1000.0).section("Sec. 4");
        /// Radius of the patch: 2 is 5×5.
        patch_radius_px: usize = 2, integer(0..=MAX_PATCH_RADIUS).unit("px").symbol("u(F_p)").section("Sec. 4");
        /// Standard deviation of the patch's Gaussian weights (ours: a quarter of the patch).
        patch_sigma_px: f64 = 1.25, number(0.01..=1000.0).unit("px");
        /// σ_r over the standard error of the flash image; the source says proportional (value ours, study `vfi-kappa`: pure
        /// noise keeps the weight exp(−1/2) on average).
        kappa: f64 = 1.4, number(0.001..=1000.0).symbol("κ").section("Sec. 4");
        /// κ where the noisy colour is the guide (ours, study `vfi-kappa`).
        color_kappa: f64 = 1.4, number(0.001..=1000.0);
        /// Least σ_r, as a fraction of the guide's bright level, its `luminance_clip_percentile` (ours).
        guide_floor: f64 = 1e-4, number(0.0..=1.0);
        /// Factor on the intensity of the virtual flash light that the heuristic gives.
        intensity_scale: f64 = 1.0, number(0.0..=1000.0).section("Fig. 3");
        /// Percentile at which bright pixels are clipped where the whole image sets intensity or floor (ours).
        luminance_clip_percentile: f64 = 99.9,
            number((Bound::Excluded(0.0), Bound::Included(100.0))).unit("%");
    }
}

/// Window, level and spatial width of one step (Sec. 3.5).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Step {
    pub name: &'static str,
    pub window_radius: usize,
    pub level: Level,
    /// σ_s of g_s (Eq. 1) in pixels: a third of the window's width (Sec. 4).
    pub spatial_sigma: f32,
}

impl Params {
    /// Both steps with patches but without a flash image, for frames from elsewhere.
    #[must_use]
    pub fn color_guided() -> Self {
        Self { guide: GuideKind::Color, ..Self::default() }
    }

    /// Step 1 alone, as in Fig. 7 (b) of the source work.
    #[must_use]
    pub fn first_step_only() -> Self {
        let d = Self::default();
        Self {
            steps: 1,
            second_window_radius_px: d.first_window_radius_px,
            second_confidence: d.first_confidence,
            second_sigma_ratio: d.first_sigma_ratio,
            ..d
        }
    }

    /// The steps in order.
    ///
    /// # Errors
    /// The level that is none.
    pub(crate) fn steps(&self) -> Result<Vec<Step>, ParamError> {
        self.check()?;
        let step = |name, radius: usize, confidence, ratio: f64| {
            // A checked parameter is above 0 and below 1.
            let level = Level::two_sided(confidence).unwrap_or(Level::TWO_SIDED_99);
            let spatial_sigma = (ratio * (2 * radius + 1) as f64) as f32;
            Step { name, window_radius: radius, level, spatial_sigma }
        };
        let first =
            step("step 1", self.first_window_radius_px, self.first_confidence, self.first_sigma_ratio);
        let second = step(
            if self.steps == 1 { "step" } else { "step 2" },
            self.second_window_radius_px,
            self.second_confidence,
            self.second_sigma_ratio,
        );
        Ok(if self.steps == 1 { vec![second] } else { vec![first, second] })
    }
}
