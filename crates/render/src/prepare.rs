//! From a scene to what rays and light paths need.

use std::sync::atomic::{AtomicU64, Ordering};

use glam::{Vec2, Vec3, Vec3A};
use noisefloor_scenes::{
    Body, CameraMove, CameraSpec, Color, EnvironmentMap, MOST_RADIANCE, Material, Models, Scattering, Scene,
    Sky,
};

use obvhs::aabb::Aabb;

use crate::bvh::{Bvh, Primitive};
use crate::geometry::{Attributes, Geometry, NONE};
use crate::lights::{Ball, Lights, LightsBuilder, SunDisc};
use crate::medium::Medium;
use crate::moving::Moving;
use crate::surface::{Scatter, Surface, Tint};
use crate::{Quantity, RenderError, available};

/// A scene ready for rendering: checked, with its acceleration structure. Make it once, render many frames.
#[derive(Debug, Clone)]
pub struct Prepared {
    pub(crate) id: String,
    /// Tells it from every other preparation; clones share it.
    pub(crate) stamp: u64,
    pub(crate) camera: CameraSpec,
    pub(crate) bvh: Bvh,
    pub(crate) geometry: Vec<Geometry>,
    pub(crate) attributes: Vec<Attributes>,
    pub(crate) surfaces: Vec<Surface>,
    pub(crate) lights: Lights,
    /// What light goes through outside glass.
    pub(crate) medium: Option<Medium>,
    /// What moves.
    pub(crate) bodies: Vec<Moving>,
    /// Part of a frame during which the shutter is open.
    pub(crate) shutter: f32,
    /// How the camera moves from frame to frame.
    pub(crate) camera_move: Option<CameraMove>,
    /// Centre of a sphere around everything that stands still, and around moving bodies at the ends of the first frame.
    pub(crate) center: Vec3A,
    /// Radius of the sphere, positive.
    pub(crate) radius: f32,
    /// Sphere around all specular and glossy surfaces, which turn light into caustics.
    pub(crate) turning: Option<Ball>,
    /// Distances to the eye light below this count as this.
    pub(crate) least_eye_distance: f32,
    models: Models,
    available: Vec<Quantity>,
    dropped: usize,
}

static STAMPS: AtomicU64 = AtomicU64::new(0);

/// Fraction of the scene's radius at which the eye light stops to grow.
const LEAST_EYE_DISTANCE: f32 = 1e-2;

impl Prepared {
    /// Checks a scene and builds everything that does not depend on the image.
    ///
    /// Triangles of zero area are dropped and counted.
    ///
    /// # Errors
    /// [`RenderError::EmptyScene`] if nothing can be hit; [`RenderError::InvalidScene`] naming the first number or index
    /// that has no meaning: non-finite or out of its documented range.
    pub fn new(scene: &Scene) -> Result<Self, RenderError> {
        let check = Check(&scene.id);
        check.scene(scene)?;
        let mut parts = Parts { scene, dropped: 0, ..Parts::new(scene) };
        let still = Body::default();
        let bodies: &[Body] = scene.animation.as_ref().map_or(&[], |a| &a.bodies);
        let moves = |index: usize| bodies.iter().any(|b| b.meshes.contains(&index));
        for (index, mesh) in scene.meshes.iter().enumerate() {
            if !moves(index) {
                parts.mesh(index, mesh, &still, &check)?;
            }
        }
        for (index, sphere) in scene.spheres.iter().enumerate() {
            parts.sphere(index, sphere, &check)?;
        }
        let bodies = parts.bodies(bodies, &check)?;
        if parts.primitives.is_empty() && bodies.is_empty() {
            return Err(RenderError::EmptyScene { scene: scene.id.to_string(), dropped: parts.dropped });
        }
        let mut reach: Vec<Aabb> = parts.primitives.iter().map(Primitive::bounds).collect();
        for moving in &bodies {
            for time in [0.0, 1.0] {
                let center = moving.body.at(time).transform_point3a(moving.center);
                reach.push(Aabb::new(center - moving.radius, center + moving.radius));
            }
        }
        let (low, high) = reach
            .iter()
            .fold((Vec3A::INFINITY, Vec3A::NEG_INFINITY), |(low, high), b| (low.min(b.min), high.max(b.max)));
        let radius = 0.5 * (high - low).length();
        let animation = scene.animation.as_ref();
        let sun = scene.sun.map(|sun| {
            let half_angle = sun.half_angle_degrees.to_radians();
            SunDisc::new(Vec3A::from(sun.direction).normalize(), half_angle, sun.irradiance.into())
        });
        let turning = turning(&parts);
        let lights = parts.lights.finish(sun, scene.sky.as_ref(), radius);
        Ok(Self {
            id: scene.id.to_string(),
            stamp: STAMPS.fetch_add(1, Ordering::Relaxed),
            camera: scene.camera,
            bvh: Bvh::new(&parts.primitives),
            geometry: parts.geometry,
            attributes: parts.attributes,
            surfaces: parts.surfaces,
            lights,
            medium: scene.medium.as_ref().map(Medium::new),
            bodies,
            shutter: animation.map_or(0.0, |a| a.shutter),
            camera_move: animation.map(|a| a.camera),
            center: (low + high) * 0.5,
            radius: radius.max(f32::MIN_POSITIVE),
            turning,
            least_eye_distance: LEAST_EYE_DISTANCE * radius,
            models: scene.models(),
            available: available(scene),
            dropped: parts.dropped,
        })
    }

