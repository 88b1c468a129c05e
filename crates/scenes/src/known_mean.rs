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
    let seen = match id {
        "furnace" => {
            // Σ albedo^k over the surfaces, in every pixel.
            let albedo = f64::from(FURNACE_ALBEDO);
            return Some((1.0 - albedo.powi(depth.min(1000) as i32)) / (1.0 - albedo));
        }
        // The lamps reflect nothing and the plane does not see itself: the second surface is the last.
        "direct" if depth >= 2 => Seen::new(&direct(), width, height, under_panel),
        "gradient" if depth >= 2 => {
            let seen = Seen::new(&gradient(), width, height, under_ball);
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

/// The plane of an analytic scene as its camera sees it. Places in the image are (u, v) with v from −1 (bottom) to 1 and
/// u in units of half the height.
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

impl Seen {
    fn new(scene: &Scene, width: usize, height: usize, radiance: fn(f64, f64) -> f64) -> Self {
        let CameraSpec { eye, target, up, vertical_fov_degrees, .. } = scene.camera;
        let (eye, target) = (eye.as_dvec3(), target.as_dvec3());
        let half = (0.5 * f64::from(vertical_fov_degrees).to_radians()).tan();
        let forward = (target - eye).normalize();
        // Neither camera looks along its up direction, and neither is rolled: this lies in the horizontal.
        let right = forward.cross(up.as_dvec3()).normalize();
        let up = right.cross(forward);
        let aspect = width as f64 / height as f64;
        Self { eye, forward, right: right * half, up: up * half, aspect, radiance }
    }

    /// Whether the ball of `gradient` is in the image, whose nearest point is on the border, in the middle row.
    fn shows_the_ball(&self) -> bool {
        let (aside, below) = (f64::from(BALL_OFFSET), self.eye.y - f64::from(GRADIENT.height));
        let rim = aside.atan2(below) - (f64::from(GRADIENT.size) / aside.hypot(below)).asin();
        (self.aspect * self.right.length()).atan() >= rim
    }

    /// Where a row of the image meets the plane: a point, and how far it moves with u. None above the horizon.
    fn row(&self, v: f64) -> Option<(DVec3, DVec3)> {
        let ray = self.forward + self.up * v;
        (ray.y < 0.0).then(|| {
            let reach = self.eye.y / -ray.y;
            (self.eye + ray * reach, self.right * reach)
        })
    }

    /// The part of a row on the plane, which ends at ±[`PLANE_HALF`] in x and z.
    fn lit(&self, (point, step): (DVec3, DVec3)) -> Option<(f64, f64)> {
        let limit = f64::from(PLANE_HALF);
        let slabs = [(point.x, step.x), (point.z, step.z)];
        let both = slabs.into_iter().try_fold((-self.aspect, self.aspect), |(from, to), (at, by)| {
            // A direction that the row does not move in is inside for all of it or for nothing.
            if by.abs() < 1e-9 {
                return (at.abs() <= limit).then_some((from, to));
            }
            let ends = [(-limit - at) / by, (limit - at) / by];
            Some((from.max(ends[0].min(ends[1])), to.min(ends[0].max(ends[1]))))
        });
        both.filter(|(from, to)| from < to)
    }

    /// Rows at which the lit part of a row begins, ends, or reaches the image's sides.
    fn breaks(&self) -> Vec<f64> {
        let limit = f64::from(PLANE_HALF);
        let mut found = vec![-1.0, 1.0];
        for axis in [0, 2] {
            for side in [-limit, limit] {
                for u in [-self.aspect, 0.0, self.aspect] {
                    // eye.y·(f + r·u + w·v) = −(side − eye)·(f.y + w.y·v), linear in v.
                    let across = side - self.eye[axis];
                    let constant =
                        self.eye.y * (self.forward[axis] + self.right[axis] * u) + across * self.forward.y;
                    let slope = self.eye.y * self.up[axis] + across * self.up.y;
                    let v = -constant / slope;
                    // A slope of zero gives no number in range.
                    if v > -1.0 && v < 1.0 {
                        found.push(v);
                    }
                }
            }
        }
        found.sort_by(f64::total_cmp);
        found
    }

    fn at(&self, (point, step): (DVec3, DVec3), u: f64) -> f64 {
        let place = point + step * u;
        (self.radiance)(place.x, place.z)
    }

    fn over_area(&self) -> f64 {
        let of_row = |v: f64| {
            let row = self.row(v);
            let lit = row.and_then(|row| Some((row, self.lit(row)?)));
            lit.map_or(0.0, |(row, (from, to))| integral(from, to, |u| self.at(row, u)))
        };
        let whole: f64 = self.breaks().windows(2).map(|ends| integral(ends[0], ends[1], of_row)).sum();
        whole / (4.0 * self.aspect)
    }

    fn over_centres(&self, width: usize, height: usize) -> f64 {
        let centre = |i: usize, n: usize| (2 * i + 1) as f64 / height as f64 - n as f64 / height as f64;
        let of_row = |j: usize| {
            let lit = self.row(centre(j, height)).and_then(|row| Some((row, self.lit(row)?)));
            let Some((row, (from, to))) = lit else { return 0.0 };
            let places = (0..width).map(|i| centre(i, width)).filter(|u| (from..=to).contains(u));
            places.map(|u| self.at(row, u)).sum::<f64>()
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
