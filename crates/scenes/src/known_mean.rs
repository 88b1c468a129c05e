//! Mean over the image of the built-in scenes whose image is known in closed form.

use std::f64::consts::PI;

use glam::DVec3;

use crate::analytic::{
    BALL_OFFSET, DIRECT, FURNACE_ALBEDO, GRADIENT, PLANE_HALF, ball_irradiance, direct, gradient,
    panel_irradiance_at,
};
use crate::{CameraSpec, Scene};

/// Which rays make the mean over an image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rays {
    /// All of the image's area.
    Area,
    /// One through the centre of each pixel.
    Centres,
}

/// Mean over an image of `width`×`height` pixels of the built-in scene `id` with paths of at most `depth` surfaces, equal in
/// all channels, where a formula gives it, to 1e-7 of itself. None for other scenes, for an image that shows no light,
/// and for one so wide (beyond about 3:2) that the lamp of `gradient` is in it.
#[must_use]
pub fn closed_form(id: &str, depth: u32, rays: Rays, (width, height): (usize, usize)) -> Option<f64> {
    if width == 0 || height == 0 {
        return None;
    }
    let aspect = width as f64 / height as f64;
    let seen = match id {
        "furnace" => {
            // Σ albedo^k over the surfaces, in every pixel.
            let albedo = f64::from(FURNACE_ALBEDO);
            return Some((1.0 - albedo.powi(depth.min(1000) as i32)) / (1.0 - albedo));
        }
        // The lamps reflect nothing and the plane does not see itself: the second surface is the last.
        "direct" if depth >= 2 => Seen::new(&direct(), aspect, under_panel),
        "gradient" if depth >= 2 => {
            let seen = Seen::new(&gradient(), aspect, under_ball);
            if seen.shows_the_ball() {
                return None;
            }
            seen
        }
        _ => return None,
    };
    Some(match rays {
        Rays::Area => seen.over_area(),
        Rays::Centres => seen.over_centres(width, height),
    })
}

/// Radiance of the plane of `direct` at (x, z).
fn under_panel(x: f64, z: f64) -> f64 {
    f64::from(DIRECT.albedo) / PI
        * panel_irradiance_at(f64::from(DIRECT.size), f64::from(DIRECT.height), x, z)
}

/// Radiance of the plane of `gradient` at (x, z).
fn under_ball(x: f64, z: f64) -> f64 {
    let aside = (x + f64::from(BALL_OFFSET)).hypot(z);
    f64::from(GRADIENT.albedo) / PI
        * ball_irradiance(f64::from(GRADIENT.size), f64::from(GRADIENT.height), aside)
}

/// The plane of an analytic scene as its camera sees it, rolled or not. Places in the image are (u, v), v from −1 (bottom) to
/// 1 and u in units of half the height.
struct Seen {
    eye: DVec3,
    forward: DVec3,
    /// To the right and up, as long as half of the image's height at distance 1.
    right: DVec3,
    up: DVec3,
    /// Largest u.
    aspect: f64,
    radiance: fn(f64, f64) -> f64,
}

/// Where `constant + u·x + v·y` is not below 0.
#[derive(Clone, Copy)]
struct HalfPlane {
    constant: f64,
    x: f64,
    y: f64,
}

impl Seen {
    fn new(scene: &Scene, aspect: f64, radiance: fn(f64, f64) -> f64) -> Self {
        let CameraSpec { eye, target, up, vertical_fov_degrees, .. } = scene.camera;
        let (eye, target) = (eye.as_dvec3(), target.as_dvec3());
        let half = (0.5 * f64::from(vertical_fov_degrees).to_radians()).tan();
        let forward = (target - eye).normalize();
        // No camera looks along its up direction.
        let right = forward.cross(up.as_dvec3()).normalize();
        let up = right.cross(forward);
        Self { eye, forward, right: right * half, up: up * half, aspect, radiance }
    }

    /// Whether the ball of `gradient` is in the image, whose nearest point is on the border, in the middle row.
    fn shows_the_ball(&self) -> bool {
        let (aside, below) = (f64::from(BALL_OFFSET), self.eye.y - f64::from(GRADIENT.height));
        let rim = aside.atan2(below) - (f64::from(GRADIENT.size) / aside.hypot(below)).asin();
        (self.aspect * self.right.length()).atan() >= rim
    }

