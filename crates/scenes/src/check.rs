//! Whether a scene can be rendered.

mod animation;
mod medium;

use glam::{Vec2, Vec3};
use thiserror::Error;

use crate::{Color, EnvironmentMap, MOST_RADIANCE, Material, Mesh, Scattering, Scene, Sky};

/// Why a scene cannot be rendered.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SceneError {
    /// No mesh with triangles and no sphere.
    #[error("scene `{scene}` has neither triangles nor spheres")]
    Empty {
        /// The scene's id.
        scene: String,
    },
    /// A mesh or sphere names a material that does not exist.
    #[error("scene `{scene}`: {what} uses material {index}, but there are {count}")]
    MissingMaterial {
        /// The scene's id.
        scene: String,
        /// Which mesh or sphere.
        what: String,
        /// What it asks for.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A part of a mesh does not fit its vertices.
    #[error("scene `{scene}`: mesh {mesh}: {problem}")]
    BadMesh {
        /// The scene's id.
        scene: String,
        /// Index of the mesh.
        mesh: usize,
        /// What is wrong and where.
        problem: String,
    },
    /// A number out of its range.
    #[error("scene `{scene}`: {what} is {value}, allowed is {allowed}")]
    OutOfRange {
        /// The scene's id.
        scene: String,
        /// Which quantity of which part.
        what: String,
        /// Its value.
        value: String,
        /// The allowed range.
        allowed: &'static str,
    },
}

impl Scene {
    /// Checks everything that a renderer relies on: finite numbers in their ranges, indices that exist, unit normals,
    /// triangles with an area.
    ///
    /// # Errors
    ///
    /// The first problem found, naming the part.
    pub fn check(&self) -> Result<(), SceneError> {
        if self.spheres.is_empty() && self.meshes.iter().all(|m| m.triangles.is_empty()) {
            return Err(SceneError::Empty { scene: self.id.to_string() });
        }
        self.check_camera()?;
        self.check_light()?;
        let problem = self.medium.as_ref().and_then(|medium| medium.problem(self));
        let problem =
            problem.or_else(|| self.animation.as_ref().and_then(|animation| animation.problem(self)));
        if let Some((what, value, allowed)) = problem {
            return Err(SceneError::OutOfRange { scene: self.id.to_string(), what, value, allowed });
        }
        self.materials.iter().try_for_each(|m| self.check_material(m))?;
        for (i, mesh) in self.meshes.iter().enumerate() {
            self.check_index(|| format!("mesh {i}"), mesh.material)?;
            mesh_problem(mesh).map_or(Ok(()), |problem| {
                Err(SceneError::BadMesh { scene: self.id.to_string(), mesh: i, problem })
            })?;
            if mesh.uvs.is_empty() && self.materials[mesh.material].is_textured() {
                let problem = "has no texture coordinates, but its material is textured".to_owned();
                return Err(SceneError::BadMesh { scene: self.id.to_string(), mesh: i, problem });
            }
        }
        for (i, sphere) in self.spheres.iter().enumerate() {
            self.check_index(|| format!("sphere {i}"), sphere.material)?;
            self.finite(|| format!("centre of sphere {i}"), sphere.center)?;
            self.within(
                || format!("radius of sphere {i}"),
                sphere.radius,
                "finite and above 0",
                |r| r > 0.0,
            )?;
        }
        Ok(())
    }

    fn check_camera(&self) -> Result<(), SceneError> {
        let c = &self.camera;
        self.finite(|| "the camera's eye".into(), c.eye)?;
        self.finite(|| "the camera's target".into(), c.target)?;
        self.finite(|| "the camera's up".into(), c.up)?;
        let sideways = (c.target - c.eye).normalize_or_zero().cross(c.up.normalize_or_zero()).length();
        self.within(
            || "the sine between the camera's view and its up".into(),
            sideways,
            "above 0.0001",
            |s| s > 1e-4,
        )?;
        self.within(
            || "the field of view".into(),
            c.vertical_fov_degrees,
            "inside (0, 180)",
            |f| f > 0.0 && f < 180.0,
        )?;
        c.lens.map_or(Ok(()), |lens| {
            self.within(|| "the lens's radius".into(), lens.radius, "finite and at least 0", |r| r >= 0.0)?;
            self.within(
                || "the focus distance".into(),
                lens.focus_distance,
                "finite and above 0",
                |d| d > 0.0,
            )
        })
    }

    fn check_light(&self) -> Result<(), SceneError> {
        if let Some(sun) = self.sun {
            self.within(|| "the length of the sun's direction".into(), sun.direction.length(), "1", is_unit)?;
            self.within(
                || "the sun's half angle".into(),
                sun.half_angle_degrees,
                "in (0, 10] degrees",
                |a| a > 0.0 && a <= 10.0,
            )?;
            self.radiance(|| "the sun's irradiance".into(), sun.irradiance)?;
        }
        match &self.sky {
            None => Ok(()),
            Some(Sky::Constant(c)) => self.radiance(|| "the sky".into(), *c),
            Some(Sky::Gradient { horizon, zenith, ground }) => {
                [horizon, zenith, ground].into_iter().try_for_each(|c| self.radiance(|| "the sky".into(), *c))
            }
            Some(Sky::Map(map)) => map.problem().map_or(Ok(()), |(what, value)| {
                Err(SceneError::OutOfRange {
                    scene: self.id.to_string(),
                    what,
                    value,
                    allowed: EnvironmentMap::ALLOWED,
                })
            }),
        }
    }