    /// Id of the scene.
    #[must_use]
    pub fn id(&self) -> &str {
        &self.id
    }

    /// What the scene models.
    #[must_use]
    pub fn models(&self) -> &Models {
        &self.models
    }

    /// What can be recorded.
    #[must_use]
    pub fn available(&self) -> &[Quantity] {
        &self.available
    }

    /// Triangles of zero area that were left out.
    #[must_use]
    pub fn dropped_triangles(&self) -> usize {
        self.dropped
    }
}

/// Sphere around what stands still and is not diffuse.
fn turning(parts: &Parts<'_>) -> Option<Ball> {
    let turns = |g: &Geometry| !matches!(parts.surfaces[g.material as usize].scatter, Scatter::Diffuse(_));
    // Primitives that stand still come first in both lists.
    let found = parts.primitives.iter().zip(&parts.geometry).filter(|(_, g)| turns(g));
    let both = |a: Aabb, b: Aabb| Aabb::new(a.min.min(b.min), a.max.max(b.max));
    let bounds = found.map(|(p, _)| p.bounds()).reduce(both)?;
    let radius = 0.5 * (bounds.max - bounds.min).length();
    // With room for rounding.
    Some(Ball { center: (bounds.min + bounds.max) * 0.5, radius: (radius * 1.0001).max(f32::MIN_POSITIVE) })
}

/// The coordinates that a body's movement adds to.
fn way(body: &Body) -> f32 {
    let spin = body.spin.map_or(0.0, |s| s.center.abs().max_element());
    body.translation.abs().max_element() + spin
}

struct Parts<'a> {
    scene: &'a Scene,
    primitives: Vec<Primitive>,
    geometry: Vec<Geometry>,
    attributes: Vec<Attributes>,
    surfaces: Vec<Surface>,
    lights: LightsBuilder,
    dropped: usize,
}

impl<'a> Parts<'a> {
    fn new(scene: &'a Scene) -> Self {
        let surfaces = scene
            .materials
            .iter()
            .map(|m| Surface {
                scatter: match &m.scattering {
                    Scattering::Diffuse { albedo } => Scatter::Diffuse(Tint::new(albedo)),
                    Scattering::Mirror { reflectance } => Scatter::Mirror((*reflectance).into()),
                    Scattering::Glass { ior } => Scatter::Glass(*ior),
                    Scattering::Conductor { f0, alpha } => {
                        Scatter::Conductor(Tint::new(f0), alpha.max(crate::bsdf::conductor::SMOOTHEST))
                    }
                },
                emission: m.emission.into(),
                emits: m.emission != Vec3::ZERO,
            })
            .collect();
        Self {
            scene,
            primitives: Vec::new(),
            geometry: Vec::new(),
            attributes: Vec::new(),
            surfaces,
            lights: LightsBuilder::default(),
            dropped: 0,
        }
    }

