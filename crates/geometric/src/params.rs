use noisefloor_denoiser::ParamDoc;
use serde::{Deserialize, Serialize};

use crate::recurrence::Recurrence;

/// Largest kernel radius that a parameter may ask for, in pixels: the cost grows with its square.
pub const LARGEST_RADIUS_PX: f64 = 64.0;

/// What the source work's word "variance" stands for: the quantity v̂ that sets the kernel radius R = m·v̂.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Spread {
    /// Trace of the covariance of one sample, as on the slides. Depends on the exposure and does not shrink with more
    /// samples, so the bias stays.
    SampleVariance,
    /// s₀·√(trace of the covariance of the mean): shrinks like n^(−1/2), depends on the exposure.
    StdOfMean,
    /// s₀·√(trace)/(L + floor) with L the pixel's luminance: shrinks like n^(−1/2), whatever the exposure.
    Relative,
}

/// What tells one material from another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Material {
    /// Equal material ids, as on the slides. A pixel that an edge crosses has the id of its first sample: averaged samples of
    /// a lamp and its ceiling then spread over one of the two.
    Ids,
    /// Like albedo. A pixel that an edge crosses is like neither side.
    Albedo,
    /// Nothing: a lamp then bleeds over the surface that it is part of.
    Off,
}

/// What the luminance floor of [`Spread::Relative`] is a multiple of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FloorUnit {
    /// The median luminance of the frame's pixels that are not black: whatever the exposure.
    Median,
    /// Unit radiance: the result depends on the exposure.
    Radiance,
}

/// Parameters of `geometric-corrected`. The defaults are ours where the slides give no value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CorrectedParams {
    /// v̂: see [`Spread`].
    pub spread: Spread,
    /// Which estimate of the variance the frame's unbiased one is turned into (by expected value) before use.
    pub variance_form: Recurrence,
    /// m, kernel radius per v̂; the slides say 2.0.
    pub multiplier: f64,
    /// s₀, pixels per unit of (relative) standard error; not used by `sample-variance`. Chosen by us, see
    /// the crate's README: with m = 2, a relative standard error of 50 % gives a radius of 5 pixels, one of 10 % none.
    pub pixels_per_error: f64,
    /// Added to the luminance under `relative`, so that black pixels divide by it; in units of `floor_unit`.
    pub luminance_floor: f64,
    /// See [`FloorUnit`].
    pub floor_unit: FloorUnit,
    /// Radius cap in pixels.
    pub radius_max_px: f64,
    /// What a neighbour of the same material has in common: see [`Material`].
    pub material: Material,
    /// T_a, largest difference of albedo in a channel, as a fraction of the largest channel of both pixels.
    pub albedo_threshold: f64,
    /// Whether depths are compared.
    pub depth_test: bool,
    /// T_z, largest depth difference as a fraction of the larger depth.
    pub depth_threshold: f64,
    /// Whether normals are compared.
    pub normal_test: bool,
    /// T_n, smallest cosine between the two unit normals.
    pub normal_threshold: f64,
}

impl Default for CorrectedParams {
    fn default() -> Self {
        Self {
            spread: Spread::Relative,
            variance_form: Recurrence::Unbiased,
            multiplier: 2.0,
            pixels_per_error: 5.0,
            luminance_floor: 0.1,
            floor_unit: FloorUnit::Median,
            radius_max_px: 16.0,
            material: Material::Albedo,
            albedo_threshold: 0.1,
            depth_test: true,
            depth_threshold: 0.02,
            normal_test: true,
            normal_threshold: 0.9,
        }
    }
}

