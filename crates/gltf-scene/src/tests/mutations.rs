//! Damaged files of both kinds: each is a scene or an error, and a scene that is accepted can be prepared or refused.

use super::*;

/// A generator that is the same everywhere (SplitMix64).
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % n as u64) as usize
    }
}

/// What numbers in a file are replaced by.
const NUMBERS: [&str; 12] = [
    "0",
    "-1",
    "1",
    "255",
    "65536",
    "4294967295",
    "4294967296",
    "18446744073709551615",
    "1e39",
    "-1e39",
    "1e-45",
    "0.5",
];

fn mutate(bytes: &mut Vec<u8>, random: &mut Random) {
    for _ in 0..=random.below(3) {
        let at = random.below(bytes.len());
        match random.below(7) {
            0 => bytes[at] = random.below(256) as u8,
            1 => bytes[at] ^= 1 << random.below(8),
            2 => bytes.truncate(at.max(1)),
            3 => {
                let end = (at + 1 + random.below(16)).min(bytes.len());
                let part = bytes[at..end].to_vec();
                bytes.splice(at..at, part);
            }
            4 => {
                let end = (at + 1 + random.below(16)).min(bytes.len() - 1).max(at);
                bytes.drain(at..end);
            }
            // Half of all changes hit a number: they are what references and sizes are.
            _ => {
                let Some(start) = (at..bytes.len()).find(|&i| bytes[i].is_ascii_digit()) else { continue };
                let rest = bytes[start..].iter().position(|b| !b.is_ascii_digit());
                let end = rest.map_or(bytes.len(), |n| start + n);
                bytes.splice(start..end, NUMBERS[random.below(NUMBERS.len())].bytes());
            }
        }
    }
}

/// A file with everything that is read: textures in buffer views, vertex colours, normals, cameras, children.
fn rich() -> (Value, Vec<u8>) {
    let mut chunk: Vec<u8> = SQUARE.iter().flatten().flat_map(|v| v.to_le_bytes()).collect();
    let uvs = [[0.0f32, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];
    chunk.extend(uvs.iter().flatten().flat_map(|v| v.to_le_bytes()));
    chunk.extend([0u16, 1, 2, 0, 2, 3].iter().flat_map(|v| v.to_le_bytes()));
    chunk.extend([0.0f32, 0.0, 1.0].repeat(4).iter().flat_map(|v| v.to_le_bytes()));
    chunk.extend([255, 0, 0, 255, 0, 255, 0, 255].repeat(2));
    let image = png_of(2, 1, &[188, 188, 188, 255, 0, 0]);
    let mut value = square();
    value["buffers"] = json!([{ "byteLength": chunk.len() + image.len() }]);
    let views = value["bufferViews"].as_array_mut().unwrap();
    views.push(json!({ "buffer": 0, "byteOffset": 92, "byteLength": 48, "byteStride": 12 }));
    views.push(json!({ "buffer": 0, "byteOffset": 140, "byteLength": 16 }));
    views.push(json!({ "buffer": 0, "byteOffset": chunk.len(), "byteLength": image.len() }));
    let accessors = value["accessors"].as_array_mut().unwrap();
    accessors.push(json!({ "bufferView": 3, "componentType": 5126, "count": 4, "type": "VEC3" }));
    accessors.push(
        json!({ "bufferView": 4, "componentType": 5121, "normalized": true, "count": 4, "type": "VEC4" }),
    );
    value["images"] = json!([{ "bufferView": 5, "mimeType": "image/png" }]);
    value["samplers"] = json!([{ "wrapS": 33071, "wrapT": 33648 }]);
    value["textures"] = json!([{ "source": 0, "sampler": 0 }]);
    value["meshes"].as_array_mut().unwrap().push(json!({ "primitives": [
        { "attributes": { "POSITION": 0, "NORMAL": 3, "COLOR_0": 4 }, "indices": 2, "material": 1, "mode": 5 }
    ] }));
    value["materials"].as_array_mut().unwrap().push(json!({
        "emissiveFactor": [1, 1, 1], "emissiveTexture": { "index": 0 },
        "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 2 } }
    }));
    value["nodes"].as_array_mut().unwrap().push(json!({ "mesh": 1, "rotation": [0, 0, 0, 1] }));
    value["nodes"][1]["children"] = json!([2]);
    chunk.extend(image);
    (value, chunk)
}

fn run(count: u64) {
    let (value, chunk) = rich();
    let accepted = load_bytes(&binary(&value, &chunk)).expect("the file is sound before it is damaged");
    assert_eq!(accepted.scene.meshes.len(), 2);
    let samples = [binary(&value, &chunk), square().to_string().into_bytes(), binary(&square(), &[])];
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("quad.gltf");
    let (mut read, mut refused) = (0u64, 0u64);
    for seed in 0..count {
        let mut bytes = samples[seed as usize % samples.len()].clone();
        mutate(&mut bytes, &mut Random(seed));
        std::fs::write(&path, &bytes).unwrap();
        let outcome = std::panic::catch_unwind(|| load(&path));
        match outcome.unwrap_or_else(|_| panic!("seed {seed} panics")) {
            Ok(loaded) => {
                read += 1;
                drop(Prepared::new(&loaded.scene));
            }
            Err(error) => {
                refused += 1;
                let told = error.to_string();
                assert!(told.contains("quad.gltf"), "seed {seed}: {told}");
                assert!(!told.contains("gave up"), "seed {seed} reaches a panic of the parser: {told}");
            }
        }
    }
    // Neither all nor none: the changes matter, and some leave a file that is looked at to its end.
    assert!(read > count / 50 && refused > count / 50, "{read} read, {refused} refused");
}

#[test]
fn damaged_files_are_scenes_or_errors() {
    run(600);
}

#[test]
#[ignore = "minutes; for changes of the reader"]
fn many_damaged_files_are_scenes_or_errors() {
    run(60_000);
}
