use glam::{Affine3A, DMat3, DVec3, Quat, Vec3};

use crate::{CameraSpec, MaterialIndex, Mesh, Scene};

/// How a scene changes from frame to frame. The scene itself is frame 0 at the moment when the shutter opens.
///
/// Bodies move while the shutter is open and are blurred by it. The camera stands still during a frame and jumps between
/// frames.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Animation {
    /// Part of a frame's duration during which the shutter is open, from its beginning, in [0, 1]; 0 blurs nothing.
    pub shutter: f32,
    /// What moves in the scene.
    pub bodies: Vec<Body>,
    /// How the camera moves.
    pub camera: CameraMove,
}

/// Meshes that move together without changing their shape.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Body {
    /// Indices into [`Scene::meshes`]; no mesh belongs to two bodies.
    pub meshes: Vec<usize>,
    /// Way per frame in scene units.
    pub translation: Vec3,
    /// Rotation, about a centre that takes part in the translation.
    pub spin: Option<Spin>,
}

/// A steady rotation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spin {
    /// A point of the axis in frame 0.
    pub center: Vec3,
    /// Unit direction of the axis; counter-clockwise when it points to the viewer.
    pub axis: Vec3,
    /// Angle per frame, within ±3600.
    pub degrees: f32,
}

/// A steady movement of the camera.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct CameraMove {
    /// Degrees per frame, within ±360, by which the eye goes around the vertical through its target, counter-clockwise
    /// seen from above.
    pub orbit_degrees: f32,
    /// Way of eye and target per frame in scene units.
    pub translation: Vec3,
}

impl CameraMove {
    /// The camera after a time in frames.
    #[must_use]
    pub fn apply(&self, camera: &CameraSpec, frames: f32) -> CameraSpec {
        let turn = Quat::from_rotation_y((self.orbit_degrees * frames).to_radians());
        let shift = self.translation * frames;
        CameraSpec {
            eye: camera.target + turn * (camera.eye - camera.target) + shift,
            target: camera.target + shift,
            up: turn * camera.up,
            ..*camera
        }
    }
}

impl Body {
    /// From frame 0 to a time in frames: a rotation and a translation.
    #[must_use]
    pub fn at(&self, frames: f32) -> Affine3A {
        let way = self.translation.as_dvec3() * f64::from(frames);
        let Some(spin) = self.spin else {
            return Affine3A::from_translation(way.as_vec3());
        };
        // In f64, with an axis of exactly unit length and an angle within a turn: rays rely on a pure rotation.
        let angle = (f64::from(spin.degrees) * f64::from(frames)).rem_euclid(360.0).to_radians();
        let turn = DMat3::from_axis_angle(spin.axis.as_dvec3().normalize_or(DVec3::Y), angle);
        let center = spin.center.as_dvec3();
        let translation = (center + way - turn * center).as_vec3a();
        Affine3A { matrix3: turn.as_mat3().into(), translation }
    }

    /// The same movement from a later moment on.
    fn later(&self, frames: f32) -> Self {
        let spin = self.spin.map(|s| Spin { center: s.center + self.translation * frames, ..s });
        Self { spin, ..self.clone() }
    }
}

impl Animation {
    /// Whether the shutter sees something move.
    #[must_use]
    pub fn blurs(&self) -> bool {
        self.shutter > 0.0 && !self.bodies.is_empty()
    }

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

impl Scene {
    /// Frame `frame` of the sequence: everything where it is when the shutter opens, and the same movement from there on.
    /// A scene without an animation is the same in every frame.
    #[must_use]
    pub fn at_frame(mut self, frame: u32) -> Self {
        let Some(animation) = &mut self.animation else { return self };
        let frames = frame as f32;
        if frame == 0 {
            return self;
        }
        self.camera = animation.camera.apply(&self.camera, frames);
        for body in &mut animation.bodies {
            let map = body.at(frames);
            for &mesh in &body.meshes {
                if let Some(mesh) = self.meshes.get_mut(mesh) {
                    let moved: Mesh = std::mem::take(mesh).transformed(map);
                    *mesh = moved;
                }
            }
            *body = body.later(frames);
        }
        self
    }