impl CorrectedParams {
    /// The parameter table: names are the fields of the struct.
    pub const DOCS: &'static [ParamDoc] = &[
        ParamDoc {
            name: "spread",
            range: "sample-variance | std-of-mean | relative",
            about: "v̂: what the slides' \"variance\" is taken for; the kernel radius is multiplier·v̂",
        },
        ParamDoc { name: "variance_form", range: Recurrence::RANGE, about: Recurrence::ABOUT },
        ParamDoc { name: "multiplier", range: "0 to 1000", about: "m: kernel radius per v̂ (slides: 2.0)" },
        ParamDoc {
            name: "pixels_per_error",
            range: "0 to 10000 px",
            about: "s₀: pixels per unit of (relative) standard error; unused by sample-variance",
        },
        ParamDoc {
            name: "luminance_floor",
            range: "above 0",
            about: "added to the luminance that relative divides by, in units of floor_unit",
        },
        ParamDoc {
            name: "floor_unit",
            range: "median | radiance",
            about: "the frame's median luminance, or radiance: then the result depends on exposure",
        },
        ParamDoc { name: "radius_max_px", range: "0 to 64 px", about: "R_max: cap of the kernel radius" },
        ParamDoc {
            name: "material",
            range: "ids | albedo | off",
            about: "what tells materials apart: ids as on the slides, or albedo; off lets lamps bleed",
        },
        ParamDoc {
            name: "albedo_threshold",
            range: "0 to 1",
            about: "T_a: largest difference of albedo in a channel, as a fraction of the largest channel of both",
        },
        ParamDoc { name: "depth_test", range: "true | false", about: "compare depths" },
        ParamDoc {
            name: "depth_threshold",
            range: "0 or more",
            about: "T_z: largest depth difference, as a fraction of the larger depth",
        },
        ParamDoc { name: "normal_test", range: "true | false", about: "compare normals" },
        ParamDoc {
            name: "normal_threshold",
            range: "-1 to 1",
            about: "T_n: smallest cosine between unit normals",
        },
    ];

    pub(crate) fn validate(&self) -> Result<(), &'static str> {
        let checks = [
            ("multiplier", (0.0..=1000.0).contains(&self.multiplier)),
            ("pixels_per_error", (0.0..=10_000.0).contains(&self.pixels_per_error)),
            ("luminance_floor", self.luminance_floor > 0.0 && self.luminance_floor.is_finite()),
            ("radius_max_px", (0.0..=LARGEST_RADIUS_PX).contains(&self.radius_max_px)),
            ("albedo_threshold", (0.0..=1.0).contains(&self.albedo_threshold)),
            ("depth_threshold", self.depth_threshold >= 0.0 && self.depth_threshold.is_finite()),
            ("normal_threshold", (-1.0..=1.0).contains(&self.normal_threshold)),
        ];
        first_failure(&checks)
    }
}

/// Parameters of `geometric-as-written`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct AsWrittenParams {
    /// Which estimate of the sample variance the frame's unbiased one is turned into; the slides define the
    /// population variance.
    pub variance_form: Recurrence,
    /// Kernel radius per variance of one sample; the slides say 2.0.
    pub multiplier: f64,
    /// Radius cap in pixels. Not on the slides: without it one firefly visits the whole image.
    pub radius_max_px: f64,
    /// Whether the loop over neighbours visits the pixel itself, with weight 1/R.
    pub visits_center: bool,
    /// Whether a neighbour must have the same material id.
    pub material_ids: bool,
    /// Whether depths are compared.
    pub depth_test: bool,
    /// Largest depth difference in scene units.
    pub depth_threshold: f64,
    /// Whether normals are compared.
    pub normal_test: bool,
    /// A neighbour is skipped if the cosine is above this: the similar normals are.
    pub normal_threshold: f64,
}

impl Default for AsWrittenParams {
    fn default() -> Self {
        Self {
            variance_form: Recurrence::Population,
            multiplier: 2.0,
            radius_max_px: 16.0,
            visits_center: true,
            material_ids: true,
            depth_test: true,
            depth_threshold: 0.1,
            normal_test: true,
            normal_threshold: 0.9,
        }
    }
}

impl AsWrittenParams {
    /// The parameter table: names are the fields of the struct.
    pub const DOCS: &'static [ParamDoc] = &[
        ParamDoc { name: "variance_form", range: Recurrence::RANGE, about: Recurrence::ABOUT },
        ParamDoc {
            name: "multiplier",
            range: "0 to 1000",
            about: "kernel radius per variance of one sample (slides: 2.0)",
        },
        ParamDoc {
            name: "radius_max_px",
            range: "0 to 64 px",
            about: "cap of the kernel radius, not on the slides",
        },
        ParamDoc {
            name: "visits_center",
            range: "true | false",
            about: "whether the neighbour loop visits the pixel itself",
        },
        ParamDoc { name: "material_ids", range: "true | false", about: "compare material ids" },
        ParamDoc { name: "depth_test", range: "true | false", about: "compare depths" },
        ParamDoc {
            name: "depth_threshold",
            range: "0 or more, scene units",
            about: "largest depth difference (no value on the slides)",
        },
        ParamDoc { name: "normal_test", range: "true | false", about: "compare normals" },
        ParamDoc {
            name: "normal_threshold",
            range: "-1 to 1",
            about: "skip neighbours whose cosine is above this (no value on the slides)",
        },
    ];

    pub(crate) fn validate(&self) -> Result<(), &'static str> {
        let checks = [
            ("multiplier", (0.0..=1000.0).contains(&self.multiplier)),
            ("radius_max_px", (0.0..=LARGEST_RADIUS_PX).contains(&self.radius_max_px)),
            ("depth_threshold", self.depth_threshold >= 0.0 && self.depth_threshold.is_finite()),
            ("normal_threshold", (-1.0..=1.0).contains(&self.normal_threshold)),
        ];
        first_failure(&checks)
    }
}

fn first_failure(checks: &[(&'static str, bool)]) -> Result<(), &'static str> {
    checks.iter().find(|(_, ok)| !ok).map_or(Ok(()), |&(name, _)| Err(name))
}
