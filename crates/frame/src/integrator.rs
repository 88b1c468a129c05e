use serde::{Deserialize, Serialize};

/// How light is carried to the eye.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Integrator {
    /// Path tracing: unbiased.
    #[default]
    PathTracing,
    /// Photon mapping (Jensen 1996): specular and glossy surfaces are followed from the eye to the first diffuse one.
    /// Direct light there is sampled as in path tracing; caustics are looked up in the caustic map; the rest is
    /// gathered by one ray per sample from the global map. Biased by the radii of the looks, and where interpolated
    /// normals send light other ways than they bring it to the eye: a percent or less on fine meshes, more on coarse
    /// ones. All samples of an image share the error of its maps: the variance between samples does not know it.
    PhotonMapping,
}

impl Integrator {
    /// Name in study files, on the command line and in frames.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::PathTracing => "path-tracing",
            Self::PhotonMapping => "photon-mapping",
        }
    }

    /// Inverse of [`Integrator::name`].
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        [Self::PathTracing, Self::PhotonMapping].into_iter().find(|i| i.name() == name)
    }
}
