use noisefloor_denoiser::ParamDoc;
use noisefloor_kernels::flash_filter::{MAX_PATCH_RADIUS, MAX_WINDOW_RADIUS};
use noisefloor_stats::Level;
use serde::{Deserialize, Serialize};

/// The image that range weights come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum GuideKind {
    /// The virtual flash image and its variance (Sec. 3.1).
    Flash,
    /// The noisy colour mean and its variance: for frames without a flash image.
    Color,
    /// No range weights: homogeneous pixels under a spatial Gaussian.
    None,
}

/// What a neighbour is compared by (Eq. 2 is written for one number per pixel).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TestKind {
    /// All three channels must pass; one set for all.
    Joint,
    /// A set of its own for each channel.
    PerChannel,
    /// Luminance alone, with a standard deviation as if the channels were fully correlated (an upper bound of the true one).
    Luminance,
}

/// Which standard error step 2 tests with; Sec. 3.5 does not say.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SpreadKind {
    /// The smaller of `Raw` and `Propagated`, per pixel and channel.
    Least,
    /// s_p/√n_p of the input, as in step 1.
    Raw,
    /// √(Σ w̄²·s_q²/n_q) with the normalised weights of step 1, as if its inputs were not shared between pixels: too small
    /// where they are alike, and above the input's own where neighbours are noisier.
    Propagated,
    /// Both half buffers filtered with the weights of step 1, their squared difference as the variance; t keeps n_p−1
    /// degrees of freedom.
    Halves,
}

/// Parameters of `virtual-flash`. Defaults are the source work's where it gives a value, and else ours.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Params {
    /// 2: both steps; 1: one step with the settings `second_…`.
    pub steps: u8,
    /// F: the image that range weights come from.
    pub guide: GuideKind,
    /// Whether only homogeneous pixels count; off is an ablation that voids every claim.
    pub homogeneous: bool,
    /// What homogeneous pixels are compared by.
    pub test: TestKind,
    /// Standard error of the test in step 2.
    pub second_spread: SpreadKind,
    /// Radius of the window Ω in step 1, pixels: 3 is 7×7.
    pub first_window_radius_px: usize,
    /// 1−α of step 1, two-sided.
    pub first_confidence: f64,
    /// σ_s of step 1 over the window's width.
    pub first_sigma_ratio: f64,
    /// Radius of the window Ω in step 2, pixels: 15 is 31×31.
    pub second_window_radius_px: usize,
    /// 1−α of step 2, two-sided.
    pub second_confidence: f64,
    /// σ_s of step 2 over the window's width.
    pub second_sigma_ratio: f64,
    /// Radius of the patch u(F_p), pixels: 2 is 5×5.
    pub patch_radius_px: usize,
    /// Standard deviation of the patch's Gaussian weights, pixels.
    pub patch_sigma_px: f64,
    /// κ of the flash image: σ_r over the standard error of the guide.
    pub kappa: f64,
    /// κ where the noisy colour is the guide.
    pub color_kappa: f64,
    /// Least σ_r, as a fraction of the guide's bright level (its `luminance_clip_percentile`).
    pub guide_floor: f64,
    /// Factor on the intensity of the virtual flash light that the heuristic gives.
    pub intensity_scale: f64,
    /// Percentile at which bright pixels are clipped where the whole image sets a number, percent.
    pub luminance_clip_percentile: f64,
}

impl Default for Params {
    fn default() -> Self {
        Self {
            steps: 2,
            guide: GuideKind::Flash,
            homogeneous: true,
            test: TestKind::Joint,
            second_spread: SpreadKind::Least,
            first_window_radius_px: 3,
            first_confidence: 0.998,
            first_sigma_ratio: 1.0 / 3.0,
            second_window_radius_px: 15,
            second_confidence: 0.99,
            second_sigma_ratio: 1.0 / 3.0,
            patch_radius_px: 2,
            patch_sigma_px: 1.25,
            kappa: 1.4,
            color_kappa: 1.4,
            guide_floor: 1e-4,
            intensity_scale: 1.0,
            luminance_clip_percentile: 99.9,
        }
    }
}

/// Window, level and spatial width of one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Step {
    pub name: &'static str,
    pub window_radius: usize,
    pub level: Level,
    /// σ_s in pixels.
    pub spatial_sigma: f32,
}

const RADIUS: &str = "0 to 32 px";
const CONFIDENCE: &str = "above 0 and below 1, two-sided";
const RATIO: &str = "0.001 to 1000";

