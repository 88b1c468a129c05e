use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// How samples are placed over a pixel and weighted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PixelFilter {
    /// Uniform over the pixel's square.
    Box,
    /// Every camera ray goes through the pixel's centre: no anti-aliasing.
    Point,
}

impl PixelFilter {
    /// Name on disk.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Box => "box",
            Self::Point => "point",
        }
    }

    /// Inverse of [`PixelFilter::name`].
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        [Self::Box, Self::Point].into_iter().find(|f| f.name() == name)
    }
}

/// Where the camera stood.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Camera {
    /// Camera-to-world matrix, row-major, right-handed, looking along −Z with +Y up; last row 0 0 0 1.
    pub camera_to_world: [[f32; 4]; 4],
    /// Full vertical field of view in degrees, in (0, 180).
    pub vertical_fov_degrees: f32,
}

/// Where a frame came from; every field is optional because other programs' files know less.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Provenance {
    /// Scene id or title.
    pub scene: Option<String>,
    /// Program and version that rendered it.
    pub renderer: Option<String>,
    /// Light transport algorithm and its settings, such as `path depth=6`.
    pub integrator: Option<String>,
    /// Sample sequence, such as `independent` or `owen-sobol`.
    pub sampler: Option<String>,
    /// Random seed.
    pub seed: Option<u64>,
    /// Film filter.
    pub filter: Option<PixelFilter>,
    /// Camera.
    pub camera: Option<Camera>,
    /// Wall-clock seconds spent rendering.
    pub render_seconds: Option<f64>,
    /// Threads that rendered it.
    pub render_threads: Option<u32>,
    /// Anything else worth keeping, by name.
    pub extra: BTreeMap<String, String>,
}