    fn mesh(
        &mut self,
        index: usize,
        mesh: &noisefloor_scenes::Mesh,
        body: &Body,
        check: &Check<'_>,
    ) -> Result<(), RenderError> {
        let material = self.material(mesh.material, &format!("mesh {index}"), check)?;
        let way = way(body);
        let textured = match &self.scene.materials[mesh.material].scattering {
            Scattering::Diffuse { albedo: c } | Scattering::Conductor { f0: c, .. } => {
                matches!(c, Color::Texture(_))
            }
            _ => false,
        };
        let count = mesh.positions.len();
        for (what, got) in [("normals", mesh.normals.len()), ("uvs", mesh.uvs.len())] {
            if got != 0 && got != count {
                return check.fail(format!("mesh {index}, {what}"), got, "none or one per vertex");
            }
        }
        for (k, p) in mesh.positions.iter().enumerate() {
            check.point(*p, || format!("mesh {index}, vertex {k}"))?;
        }
        for (k, n) in mesh.normals.iter().enumerate() {
            check.point(*n, || format!("mesh {index}, normal {k}"))?;
        }
        for (k, uv) in mesh.uvs.iter().enumerate() {
            check.point(uv.extend(0.0), || format!("mesh {index}, texture coordinates {k}"))?;
        }
        let keep = !mesh.normals.is_empty() || (textured && !mesh.uvs.is_empty());
        for (k, corners) in mesh.triangles.iter().enumerate() {
            if let Some(&bad) = corners.iter().find(|&&i| i as usize >= count) {
                return check.fail(
                    format!("mesh {index}, triangle {k}, vertex index"),
                    bad,
                    "below the vertex count",
                );
            }
            let corners = corners.map(|i| i as usize);
            let v = corners.map(|i| Vec3A::from(mesh.positions[i]));
            let scaled = (v[1] - v[0]).cross(v[2] - v[0]);
            // Neither zero nor so small or large that its square is not a normal number.
            if !(1e-36..1e36).contains(&scaled.length_squared()) {
                self.dropped += 1;
                continue;
            }
            let attributes = if keep {
                let normal = |i: usize| mesh.normals.get(i).copied().unwrap_or(Vec3::ZERO);
                let uv = |i: usize| mesh.uvs.get(i).copied().unwrap_or(Vec2::ZERO);
                self.attributes.push(Attributes { normals: corners.map(normal), uvs: corners.map(uv) });
                (self.attributes.len() - 1) as u32
            } else {
                NONE
            };
            let mut geometry = Geometry::triangle(v, material, attributes).moving(way);
            let surface = &self.surfaces[material as usize];
            if surface.emits {
                geometry.light = self.lights.triangle(v, surface.emission);
            }
            self.geometry.push(geometry);
            self.primitives.push(Primitive::Triangle(v));
        }
        Ok(())
    }

    /// Bodies with their own hierarchies. Their primitives follow all others.
    fn bodies(&mut self, bodies: &[Body], check: &Check<'_>) -> Result<Vec<Moving>, RenderError> {
        let mut out = Vec::new();
        for body in bodies {
            let (first, before) = (self.geometry.len() as u32, self.primitives.len());
            for &index in &body.meshes {
                self.mesh(index, &self.scene.meshes[index], body, check)?;
            }
            let own = self.primitives.split_off(before);
            let bounds = own.iter().map(Primitive::bounds);
            let start = (Vec3A::INFINITY, Vec3A::NEG_INFINITY);
            let (low, high) = bounds.fold(start, |(low, high), b| (low.min(b.min), high.max(b.max)));
            if own.is_empty() {
                continue;
            }
            out.push(Moving {
                bvh: Bvh::new(&own),
                body: body.clone(),
                first,
                center: (low + high) * 0.5,
                // With room for the rounding of the test against it.
                radius: 0.5001 * (high - low).length()
                    + 1e-6 * (low.abs().max(high.abs())).max_element()
                    + way(body) * 1e-6,
            });
        }
        Ok(out)
    }

    fn sphere(
        &mut self,
        index: usize,
        sphere: &noisefloor_scenes::Sphere,
        check: &Check<'_>,
    ) -> Result<(), RenderError> {
        let material = self.material(sphere.material, &format!("sphere {index}"), check)?;
        check.point(sphere.center, || format!("sphere {index}, centre"))?;
        check.range(sphere.radius, 1e-15..=1e15, "positive", || format!("sphere {index}, radius"))?;
        let mut geometry = Geometry::sphere(sphere.center.into(), sphere.radius, material);
        let surface = &self.surfaces[material as usize];
        if surface.emits {
            geometry.light = self.lights.sphere(sphere.center.into(), sphere.radius, surface.emission);
        }
        self.geometry.push(geometry);
        self.primitives.push(Primitive::Sphere(sphere.center.into(), sphere.radius));
        Ok(())
    }

    fn material(&self, index: usize, what: &str, check: &Check<'_>) -> Result<u32, RenderError> {
        if index >= self.surfaces.len() {
            return check.fail(format!("{what}, material"), index, "below the number of materials");
        }
        Ok(index as u32)
    }
}

/// Checks of numbers, with the scene's name for messages.
struct Check<'a>(&'a str);

