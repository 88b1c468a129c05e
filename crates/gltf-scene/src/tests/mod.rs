mod colors;
mod hostile;
mod light;
mod mutations;

use std::ops::ControlFlow;
use std::path::PathBuf;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use glam::{Vec2, Vec3};
use noisefloor_render::{Prepared, Recorded, RenderRequest, render};
use noisefloor_scenes::{Color, Scattering, Sky};
use serde_json::{Value, json};

use crate::{GltfError, Loaded, load};

/// A square of side 2 around the origin in the plane z = 0, facing +Z.
const SQUARE: [[f32; 3]; 4] = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];

fn uri(bytes: &[u8]) -> String {
    format!("data:application/octet-stream;base64,{}", STANDARD.encode(bytes))
}

/// A PNG file of sRGB colours.
fn png_of(width: u32, height: u32, bytes: &[u8]) -> Vec<u8> {
    let mut out = Vec::new();
    let mut encoder = png::Encoder::new(&mut out, width, height);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(bytes).unwrap();
    writer.finish().unwrap();
    out
}

/// A 2x1 image: a pixel of sRGB 188, then a red one.
fn image() -> String {
    uri(&png_of(2, 1, &[188, 188, 188, 255, 0, 0]))
}

fn file(positions: [[f32; 3]; 4], indices: [u16; 6]) -> Value {
    let mut bytes: Vec<u8> = positions.iter().flatten().flat_map(|v| v.to_le_bytes()).collect();
    let uvs = [[0.0f32, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];
    bytes.extend(uvs.iter().flatten().flat_map(|v| v.to_le_bytes()));
    bytes.extend(indices.iter().flat_map(|v| v.to_le_bytes()));
    json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0, 1] }],
        "nodes": [
            { "mesh": 0, "translation": [0.0, 0.0, -3.0], "scale": [2.0, 2.0, 1.0] },
            { "camera": 0, "translation": [0.0, 0.0, -2.0] }
        ],
        "cameras": [{ "type": "perspective", "perspective": { "yfov": 1.0, "znear": 0.1 } }],
        "meshes": [{ "primitives": [
            { "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "indices": 2, "material": 0 }
        ] }],
        "materials": [{ "pbrMetallicRoughness": {
            "baseColorTexture": { "index": 0 }, "baseColorFactor": [0.5, 1.0, 1.0, 1.0],
            "metallicFactor": 0.0
        } }],
        "textures": [{ "source": 0 }],
        "images": [{ "uri": image() }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
              "min": [-1, -1, 0], "max": [1, 1, 0] },
            { "bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2" },
            { "bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR" }
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 48 },
            { "buffer": 0, "byteOffset": 48, "byteLength": 32 },
            { "buffer": 0, "byteOffset": 80, "byteLength": 12 }
        ],
        "buffers": [{ "byteLength": 92, "uri": uri(&bytes) }]
    })
}

fn square() -> Value {
    file(SQUARE, [0, 1, 2, 0, 2, 3])
}

/// A GLB file, with a binary chunk if there is something to put into it.
fn binary(json: &Value, chunk: &[u8]) -> Vec<u8> {
    let padded = |bytes: &[u8], by: u8| {
        let mut bytes = bytes.to_vec();
        bytes.resize(bytes.len().next_multiple_of(4), by);
        bytes
    };
    let mut body = Vec::new();
    for (kind, bytes) in [(b"JSON", padded(json.to_string().as_bytes(), b' ')), (b"BIN\0", padded(chunk, 0))]
    {
        if !bytes.is_empty() {
            body.extend((bytes.len() as u32).to_le_bytes());
            body.extend(kind);
            body.extend(bytes);
        }
    }
    let mut out = b"glTF\x02\0\0\0".to_vec();
    out.extend((12 + body.len() as u32).to_le_bytes());
    out.extend(body);
    out
}

fn load_bytes(bytes: &[u8]) -> Result<Loaded, GltfError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("quad.gltf");
    std::fs::write(&path, bytes).unwrap();
    load(&path)
}

fn load_json(value: &Value) -> Result<Loaded, GltfError> {
    load_bytes(value.to_string().as_bytes())
}

fn refused(spoil: impl FnOnce(&mut Value)) -> String {
    let mut value = square();
    spoil(&mut value);
    load_json(&value).expect_err("the file was spoilt").to_string()
}

#[test]
fn a_textured_square_has_its_colours_its_place_and_its_camera() {
    let Loaded { scene, notices, .. } = load_json(&square()).unwrap();
    assert_eq!(scene.id, "quad");
    assert_eq!(scene.meshes[0].positions[2], Vec3::new(2.0, 2.0, -3.0));
    assert_eq!(scene.camera.eye, Vec3::new(0.0, 0.0, -2.0));
    assert_eq!(scene.camera.target, Vec3::new(0.0, 0.0, -3.0));
    assert!((scene.camera.vertical_fov_degrees - 57.295_78).abs() < 1e-4);
    assert_eq!(scene.sky, Some(Sky::Constant(Vec3::ONE)));
    assert!(notices.iter().any(|n| n.contains("constant sky")), "{notices:?}");
    let Scattering::Diffuse { albedo: Color::Texture(texture) } = &scene.materials[0].scattering else {
        panic!("{:?}", scene.materials[0]);
    };
    // sRGB 188 is ((188/255 + 0.055)/1.055)^2.4 = 0.502886 in linear light; the factor halves red.
    let expected = Vec3::new(0.251_443, 0.502_886, 0.502_886);
    assert!((texture.eval(Vec2::new(0.25, 0.5)) - expected).length() < 1e-5);
    assert!((texture.eval(Vec2::new(0.75, 0.5)) - Vec3::new(0.5, 0.0, 0.0)).length() < 1e-6);
}

