use noisefloor_frame::{Integrator, Maps, PhotonSettings};
use noisefloor_scenes::{CameraMove, Scene};
use serde::{Deserialize, Serialize};

/// Which moment of a scene is shown, and how its light is carried.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Shot {
    /// Frame of the sequence; 0 is the scene as it was built.
    pub frame: u32,
    /// Degrees per frame by which the camera goes around its target, beside what the scene itself moves.
    pub orbit_degrees: f32,
    /// How light is carried in the noisy frames.
    pub integrator: Integrator,
    /// Photon maps: for photon mapping, and for caustics as a feature.
    pub photons: Option<PhotonSettings>,
    /// Whether replicates share them.
    pub maps: Maps,
}

impl Shot {
    /// The scene at this moment.
    #[must_use]
    pub fn of(&self, scene: Scene) -> Scene {
        let scene = if self.orbit_degrees == 0.0 {
            scene
        } else {
            let own = scene.animation.as_ref().map_or_else(CameraMove::default, |a| a.camera);
            let orbit_degrees = own.orbit_degrees + self.orbit_degrees;
            scene.with_camera_move(CameraMove { orbit_degrees, ..own })
        };
        scene.at_frame(self.frame)
    }

    /// The settings of the maps, if there are any.
    #[must_use]
    pub fn photons(&self) -> Option<PhotonSettings> {
        self.photons.or_else(|| (self.integrator == Integrator::PhotonMapping).then(PhotonSettings::default))
    }
}
