//! Small scenes whose image is known in closed form, for testing renderers.

use glam::Vec3;

use crate::shape::{cuboid, quad};
use crate::{CameraSpec, Color, Material, Scattering, Scene, Sky, Sun};

fn camera(eye: Vec3, target: Vec3, up: Vec3) -> CameraSpec {
    CameraSpec { eye, target, up, vertical_fov_degrees: 40.0, lens: None }
}

/// Inside of a closed box of diffuse reflectance `albedo` in [0, 1) that emits radiance 1 everywhere. Every pixel
/// is 1/(1 − `albedo`); with paths of at most k surfaces it is the geometric sum of k terms.
#[must_use]
pub fn furnace(albedo: f32) -> Scene {
    let mut scene = Scene::empty("furnace", "White furnace", camera(Vec3::ZERO, -Vec3::Z, Vec3::Y));
    let wall = Material { emission: Vec3::ONE, ..Material::diffuse("glowing wall", Vec3::splat(albedo)) };
    let wall = scene.add_material(wall);
    scene.add_mesh(cuboid(Vec3::splat(-1.0), Vec3::ONE).flipped(), wall);
    scene
}

/// Diffuse reflectance of the built-in furnace.
pub(crate) const FURNACE_ALBEDO: f32 = 0.5;

/// A diffuse plane under a lamp of radiance 1.
pub(crate) struct UnderLamp {
    pub(crate) albedo: f32,
    /// Half the side of a panel, or the radius of a ball.
    pub(crate) size: f32,
    pub(crate) height: f32,
}

pub(crate) const DIRECT: UnderLamp = UnderLamp { albedo: 0.6, size: 1.0, height: 1.5 };
pub(crate) const GRADIENT: UnderLamp = UnderLamp { albedo: 0.7, size: 0.9, height: 2.0 };

/// The built-in scene `direct`.
pub(crate) fn direct() -> Scene {
    plane_under_panel(Vec3::splat(DIRECT.albedo), DIRECT.size, DIRECT.height)
}

/// The built-in scene `gradient`.
pub(crate) fn gradient() -> Scene {
    plane_under_ball(Vec3::splat(GRADIENT.albedo), GRADIENT.size, GRADIENT.height)
}

/// A sphere of radius 1 under a sky of radiance 1 from everywhere, filling the middle of the image. What it reflects
/// is its albedo: a material that loses nothing cannot be seen. A diffuse one of reflectance a shows a, a mirror
/// its reflectance, glass 1.
#[must_use]
pub fn sphere_under_sky(scattering: Scattering) -> Scene {
    let view = camera(Vec3::Z * 4.0, Vec3::ZERO, Vec3::Y);
    let mut scene = Scene::empty("sphere-under-sky", "Sphere under a white sky", view);
    let material = scene.add_material(Material::dark("sphere", scattering));
    scene.add_sphere(Vec3::ZERO, 1.0, material);
    scene.sky = Some(Sky::Constant(Vec3::ONE));
    scene
}

/// A wide diffuse plane seen from above under a sun of irradiance `irradiance`, `zenith_degrees` (under 80) from
/// overhead. The reflected radiance is `albedo`/π · `irradiance` · cos(zenith), to second order in the sun's radius.
#[must_use]
pub fn plane_under_sun(albedo: impl Into<Color>, irradiance: Vec3, zenith_degrees: f32) -> Scene {
    let (sin, cos) = zenith_degrees.to_radians().sin_cos();
    let mut scene = plane("plane-under-sun", "Plane under a sun", albedo);
    let direction = Vec3::new(sin, cos, 0.0);
    scene.sun = Some(Sun { direction, half_angle_degrees: 0.25, irradiance });
    scene
}

/// A wide diffuse plane at height 0 seen from above, below a square lamp of side `2·half` and radiance 1 at height
/// `height` that faces down; the camera looks at the point under the lamp's middle from beside it. Irradiance there:
/// [`panel_irradiance`].
#[must_use]
pub fn plane_under_panel(albedo: impl Into<Color>, half: f32, height: f32) -> Scene {
    let mut scene = plane("direct", "Plane under a square lamp", albedo);
    // Below the lamp's rim, so that it never hides the point.
    scene.camera.eye = Vec3::new(2.0 * half, 0.5 * height, 0.0);
    let lamp = scene.add_material(Material::emitter("lamp", Vec3::ONE));
    let corner = Vec3::new(-half, height, -half);
    scene.add_mesh(quad(corner, Vec3::X * (2.0 * half), Vec3::Z * (2.0 * half)), lamp);
    scene
}

/// Irradiance from a square of radiance 1 and side `2·half`, parallel to the receiver at distance `height`, at the
/// point below its middle: four times the view factor of a quarter, times π (Hottel's corner formula):
/// `4·a·atan(a)` with `a = half/√(half² + height²)`.
#[must_use]
pub fn panel_irradiance(half: f64, height: f64) -> f64 {
    let a = half / half.hypot(height);
    4.0 * a * a.atan()
}