#[test]
fn metal_is_a_conductor_with_the_squared_roughness() {
    let mut value = square();
    value["materials"][0]["pbrMetallicRoughness"] = json!({ "metallicFactor": 1.0, "roughnessFactor": 0.5 });
    let scene = load_json(&value).unwrap().scene;
    let expected = Scattering::Conductor { f0: Color::Constant(Vec3::ONE), alpha: 0.25 };
    assert_eq!(scene.materials[0].scattering, expected);
}

#[test]
fn an_emissive_square_that_fills_the_view_shows_exactly_its_emission() {
    let mut value = square();
    value["extensionsUsed"] = json!(["KHR_materials_emissive_strength"]);
    value["materials"] = json!([{
        "emissiveFactor": [0.5, 0.25, 1.0],
        "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 4.0 } },
        "pbrMetallicRoughness": { "baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0 }
    }]);
    let Loaded { scene, notices, .. } = load_json(&value).unwrap();
    assert!(notices.is_empty(), "{notices:?}");
    let prepared = Prepared::new(&scene).unwrap();
    let mut request = RenderRequest::new(&prepared, 16, 16, 4);
    request.record = Recorded::color_only();
    let frame = render(&request, &|_: usize| ControlFlow::Continue(())).unwrap();
    for (channel, expected) in [2.0, 1.0, 4.0].into_iter().enumerate() {
        assert!(frame.color.mean.plane(channel).iter().all(|v| *v == expected));
    }
}

#[test]
fn binary_files_are_read_like_text() {
    let bytes = binary(&square(), &[]);
    let (read, text) = (load_bytes(&bytes).unwrap(), load_json(&square()).unwrap());
    assert_eq!((read.scene, read.notices), (text.scene, text.notices));
    assert!(load_bytes(&bytes[..100]).is_err());
}

#[test]
fn what_is_left_out_is_named() {
    let mut value = square();
    value["extensionsUsed"] = json!(["KHR_lights_punctual"]);
    value["materials"][0]["doubleSided"] = json!(true);
    value["materials"][0]["alphaMode"] = json!("BLEND");
    value["scenes"][0]["nodes"] = json!([0]);
    let notices = load_json(&value).unwrap().notices.join("\n");
    for expected in ["KHR_lights_punctual", "double-sided", "alpha modes", "no perspective camera"] {
        assert!(notices.contains(expected), "{expected}: {notices}");
    }
}

#[test]
fn triangles_without_an_area_are_dropped_and_counted() {
    let loaded = load_json(&file(SQUARE, [0, 1, 2, 0, 2, 2])).unwrap();
    assert_eq!(loaded.scene.primitives(), 1);
    assert!(loaded.notices.iter().any(|n| n.contains("dropped 1 triangles")), "{:?}", loaded.notices);
    let empty = load_json(&file(SQUARE, [0; 6]));
    assert!(matches!(empty, Err(GltfError::NoTriangles { .. })), "{empty:?}");
}

#[test]
fn hostile_numbers_are_refused_with_the_place() {
    let mut nan = SQUARE;
    nan[1][0] = f32::NAN;
    let told = load_json(&file(nan, [0, 1, 2, 0, 2, 3])).unwrap_err().to_string();
    assert!(told.contains("vertex 1"), "{told}");
    let told = load_json(&file(SQUARE, [0, 1, 9, 0, 2, 3])).unwrap_err().to_string();
    assert!(told.contains("index 9 is out of range"), "{told}");
    let told = refused(|v| v["accessors"][0]["count"] = json!(1_000_000_000_000u64));
    assert!(told.contains("accessor 0: reaches beyond"), "{told}");
    let told = refused(|v| v["bufferViews"][2]["byteLength"] = json!(4_000_000_000u64));
    assert!(told.contains("buffer view 2"), "{told}");
    let told = refused(|v| v["buffers"][0]["byteLength"] = json!(1000));
    assert!(told.contains("truncated"), "{told}");
    let told = refused(|v| v["nodes"][0]["children"] = json!([0]));
    assert!(told.contains("tree"), "{told}");
    let told = refused(|v| v["images"][0]["uri"] = json!(uri(b"")));
    assert!(told.contains("image 0"), "{told}");
    assert!(matches!(load_bytes(b"not a scene"), Err(GltfError::Syntax { .. })));
    assert!(matches!(load(&PathBuf::from("no/such.glb")), Err(GltfError::Io { .. })));
}

#[test]
fn lights_without_an_area_are_dropped_and_counted() {
    let mut value = square();
    value["materials"].as_array_mut().unwrap().push(json!({ "emissiveFactor": [1.0, 1.0, 1.0] }));
    let primitives = value["meshes"][0]["primitives"].as_array_mut().unwrap();
    // Two corners make no triangle.
    let point = json!({ "attributes": { "POSITION": 0 }, "indices": 3, "material": 1 });
    primitives.push(point);
    value["accessors"].as_array_mut().unwrap().push(
        json!({ "bufferView": 2, "byteOffset": 4, "componentType": 5123, "count": 2, "type": "SCALAR" }),
    );
    let loaded = load_json(&value).unwrap();
    assert!(loaded.notices.iter().any(|n| n == "dropped 1 lights without an area"), "{:?}", loaded.notices);
    assert_eq!(loaded.scene.meshes.len(), 1);
}

#[test]
fn an_image_of_no_pixels_is_refused() {
    let mut bytes = STANDARD.decode(image().split_once(',').unwrap().1).unwrap();
    // The width, after the signature and the length and name of the first chunk.
    bytes[16..20].fill(0);
    let told = refused(|v| v["images"][0]["uri"] = json!(uri(&bytes)));
    assert!(told.contains("image 0"), "{told}");
}
