//! Base colours: vertex colours, textures that are not shown, names of image files.

use super::*;

/// The square with colours of its vertices, as floating-point numbers.
fn colored(colors: [[f32; 3]; 4]) -> Value {
    let mut value = square();
    let bytes: Vec<u8> = colors.iter().flatten().flat_map(|v| v.to_le_bytes()).collect();
    value["buffers"].as_array_mut().unwrap().push(json!({ "byteLength": 48, "uri": uri(&bytes) }));
    value["bufferViews"].as_array_mut().unwrap().push(json!({ "buffer": 1, "byteLength": 48 }));
    value["accessors"]
        .as_array_mut()
        .unwrap()
        .push(json!({ "bufferView": 3, "componentType": 5126, "count": 4, "type": "VEC3" }));
    value["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(3);
    let plain = json!({ "metallicFactor": 0.0, "baseColorFactor": [1.0, 0.5, 1.0, 1.0] });
    value["materials"][0]["pbrMetallicRoughness"] = plain;
    value
}

/// Red on the left, green on the right.
const RED_TO_GREEN: [[f32; 3]; 4] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]];

#[test]
fn vertex_colours_are_multiplied_into_the_base_colour_and_run_from_vertex_to_vertex() {
    let Loaded { scene, notices, .. } = load_json(&colored(RED_TO_GREEN)).unwrap();
    assert!(!notices.iter().any(|n| n.contains("left out")), "{notices:?}");
    let Scattering::Diffuse { albedo: Color::Texture(texture) } = &scene.materials[0].scattering else {
        panic!("{:?}", scene.materials[0]);
    };
    let mesh = &scene.meshes[0];
    for triangle in &mesh.triangles {
        let corners = triangle.map(|i| i as usize);
        let middle = corners.iter().fold(Vec2::ZERO, |sum, &i| sum + mesh.uvs[i] / 3.0);
        let x = corners.iter().map(|&i| mesh.positions[i].x).sum::<f32>() / 3.0;
        // From −2 to 2, half as green as it is in the file.
        let right = (x + 2.0) / 4.0;
        let found = texture.eval(middle);
        assert!((found - Vec3::new(1.0 - right, 0.5 * right, 0.0)).length() < 1e-4, "{x}: {found}");
    }
}

#[test]
fn one_vertex_colour_is_a_factor_with_and_without_a_texture() {
    let same = [[0.5, 0.5, 0.25]; 4];
    let scene = load_json(&colored(same)).unwrap().scene;
    let expected = Scattering::Diffuse { albedo: Color::Constant(Vec3::new(0.5, 0.25, 0.25)) };
    assert_eq!(scene.materials[0].scattering, expected);
    let mut value = colored(same);
    value["materials"] = square()["materials"].clone();
    let scene = load_json(&value).unwrap().scene;
    let Scattering::Diffuse { albedo: Color::Texture(texture) } = &scene.materials[0].scattering else {
        panic!("{:?}", scene.materials[0]);
    };
    assert!((texture.eval(Vec2::new(0.75, 0.5)) - Vec3::new(0.25, 0.0, 0.0)).length() < 1e-6);
}

#[test]
fn vertex_colours_that_cannot_be_shown_beside_a_texture_are_told() {
    let mut value = colored(RED_TO_GREEN);
    value["materials"] = square()["materials"].clone();
    let notices = load_json(&value).unwrap().notices;
    assert!(notices.iter().any(|n| n.contains("vertex colours")), "{notices:?}");
}

#[test]
fn vertex_colours_may_be_normalised_and_have_an_opacity() {
    let mut value = colored(RED_TO_GREEN);
    value["buffers"][1] = json!({ "byteLength": 16, "uri": uri(&[255, 51, 0, 7].repeat(4)) });
    value["bufferViews"][3] = json!({ "buffer": 1, "byteLength": 16 });
    value["accessors"][3] =
        json!({ "bufferView": 3, "componentType": 5121, "normalized": true, "count": 4, "type": "VEC4" });
    let scene = load_json(&value).unwrap().scene;
    let expected = Scattering::Diffuse { albedo: Color::Constant(Vec3::new(1.0, 0.1, 0.0)) };
    assert_eq!(scene.materials[0].scattering, expected);
}

#[test]
fn wrong_vertex_colours_are_refused() {
    let mut value = colored([[0.0, f32::NAN, 0.0]; 4]);
    let told = load_json(&value).unwrap_err().to_string();
    assert!(told.contains("quad.gltf: node 0: the colour of vertex 0"), "{told}");
    value["accessors"][3]["count"] = json!(3);
    let told = load_json(&value).unwrap_err().to_string();
    assert!(told.contains("4 vertices but 3 vertex colours"), "{told}");
}

#[test]
fn a_texture_that_has_no_coordinates_gives_its_mean() {
    let mut value = square();
    value["meshes"][0]["primitives"][0]["attributes"].as_object_mut().unwrap().remove("TEXCOORD_0");
    let Loaded { scene, notices, .. } = load_json(&value).unwrap();
    let Scattering::Diffuse { albedo: Color::Constant(color) } = scene.materials[0].scattering else {
        panic!("{:?}", scene.materials[0]);
    };
    // The mean of grey 0.502886 and red, times the factor (0.5, 1, 1).
    let expected = Vec3::new(0.25 * 1.502_886, 0.251_443, 0.251_443);
    assert!((color - expected).length() < 1e-5, "{color}");
    assert!(notices.iter().any(|n| n.contains("mean colour")), "{notices:?}");
}

#[test]
fn images_in_a_format_that_is_not_read_are_told() {
    let mut value = square();
    value["images"][0]["uri"] = json!(uri(&[0xff, 0xd8, 0xff, 0xe0]));
    let Loaded { scene, notices, .. } = load_json(&value).unwrap();
    let factor = Scattering::Diffuse { albedo: Color::Constant(Vec3::new(0.5, 1.0, 1.0)) };
    assert_eq!(scene.materials[0].scattering, factor);
    assert!(notices.iter().any(|n| n.contains("JPEG")), "{notices:?}");
}

#[test]
fn image_files_are_found_by_every_escape_of_their_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("quad.gltf");
    let png = png_of(2, 1, &[188, 188, 188, 255, 0, 0]);
    for (name, escaped) in
        [("tex é#1.png", "tex%20%C3%A9%231.png"), ("50%.png", "50%.png"), ("a%20b.png", "a%20b.png")]
    {
        std::fs::write(folder.path().join(name), &png).unwrap();
        let mut value = square();
        value["images"][0]["uri"] = json!(escaped);
        std::fs::write(&path, value.to_string()).unwrap();
        let loaded = load(&path).unwrap();
        assert_eq!(loaded.scene, load_json(&square()).unwrap().scene, "{escaped}");
        assert_eq!(loaded.files, [path.clone(), folder.path().join(name)], "{escaped}");
    }
    let mut value = square();
    for bad in ["%FF%FE.png", "none.png", "https://example.org/a.png"] {
        value["images"][0]["uri"] = json!(bad);
        std::fs::write(&path, value.to_string()).unwrap();
        assert!(load(&path).is_err(), "{bad}");
    }
}
