//! Camera rays.

use glam::Vec3A;
use noisefloor_frame::{Camera, PixelFilter};
use noisefloor_scenes::{CameraSpec, Lens};

/// A camera for one image size.
#[derive(Debug, Clone, Copy)]
pub struct Eye {
    position: Vec3A,
    right: Vec3A,
    up: Vec3A,
    forward: Vec3A,
    /// Half the image's extent at distance 1.
    half: [f32; 2],
    size: [f32; 2],
    lens: Option<Lens>,
    filter: PixelFilter,
}

impl Eye {
    /// Turns a checked description into a camera for an image of this size.
    pub fn new(spec: &CameraSpec, width: usize, height: usize, filter: PixelFilter) -> Self {
        let forward = Vec3A::from(spec.target - spec.eye).normalize();
        let right = forward.cross(Vec3A::from(spec.up)).normalize();
        let up = right.cross(forward);
        let half_y = (0.5 * spec.vertical_fov_degrees.to_radians()).tan();
        let size = [width as f32, height as f32];
        Self {
            position: spec.eye.into(),
            right,
            up,
            forward,
            half: [half_y * size[0] / size[1], half_y],
            size,
            lens: spec.lens.filter(|lens| lens.radius > 0.0),
            filter,
        }
    }

    /// Centre of the lens.
    #[inline]
    pub fn position(&self) -> Vec3A {
        self.position
    }

    /// Origin and unit direction of a ray through pixel `(x, y)`; `u` places it in the pixel and on the lens.
    #[inline]
    pub fn ray(&self, x: usize, y: usize, u: [f32; 4]) -> (Vec3A, Vec3A) {
        let [dx, dy] = self.place(u);
        let sx = (2.0 * ((x as f32 + dx) / self.size[0]) - 1.0) * self.half[0];
        let sy = (1.0 - 2.0 * ((y as f32 + dy) / self.size[1])) * self.half[1];
        let through = self.forward + self.right * sx + self.up * sy;
        match self.lens {
            None => (self.position, through.normalize()),
            Some(lens) => {
                let (a, b) = crate::math::concentric_disc(u[2], u[3]);
                let offset = (self.right * a + self.up * b) * lens.radius;
                (self.position + offset, (through * lens.focus_distance - offset).normalize())
            }
        }
    }

    /// Where in its pixel such a ray goes through the image, right and down, in 0..1.
    #[inline(always)]
    pub fn place(&self, u: [f32; 4]) -> [f32; 2] {
        match self.filter {
            PixelFilter::Box => [u[0], u[1]],
            PixelFilter::Point => [0.5, 0.5],
        }
    }

    /// Width of a pixel at distance 1 from the eye, in the middle of the image.
    pub fn pixel(&self) -> f32 {
        2.0 * self.half[1] / self.size[1]
    }

    /// Where a point appears on the image, in pixels from the upper left corner; `None` behind the eye.
    pub fn project(&self, p: Vec3A) -> Option<[f32; 2]> {
        let to = p - self.position;
        let z = to.dot(self.forward);
        // A point closer to the eye's plane than this, relative to its distance, is nowhere near the image.
        if z <= 1e-6 * to.length() {
            return None;
        }
        let along = |axis: Vec3A, half: f32| to.dot(axis) / (z * half);
        Some([
            (0.5 + 0.5 * along(self.right, self.half[0])) * self.size[0],
            (0.5 - 0.5 * along(self.up, self.half[1])) * self.size[1],
        ])
    }

    /// Diameter in pixels of the disc over which a point at `p` is spread; 0 for a pinhole.
    pub fn circle_of_confusion(&self, p: Vec3A) -> f32 {
        let Some(lens) = self.lens else { return 0.0 };
        let z = (p - self.position).dot(self.forward);
        if z <= 0.0 {
            return 0.0;
        }
        let on_focal_plane = 2.0 * lens.radius * (z - lens.focus_distance).abs() / z;
        let pixel = 2.0 * self.half[1] * lens.focus_distance / self.size[1]; // positive: checked on preparation
        on_focal_plane / pixel
    }

    /// As other programs want it: camera-to-world, looking along −Z.
    pub fn provenance(&self, spec: &CameraSpec) -> Camera {
        let (r, u, b, p) = (self.right, self.up, -self.forward, self.position);
        Camera {
            camera_to_world: [
                [r.x, u.x, b.x, p.x],
                [r.y, u.y, b.y, p.y],
                [r.z, u.z, b.z, p.z],
                [0.0, 0.0, 0.0, 1.0],
            ],
            vertical_fov_degrees: spec.vertical_fov_degrees,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    fn spec(lens: Option<Lens>) -> CameraSpec {
        CameraSpec {
            eye: Vec3::new(1.0, 2.0, 3.0),
            target: Vec3::new(1.0, 2.0, -3.0),
            up: Vec3::Y,
            vertical_fov_degrees: 90.0,
            lens,
        }
    }

    #[test]
    fn the_first_pixel_is_at_the_upper_left() {
        let eye = Eye::new(&spec(None), 4, 2, PixelFilter::Box);
        let (origin, direction) = eye.ray(0, 0, [0.0; 4]);
        assert_eq!(origin, Vec3A::new(1.0, 2.0, 3.0));
        assert!((direction - Vec3A::new(-2.0, 1.0, -1.0).normalize()).length() < 1e-6);
        let matrix = eye.provenance(&spec(None)).camera_to_world;
        assert_eq!(matrix[0], [1.0, 0.0, 0.0, 1.0]);
        assert_eq!(matrix[2], [0.0, 0.0, 1.0, 3.0]);
    }

    #[test]
    fn lens_rays_meet_on_the_plane_in_focus() {
        let lens = Some(Lens { radius: 0.25, focus_distance: 5.0 });
        let eye = Eye::new(&spec(lens), 8, 8, PixelFilter::Point);
        let meet = |u| {
            let (o, d) = eye.ray(1, 6, u);
            let t = (-2.0 - o.z) / d.z;
            o + d * t
        };
        let centre = meet([0.0, 0.0, 0.5, 0.5]);
        for u in [[0.3, 0.9, 0.1, 0.8], [0.0, 0.1, 0.99, 0.02]] {
            assert!((meet(u) - centre).length() < 1e-5);
        }
        assert!(eye.circle_of_confusion(Vec3A::new(0.0, 0.0, -2.0)) < 1e-5);
        // At twice the distance: 2·0.25·5/10 on a plane where a pixel is 10/8 wide.
        let wide = eye.circle_of_confusion(Vec3A::new(0.0, 0.0, -7.0));
        assert!((wide - 0.2).abs() < 1e-5, "{wide}");
    }
}
