//! What shines: emissive factors and textures together or neither, and a sky where nothing does.

use super::*;

/// Black but for one white texel.
fn spark(side: usize) -> Value {
    let mut bytes = vec![0; side * side * 3];
    bytes[..3].fill(255);
    json!(uri(&png_of(side as u32, side as u32, &bytes)))
}

/// The square as a lamp with an emissive texture.
fn lamp(texture: Value) -> Value {
    let mut value = square();
    value["materials"][0]["emissiveFactor"] = json!([1.0, 0.5, 1.0]);
    value["materials"][0]["emissiveTexture"] = json!({ "index": 1 });
    value["textures"].as_array_mut().unwrap().push(json!({ "source": 1 }));
    value["images"].as_array_mut().unwrap().push(json!({ "uri": texture }));
    value
}

fn has(loaded: &Loaded, words: &str) -> bool {
    loaded.notices.iter().any(|n| n.contains(words))
}

#[test]
fn a_lamp_with_one_lit_texel_does_not_shine_all_over_and_the_sky_stays() {
    let loaded = load_json(&lamp(spark(4))).unwrap();
    assert_eq!(loaded.scene.materials[0].emission, Vec3::ZERO);
    assert_eq!(loaded.scene.sky, Some(Sky::Constant(Vec3::ONE)));
    assert!(has(&loaded, "emissive textures of more than one colour"), "{:?}", loaded.notices);
    assert!(has(&loaded, "nothing in the file shines"), "{:?}", loaded.notices);
}

#[test]
fn a_room_whose_only_lamp_has_a_texture_is_not_black() {
    let mut value = lamp(spark(4));
    // The room is the square, the lamp a speck before it.
    let material = value["materials"][0].clone();
    value["materials"] = json!([{ "pbrMetallicRoughness": { "metallicFactor": 0 } }, material]);
    value["meshes"].as_array_mut().unwrap().push(json!({ "primitives": [
        { "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "indices": 2, "material": 1 }
    ] }));
    value["nodes"]
        .as_array_mut()
        .unwrap()
        .push(json!({ "mesh": 1, "translation": [0.0, 0.0, -2.9], "scale": [0.01, 0.01, 1.0] }));
    value["scenes"][0]["nodes"] = json!([0, 1, 2]);
    let scene = load_json(&value).unwrap().scene;
    let prepared = Prepared::new(&scene).unwrap();
    let mut request = RenderRequest::new(&prepared, 16, 16, 4);
    request.record = Recorded::color_only();
    let frame = render(&request, &|_: usize| ControlFlow::Continue(())).unwrap();
    assert!(frame.color.mean.plane(1).iter().all(|v| *v > 0.1));
}

#[test]
fn an_emissive_texture_of_one_colour_is_multiplied_in() {
    // sRGB 188 is 0.502886 in linear light.
    let loaded = load_json(&lamp(json!(uri(&png_of(2, 1, &[188, 188, 188, 188, 188, 188]))))).unwrap();
    let expected = Vec3::new(0.502_886, 0.251_443, 0.502_886);
    assert!((loaded.scene.materials[0].emission - expected).length() < 1e-5);
    assert_eq!(loaded.scene.sky, None);
    assert!(!has(&loaded, "emissive"), "{:?}", loaded.notices);
    let black = load_json(&lamp(json!(uri(&png_of(1, 1, &[0; 3]))))).unwrap();
    assert_eq!(black.scene.materials[0].emission, Vec3::ZERO);
    assert!(black.scene.sky.is_some() && !has(&black, "emissive"), "{:?}", black.notices);
}

#[test]
fn a_lamp_whose_texture_is_not_read_does_not_shine() {
    let loaded = load_json(&lamp(json!(uri(&[0xff, 0xd8, 0xff, 0xe0])))).unwrap();
    assert_eq!(loaded.scene.materials[0].emission, Vec3::ZERO);
    assert!(loaded.scene.sky.is_some() && has(&loaded, "emissive textures"), "{:?}", loaded.notices);
}

#[test]
fn emission_that_is_negative_or_beyond_all_bounds_is_refused_with_file_and_material() {
    for strength in [-1.0, 1e16, 3e38] {
        let told = refused(|v| {
            v["materials"][0]["emissiveFactor"] = json!([1.0, 0.5, 1.0]);
            let strength = json!({ "emissiveStrength": strength });
            v["materials"][0]["extensions"] = json!({ "KHR_materials_emissive_strength": strength });
        });
        assert!(told.contains("quad.gltf: material 0: emits"), "{told}");
    }
    // The parser's own check: a factor is in [0, 1].
    let told = refused(|v| v["materials"][0]["emissiveFactor"] = json!([0, -1, 0]));
    assert!(told.contains("quad.gltf"), "{told}");
}
