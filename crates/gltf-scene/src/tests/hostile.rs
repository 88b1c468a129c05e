//! References that lead nowhere, numbers that mean nothing, and small files that ask for much.

use super::*;

/// Both as text and as a binary file.
fn told(value: &Value) -> String {
    let told = load_json(value).expect_err("the file was spoilt").to_string();
    assert!(told.contains("quad.gltf"), "{told}");
    let binary = load_bytes(&binary(value, &[])).expect_err("the file was spoilt").to_string();
    assert_eq!(told.split_once("quad.gltf").unwrap().1, binary.split_once("quad.gltf").unwrap().1);
    told
}

#[test]
fn references_that_lead_nowhere_name_file_and_place() {
    let place = |spoil: &dyn Fn(&mut Value), expected: &str| {
        let mut value = square();
        spoil(&mut value);
        let told = told(&value);
        assert!(told.contains(expected), "{expected}: {told}");
    };
    place(
        &|v| v["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = json!(99),
        "mesh 0, primitive 0, POSITION: is accessor 99, but there are 3",
    );
    place(
        &|v| v["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(4_000_000_000u32),
        "mesh 0, primitive 0, COLOR_0",
    );
    place(
        &|v| v["images"][0] = json!({ "bufferView": 0 }),
        "image 0: lies in a buffer view, but has no mimeType",
    );
    place(&|v| v["images"][0] = json!({}), "image 0: has neither");
    place(
        &|v| {
            v["cameras"][0] = json!({ "type": "perspective",
            "orthographic": { "xmag": 1, "ymag": 1, "znear": 0.1, "zfar": 1 } })
        },
        "camera 0",
    );
    // The parser's own checks.
    for spoil in [
        (|v| v["scene"] = json!(7)) as fn(&mut Value),
        |v| v["scenes"][0]["nodes"] = json!([9]),
        |v| v["nodes"][0]["mesh"] = json!(9),
        |v| v["nodes"][0]["children"] = json!([9]),
        |v| v["nodes"][1]["camera"] = json!(9),
        |v| v["textures"][0]["source"] = json!(9),
        |v| v["textures"][0]["sampler"] = json!(9),
        |v| v["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = json!(9),
        |v| v["accessors"][0]["bufferView"] = json!(9),
        |v| v["accessors"][0]["componentType"] = json!(9),
        |v| v["bufferViews"][0]["buffer"] = json!(9),
        |v| v["meshes"][0]["primitives"][0]["indices"] = json!(9),
        |v| v["meshes"][0]["primitives"][0]["material"] = json!(9),
        |v| v["meshes"][0]["primitives"][0]["mode"] = json!(9),
        |v| drop(v["meshes"][0]["primitives"][0]["attributes"].as_object_mut().unwrap().remove("POSITION")),
    ] {
        let mut value = square();
        spoil(&mut value);
        told(&value);
    }
}

#[test]
fn accessors_without_elements_or_bytes_are_refused() {
    for (spoil, expected) in [
        ((|v| v["accessors"][0]["count"] = json!(0)) as fn(&mut Value), "accessor 0"),
        (|v| v["accessors"][1]["byteOffset"] = json!(u64::MAX), "accessor 1"),
        (|v| v["bufferViews"][0]["byteStride"] = json!(4), "accessor 0: has elements that overlap"),
        (|v| v["bufferViews"][0]["byteOffset"] = json!(u64::MAX), "buffer view 0"),
        (
            |v| v["buffers"][0]["uri"] = json!("data:application/octet-stream;base64,AAAA"),
            "buffer 0: is truncated",
        ),
        (|v| v["buffers"][0]["uri"] = json!("data:"), "buffer 0"),
        (|v| drop(v["buffers"][0].as_object_mut().unwrap().remove("uri")), "buffer 0: has no data"),
        (|v| v["accessors"][0]["type"] = json!("MAT4"), "accessor 0"),
        (
            |v| {
                v["accessors"][0]["sparse"] = json!({ "count": 1,
                    "indices": { "bufferView": 2, "componentType": 5123 }, "values": { "bufferView": 0 } });
            },
            "accessor 0: is sparse",
        ),
    ] {
        let mut value = square();
        spoil(&mut value);
        let told = told(&value);
        assert!(told.contains(expected), "{expected}: {told}");
    }
}

#[test]
fn numbers_without_meaning_are_refused() {
    for (spoil, expected) in [
        ((|v| v["cameras"][0]["perspective"]["yfov"] = json!(-1.0)) as fn(&mut Value), "the field of view"),
        (|v| v["cameras"][0]["perspective"]["yfov"] = json!(1e30), "the field of view"),
        (|v| v["cameras"][0]["perspective"]["yfov"] = json!(1e300), "not valid glTF"),
        (|v| v["nodes"][1]["rotation"] = json!([1e30, 0, 0, 1e30]), "node 1: has a transformation"),
        // So far away that all vertices round to one.
        (|v| v["nodes"][0]["translation"] = json!([3e38, 3e38, 3e38]), "no triangle with an area"),
        (|v| v["nodes"][1]["translation"] = json!([3e38, 3e38, 3e38]), "camera"),
    ] {
        let mut value = square();
        spoil(&mut value);
        let outcome = load_json(&value).map(|loaded| Prepared::new(&loaded.scene).map(drop));
        match outcome {
            Err(error) => {
                let source = std::error::Error::source(&error).map(ToString::to_string).unwrap_or_default();
                let told = format!("{error}: {source}");
                assert!(told.contains("quad.gltf") && told.contains(expected), "{expected}: {told}");
            }
            Ok(prepared) => assert!(prepared.is_err(), "{expected}"),
        }
    }
}

#[test]
fn graphs_that_are_no_tree_and_graphs_that_are_deep_end() {
    let mut circle = square();
    circle["nodes"] = json!([{ "children": [1] }, { "children": [0], "mesh": 0 }]);
    assert!(told(&circle).contains("tree"));
    let mut deep = square();
    let nodes = 50_000;
    let mut chain: Vec<Value> = (1..nodes).map(|i| json!({ "children": [i] })).collect();
    chain.push(json!({ "mesh": 0 }));
    deep["nodes"] = json!(chain);
    deep["scenes"][0]["nodes"] = json!([0]);
    assert_eq!(load_json(&deep).unwrap().scene.primitives(), 2);
    let nested = format!("{{\"asset\": {}", "[".repeat(100_000));
    assert!(matches!(load_bytes(nested.as_bytes()), Err(GltfError::Syntax { .. })));
    let nested = format!("{{\"asset\": {{\"version\": \"2.0\", \"extras\": {}", "[".repeat(100_000));
    assert!(matches!(load_bytes(nested.as_bytes()), Err(GltfError::Syntax { .. })));
}

#[test]
fn a_short_file_cannot_ask_for_endless_work() {
    // A million triangles without an area, a thousand times: nothing of it is kept, but all of it would be looked at.
    let mut value = square();
    value["bufferViews"][2] = json!({ "buffer": 1, "byteLength": 3_000_000 });
    let zeros = vec![0u8; 3_000_000];
    value["buffers"].as_array_mut().unwrap().push(json!({ "byteLength": 3_000_000, "uri": uri(&zeros) }));
    value["accessors"][2]["componentType"] = json!(5121);
    value["accessors"][2]["count"] = json!(3_000_000);
    value["nodes"] = json!(vec![json!({ "mesh": 0 }); 1000]);
    value["scenes"][0]["nodes"] = json!((0..1000).collect::<Vec<_>>());
    let outcome = load_json(&value);
    assert!(matches!(outcome, Err(GltfError::TooManyTriangles { .. })), "{outcome:?}");
}

#[test]
fn a_binary_header_shorter_than_itself_is_refused() {
    let whole = binary(&square(), &[]);
    for length in [0u32, 11, u32::MAX] {
        let mut bytes = whole.clone();
        bytes[8..12].copy_from_slice(&length.to_le_bytes());
        let told = load_bytes(&bytes).unwrap_err().to_string();
        assert!(told.contains("quad.gltf"), "{told}");
    }
    for cut in 0..200 {
        load_bytes(&whole[..cut]).unwrap_err();
    }
}