    /// The part of the image where the plane is: below the horizon, within ±[`PLANE_HALF`] in x and z, inside of the image's
    /// sides. Straight lines all, since a ray that falls meets the plane at eye + ray·eye.y/(−ray.y).
    fn edges(&self) -> [HalfPlane; 7] {
        let limit = f64::from(PLANE_HALF);
        let along = |of: &dyn Fn(DVec3) -> f64| HalfPlane {
            constant: of(self.forward),
            x: of(self.right),
            y: of(self.up),
        };
        let slab = |axis: usize, side: f64| {
            // side·(limit·side − eye)·(−ray.y) − side·ray·eye.y, not below 0.
            along(&|ray| side * ((limit * side - self.eye[axis]) * -ray.y - ray[axis] * self.eye.y))
        };
        [
            along(&|ray| -ray.y),
            slab(0, 1.0),
            slab(0, -1.0),
            slab(2, 1.0),
            slab(2, -1.0),
            HalfPlane { constant: self.aspect, x: 1.0, y: 0.0 },
            HalfPlane { constant: self.aspect, x: -1.0, y: 0.0 },
        ]
    }

    /// From where to where a row shows the plane.
    fn lit(&self, v: f64) -> Option<(f64, f64)> {
        let mut ends = (-self.aspect, self.aspect);
        for HalfPlane { constant, x, y } in self.edges() {
            let at = constant + y * v;
            // An edge along the row has all of it on one side.
            if x.abs() < 1e-12 {
                if at < 0.0 {
                    return None;
                }
            } else if x > 0.0 {
                ends.0 = ends.0.max(-at / x);
            } else {
                ends.1 = ends.1.min(-at / x);
            }
        }
        (ends.0 < ends.1).then_some(ends)
    }

    /// Rows at corners of the part with the plane: between two of them its ends are straight.
    fn corners(&self) -> Vec<f64> {
        let edges = self.edges();
        let mut found = vec![-1.0, 1.0];
        for (i, a) in edges.iter().enumerate() {
            for b in &edges[..i] {
                // Parallel lines give no number in range.
                let v = (b.x * a.constant - a.x * b.constant) / (a.x * b.y - b.x * a.y);
                if v > -1.0 && v < 1.0 {
                    found.push(v);
                }
            }
        }
        found.sort_by(f64::total_cmp);
        found
    }

    /// Radiance at a place that shows the plane.
    fn at(&self, u: f64, v: f64) -> f64 {
        let ray = self.forward + self.right * u + self.up * v;
        let place = self.eye + ray * (self.eye.y / -ray.y);
        (self.radiance)(place.x, place.z)
    }

    fn over_area(&self) -> f64 {
        let of_row = |v: f64| self.lit(v).map_or(0.0, |(from, to)| integral(from, to, |u| self.at(u, v)));
        let whole: f64 = self.corners().windows(2).map(|ends| integral(ends[0], ends[1], of_row)).sum();
        whole / (4.0 * self.aspect)
    }

    fn over_centres(&self, width: usize, height: usize) -> f64 {
        let centre = |i: usize, n: usize| (2.0 * i as f64 + 1.0 - n as f64) / height as f64;
        let of_row = |j: usize| {
            let v = centre(j, height);
            let Some((from, to)) = self.lit(v) else { return 0.0 };
            let places = (0..width).map(|i| centre(i, width)).filter(|u| (from..=to).contains(u));
            places.map(|u| self.at(u, v)).sum::<f64>()
        };
        (0..height).map(of_row).sum::<f64>() / (width * height) as f64
    }
}

/// Of a smooth function: Gauss and Legendre's rule of three points in each of 48 equal parts.
fn integral(from: f64, to: f64, of: impl Fn(f64) -> f64) -> f64 {
    let part = (to - from) / 48.0;
    let nodes = [(-0.6f64.sqrt(), 5.0), (0.0, 8.0), (0.6f64.sqrt(), 5.0)];
    let of_part = |k: u32| -> f64 {
        let middle = from + (f64::from(k) + 0.5) * part;
        nodes.iter().map(|(at, weight)| weight / 18.0 * of(middle + 0.5 * part * at)).sum()
    };
    part * (0..48).map(of_part).sum::<f64>()
}

#[cfg(test)]
mod tests;
