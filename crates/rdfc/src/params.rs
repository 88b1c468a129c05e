use noisefloor_denoiser::ParamDoc;
use noisefloor_kernels::nlm::{MAX_PATCH_RADIUS, MAX_WINDOW_RADIUS};
use serde::{Deserialize, Serialize};

/// Whose choices hold where the printed text and the authors' program differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Profile {
    /// The printed text, with its misprint in line 21 mended.
    Paper,
    /// The authors' program, as far as it is here: without its weights of symmetric pairs, its smoothing of weights and
    /// its mirrored windows.
    Authors,
    /// What wins by measurement: each choice with its figure in the crate's documentation.
    Best,
}

/// Squared slope of a feature that differences are measured against (Sec. 5).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Gradient {
    /// Per axis the smaller of both one-sided half-pixel differences, 0 on the border: the program's rule.
    MinHalf,
    /// Per axis half the difference of both neighbours, one-sided on the border.
    Central,
    /// None: feature weights along edges are as strict as elsewhere (Fig. 4).
    Off,
}

/// Which pixels' variance and gradient Φ² is divided by (Eq. 6).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FeatureDenominator {
    /// The centre's alone, as printed.
    Centre,
    /// The sum of both pixels', as programmed: twice as tolerant.
    Pair,
}

/// Weight of a pixel in its own mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CenterWeight {
    /// 1, as the formula gives.
    One,
    /// The largest of its neighbours' weights, at least 1e-3.
    LargestNeighbor,
}

/// How the derivative in SURE is taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DerivativeRule {
    /// Each channel alone, in the pixel's own patch and in its neighbours'.
    Exact,
    /// All channels at once, in the pixel's own patch.
    Joint,
}

/// What differences of the colour are divided by in the second pass, beside ε.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ColorDenominator {
    /// k_c²·(v(p) + v(q)), as printed: a bright pixel that the combination has left, whose variance is as large as itself,
    /// is averaged into all pixels around it.
    Pair,
    /// 2·k_c²·v(p), as programmed: the pixel alone says what is noise to it.
    TwiceCentre,
}

/// What counts as 1 of depth, and of other features without a limit of their own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DepthRange {
    /// The largest magnitude of the image, as printed.
    Largest,
    /// The 99th percentile; what is beyond is cut.
    Common,
}

/// What sampling densities are made of (Sec. 8).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Density {
    /// The combination's estimate times Σ w/(1 + Σ w·n), filtered by the colour, then clamped at 0.
    Text,
    /// FIRST's estimate, clamped at 0, filtered by colour and features, over FIRST's Σ w·n. Where no neighbour is similar the
    /// pixel's own weight may be 10⁻³ ([`CenterWeight::LargestNeighbor`]), and a clean pixel then asks for a thousand times
    /// what it needs.
    Code,
    /// As [`Density::Code`], over the samples that count as much as the pixel's own, Σ w·n/w(p,p): the same whatever the
    /// scale of the weights.
    Effective,
}

/// Which of SECOND and THIRD a pixel of equal error estimates gets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Ties {
    /// SECOND.
    Earlier,
    /// THIRD.
    Later,
}

/// The pass that removes what the combination leaves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SecondPass {
    /// Colour alone, patch radius 1, the full window (Algorithm 1).
    Text,
    /// Colour and features, patch radius 3, half the window.
    Code,
    /// None.
    Off,
}

/// Whether the sample variance is scaled to the level of the two-buffer variance (Sec. 4).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum VarianceScaling {
    /// For low-discrepancy frames; with independent samples the sample variance is right as it is.
    Auto,
    /// Always.
    Always,
    /// Never.
    Never,
}

/// Parameters of `rdfc` and of its candidates. `None` (null) means: as the profile says.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Params {
    /// Text or program, where they differ.
    pub profile: Profile,
    /// R: radius of the candidates' and the second pass's window, pixels.
    pub window_radius_px: usize,
    /// k_c of FIRST, SECOND and the second pass.
    pub color_k: f64,
    /// k_f of the candidates.
    pub feature_k: f64,
    /// Features in use, by name, where the frame has them.
    pub features: Vec<String>,
    /// Whether features are filtered before use (Sec. 5).
    pub prefilter: bool,
    /// k_c of the features' own filter.
    pub prefilter_k: f64,
    /// Window radius of the features' own filter, pixels.
    pub prefilter_window_radius_px: usize,
    /// Patch radius of the features' own filter, pixels.
    pub prefilter_patch_radius_px: usize,
    /// Scaling of sample variances.
    pub variance_scaling: VarianceScaling,
    /// Frames on each side that the window takes in.
    pub neighbors: usize,
    /// Slope of features.
    pub gradient: Option<Gradient>,
    /// What counts as 1 of depth.
    pub depth_range: Option<DepthRange>,
    /// Denominator of Φ².
    pub feature_denominator: Option<FeatureDenominator>,
    /// Weight of a pixel in its own mean.
    pub center_weight: Option<CenterWeight>,
    /// Derivative in SURE.
    pub derivative: Option<DerivativeRule>,
    /// Equal estimates.
    pub ties: Option<Ties>,
    /// Second pass.
    pub second_pass: Option<SecondPass>,
    /// Denominator of the colour in the second pass.
    pub second_pass_denominator: Option<ColorDenominator>,
    /// Patch radius of the filters of error estimates and selection maps, pixels.
    pub map_patch_radius_px: Option<usize>,
    /// Sampling densities.
    pub density: Option<Density>,
}

