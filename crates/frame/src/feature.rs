use std::fmt;

/// Declares [`FeatureId`] from one row for each feature with a fixed meaning: its name, and its channels in the order of
/// their planes.
macro_rules! features {
    ($($(#[$meaning:meta])* $id:ident $name:literal [$($channel:literal)*],)*) => {
        /// Which auxiliary quantity a per-pixel feature is.
        #[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[non_exhaustive]
        pub enum FeatureId {
            $($(#[$meaning])* $id,)*
            /// Anything else, by the name of its layer.
            Extra(String),
        }

        impl FeatureId {
            /// The features with a fixed meaning.
            pub const KNOWN: [Self; [$($name),*].len()] = [$(Self::$id),*];

            /// Layer name on disk and in messages.
            #[must_use]
            pub fn name(&self) -> &str {
                match self {
                    $(Self::$id => $name,)*
                    Self::Extra(name) => name,
                }
            }

            /// Channel names on disk, in plane order; `None` for extra features, whose file decides.
            #[must_use]
            pub fn channel_names(&self) -> Option<&'static [&'static str]> {
                Some(match self {
                    $(Self::$id => &[$($channel),*],)*
                    Self::Extra(_) => return None,
                })
            }
        }
    };
}

features! {
    /// Diffuse reflectance or specular tint at the hit, [0, 1], 3 channels.
    Albedo "albedo" ["R" "G" "B"],
    /// World-space shading normal facing the viewer, components in [−1, 1], 3 channels.
    Normal "normal" ["X" "Y" "Z"],
    /// Distance along the camera ray's direction of travel, scene units, 1 channel; background 0 in
    /// rendered frames (material id −1 tells it from a hit).
    Depth "depth" ["Z"],
    /// Shadow rays that reached a light over shadow rays traced at the first hit, 0 if none was, 1 channel.
    Visibility "visibility" ["Y"],
    /// Density of caustic photons, 1 channel.
    Caustics "caustics" ["Y"],
    /// Mean of the sampled BRDF weight, 3 channels.
    Brdf "brdf" ["R" "G" "B"],
    /// Direct light alone, 3 channels.
    Direct "direct" ["R" "G" "B"],
    /// Screen-space motion in pixels per frame, 2 channels.
    Motion "motion" ["X" "Y"],
    /// Material id of the first sample's first hit, a small non-negative integer, −1 for background, 1 channel.
    Material "material" ["Y"],
}

impl FeatureId {
    /// Inverse of [`FeatureId::name`]; unknown names become [`FeatureId::Extra`].
    #[must_use]
    pub fn from_name(name: &str) -> Self {
        Self::KNOWN
            .into_iter()
            .find(|known| known.name() == name)
            .unwrap_or_else(|| Self::Extra(name.to_owned()))
    }
}

impl fmt::Display for FeatureId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::FeatureId;

    #[test]
    fn names_round_trip() {
        for id in FeatureId::KNOWN {
            assert_eq!(FeatureId::from_name(id.name()), id);
            assert!(id.channel_names().is_some());
        }
        assert_eq!(FeatureId::from_name("curvature"), FeatureId::Extra("curvature".into()));
    }
}