    fn check_material(&self, material: &Material) -> Result<(), SceneError> {
        let name = &material.name;
        self.radiance(|| format!("the emission of `{name}`"), material.emission)?;
        let reflectance = |c: Vec3| {
            self.within(
                || format!("the reflectance of `{name}`"),
                c.max_element(),
                "in [0, 1]",
                |v| v <= 1.0,
            )?;
            self.within(|| format!("the reflectance of `{name}`"), c.min_element(), "in [0, 1]", |v| v >= 0.0)
        };
        match &material.scattering {
            Scattering::Diffuse { albedo: Color::Constant(c) } => reflectance(*c),
            Scattering::Mirror { reflectance: c } => reflectance(*c),
            Scattering::Glass { ior } => {
                self.within(|| format!("the refractive index of `{name}`"), *ior, "above 1", |v| v > 1.0)
            }
            Scattering::Conductor { f0, alpha } => {
                if let Color::Constant(c) = f0 {
                    reflectance(*c)?;
                }
                self.within(
                    || format!("the roughness of `{name}`"),
                    *alpha,
                    "in (0, 1]",
                    |a| a > 0.0 && a <= 1.0,
                )
            }
            Scattering::Diffuse { albedo: Color::Texture(_) } => Ok(()),
        }
    }

    fn check_index(&self, what: impl Fn() -> String, index: usize) -> Result<(), SceneError> {
        let count = self.materials.len();
        if index < count {
            return Ok(());
        }
        Err(SceneError::MissingMaterial { scene: self.id.to_string(), what: what(), index, count })
    }

    fn finite(&self, what: impl Fn() -> String, v: Vec3) -> Result<(), SceneError> {
        if v.is_finite() {
            return Ok(());
        }
        Err(SceneError::OutOfRange {
            scene: self.id.to_string(),
            what: what(),
            value: v.to_string(),
            allowed: "finite",
        })
    }

    fn radiance(&self, what: impl Fn() -> String, v: Vec3) -> Result<(), SceneError> {
        self.finite(&what, v)?;
        self.within(&what, v.min_element(), "at least 0", |c| c >= 0.0)?;
        self.within(what, v.max_element(), "at most 1e15", |c| c <= MOST_RADIANCE)
    }

    fn within(
        &self,
        what: impl Fn() -> String,
        value: f32,
        allowed: &'static str,
        ok: impl Fn(f32) -> bool,
    ) -> Result<(), SceneError> {
        if value.is_finite() && ok(value) {
            return Ok(());
        }
        Err(SceneError::OutOfRange {
            scene: self.id.to_string(),
            what: what(),
            value: value.to_string(),
            allowed,
        })
    }
}

impl Material {
    /// Whether a texture is looked up on the surface.
    #[must_use]
    pub fn is_textured(&self) -> bool {
        match &self.scattering {
            Scattering::Diffuse { albedo: c } | Scattering::Conductor { f0: c, .. } => {
                matches!(c, Color::Texture(_))
            }
            Scattering::Mirror { .. } | Scattering::Glass { .. } => false,
        }
    }
}

/// Room for rounding in `f32` of a vector that was normalised.
fn is_unit(length: f32) -> bool {
    (length - 1.0).abs() <= 1e-5
}

fn mesh_problem(mesh: &Mesh) -> Option<String> {
    let n = mesh.positions.len();
    for (what, length) in [("normals", mesh.normals.len()), ("texture coordinates", mesh.uvs.len())] {
        if length != 0 && length != n {
            return Some(format!("{n} vertices but {length} {what}"));
        }
    }
    if let Some(i) = mesh.positions.iter().position(|p| !p.is_finite()) {
        return Some(format!("vertex {i} is at {}", mesh.positions[i]));
    }
    if let Some(i) = mesh.uvs.iter().position(|p: &Vec2| !p.is_finite()) {
        return Some(format!("texture coordinates of vertex {i} are {}", mesh.uvs[i]));
    }
    if let Some(i) = mesh.normals.iter().position(|p| !is_unit(p.length())) {
        return Some(format!("normal of vertex {i} has length {}", mesh.normals[i].length()));
    }
    mesh.triangles.iter().enumerate().find_map(|(i, triangle)| {
        if let Some(&v) = triangle.iter().find(|&&v| v as usize >= n) {
            return Some(format!("triangle {i} uses vertex {v} of {n}"));
        }
        let [a, b, c] = triangle.map(|v| mesh.positions[v as usize].as_dvec3());
        let (u, v) = (b - a, c - a);
        // Twice the area against the squared sides: zero for a needle or a point, whatever the unit of length.
        let slender = u.cross(v).length() <= 1e-7 * u.length_squared().max(v.length_squared());
        slender.then(|| format!("triangle {i} has no area"))
    })
}

#[cfg(test)]
mod tests;