/// The same at a point `x` and `z` aside of the middle: a signed sum over the rectangles between the point's foot and the
/// four corners.
#[must_use]
pub fn panel_irradiance_at(half: f64, height: f64, x: f64, z: f64) -> f64 {
    // π times the view factor of a rectangle with one corner above the point; odd in both sides.
    let corner = |a: f64, b: f64| {
        let (p, q) = (a / a.hypot(height), b / b.hypot(height));
        0.5 * (p * (b / a.hypot(height)).atan() + q * (a / b.hypot(height)).atan())
    };
    let (left, right, back, front) = (-half - x, half - x, -half - z, half - z);
    corner(right, front) - corner(left, front) - corner(right, back) + corner(left, back)
}

/// A wide diffuse plane at height 0 seen from above, lit by a ball of radiance 1 and radius `radius` whose centre
/// stands `height` (at least `radius`) above the point (−[`BALL_OFFSET`], 0, 0), outside of the image. Irradiance:
/// [`ball_irradiance`].
#[must_use]
pub fn plane_under_ball(albedo: impl Into<Color>, radius: f32, height: f32) -> Scene {
    let mut scene = plane("gradient", "Plane under a ball lamp", albedo);
    let lamp = scene.add_material(Material::emitter("lamp", Vec3::ONE));
    scene.add_sphere(Vec3::new(-BALL_OFFSET, height, 0.0), radius, lamp);
    scene
}

/// Distance along X from the middle of the image of [`plane_under_ball`] to the foot of its lamp.
pub const BALL_OFFSET: f32 = 2.2;

/// Irradiance from a ball of radiance 1 that is wholly above the receiver's plane: π times the squared sine of its half
/// angle times the cosine towards its centre. `aside`: distance in the plane from the centre's foot.
#[must_use]
pub fn ball_irradiance(radius: f64, height: f64, aside: f64) -> f64 {
    let distance = height.hypot(aside);
    std::f64::consts::PI * (radius / distance).powi(2) * (height / distance)
}

/// Half the side of the planes.
pub(crate) const PLANE_HALF: f32 = 5.0;

fn plane(id: &'static str, title: &'static str, albedo: impl Into<Color>) -> Scene {
    let mut scene = Scene::empty(id, title, camera(Vec3::Y * 4.0, Vec3::ZERO, Vec3::Z));
    let ground = scene.add_material(Material::diffuse("ground", albedo));
    // Beyond every view, and small: renderers lift shadow rays by the rounding of a triangle's coordinates.
    let side = PLANE_HALF;
    scene
        .add_mesh(quad(Vec3::new(-side, 0.0, -side), Vec3::Z * (2.0 * side), Vec3::X * (2.0 * side)), ground);
    scene
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panel_irradiance_equals_the_integral_over_the_panel() {
        let (half, height, n) = (0.7, 1.3, 400);
        for (x, z) in [(0.0, 0.0), (0.4, -0.3), (2.0, 0.5), (-0.7, 0.7)] {
            let step = 2.0 * half / f64::from(n);
            let mut sum = 0.0;
            for i in 0..n * n {
                let at = |k: i32| (f64::from(k) + 0.5) * step - half;
                let (a, b) = (at(i % n) - x, at(i / n) - z);
                sum += (height / (a * a + b * b + height * height)).powi(2) * step * step;
            }
            let found = panel_irradiance_at(half, height, x, z);
            assert!((found / sum - 1.0).abs() < 1e-5, "{x} {z}: {found}, {sum}");
        }
        assert!(
            (panel_irradiance_at(half, height, 0.0, 0.0) / panel_irradiance(half, height) - 1.0).abs()
                < 1e-12
        );
        let step = 2.0 * half / f64::from(n);
        let mut sum = 0.0;
        for i in 0..n {
            for j in 0..n {
                let x = (f64::from(i) + 0.5) * step - half;
                let y = (f64::from(j) + 0.5) * step - half;
                let d2 = x * x + y * y + height * height;
                // cos/d at both ends, over the squared distance.
                sum += height * height / (d2 * d2) * step * step;
            }
        }
        // The midpoint rule's error is of order step².
        assert!((sum - panel_irradiance(half, height)).abs() < step * step);
    }

    #[test]
    fn all_pass_the_check() {
        let white = Vec3::splat(0.8);
        for scene in [
            furnace(0.5),
            sphere_under_sky(Scattering::Glass { ior: 1.5 }),
            plane_under_sun(white, Vec3::ONE, 30.0),
            plane_under_panel(white, 0.5, 1.0),
            plane_under_ball(white, 0.5, 2.0),
        ] {
            assert_eq!(scene.check(), Ok(()));
        }
    }
}
