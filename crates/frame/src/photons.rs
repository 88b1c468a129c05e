//! Photon maps as settings: how many photons, looked at how widely, shared by which frames.

use serde::{Deserialize, Serialize};

/// What makes a pair of photon maps.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct PhotonSettings {
    /// Light paths for the global map, in 1..=2^26.
    pub paths: u32,
    /// Light paths for the caustic map, in 1..=2^26.
    pub caustic_paths: u32,
    /// Radius of a look at the global map as a fraction of the scene's radius, in [1e-6, 1].
    pub radius: f32,
    /// Radius of a look at the caustic map in pixels, as wide as they are where they meet the surface; in [1e-6, 1000].
    pub caustic_pixels: f32,
    /// The largest radius of a look at the caustic map as a fraction of the scene's radius, in [1e-6, 1].
    pub caustic_radius: f32,
}

impl Default for PhotonSettings {
    fn default() -> Self {
        Self {
            paths: 200_000,
            caustic_paths: 1_000_000,
            radius: 0.02,
            caustic_pixels: 2.0,
            caustic_radius: 0.02,
        }
    }
}

impl PhotonSettings {
    /// All three radii times `factor`.
    #[must_use]
    pub fn scaled(self, factor: f32) -> Self {
        Self {
            radius: self.radius * factor,
            caustic_pixels: self.caustic_pixels * factor,
            caustic_radius: self.caustic_radius * factor,
            ..self
        }
    }
}

/// Which photon maps the frames of a scene get.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Maps {
    /// One pair for all frames and for the reference: what the frames estimate is the image that these maps give, so
    /// intervals and bounds can hold.
    #[default]
    Fixed,
    /// A new pair for each replicate, and a path-traced reference: errors are against the true image. The variance
    /// between the samples of a frame does not know the error of its maps, so intervals and bounds are void.
    Fresh,
}

impl Maps {
    /// Name in study files, records and frames.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Fixed => "fixed",
            Self::Fresh => "fresh",
        }
    }

    /// Inverse of [`Maps::name`].
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        [Self::Fixed, Self::Fresh].into_iter().find(|maps| maps.name() == name)
    }
}
