use noisefloor_denoiser::{choices, parameters};

use crate::recurrence::Recurrence;

/// Largest kernel radius that a parameter may ask for, in pixels: the cost grows with its square. Ours.
pub const LARGEST_RADIUS_PX: f64 = 64.0;

choices! {
    /// What the source work's word "variance" (Listing, line 3) stands for: the quantity v̂ that sets the kernel radius R = m·v̂.
    pub enum Spread {
        /// Trace of the covariance of one sample, as on the slides. Depends on the exposure and does not shrink with more
        /// samples, so the bias stays.
        SampleVariance = "sample-variance",
        /// s₀·√(trace of the covariance of the mean): shrinks like n^(−1/2), depends on the exposure.
        StdOfMean = "std-of-mean",
        /// s₀·√(trace)/(L + floor) with L the pixel's luminance: shrinks like n^(−1/2), whatever the exposure.
        Relative = "relative",
    }
}

choices! {
    /// What tells one material from another (Listing, lines 5-6).
    pub enum Material {
        /// Equal material ids, as on the slides. A pixel that an edge crosses has the id of its first sample: averaged samples of
        /// a lamp and its ceiling then spread over one of the two.
        Ids = "ids",
        /// Like albedo. A pixel that an edge crosses is like neither side.
        Albedo = "albedo",
        /// Nothing: a lamp then bleeds over the surface that it is part of.
        Off = "off",
    }
}

choices! {
    /// What the luminance floor of [`Spread::Relative`] is a multiple of.
    pub enum FloorUnit {
        /// The median luminance of the frame's pixels that are not black: whatever the exposure.
        Median = "median",
        /// Unit radiance: the result depends on the exposure.
        Radiance = "radiance",
    }
}

parameters! {
    /// Parameters of `geometric-corrected`. The defaults are ours where the slides give no value.
    pub struct CorrectedParams {
        /// What the slides' "variance" is taken for; the kernel radius is multiplier·v̂.
        spread: Spread = Spread::Relative, choice::<Spread>().symbol("v̂");
        /// Which running variance the frame's unbiased one is scaled to before use, by its expected value at n samples.
        variance_form: Recurrence = Recurrence::Unbiased, choice::<Recurrence>();
        /// Kernel radius per v̂ (slides: 2.0).
        multiplier: f64 = 2.0, number(0.0..=1000.0).symbol("m");
        /// Pixels per unit of (relative) standard error; unused by `sample-variance`. Chosen by us: with m = 2, a relative
        /// standard error of 50 % gives a radius of 5 pixels, one of 10 % one pixel.
        pixels_per_error: f64 = 5.0, number(0.0..=10_000.0).unit("px").symbol("s₀");
        /// Added to the luminance that `relative` divides by, so that black pixels have a quotient; in units of `floor_unit`
        /// (ours).
        luminance_floor: f64 = 0.1, above(0.0);
        /// The frame's median luminance, or radiance: then the result depends on exposure.
        floor_unit: FloorUnit = FloorUnit::Median, choice::<FloorUnit>();
        /// Cap of the kernel radius (ours).
        radius_max_px: f64 = 16.0, number(0.0..=LARGEST_RADIUS_PX).unit("px").symbol("R_max");
        /// What tells materials apart: ids as on the slides, or albedo; `off` lets lamps bleed.
        material: Material = Material::Albedo, choice::<Material>();
        /// Largest difference of albedo in a channel, as a fraction of the largest channel of both pixels (ours).
        albedo_threshold: f64 = 0.1, number(0.0..=1.0).symbol("T_a");
        /// Whether depths are compared.
        depth_test: bool = true, flag();
        /// Largest depth difference, as a fraction of the larger depth (value ours).
        depth_threshold: f64 = 0.02, number(0.0..).symbol("T_z");
        /// Whether normals are compared.
        normal_test: bool = true, flag();
        /// Smallest cosine between unit normals (value ours).
        normal_threshold: f64 = 0.9, number(-1.0..=1.0).symbol("T_n");
    }
}

parameters! {
    /// Parameters of `geometric-as-written`.
    pub struct AsWrittenParams {
        /// Which running variance the frame's unbiased one is scaled to before use, by its expected value at n samples; the
        /// slides define the population variance.
        variance_form: Recurrence = Recurrence::Population, choice::<Recurrence>();
        /// Kernel radius per variance of one sample (slides: 2.0).
        multiplier: f64 = 2.0, number(0.0..=1000.0);
        /// Cap of the kernel radius. Not on the slides: without it one firefly visits the whole image.
        radius_max_px: f64 = 16.0, number(0.0..=LARGEST_RADIUS_PX).unit("px");
        /// Whether the loop over neighbours visits the pixel itself, with weight 1/R.
        visits_center: bool = true, flag();
        /// Whether a neighbour must have the same material id.
        material_ids: bool = true, flag();
        /// Whether depths are compared.
        depth_test: bool = true, flag();
        /// Largest depth difference (no value on the slides).
        depth_threshold: f64 = 0.1, number(0.0..).unit("scene units");
        /// Whether normals are compared.
        normal_test: bool = true, flag();
        /// A neighbour is skipped if the cosine is above this: the similar normals are (no value on the slides).
        normal_threshold: f64 = 0.9, number(-1.0..=1.0);
    }
}
