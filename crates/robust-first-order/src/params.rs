use noisefloor_denoiser::{choices, parameters};
use noisefloor_kernels::joint_nlm;
use noisefloor_kernels::regression::models;

choices! {
    /// What distances of the prefiltered colour are measured against (Sec. 3.3).
    pub enum VarianceKind {
        /// Its own: the squared half difference of both prefiltered half buffers, smoothed.
        Residual = "residual",
        /// That of the noisy colour, larger by what the prefilter takes away.
        Raw = "raw",
    }
}

choices! {
    /// How errors of the pixels of a window become one number for each k (Eq. 10).
    pub enum KSum {
        /// Σ_j w(i,j)·err(j,k): smaller weights make smaller sums, which favours small k.
        AsWritten = "as-written",
        /// Over Σ_j w(i,j).
        Divided = "divided",
    }
}

choices! {
    /// What error is added up (Eq. 10).
    pub enum ErrorKind {
        /// err/(m² + 0.01·mean(M)²) with the pixel's mean m of the channels of M, so that no bright pixel rules the sum.
        Relative = "relative",
        /// err, as printed.
        Absolute = "absolute",
    }
}

choices! {
    /// Which y_1 the second step of the error estimate starts from (Eq. 11).
    pub enum Assembled {
        /// The image that all models make, one for each k.
        Image = "image",
        /// The image that all models make with the k that the first step chooses.
        One = "one",
        /// What the model itself made: without ridge its bias is then 0.
        Local = "local",
    }
}

choices! {
    /// What is fitted (Eq. 1).
    pub enum Fit {
        /// The noisy colour.
        Noisy = "noisy",
        /// The prefiltered colour.
        Prefiltered = "prefiltered",
    }
}

choices! {
    /// How the colour is prefiltered before weights are made from it (Sec. 3.3).
    pub enum ColorPrefilter {
        /// By guided filters, one for each feature channel, of which the mean is taken.
        Guided = "guided",
        /// By a Gaussian.
        Gaussian = "gaussian",
        /// Not at all.
        None = "none",
    }
}

choices! {
    /// How features are prefiltered (Sec. 3.2).
    pub enum FeaturePrefilter {
        /// By joint non-local means, then by a guided filter.
        Both = "both",
        /// By joint non-local means alone.
        Nlm = "nlm",
        /// Not at all.
        None = "none",
    }
}

choices! {
    /// Centres that a tile begins with (Sec. 3.5).
    pub enum Tiling {
        /// One large window in a plain tile; as many small ones as fill a detailed tile: 3×3.
        ThreeByThree = "three-by-three",
        /// One window, large in a plain tile and small in a detailed one, as printed.
        Literal = "literal",
        /// Every tile is detailed.
        AllDetail = "all-detail",
        /// Windows of the growth radius, one in 8×8 pixels.
        Dense = "dense",
    }
}

