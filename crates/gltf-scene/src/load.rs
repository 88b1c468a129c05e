use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use glam::{Mat4, Vec3};
use gltf::camera::Projection;
use noisefloor_scenes::{CameraSpec, Scene, Sky};

use crate::GltfError;
use crate::data::Buffers;
use crate::geometry::{mesh, size};
use crate::images::Images;
use crate::material::Materials;
use crate::parse::{guard, parse};
use crate::uri::{Fetcher, file_of, read_file};

/// The most triangles or vertices of a scene, instances counted each.
const MOST_TRIANGLES: usize = 50_000_000;

/// A scene from a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Loaded {
    /// The scene, checked; its id is the file's stem.
    pub scene: Scene,
    /// What was left out, dropped or made up, one sentence each.
    pub notices: Vec<String>,
    /// Every file that was read: the scene's own first, then buffers and images.
    pub files: Vec<PathBuf>,
}

/// Loads a `.gltf` or `.glb` file.
///
/// # Errors
///
/// [`GltfError`] if the file or one that it refers to cannot be read or is not valid, or if there is nothing to see.
pub fn load(path: &Path) -> Result<Loaded, GltfError> {
    guard(|| read(path)).map_err(|error| error.of(path))
}

fn read(path: &Path) -> Result<Loaded, GltfError> {
    let bytes = read_file(path)?;
    let mut gltf = parse(&bytes, path)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut fetcher = Fetcher::new(folder);
    let buffers = Buffers::read(&mut gltf, &mut fetcher)?;
    let document = &gltf.document;
    let files = std::iter::once(path.to_owned()).chain(named_files(document, folder)).collect();
    let id = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let unset =
        CameraSpec { eye: Vec3::Z, target: Vec3::ZERO, up: Vec3::Y, vertical_fov_degrees: 45.0, lens: None };
    let mut scene = Scene::empty(id.clone(), id, unset);
    let mut left_out = unsupported(document);
    let mut notices = Vec::new();
    let mut materials = Materials::new(Images::new(&buffers, fetcher));
    let mut camera = None;
    let (mut dropped, mut dark_lamps, mut total, mut shown) = (0, 0, 0usize, 0usize);
    let mut seen = BTreeSet::new();
    let first = document.default_scene().or_else(|| document.scenes().next());
    let mut open: Vec<_> = first.iter().flat_map(|s| s.nodes()).map(|n| (n, Mat4::IDENTITY)).collect();
    open.reverse();
    while let Some((node, parent)) = open.pop() {
        let what = format!("node {}", node.index());
        if !seen.insert(node.index()) {
            return Err(GltfError::data(what, "is reached twice, but nodes must form a tree"));
        }
        let world = parent * Mat4::from_cols_array_2d(&node.transform().matrix());
        if !world.is_finite() {
            return Err(GltfError::data(what, "has a transformation that is not finite"));
        }
        if let Some(c) = node.camera() {
            match c.projection() {
                Projection::Perspective(p) if camera.is_none() => {
                    camera = Some(perspective(world, p.yfov()));
                }
                Projection::Perspective(_) => drop(left_out.insert("cameras after the first".into())),
                Projection::Orthographic(_) => drop(left_out.insert("orthographic cameras".into())),
            }
        }
        for primitive in node.mesh().iter().flat_map(|m| m.primitives()) {
            // Before any work, and whether or not something of it is seen: a short file may use a mesh many times.
            total = total.saturating_add(size(&primitive, &buffers)?);
            if total > MOST_TRIANGLES {
                return Err(GltfError::TooManyTriangles { path: path.to_owned(), most: MOST_TRIANGLES });
            }
            let Some(shape) = mesh(&primitive, world, &buffers, &what, &mut left_out)? else {
                continue;
            };
            dropped += shape.dropped;
            if shape.mesh.triangles.is_empty() {
                let lamp = materials.emission(&primitive.material(), &mut left_out)? != Vec3::ZERO;
                dark_lamps += usize::from(lamp);
                continue;
            }
            shown += shape.mesh.triangles.len();
            let material = primitive.material();
            let mesh = materials.dress(&mut scene, shape.mesh, shape.colors, &material, &mut left_out)?;
            let index = mesh.material;
            scene.add_mesh(mesh, index);
        }
        let children: Vec<_> = node.children().map(|n| (n, world)).collect();
        open.extend(children.into_iter().rev());
    }
    if shown == 0 {
        return Err(GltfError::NoTriangles { path: path.to_owned() });
    }
    if dropped > 0 {
        notices.push(format!("dropped {dropped} triangles without an area"));
    }
    if dark_lamps > 0 {
        notices.push(format!("dropped {dark_lamps} lights without an area"));
    }
    scene.camera = camera.unwrap_or_else(|| {
        notices.push("the file has no perspective camera: looking along -Z at the whole scene".into());
        framing(&scene)
    });
    if !scene.models().area_lights {
        notices.push("nothing in the file shines: lit by a constant sky of radiance 1".into());
        scene.sky = Some(Sky::Constant(Vec3::ONE));
    }
    notices.extend(left_out.into_iter().map(|what| format!("not supported, left out: {what}")));
    scene.check().map_err(|source| GltfError::Scene { path: path.to_owned(), source })?;
    Ok(Loaded { scene, notices, files })
}

/// The files that buffers and images are in, whether or not a material shows them.
fn named_files(document: &gltf::Document, folder: &Path) -> Vec<PathBuf> {
    let written = document.as_json();
    let buffers = written.buffers.iter().filter_map(|buffer| buffer.uri.as_deref());
    let images = written.images.iter().filter_map(|image| image.uri.as_deref());
    buffers.chain(images).filter_map(|uri| file_of(uri, folder)).collect()
}

/// What the file as a whole has and a scene cannot show.
fn unsupported(document: &gltf::Document) -> BTreeSet<String> {
    let known = |name: &&str| *name != "KHR_materials_emissive_strength";
    let mut all: BTreeSet<String> = document.extensions_used().filter(known).map(str::to_owned).collect();
    let parts = [
        (document.skins().next().is_some(), "skins"),
        (document.animations().next().is_some(), "animations"),
        (document.scenes().nth(1).is_some(), "scenes other than the default one"),
    ];
    all.extend(parts.into_iter().filter(|(is, _)| *is).map(|(_, what)| what.to_owned()));
    all
}

/// A camera looks along its own -Z.
fn perspective(world: Mat4, vertical_fov: f32) -> CameraSpec {
    let eye = world.w_axis.truncate();
    CameraSpec {
        eye,
        target: eye - world.z_axis.truncate().normalize_or_zero(),
        up: world.y_axis.truncate().normalize_or_zero(),
        vertical_fov_degrees: vertical_fov.to_degrees(),
        lens: None,
    }
}

/// Sees the sphere around the bounding box, along -Z with a field of view of 45 degrees.
fn framing(scene: &Scene) -> CameraSpec {
    let points = || scene.meshes.iter().flat_map(|m| &m.positions);
    let low = points().fold(Vec3::INFINITY, |a, b| a.min(*b));
    let high = points().fold(Vec3::NEG_INFINITY, |a, b| a.max(*b));
    let target = 0.5 * low + 0.5 * high;
    let distance = 0.5 * (high - low).length() / 22.5f32.to_radians().sin();
    let eye = target + Vec3::Z * distance;
    CameraSpec { eye, target, up: Vec3::Y, vertical_fov_degrees: 45.0, lens: None }
}
