//! The frames of a scene that moves.

use crate::{Animation, Body, CameraMove, Mesh, Scene};

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
