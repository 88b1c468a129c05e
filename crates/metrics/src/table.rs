use crate::MetricError;

/// ε of the relative metrics, squared radiance.
pub const EPSILON: f64 = 0.01;

/// Share of the pixels that trimmed metrics leave out, rounded up to whole pixels.
pub const TRIMMED_SHARE: f64 = 0.001;

/// Which values of a metric are good.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Better {
    /// Of an error.
    Lower,
    /// Of a score.
    Higher,
    /// Of a balance, which can be off to either side: not ranked, and in no ratio to another row's.
    CloserTo(f64),
}

impl std::fmt::Display for Better {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Lower => f.write_str("lower"),
            Self::Higher => f.write_str("higher"),
            Self::CloserTo(ideal) => write!(f, "closer to {ideal}"),
        }
    }
}

/// What a metric's number means.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Metric {
    /// Stable id, as in records.
    pub id: &'static str,
    /// Short name for tables and plots.
    pub name: &'static str,
    /// Formula: x test, r reference, p pixels, c channels.
    pub formula: &'static str,
    /// ε, if the formula has one.
    pub epsilon: Option<f64>,
    /// What is averaged over what, in which order.
    pub averaging: &'static str,
    /// Which values are good.
    pub better: Better,
    /// Unit, or empty for a pure number.
    pub unit: &'static str,
    /// Whether the reference's noise is taken out.
    pub reference_noise_removed: bool,
    /// Power of the error that it measures: 2 for squared errors, 1 for their root, `None` where plain Monte
    /// Carlo has no fixed rate. Under independent sampling its expectation is c/n (2) for plain Monte Carlo.
    pub order: Option<u32>,
    /// What happens to values that are NaN or infinite.
    pub non_finite: &'static str,
}

impl Metric {
    /// The formula with everything that a reader needs beside it: averaging order and what happens to the
    /// reference's noise.
    #[must_use]
    pub fn formula_text(&self) -> String {
        let noise = if self.reference_noise_removed {
            "reference noise removed"
        } else {
            "not corrected for the reference's noise"
        };
        format!("{}; {}; {noise}", self.formula, self.averaging)
    }
}

const LEFT_OUT: &str = "a pixel with a NaN or infinite channel is counted and left out";

/// All metrics, in the order of display.
pub const METRICS: &[Metric] = &[
    Metric {
        id: "mse",
        name: "MSE",
        formula: "mean (x−r)², with (x−r)² taken as (x−r_A)(x−r_B) from the reference's halves, as \
                  (x−r)²−var(r) where it has a variance only, as it stands where it is exact",
        epsilon: None,
        averaging: "mean over pixels and channels",
        better: Better::Lower,
        unit: "radiance²",
        reference_noise_removed: true,
        order: Some(2),
        non_finite: LEFT_OUT,
    },
    Metric {
        id: "rmse",
        name: "RMSE",
        formula: "√max(0, MSE)",
        epsilon: None,
        averaging: "root after the mean over pixels and channels",
        better: Better::Lower,
        unit: "radiance",
        reference_noise_removed: true,
        order: Some(1),
        non_finite: LEFT_OUT,
    },
    Metric {
        id: "relmse",
        name: "rMSE",
        formula: "mean (x−r)²/(max(r,0)²+ε), ε = 0.01, squared error corrected as in MSE, less the bias by the \
                  reference's noise in the denominator",
        epsilon: Some(EPSILON),
        averaging: "ratio per pixel and channel, then mean over pixels and channels",
        better: Better::Lower,
        unit: "",
        reference_noise_removed: true,
        order: Some(2),
        non_finite: LEFT_OUT,
    },
    Metric {
        id: "relmse_trimmed",
        name: "rMSE trimmed",
        formula: "as rMSE, without the 0.1 % of the pixels (rounded up) where the mean of (x−r)²/(max(r,0)²+ε) over \
                  the channels is largest",
        epsilon: Some(EPSILON),
        averaging: "ratio per pixel and channel, mean over channels, then mean over the pixels kept",
        better: Better::Lower,
        unit: "",
        reference_noise_removed: true,
        order: None,
        non_finite: LEFT_OUT,
    },
    Metric {
        id: "psnr",
        name: "PSNR",
        formula: "−10·log10 mean (T(x)−T(r))², T(x) = sRGB curve of clamp(x, 0, 1) at exposure 1, peak 1; \
                  no value for equal images",
        epsilon: None,
        averaging: "mean over pixels and channels before the logarithm",
        better: Better::Higher,
        unit: "dB",
        reference_noise_removed: false,
        order: None,
        non_finite: LEFT_OUT,
    },
    Metric {
        id: "ssim",
        name: "SSIM",
        formula: "structural similarity (Wang et al. 2004) of Rec. 709 luma of T(x) and T(r), T as for \
                  PSNR; Gaussian window 11×11, σ = 1.5, K1 = 0.01, K2 = 0.03, peak 1; at the border and \
                  beside left-out pixels the window is clipped and its weights are normalised",
        epsilon: None,
        averaging: "mean over pixels",
        better: Better::Higher,
        unit: "",
        reference_noise_removed: false,
        order: None,
        non_finite: LEFT_OUT,
    },
    Metric {
        id: "energy",
        name: "energy",
        formula: "mean x / mean r; no value where mean r is not positive",
        epsilon: None,
        averaging: "means over pixels and all three channels together, then their ratio",
        better: Better::CloserTo(1.0),
        unit: "",
        reference_noise_removed: false,
        order: None,
        non_finite: LEFT_OUT,
    },
];

/// The metric of this id.
///
/// # Errors
/// [`MetricError::Unknown`] listing the known ids.
pub fn metric(id: &str) -> Result<&'static Metric, MetricError> {
    METRICS.iter().find(|m| m.id == id).ok_or_else(|| MetricError::Unknown {
        id: id.to_owned(),
        known: METRICS.iter().map(|m| m.id).collect::<Vec<_>>().join(", "),
    })
}
