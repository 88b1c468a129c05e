//! Bytes to a document whose every index exists.
//!
//! The parser takes some references on trust and panics where they lead nowhere. They are checked here first, so that
//! the message names the place; whatever else makes it panic becomes an error, too.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use gltf::json::Root;
use gltf::json::camera::Type;
use gltf::json::validation::Checked;
use gltf::{Document, Gltf};

use crate::GltfError;

/// Length of the header of a binary file.
const BINARY_HEADER: usize = 12;

/// The document in `bytes`, which were read from `path`.
pub fn parse(bytes: &[u8], path: &Path) -> Result<Gltf, GltfError> {
    let syntax = |source| GltfError::Syntax { path: path.to_owned(), source };
    check_header(bytes)?;
    let Gltf { document, blob } = guard(|| Gltf::from_slice_without_validation(bytes).map_err(syntax))?;
    let root = document.into_json();
    check_attributes(&root)?;
    check_images(&root)?;
    check_cameras(&root)?;
    let document = guard(|| Document::from_json(root).map_err(syntax))?;
    Ok(Gltf { document, blob })
}

/// Calls something that may panic on hostile files; what it leaves half-done is dropped.
pub fn guard<T>(call: impl FnOnce() -> Result<T, GltfError>) -> Result<T, GltfError> {
    catch_unwind(AssertUnwindSafe(call)).unwrap_or_else(|panic| {
        let said = panic.downcast_ref::<String>().map(String::as_str);
        let said = said.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no reason given");
        Err(GltfError::data("the file", format!("the parser gave up: {said}")))
    })
}

fn check_header(bytes: &[u8]) -> Result<(), GltfError> {
    let Some(length) = bytes.strip_prefix(b"glTF").and_then(|rest| rest.get(4..8)) else { return Ok(()) };
    let length = u32::from_le_bytes([length[0], length[1], length[2], length[3]]);
    if (length as usize) < BINARY_HEADER {
        let problem = format!("says that the file has {length} bytes, fewer than the header itself");
        return Err(GltfError::data("the binary header", problem));
    }
    Ok(())
}

fn check_attributes(root: &Root) -> Result<(), GltfError> {
    let count = root.accessors.len();
    for (m, mesh) in root.meshes.iter().enumerate() {
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            for (name, index) in &primitive.attributes {
                if index.value() >= count {
                    let name = match name {
                        Checked::Valid(name) => name.to_string(),
                        Checked::Invalid => "an attribute".to_owned(),
                    };
                    let what = format!("mesh {m}, primitive {p}, {name}");
                    let problem = format!("is accessor {}, but there are {count}", index.value());
                    return Err(GltfError::data(what, problem));
                }
            }
        }
    }
    Ok(())
}

fn check_images(root: &Root) -> Result<(), GltfError> {
    for (i, image) in root.images.iter().enumerate() {
        let problem = match (&image.uri, &image.buffer_view, &image.mime_type) {
            (None, None, _) => "has neither a URI nor a buffer view",
            (_, Some(_), None) => "lies in a buffer view, but has no mimeType",
            _ => continue,
        };
        return Err(GltfError::image(i, problem));
    }
    Ok(())
}

fn check_cameras(root: &Root) -> Result<(), GltfError> {
    for (i, camera) in root.cameras.iter().enumerate() {
        let lacks = match camera.type_ {
            Checked::Valid(Type::Perspective) if camera.perspective.is_none() => "perspective",
            Checked::Valid(Type::Orthographic) if camera.orthographic.is_none() => "orthographic",
            _ => continue,
        };
        let problem = format!("has the type `{lacks}`, but no numbers for it");
        return Err(GltfError::data(format!("camera {i}"), problem));
    }
    Ok(())
}
