//! Whether a movement has a meaning in its scene.

use glam::Vec3;

use crate::{Animation, MaterialIndex, Scene};

impl Animation {
    /// The first number that has no meaning, or the first moving mesh that may not move: what, its value, what is
    /// allowed.
    #[must_use]
    pub fn problem(&self, scene: &Scene) -> Option<(String, String, &'static str)> {
        let found = |what: &str, value: String, allowed| Some((what.to_owned(), value, allowed));
        if !(0.0..=1.0).contains(&self.shutter) {
            return found("shutter", self.shutter.to_string(), "in [0, 1] of a frame");
        }
        let camera = self.camera;
        if !(-360.0..=360.0).contains(&camera.orbit_degrees) {
            return found(
                "orbit of the camera",
                camera.orbit_degrees.to_string(),
                "within ±360 degrees per frame",
            );
        }
        if !is_way(camera.translation) {
            return found("way of the camera", camera.translation.to_string(), WAY);
        }
        let mut taken = vec![false; scene.meshes.len()];
        for (i, body) in self.bodies.iter().enumerate() {
            if !is_way(body.translation) {
                return found(&format!("way of body {i}"), body.translation.to_string(), WAY);
            }
            if let Some(spin) = body.spin {
                if !is_way(spin.center) {
                    return found(&format!("centre of body {i}"), spin.center.to_string(), WAY);
                }
                if (spin.axis.length() - 1.0).abs() > 1e-4 || !spin.axis.is_finite() {
                    return found(&format!("axis of body {i}"), spin.axis.to_string(), "of length 1");
                }
                if !(-3600.0..=3600.0).contains(&spin.degrees) {
                    let allowed = "within ±3600 degrees per frame";
                    return found(&format!("rotation of body {i}"), spin.degrees.to_string(), allowed);
                }
            }
            for &mesh in &body.meshes {
                let what = format!("mesh of body {i}");
                match scene.meshes.get(mesh) {
                    None => return found(&what, mesh.to_string(), "below the number of meshes"),
                    Some(m) if emits(scene, m.material) => {
                        return found(&what, mesh.to_string(), "one that does not shine: lamps cannot move");
                    }
                    Some(_) if std::mem::replace(&mut taken[mesh], true) => {
                        return found(&what, mesh.to_string(), "in one body only");
                    }
                    Some(_) => {}
                }
            }
        }
        None
    }
}

const WAY: &str = "finite and at most 1e6";

fn is_way(v: Vec3) -> bool {
    v.is_finite() && v.abs().max_element() <= 1e6
}

fn emits(scene: &Scene, material: MaterialIndex) -> bool {
    scene.materials.get(material).is_some_and(|m| m.emission != Vec3::ZERO)
}