impl Check<'_> {
    fn fail<T>(&self, what: String, value: impl ToString, expected: &'static str) -> Result<T, RenderError> {
        Err(RenderError::InvalidScene { scene: self.0.into(), what, value: value.to_string(), expected })
    }

    /// Coordinates whose squares do not overflow.
    fn point(&self, p: Vec3, what: impl FnOnce() -> String) -> Result<(), RenderError> {
        if p.is_finite() && p.abs().max_element() <= 1e15 {
            return Ok(());
        }
        self.fail(what(), p, "finite and at most 1e15")
    }

    fn range(
        &self,
        value: f32,
        range: std::ops::RangeInclusive<f32>,
        expected: &'static str,
        what: impl FnOnce() -> String,
    ) -> Result<(), RenderError> {
        if range.contains(&value) {
            return Ok(());
        }
        self.fail(what(), value, expected)
    }

    fn radiance(&self, value: Vec3, what: impl FnOnce() -> String) -> Result<(), RenderError> {
        if value.is_finite() && value.min_element() >= 0.0 && value.max_element() <= MOST_RADIANCE {
            return Ok(());
        }
        self.fail(what(), value, "finite, not negative and at most 1e15")
    }

    fn reflectance(&self, value: Vec3, what: impl FnOnce() -> String) -> Result<(), RenderError> {
        if value.min_element() >= 0.0 && value.max_element() <= 1.0 && value.is_finite() {
            return Ok(());
        }
        self.fail(what(), value, "in 0..=1")
    }

    fn scene(&self, scene: &Scene) -> Result<(), RenderError> {
        self.camera(&scene.camera)?;
        for material in &scene.materials {
            self.material(material)?;
        }
        if let Some(sun) = scene.sun {
            self.point(sun.direction, || "sun direction".into())?;
            if sun.direction.length_squared() < 1e-12 {
                return self.fail("sun direction".into(), sun.direction, "not zero");
            }
            self.range(sun.half_angle_degrees, 1e-3..=10.0, "in 0.001..=10 degrees", || {
                "sun half angle".into()
            })?;
            self.radiance(sun.irradiance, || "sun irradiance".into())?;
            let sin = sun.half_angle_degrees.to_radians().sin();
            let radiance = sun.irradiance.max_element() / (std::f32::consts::PI * sin * sin);
            self.range(radiance, 0.0..=1e18, "at most 1e18", || "sun radiance".into())?;
        }
        let problem = scene.medium.as_ref().and_then(|medium| medium.problem(scene));
        let problem = problem.or_else(|| scene.animation.as_ref().and_then(|a| a.problem(scene)));
        if let Some((what, value, allowed)) = problem {
            return self.fail(what, value, allowed);
        }
        match &scene.sky {
            Some(Sky::Constant(radiance)) => self.radiance(*radiance, || "sky".into()),
            Some(Sky::Gradient { horizon, zenith, ground }) => [horizon, zenith, ground]
                .into_iter()
                .try_for_each(|radiance| self.radiance(*radiance, || "sky".into())),
            Some(Sky::Map(map)) => match map.problem() {
                Some((what, value)) => self.fail(what, value, EnvironmentMap::ALLOWED),
                None => Ok(()),
            },
            None => Ok(()),
        }
    }

    fn camera(&self, camera: &CameraSpec) -> Result<(), RenderError> {
        for (name, p) in [("eye", camera.eye), ("target", camera.target), ("up", camera.up)] {
            self.point(p, || format!("camera {name}"))?;
        }
        let forward = (camera.target - camera.eye).normalize_or_zero();
        if forward.cross(camera.up.normalize_or_zero()).length() < 1e-4 {
            return self.fail(
                "camera up".into(),
                camera.up,
                "not along the line of sight, and eye apart from target",
            );
        }
        let fov = camera.vertical_fov_degrees;
        self.range(fov, 1e-3..=179.0, "in 0.001..=179 degrees", || "camera field of view".into())?;
        if let Some(lens) = camera.lens {
            self.range(lens.radius, 0.0..=1e15, "not negative", || "lens radius".into())?;
            self.range(lens.focus_distance, 1e-6..=1e15, "positive", || "focus distance".into())?;
        }
        Ok(())
    }

    fn material(&self, m: &Material) -> Result<(), RenderError> {
        let of = |part: &str| format!("material `{}`, {part}", m.name);
        self.radiance(m.emission, || of("emission"))?;
        match &m.scattering {
            Scattering::Diffuse { albedo: Color::Constant(c) } => self.reflectance(*c, || of("albedo")),
            Scattering::Mirror { reflectance } => self.reflectance(*reflectance, || of("reflectance")),
            Scattering::Glass { ior } => self.range(*ior, 1.0..=10.0, "in 1..=10", || of("refractive index")),
            Scattering::Conductor { f0, alpha } => {
                self.range(*alpha, f32::MIN_POSITIVE..=1.0, "in (0, 1]", || of("alpha"))?;
                match f0 {
                    Color::Constant(c) => self.reflectance(*c, || of("f0")),
                    Color::Texture(_) => Ok(()),
                }
            }
            Scattering::Diffuse { albedo: Color::Texture(_) } => Ok(()),
        }
    }
}