parameters! {
    /// Parameters of `robust-first-order`.
    pub struct Params {
        /// Least weight of a pixel that a model predicts; 0: all of the window, as printed, which fails.
        coverage: f64 = 0.1, number(0.0..=1.0).symbol("θ").section("Sec. 3.5");
        /// What distances of the prefiltered colour are measured against.
        variance: VarianceKind = VarianceKind::Residual, choice::<VarianceKind>().symbol("var").section("Sec. 3.3");
        /// Standard deviation of the Gaussian that smooths the residual variance, 0 for none.
        residual_blur_px: f64 = 2.0, number(0.0..=16.0).unit("px");
        /// Window radius of the guided filters of the colour.
        color_guided_radius_px: usize = 2, integer(0..=64).unit("px").symbol("N_i").section("Eq. 6, Eq. 8");
        /// Window radius of the guided filters of the features.
        feature_guided_radius_px: usize = 2, integer(0..=64).unit("px").symbol("N_i").section("Eq. 6, Eq. 7");
        /// Regularisation of the guided filters, in squared units of features.
        guided_epsilon: f64 = 1e-3, number(0.0..=1e6).symbol("ε").section("Sec. 3.2");
        /// Whether errors are added up or averaged over a window.
        k_sum: KSum = KSum::AsWritten, choice::<KSum>().section("Eq. 10");
        /// Whether errors count relative to the brightness.
        error: ErrorKind = ErrorKind::Relative, choice::<ErrorKind>().section("Eq. 10");
        /// Which image the second step of the error estimate starts from.
        assembled: Assembled = Assembled::Image, choice::<Assembled>().symbol("y_1").section("Eq. 11");
        /// Steps of the error estimate.
        iterations: usize = 2, integer(1..=3).symbol("T").section("Sec. 3.4");
        /// Penalty of slopes over the sum of weights; 0: none, and small eigenvalues are cut.
        ridge: f64 = 1e-3, number(0.0..=1e3);
        /// What is fitted.
        fit: Fit = Fit::Noisy, choice::<Fit>().symbol("Y").section("Eq. 2");
        /// How the colour is prefiltered.
        color_prefilter: ColorPrefilter = ColorPrefilter::Guided, choice::<ColorPrefilter>().symbol("M").section("Eq. 8");
        /// Standard deviation of the Gaussian that may prefilter the colour.
        gaussian_px: f64 = 0.8, number(0.0..=16.0).unit("px").section("Sec. 3.3");
        /// How features are prefiltered.
        feature_prefilter: FeaturePrefilter = FeaturePrefilter::Both, choice::<FeaturePrefilter>().section("Eq. 7");
        /// Whether models see features, or positions alone.
        features_in_model: bool = true, flag().symbol("x_i").section("Eq. 1");
        /// What the bandwidths 1, 1.5, 2, 3.5 and 4 are multiplied by.
        k_scale: f64 = 1.0, number(0.01..=100.0).section("Sec. 4");
        /// One bandwidth for all models, in place of a choice.
        fixed_k: Option<f64> = None, number(0.01..=100.0).or_null().symbol("k");
        /// Centres that a tile begins with.
        tiling: Tiling = Tiling::ThreeByThree, choice::<Tiling>().section("Sec. 3.5");
        /// Gradient of a prefiltered feature above which a pixel is detail.
        edge: f64 = 0.1, number(0.0..=10.0).symbol("gra").section("Eq. 14");
        /// Share of detail above which a tile is detailed.
        edge_share: f64 = 0.4, number(0.0..=1.0).symbol("τ").section("Sec. 4");
        /// Radius of small windows.
        small_radius_px: usize = 5, integer(1..=models::MAX_RADIUS).unit("px").symbol("r_s").section("Sec. 4");
        /// Radius of windows around pixels that no other covers.
        growth_radius_px: usize = 10, integer(1..=models::MAX_RADIUS).unit("px").symbol("r_m").section("Sec. 4");
        /// Radius of large windows and of tiles.
        large_radius_px: usize = 15, integer(1..=models::MAX_RADIUS).unit("px").symbol("r_l").section("Sec. 4");
        /// Patch radius of all distances.
        patch_radius_px: usize = 3, integer(0..=models::MAX_PATCH_RADIUS).unit("px").symbol("r").section("Sec. 4");
        /// Window radius of the features' non-local means.
        prefilter_window_radius_px: usize = 5, integer(0..=joint_nlm::MAX_WINDOW_RADIUS).unit("px").section("Eq. 7");
        /// k of the features' non-local means.
        prefilter_k: f64 = 0.25, number(0.001..=1000.0).symbol("k").section("Eq. 7");
        /// Spatial σ of the features' non-local means.
        spatial_sigma_px: f64 = 2.0, number(0.01..=1000.0).unit("px").symbol("σ_s").section("Sec. 3.2");
        /// σ of patch distances, of features and colour.
        range_sigma: f64 = 1.0, number(0.01..=100.0).symbol("σ_r").section("Sec. 3.2");
        /// σ of normals.
        normal_sigma: f64 = 0.8, number(0.001..=1000.0).symbol("σ_m").section("Sec. 3.2");
        /// σ of albedos.
        albedo_sigma: f64 = 0.25, number(0.001..=1000.0).symbol("σ_m").section("Sec. 3.2");
        /// σ of depths over the largest.
        depth_sigma: f64 = 0.6, number(0.001..=1000.0).symbol("σ_m").section("Sec. 3.2");
    }
}
