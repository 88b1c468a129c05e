use serde::{Deserialize, Serialize};

/// Which point along a path the features belong to (albedo, normal, depth, visibility, direct light, material).
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FeatureHit {
    /// Where the camera ray first hits.
    #[default]
    First,
    /// The first hit that is not perfectly specular: mirrors and smooth glass are followed. Albedo is multiplied by the
    /// tint of the mirrors on the way, depth is the length of the way, the normal is that of the surface itself, and
    /// direct light is the emission seen there plus light scattered once there. Background behind specular surfaces
    /// counts as background; where the path ends before, the last specular hit counts. Motion and caustic density are
    /// those of the point itself, as if it were seen directly. Not for scenes with a medium.
    ThroughSpecular,
}

impl FeatureHit {
    /// Name in study files, on the command line and in frames.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::First => "first",
            Self::ThroughSpecular => "through-specular",
        }
    }
}
