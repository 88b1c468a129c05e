use noisefloor_denoiser::{choices, parameters};
use noisefloor_kernels::nlm::{MAX_PATCH_RADIUS, MAX_WINDOW_RADIUS};

choices! {
    /// Whose choices hold where the printed text and the authors' program differ.
    pub enum Profile {
        /// The printed text, with its misprint in Alg. 1, line 21 mended.
        Paper = "paper",
        /// The authors' program.
        Authors = "authors",
        /// What wins by measurement: each choice with its figure in the crate's documentation.
        Best = "best",
    }
}

choices! {
    /// Squared slope of a feature that differences are measured against (Sec. 5).
    pub enum Gradient {
        /// Per axis the smaller of both one-sided half-pixel differences, 0 on the border: the program's rule.
        MinHalf = "min-half",
        /// Per axis half the difference of both neighbours, one-sided on the border.
        Central = "central",
        /// None: feature weights along edges are as strict as elsewhere (Fig. 4).
        Off = "off",
    }
}

choices! {
    /// Which pixels' variance and gradient Φ² is divided by (Sec. 5, above Eq. 3).
    pub enum FeatureDenominator {
        /// The centre's alone, as printed.
        Centre = "centre",
        /// The sum of both pixels', as programmed: twice as tolerant.
        Pair = "pair",
    }
}

choices! {
    /// Weight of a pixel in its own mean (Eq. 1).
    pub enum CenterWeight {
        /// 1, as Eq. 2 and Eq. 3 give.
        One = "one",
        /// The largest of its neighbours' weights, at least 1e-3.
        LargestNeighbor = "largest-neighbor",
    }
}

choices! {
    /// How the derivative in SURE is taken (Sec. 6, below Eq. 5).
    pub enum DerivativeRule {
        /// Each channel alone, in the pixel's own patch and in its neighbours'.
        Exact = "exact",
        /// All channels at once, in the pixel's own patch.
        Joint = "joint",
    }
}

choices! {
    /// What differences of the colour are divided by in the second pass, beside ε.
    pub enum ColorDenominator {
        /// k_c²·(v(p) + v(q)), as printed (Sec. 4): a bright pixel that the combination has left, whose variance is as large as itself,
        /// is averaged into all pixels around it.
        Pair = "pair",
        /// 2·k_c²·v(p), as programmed: the pixel alone says what is noise to it.
        TwiceCentre = "twice-centre",
    }
}

choices! {
    /// What a window sees beyond the image.
    pub enum WindowBorder {
        /// Nothing: it is cut there.
        Clipped = "clipped",
        /// The mirrored pixels, as programmed: a pixel near the border may meet itself.
        Mirrored = "mirrored",
    }
}

choices! {
    /// What the patch around a pixel sees beyond the image.
    pub enum PatchTaps {
        /// The mirrored pixels.
        Mirrored = "mirrored",
        /// Nothing, as programmed: the mean is over the taps that remain.
        Clipped = "clipped",
    }
}

choices! {
    /// What counts as 1 of depth, and of other features without a limit of their own.
    pub enum DepthRange {
        /// The largest magnitude of the image, as printed.
        Largest = "largest",
        /// The 99th percentile; what is beyond is cut.
        Common = "common",
    }
}

choices! {
    /// What sampling densities are made of (Sec. 8).
    pub enum Density {
        /// The combination's estimate times Σ w/(1 + Σ w·n), filtered by the colour, then clamped at 0.
        Text = "text",
        /// FIRST's estimate, clamped at 0, filtered by colour and features, over FIRST's Σ w·n. Where no neighbour is similar the
        /// pixel's own weight may be 10⁻³ ([`CenterWeight::LargestNeighbor`]), and a clean pixel then asks for a thousand times
        /// what it needs.
        Code = "code",
        /// As [`Density::Code`], over the samples that count as much as the pixel's own, Σ w·n/w(p,p): the same whatever the
        /// scale of the weights.
        Effective = "effective",
    }
}

choices! {
    /// Which of SECOND and THIRD a pixel of equal error estimates gets; neither by the letter of Alg. 1, line 20 and line 21.
    pub enum Ties {
        /// SECOND.
        Earlier = "earlier",
        /// THIRD.
        Later = "later",
        /// THIRD, and FIRST may have SECOND's derivative too: the program's comparisons.
        Program = "program",
    }
}

choices! {
    /// The pass that removes what the combination leaves (Alg. 1, lines 27-29).
    pub enum SecondPass {
        /// Colour alone, patch radius 1, the full window (Alg. 1, line 27).
        Text = "text",
        /// Colour and features, patch radius 3, half the window.
        Code = "code",
        /// None.
        Off = "off",
    }
}

choices! {
    /// Whether the sample variance is scaled to the level of the two-buffer variance (Sec. 4).
    pub enum VarianceScaling {
        /// For low-discrepancy frames; with independent samples the sample variance is right as it is.
        Auto = "auto",
        /// Always.
        Always = "always",
        /// Never.
        Never = "never",
    }
}

