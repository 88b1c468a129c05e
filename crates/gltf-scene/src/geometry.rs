//! Primitives to meshes in world space.

use std::collections::BTreeSet;

use glam::{Mat3, Mat4, Vec2, Vec3};
use gltf::Semantic;
use gltf::accessor::Dimensions;
use gltf::mesh::{Mode, Primitive};
use noisefloor_scenes::Mesh;

use crate::GltfError;
use crate::data::Buffers;
use crate::tint::VertexColors;

/// What a primitive becomes.
pub struct Shape {
    pub mesh: Mesh,
    pub colors: Option<VertexColors>,
    /// Triangles without an area that were dropped.
    pub dropped: usize,
}

/// How many vertices or triangles a primitive has at most, without looking at more than the bounds of its data.
pub fn size(primitive: &Primitive<'_>, buffers: &Buffers) -> Result<usize, GltfError> {
    let count = |accessor: Option<gltf::Accessor<'_>>, components: usize| match accessor {
        Some(accessor) => buffers.elements(&accessor, components).map(|_| accessor.count()),
        None => Ok(0),
    };
    Ok(count(primitive.get(&Semantic::Positions), 3)?.max(count(primitive.indices(), 1)?))
}

/// The mesh of a primitive.
pub fn mesh(
    primitive: &Primitive<'_>,
    world: Mat4,
    buffers: &Buffers,
    what: &str,
    notices: &mut BTreeSet<String>,
) -> Result<Option<Shape>, GltfError> {
    let mode = primitive.mode();
    if !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
        notices.insert("points and lines".into());
        return Ok(None);
    }
    if primitive.morph_targets().next().is_some() {
        notices.insert("morph targets".into());
    }
    let Some(accessor) = primitive.get(&Semantic::Positions) else { return Ok(None) };
    let mut mesh = Mesh::default();
    for p in buffers.floats::<3>(&accessor)? {
        let p = world.transform_point3(Vec3::from(p));
        if !p.is_finite() {
            return Err(GltfError::data(what, format!("vertex {} is at {p}", mesh.positions.len())));
        }
        mesh.positions.push(p);
    }
    let n = mesh.positions.len();
    let turn = Mat3::from_mat4(world);
    if let Some(accessor) = primitive.get(&Semantic::Normals) {
        let map = turn.inverse().transpose();
        let normals = buffers.floats::<3>(&accessor)?.into_iter();
        mesh.normals = normals.map(|v| (map * Vec3::from(v)).normalize_or_zero()).collect();
        // Also of a NaN, for which no comparison holds.
        if !mesh.normals.iter().all(|v| (v.length() - 1.0).abs() <= 1e-5) {
            notices.insert(format!("the normals of {what}, of which some have no direction"));
            mesh.normals.clear();
        }
    }
    if let Some(accessor) = primitive.get(&Semantic::TexCoords(0)) {
        mesh.uvs = buffers.floats::<2>(&accessor)?.into_iter().map(Vec2::from).collect();
    }
    let colors =
        primitive.get(&Semantic::Colors(0)).map(|accessor| vertex_colors(&accessor, n, what, buffers));
    let indices = match primitive.indices() {
        Some(accessor) => buffers.indices(&accessor)?,
        None => (0..n as u32).collect(),
    };
    if let Some(bad) = indices.iter().find(|&&i| i as usize >= n) {
        return Err(GltfError::data(what, format!("index {bad} is out of range, there are {n} vertices")));
    }
    let mirrored = turn.determinant() < 0.0;
    let mut dropped = 0;
    for mut t in triangles(mode, &indices) {
        if mirrored {
            t.swap(1, 2);
        }
        if has_area(t.map(|i| mesh.positions[i as usize])) {
            mesh.triangles.push(t);
        } else {
            dropped += 1;
        }
    }
    Ok(Some(Shape { mesh, colors: colors.transpose()?, dropped }))
}

/// Linear colours, of which an opacity is left out.
fn vertex_colors(
    accessor: &gltf::Accessor<'_>,
    vertices: usize,
    what: &str,
    buffers: &Buffers,
) -> Result<VertexColors, GltfError> {
    let colors: Vec<Vec3> = if accessor.dimensions() == Dimensions::Vec4 {
        buffers.floats::<4>(accessor)?.into_iter().map(|[r, g, b, _]| Vec3::new(r, g, b)).collect()
    } else {
        buffers.floats::<3>(accessor)?.into_iter().map(Vec3::from).collect()
    };
    if colors.len() != vertices {
        let problem = format!("{vertices} vertices but {} vertex colours", colors.len());
        return Err(GltfError::data(what, problem));
    }
    if let Some(i) = colors.iter().position(|c| !c.is_finite()) {
        return Err(GltfError::data(what, format!("the colour of vertex {i} is {}", colors[i])));
    }
    Ok(VertexColors::new(colors))
}

fn triangles(mode: Mode, indices: &[u32]) -> Vec<[u32; 3]> {
    match mode {
        Mode::TriangleStrip => {
            let corners = indices.windows(3).enumerate();
            corners.map(|(i, w)| if i % 2 == 0 { [w[0], w[1], w[2]] } else { [w[1], w[0], w[2]] }).collect()
        }
        Mode::TriangleFan => {
            indices.get(1..).unwrap_or_default().windows(2).map(|w| [indices[0], w[0], w[1]]).collect()
        }
        _ => indices.chunks_exact(3).map(|w| [w[0], w[1], w[2]]).collect(),
    }
}

/// As a scene's check demands: not a needle or a point, whatever the unit of length.
fn has_area(corners: [Vec3; 3]) -> bool {
    let [a, b, c] = corners.map(|p| p.as_dvec3());
    let (u, v) = (b - a, c - a);
    u.cross(v).length() > 1e-7 * u.length_squared().max(v.length_squared())
}