impl Default for Params {
    fn default() -> Self {
        Self {
            profile: Profile::Best,
            window_radius_px: 10,
            color_k: 0.45,
            feature_k: 0.6,
            features: ["albedo", "normal", "depth", "visibility", "caustics"].map(String::from).to_vec(),
            prefilter: true,
            prefilter_k: 1.0,
            prefilter_window_radius_px: 5,
            prefilter_patch_radius_px: 3,
            variance_scaling: VarianceScaling::Auto,
            neighbors: 0,
            gradient: None,
            depth_range: None,
            feature_denominator: None,
            center_weight: None,
            derivative: None,
            ties: None,
            second_pass: None,
            second_pass_denominator: None,
            map_patch_radius_px: None,
            density: None,
        }
    }
}

/// Most frames on each side.
pub(crate) const MAX_NEIGHBORS: usize = 8;
/// Most features in use.
pub(crate) const MAX_FEATURES: usize = 10;

const K: &str = "0.001 to 1000";
const RADIUS: &str = "0 to 32 px";
const PATCH: &str = "0 to 3 px";

const fn doc(name: &'static str, range: &'static str, about: &'static str) -> ParamDoc {
    ParamDoc { name, range, about }
}

impl Params {
    /// The parameter table: names are the fields of the struct.
    pub const DOCS: &'static [ParamDoc] = &[
        doc(
            "profile",
            "paper | authors | best",
            "printed text, the authors' program, or what wins by measurement",
        ),
        doc("window_radius_px", RADIUS, "R: window of candidates and second pass (Sec. 9: 10, rings 20)"),
        doc("color_k", K, "k_c of FIRST, SECOND and the second pass (Algorithm 1)"),
        doc("feature_k", K, "k_f of the candidates (Algorithm 1)"),
        doc("features", "up to 10 names", "features in use where the frame has them; [] for none (Sec. 5)"),
        doc("prefilter", "true | false", "filter features before use (Fig. 3)"),
        doc("prefilter_k", K, "k_c of the features' own filter (Algorithm 1)"),
        doc("prefilter_window_radius_px", RADIUS, "window of the features' own filter (Algorithm 1)"),
        doc("prefilter_patch_radius_px", PATCH, "patch of the features' own filter (Algorithm 1)"),
        doc(
            "variance_scaling",
            "auto | always | never",
            "sample variance to the level of the two-buffer variance (Sec. 4)",
        ),
        doc("neighbors", "0 to 8", "frames on each side that the candidates' window takes in (Sec. 8)"),
        doc(
            "gradient",
            "null | min-half | central | off",
            "slope that feature differences are measured against (Fig. 4)",
        ),
        doc(
            "depth_range",
            "null | largest | common",
            "what counts as 1 of depth: largest value or 99th percentile",
        ),
        doc("feature_denominator", "null | centre | pair", "whose variance and gradient divide Φ² (Eq. 6)"),
        doc("center_weight", "null | one | largest-neighbor", "weight of a pixel in its own mean"),
        doc("derivative", "null | exact | joint", "finite difference in SURE (Sec. 6)"),
        doc("ties", "null | earlier | later", "SECOND or THIRD where their estimates are equal"),
        doc("second_pass", "null | text | code | off", "filter after the combination (Algorithm 1)"),
        doc(
            "second_pass_denominator",
            "null | pair | twice-centre",
            "whose variance divides differences of the colour there (Sec. 4)",
        ),
        doc(
            "map_patch_radius_px",
            "null | 0 to 3 px",
            "patch of the filters of estimates and maps (Algorithm 1)",
        ),
        doc("density", "null | text | code | effective", "what sampling densities are made of (Sec. 8)"),
    ];

    pub(crate) fn validate(&self) -> Result<(), &'static str> {
        let k = |v: f64| (1e-3..=1e3).contains(&v);
        let checks = [
            ("window_radius_px", self.window_radius_px <= MAX_WINDOW_RADIUS),
            ("color_k", k(self.color_k)),
            ("feature_k", k(self.feature_k)),
            ("features", self.features.len() <= MAX_FEATURES),
            ("prefilter_k", k(self.prefilter_k)),
            ("prefilter_window_radius_px", self.prefilter_window_radius_px <= MAX_WINDOW_RADIUS),
            ("prefilter_patch_radius_px", self.prefilter_patch_radius_px <= MAX_PATCH_RADIUS),
            ("neighbors", self.neighbors <= MAX_NEIGHBORS),
            ("map_patch_radius_px", self.map_patch_radius_px.unwrap_or(0) <= MAX_PATCH_RADIUS),
        ];
        match checks.iter().find(|(_, ok)| !ok) {
            Some((name, _)) => Err(name),
            None => Ok(()),
        }
    }
}