/// Most frames on each side; ours, for the time that it takes.
const MAX_NEIGHBORS: usize = 8;
/// Most features in use; ours: of three channels each they are within the engine's limit.
const MAX_FEATURES: usize = 10;

parameters! {
    /// Parameters of `rdfc` and of its candidates. `None` (null) means: as the profile says.
    pub struct Params {
        /// Printed text, authors' program, or what wins, where they differ.
        profile: Profile = Profile::Best, choice::<Profile>();
        // R of the input to Alg. 1; 10 in Sec. 9, and the scenes that had 20.
        /// Radius of the window of the candidates and the second pass (20 for rings, conference, fog).
        window_radius_px: usize = 10, integer(0..=MAX_WINDOW_RADIUS).unit("px").symbol("R").section("Sec. 9");
        // 0.45: Alg. 1, line 9, Alg. 1, line 11 and Alg. 1, line 27. THIRD has ∞: Alg. 1, line 13.
        /// Colour sensitivity of FIRST, SECOND and the second pass.
        color_k: f64 = 0.45, number(0.001..=1000.0).symbol("k_c").section("Alg. 1");
        // 0.6: Alg. 1, line 9, Alg. 1, line 11 and Alg. 1, line 13.
        /// Feature sensitivity of the candidates.
        feature_k: f64 = 0.6, number(0.001..=1000.0).symbol("k_f").section("Alg. 1");
        /// Features in use, by name, where the frame has them.
        features: Vec<String> = ["albedo", "normal", "depth", "visibility", "caustics"].map(String::from).to_vec(),
            names(MAX_FEATURES).symbol("f_j").section("Sec. 5");
        /// Whether features are filtered before use.
        prefilter: bool = true, flag().section("Sec. 5, Fig. 3");
        // k_c = 1, r = 5, f = 3: Sec. 5, and Alg. 1, line 5.
        /// k_c of the features' own filter.
        prefilter_k: f64 = 1.0, number(0.001..=1000.0).section("Alg. 1");
        /// Window radius of the features' own filter.
        prefilter_window_radius_px: usize = 5, integer(0..=MAX_WINDOW_RADIUS).unit("px").section("Alg. 1");
        /// Patch radius of the features' own filter.
        prefilter_patch_radius_px: usize = 3, integer(0..=MAX_PATCH_RADIUS).unit("px").section("Alg. 1");
        /// Whether sample variances are scaled to the level of the two-buffer variance.
        variance_scaling: VarianceScaling = VarianceScaling::Auto, choice::<VarianceScaling>().section("Sec. 4");
        /// Frames on each side that the candidates' window takes in.
        neighbors: usize = 0, integer(0..=MAX_NEIGHBORS).symbol("k").section("Sec. 8");
        /// Slope that feature differences are measured against.
        gradient: Option<Gradient> = None, choice::<Gradient>().or_null().section("Sec. 5, Fig. 4");
        /// What counts as 1 of depth: the largest value or the 99th percentile.
        depth_range: Option<DepthRange> = None, choice::<DepthRange>().or_null();
        /// Whose variance and gradient divide Φ².
        feature_denominator: Option<FeatureDenominator> = None, choice::<FeatureDenominator>().or_null().section("Sec. 5");
        /// Weight of a pixel in its own mean.
        center_weight: Option<CenterWeight> = None, choice::<CenterWeight>().or_null();
        /// Finite difference in SURE.
        derivative: Option<DerivativeRule> = None, choice::<DerivativeRule>().or_null().section("Sec. 6");
        /// SECOND or THIRD where their estimates are equal.
        ties: Option<Ties> = None, choice::<Ties>().or_null();
        /// Filter after the combination.
        second_pass: Option<SecondPass> = None, choice::<SecondPass>().or_null().section("Alg. 1, lines 27-29");
        /// Whose variance divides differences of the colour in the second pass.
        second_pass_denominator: Option<ColorDenominator> = None, choice::<ColorDenominator>().or_null().section("Sec. 4");
        /// Patch radius of the filters of error estimates and selection maps.
        map_patch_radius_px: Option<usize> = None, integer(0..=MAX_PATCH_RADIUS).unit("px").or_null().section("Alg. 1");
        /// Whether weights of the colour, and of features in their own filter, are smoothed over patch radius less 1; not the
        /// candidates'.
        weight_smoothing: Option<bool> = None, flag().or_null();
        /// Whether opposite neighbours share the weight of their mean.
        symmetric_pairs: Option<bool> = None, flag().or_null();
        /// What windows see beyond the image.
        window_border: Option<WindowBorder> = None, choice::<WindowBorder>().or_null();
        /// What the patch around a pixel sees beyond the image.
        patch_taps: Option<PatchTaps> = None, choice::<PatchTaps>().or_null();
        /// What sampling densities are made of.
        density: Option<Density> = None, choice::<Density>().or_null().section("Sec. 8");
    }
}