    /// With this movement of the camera, whatever else moves.
    #[must_use]
    pub fn with_camera_move(mut self, camera: CameraMove) -> Self {
        let animation = self.animation.take().unwrap_or_default();
        self.animation = Some(Animation { camera, ..animation });
        self
    }

    /// Makes meshes move, with the shutter open during `shutter` of each frame.
    pub fn add_body(&mut self, shutter: f32, body: Body) {
        let animation = self.animation.get_or_insert_default();
        animation.shutter = shutter;
        animation.bodies.push(body);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rolling() -> Body {
        Body {
            meshes: vec![0],
            translation: Vec3::new(0.5, 0.0, 0.0),
            spin: Some(Spin { center: Vec3::new(1.0, 2.0, 0.0), axis: Vec3::Z, degrees: 90.0 }),
        }
    }

    #[test]
    fn a_body_turns_about_its_moving_centre() {
        let body = rolling();
        let center = body.at(0.6).transform_point3(Vec3::new(1.0, 2.0, 0.0));
        assert!((center - Vec3::new(1.3, 2.0, 0.0)).length() < 1e-6);
        // One unit to the right of the centre; a quarter turn later above it.
        let rim = body.at(1.0).transform_point3(Vec3::new(2.0, 2.0, 0.0));
        assert!((rim - Vec3::new(1.5, 3.0, 0.0)).length() < 1e-6);
    }

    #[test]
    fn a_later_frame_goes_on_where_the_earlier_one_ends() {
        let mut scene = (crate::find("two-quads").unwrap().build)();
        scene.add_body(0.5, rolling());
        let scene = scene.with_camera_move(CameraMove { orbit_degrees: 3.0, translation: Vec3::X });
        let two = scene.clone().at_frame(2);
        let stepped = scene.clone().at_frame(1).at_frame(1);
        assert!((two.camera.eye - stepped.camera.eye).length() < 1e-5);
        assert!((two.camera.eye - scene.camera.eye).length() > 1.0);
        for (a, b) in two.meshes[0].positions.iter().zip(&stepped.meshes[0].positions) {
            assert!((*a - *b).length() < 1e-5, "{a} {b}");
        }
        assert_ne!(two.meshes[0].positions, scene.meshes[0].positions);
        assert_eq!(two.meshes[1], scene.meshes[1]);
        assert_eq!(two.check(), Ok(()));
        assert_eq!(
            (crate::find("cornell").unwrap().build)().at_frame(7),
            (crate::find("cornell").unwrap().build)()
        );
    }

    #[test]
    fn movements_without_meaning_are_named() {
        let base = (crate::find("cornell-diffuse").unwrap().build)();
        let lamp = base.meshes.iter().position(|m| emits(&base, m.material)).unwrap();
        let body = |f: &dyn Fn(&mut Body)| {
            let mut body = Body { meshes: vec![0], ..rolling() };
            f(&mut body);
            Animation { shutter: 1.0, bodies: vec![body], ..Animation::default() }
        };
        let spin = |f: &dyn Fn(&mut Spin)| {
            let mut s = rolling().spin.unwrap();
            f(&mut s);
            body(&|b| b.spin = Some(s))
        };
        assert_eq!(body(&|_| {}).problem(&base), None);
        for (animation, word) in [
            (Animation { shutter: f32::NAN, ..Animation::default() }, "shutter"),
            (Animation { shutter: 1.5, ..Animation::default() }, "shutter"),
            (body(&|b| b.meshes = vec![99]), "mesh of body 0"),
            (body(&|b| b.meshes = vec![1, 1]), "mesh of body 0"),
            (body(&|b| b.meshes = vec![lamp]), "mesh of body 0"),
            (body(&|b| b.translation.y = f32::INFINITY), "way of body 0"),
            (spin(&|s| s.axis = Vec3::ZERO), "axis of body 0"),
            (spin(&|s| s.center.x = f32::NAN), "centre of body 0"),
            (spin(&|s| s.degrees = 1e9), "rotation of body 0"),
        ] {
            let (what, _, _) = animation.problem(&base).expect(word);
            assert_eq!(what, word);
            let scene = Scene { animation: Some(animation), ..base.clone() };
            assert!(scene.check().unwrap_err().to_string().contains(word));
        }
    }
}
