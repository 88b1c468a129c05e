use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::{Integrator, Maps};

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

/// Rounds of samples, the first of them uniform, the others where they seemed to be needed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RoundsTaken {
    /// How many.
    pub count: u32,
    /// Seconds that the decisions took where to place samples.
    pub density_seconds: Option<f64>,
}

impl Provenance {
    /// Which photon maps carried the light, if any did. A photon-mapped frame that does not say it, because it was rendered
    /// alone and imported, counts as one whose maps the truth does not share.
    #[must_use]
    pub fn maps(&self) -> Option<Maps> {
        self.photon_maps.or_else(|| (self.light == Some(Integrator::PhotonMapping)).then_some(Maps::Fresh))
    }
}

/// Where a frame came from; every field is optional because other programs' files know less.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Provenance {
    /// Scene id or title.
    pub scene: Option<String>,
    /// Program and version that rendered it.
    pub renderer: Option<String>,
    /// Light transport algorithm and its settings, such as `path depth=6`; for people.
    pub integrator: Option<String>,
    /// The same, where it is one that this program knows.
    pub light: Option<Integrator>,
    /// Which photon maps carried the light, where the frame says it.
    pub photon_maps: Option<Maps>,
    /// How it was rendered in rounds, if samples were placed by what was seen.
    pub rounds: Option<RoundsTaken>,
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
