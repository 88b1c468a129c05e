use noisefloor_denoiser::{choices, parameters};
use noisefloor_kernels::regression::dense::{MAX_FEATURES, MAX_PATCH_RADIUS, MAX_WINDOW_RADIUS};

choices! {
    /// Whose choices hold where the pseudo-code and the program differ.
    pub enum Profile {
        /// The first author's program.
        Program = "program",
        /// The authors' pseudo-code.
        Paper = "paper",
        /// What wins by measurement.
        Best = "best",
    }
}

choices! {
    /// How the distances of red, green and blue become the one weight of a model.
    pub enum Channels {
        /// The smallest of the three weights.
        Minimum = "minimum",
        /// The weight of the mean distance.
        Mean = "mean",
    }
}

choices! {
    /// What becomes of features that do not vary in a window, or together.
    pub enum Solver {
        /// Their coefficient is 0, found by pivoting.
        Dropped = "dropped",
        /// Of all solutions the one of least norm, in units of each feature's range.
        MinimalNorm = "minimal-norm",
    }
}

choices! {
    /// The unit of depth, and where the background is.
    pub enum Depth {
        /// As the frame has it: scene units, 0 where the ray escapes.
        Raw = "raw",
        /// Over its largest value, 1.1 where the ray escapes.
        Scaled = "scaled",
    }
}

choices! {
    /// Estimates of squared errors that are negative, before they are filtered.
    pub enum NegativeError {
        /// Kept: the mean over a window is unbiased.
        Kept = "kept",
        /// 0.
        Clamped = "clamped",
    }
}

choices! {
    /// Which half weights come from.
    pub enum Guide {
        /// The one that is not filtered: weights and values are independent.
        OppositeHalf = "opposite-half",
        /// The one that is filtered.
        SameHalf = "same-half",
    }
}

choices! {
    /// The exposure at which ε is added.
    pub enum Exposure {
        /// The frame's own.
        AsIs = "as-is",
        /// One for all frames: a median luminance between ¼ and ½.
        Common = "common",
    }
}

choices! {
    /// Whether sample variances are scaled to the level of the two-buffer variance.
    pub enum VarianceScaling {
        /// For low-discrepancy frames.
        Auto = "auto",
        /// Always.
        Always = "always",
        /// Never.
        Never = "never",
    }
}

/// Most features in use; ours: of three channels each they are within the kernels' limit.
const MOST_FEATURES: usize = MAX_FEATURES / 3;

parameters! {
    /// Parameters of `nfor`. `None` (null) means: as the profile says.
    pub struct Params {
        /// The first author's program, the pseudo-code, or what wins, where they differ.
        profile: Profile = Profile::Program, choice::<Profile>();
        /// Features in use, by name, where the frame has them.
        features: Vec<String> = ["albedo", "normal", "depth"].map(String::from).to_vec(), names(MOST_FEATURES).symbol("f_j");
        /// Radius of the windows of models and of the filters of errors and selection.
        window_radius_px: usize = 9, integer(0..=MAX_WINDOW_RADIUS).unit("px").symbol("R");
        /// Patch radius of the models' weights.
        patch_radius_px: usize = 3, integer(0..=MAX_PATCH_RADIUS).unit("px").symbol("F");
        /// Damping of distances of the narrower candidate.
        narrow_k: f64 = 0.5, number(0.001..=1000.0).symbol("k");
        /// Damping of distances of the wider candidate.
        wide_k: f64 = 1.0, number(0.001..=1000.0).symbol("k");
        /// Damping of distances of the last regression.
        last_k: f64 = 1.0, number(0.001..=1000.0).symbol("k");
        /// Window radius of the features' own filter.
        feature_window_radius_px: usize = 5, integer(0..=MAX_WINDOW_RADIUS).unit("px");
        /// Patch radius of the features' own filter.
        feature_patch_radius_px: usize = 3, integer(0..=MAX_PATCH_RADIUS).unit("px");
        /// Damping of distances of both filters of features.
        feature_k: f64 = 0.5, number(0.001..=1000.0);
        /// Patch radius of the filters of errors and selection.
        map_patch_radius_px: usize = 1, integer(0..=MAX_PATCH_RADIUS).unit("px");
        /// Damping of distances of the filters of errors and selection.
        map_k: f64 = 1.0, number(0.001..=1000.0);
        /// How the channels' distances become the weight of a model.
        channels: Option<Channels> = None, choice::<Channels>().or_null();
        /// What becomes of features that do not vary, or together.
        solver: Option<Solver> = None, choice::<Solver>().or_null();
        /// Unit of depth, and where the background is.
        depth: Option<Depth> = None, choice::<Depth>().or_null();
        /// What becomes of negative error estimates before they are filtered.
        negative_error: Option<NegativeError> = None, choice::<NegativeError>().or_null();
        /// Which half the weights of the candidates come from.
        guide: Option<Guide> = None, choice::<Guide>().or_null();
        /// Which half the weights of the features' own filter come from.
        feature_guide: Option<Guide> = None, choice::<Guide>().or_null();
        /// Window radius of the second filter of features.
        last_feature_window_radius_px: Option<usize> = None, integer(0..=MAX_WINDOW_RADIUS).unit("px").or_null();
        /// Patch radius of the second filter of features.
        last_feature_patch_radius_px: Option<usize> = None, integer(0..=MAX_PATCH_RADIUS).unit("px").or_null();
        /// Factor on variances in the last regression.
        last_variance_factor: Option<f64> = None, number(0.001..=1000.0).or_null();
        /// Whether models have columns for x and y.
        positions: Option<bool> = None, flag().or_null();
        /// Exposure at which ε is added.
        exposure: Option<Exposure> = None, choice::<Exposure>().or_null();
        /// Whether sample variances are scaled to the level of the two-buffer variance.
        variance_scaling: Option<VarianceScaling> = None, choice::<VarianceScaling>().or_null();
    }
}
