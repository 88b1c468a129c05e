use std::collections::BTreeMap;

use noisefloor_frame::FeatureId;
use noisefloor_scenes::{Scattering, Scene};
use serde::{Deserialize, Serialize};

/// Declares [`Quantity`] from one row for each.
macro_rules! quantities {
    ($($(#[$meaning:meta])* $id:ident $name:literal,)*) => {
        /// What can be recorded beside the colour, which always comes with variance and halves. Features belong to the
        /// first hit, or to where [`crate::FeatureHit`] says.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
        #[serde(rename_all = "kebab-case")]
        #[non_exhaustive]
        pub enum Quantity {
            $($(#[$meaning])* $id,)*
        }

        impl Quantity {
            /// All of them.
            pub const ALL: [Self; [$($name),*].len()] = [$(Self::$id),*];

            /// Name in study files and on the command line: that of the feature it becomes.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$id => $name,)*
                }
            }
        }
    };
}

quantities! {
    /// [`FeatureId::Albedo`]: diffuse reflectance, mirror reflectance, conductor reflectance at normal incidence, 1 for
    /// glass, 0 for background.
    Albedo "albedo",
    /// [`FeatureId::Normal`]: shading normal in world space, turned to the viewer, 0 for background.
    Normal "normal",
    /// [`FeatureId::Depth`]: distance from the ray's origin to the first hit, 0 for background.
    Depth "depth",
    /// [`FeatureId::Visibility`]: shadow rays from the first hit that reached their light over shadow rays traced, 0 if
    /// none was (background, perfectly specular, light below the horizon).
    Visibility "visibility",
    /// [`FeatureId::Direct`]: emission seen directly plus light scattered once; the colour at path depth 2.
    Direct "direct",
    /// [`FeatureId::Material`]: index of the first sample's material, −1 for background; a mean only.
    Material "material",
    /// [`noisefloor_frame::Flash::Parts`] (moon2013flash, Sec. 3.1).
    Flash "flash",
    /// [`FeatureId::Brdf`]: mean over the samples of BRDF times cosine over density for the direction that was sampled, 0
    /// where none was (rousselle2013rdfc, Fig. 9); reflectance of specular surfaces, 0 for background.
    Brdf "brdf",
    /// [`FeatureId::Motion`]: where the point that is seen will be on the next frame's image less where it is on this
    /// one's, in pixels, right and down, both at the moment when the shutter opens; 0 for background.
    Motion "motion",
    /// [`FeatureId::Caustics`]: caustic photons per area around the hit, per path of light that was followed; in 1 over
    /// squared scene units. Needs photon maps.
    Caustics "caustics",
}

impl Quantity {
    /// Inverse of [`Quantity::name`].
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|q| q.name() == name)
    }

    /// The feature it becomes; `None` for the flash, which is no feature.
    #[must_use]
    pub fn feature(self) -> Option<FeatureId> {
        FeatureId::KNOWN.into_iter().find(|id| id.name() == self.name())
    }
}

/// What is kept of a quantity beside its mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Keep {
    /// Variance of the mean, from 2 samples on.
    pub variance: bool,
    /// Half buffers, from 2 samples on.
    pub halves: bool,
}

impl Keep {
    /// The mean alone.
    pub const MEAN: Self = Self { variance: false, halves: false };
    /// Mean, variance and halves.
    pub const ALL: Self = Self { variance: true, halves: true };
}

/// What to record beside the colour.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Recorded {
    /// Everything the scene can give, with variances and halves.
    #[default]
    Available,
    /// These, and an error if the scene cannot give one of them.
    Exactly(BTreeMap<Quantity, Keep>),
}

impl Recorded {
    /// The colour alone.
    #[must_use]
    pub fn color_only() -> Self {
        Self::Exactly(BTreeMap::new())
    }

    /// These quantities with variances and halves.
    #[must_use]
    pub fn exactly(quantities: impl IntoIterator<Item = Quantity>) -> Self {
        Self::Exactly(quantities.into_iter().map(|q| (q, Keep::ALL)).collect())
    }
}

/// What a scene can give without photon maps: motion needs an animation, visibility and direct light need a light, the
/// flash also needs a surface that is not perfectly specular.
#[must_use]
pub fn available(scene: &Scene) -> Vec<Quantity> {
    let models = scene.models();
    let lit = models.area_lights || models.sun || models.sky;
    let rough = scene
        .materials
        .iter()
        .any(|m| matches!(m.scattering, Scattering::Diffuse { .. } | Scattering::Conductor { .. }));
    Quantity::ALL
        .into_iter()
        .filter(|q| match q {
            Quantity::Visibility | Quantity::Direct => lit,
            Quantity::Flash => lit && rough,
            Quantity::Motion => scene.animation.is_some(),
            Quantity::Caustics => false,
            _ => true,
        })
        .collect()
}