const fn doc(name: &'static str, range: &'static str, about: &'static str) -> ParamDoc {
    ParamDoc { name, range, about }
}

impl Params {
    /// The parameter table: names are the fields of the struct.
    pub const DOCS: &'static [ParamDoc] = &[
        doc("steps", "1 | 2", "both steps, or one with the settings second_… (Sec. 3.5, Fig. 7)"),
        doc("guide", "flash | color | none", "F: the image that range weights come from (Eq. 1)"),
        doc("homogeneous", "true | false", "only homogeneous pixels count; off voids every claim (Sec. 3.3)"),
        doc("test", "joint | per-channel | luminance", "what homogeneous pixels are compared by (Eq. 2)"),
        doc("second_spread", "least | raw | propagated | halves", "standard error of the test in step 2"),
        doc("first_window_radius_px", RADIUS, "radius of Ω in step 1 (Sec. 3.5: 7×7)"),
        doc("first_confidence", CONFIDENCE, "1−α of step 1 (Sec. 3.5: 99.8 %)"),
        doc("first_sigma_ratio", RATIO, "σ_s of step 1 over the width of its window"),
        doc("second_window_radius_px", RADIUS, "radius of Ω in step 2 (Sec. 3.5: 31×31)"),
        doc("second_confidence", CONFIDENCE, "1−α of step 2 (Sec. 3.5: 99 %)"),
        doc("second_sigma_ratio", RATIO, "σ_s of step 2 over the width of its window (Sec. 4: 1/3)"),
        doc("patch_radius_px", "0 to 3 px", "radius of the patch u (Sec. 4: 5×5)"),
        doc("patch_sigma_px", "0.01 to 1000 px", "standard deviation of the patch weights"),
        doc(
            "kappa",
            "0.001 to 1000",
            "κ: σ_r over the standard error of the flash image (Sec. 4: proportional)",
        ),
        doc("color_kappa", "0.001 to 1000", "κ with guide = color"),
        doc("guide_floor", "0 to 1", "least σ_r, as a fraction of the guide's bright level"),
        doc("intensity_scale", "0 to 1000", "factor on the heuristic flash intensity (Fig. 3)"),
        doc(
            "luminance_clip_percentile",
            "above 0, at most 100 %",
            "where bright pixels are clipped when the image sets intensity or floor",
        ),
    ];

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
    pub(crate) fn steps(&self) -> Result<Vec<Step>, &'static str> {
        let step = |name, radius: usize, confidence, ratio: f64, which| {
            let level = Level::two_sided(confidence).map_err(|_| which)?;
            let spatial_sigma = (ratio * (2 * radius + 1) as f64) as f32;
            Ok(Step { name, window_radius: radius, level, spatial_sigma })
        };
        let first = step(
            "step 1",
            self.first_window_radius_px,
            self.first_confidence,
            self.first_sigma_ratio,
            "first_confidence",
        )?;
        let second = step(
            if self.steps == 1 { "step" } else { "step 2" },
            self.second_window_radius_px,
            self.second_confidence,
            self.second_sigma_ratio,
            "second_confidence",
        )?;
        Ok(if self.steps == 1 { vec![second] } else { vec![first, second] })
    }

    pub(crate) fn validate(&self) -> Result<(), &'static str> {
        let ratio = |v: f64| (1e-3..=1e3).contains(&v);
        let checks = [
            ("steps", (1..=2).contains(&self.steps)),
            ("first_window_radius_px", self.first_window_radius_px <= MAX_WINDOW_RADIUS),
            ("first_sigma_ratio", ratio(self.first_sigma_ratio)),
            ("second_window_radius_px", self.second_window_radius_px <= MAX_WINDOW_RADIUS),
            ("second_sigma_ratio", ratio(self.second_sigma_ratio)),
            ("patch_radius_px", self.patch_radius_px <= MAX_PATCH_RADIUS),
            ("patch_sigma_px", (0.01..=1e3).contains(&self.patch_sigma_px)),
            ("kappa", ratio(self.kappa)),
            ("color_kappa", ratio(self.color_kappa)),
            ("guide_floor", (0.0..=1.0).contains(&self.guide_floor)),
            ("intensity_scale", (0.0..=1e3).contains(&self.intensity_scale)),
            (
                "luminance_clip_percentile",
                self.luminance_clip_percentile > 0.0 && self.luminance_clip_percentile <= 100.0,
            ),
        ];
        if let Some((name, _)) = checks.iter().find(|(_, ok)| !ok) {
            return Err(name);
        }
        self.steps().map(|_| ())
    }
}
