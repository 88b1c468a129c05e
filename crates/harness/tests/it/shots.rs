//! Scenes shown at a moment of their own, lit by photon maps, or read from a file.

use std::path::Path;

use crate::common::{Place, Watch, records, study};
use noisefloor_harness::HarnessError;
use noisefloor_render::Integrator;
use noisefloor_study::{Maps, Shot, Study, StudyError};

/// A tiny study of one rendered scene.
fn rendered(keys: &str) -> String {
    format!(
        "name = \"shots\"\nspp = [4]\nreplicates = 3\nwidth = 16\nheight = 12\ncoverage = [0.95]\n\
         [reference]\nspp = 64\nparts = 8\n[timing]\nwarmup = 0\nruns = 1\n\
         [[scene]]\n{keys}\n[[method]]\nid = \"mc\"\n[[method]]\nid = \"blur\"\n"
    )
}

const MAPPED: &str =
    "id = \"cornell\"\nintegrator = \"photon-mapping\"\nphotons = { paths = 3000, caustic-paths = 3000 }\n";

fn error(keys: &str) -> String {
    Study::from_toml(&rendered(keys), Path::new("shots.toml")).unwrap_err().to_string()
}

#[test]
fn intervals_are_counted_with_fixed_maps_and_void_with_fresh_ones() {
    let place = Place::new();
    let fixed = place.run(&study(&rendered(MAPPED)), &Watch::default()).unwrap();
    assert!(!fixed.coverage.is_empty());
    let first = records(&place.out());
    assert!(first.iter().all(|r| r.photon_maps == Some(Maps::Fixed)));
    let place = Place::new();
    let fresh =
        place.run(&study(&rendered(&format!("{MAPPED}maps = \"fresh\""))), &Watch::default()).unwrap();
    assert!(fresh.coverage.is_empty());
    assert!(
        fresh.warnings.iter().any(|w| w.to_string().contains("photon maps are new in each replicate")),
        "{:?}",
        fresh.warnings
    );
    let second = records(&place.out());
    assert!(second.iter().all(|r| r.photon_maps == Some(Maps::Fresh)));
    assert!(fresh.cells.iter().all(|c| c.equal_error.is_empty()), "errors do not fall like c/n");
    // Maps that only serve features, or nobody, void nothing.
    let place = Place::new();
    let keys = "id = \"cornell\"\nphotons = { paths = 3000 }\nmaps = \"fresh\"";
    let traced = place.run(&study(&rendered(keys)), &Watch::default()).unwrap();
    assert!(
        !traced.coverage.is_empty() && !traced.warnings.iter().any(|w| w.to_string().contains("photon maps"))
    );
    // Path tracing says nothing of maps.
    let place = Place::new();
    place.run(&study(&rendered("id = \"cornell\"")), &Watch::default()).unwrap();
    let text = std::fs::read_to_string(place.out().join("results.jsonl")).unwrap();
    assert!(!text.contains("photon_maps"));
    // The same random seeds, but other light.
    let mse = |r: &[noisefloor_study::record::Record]| r[0].metrics["mse"];
    assert_ne!(mse(&first), mse(&second));
}

#[test]
fn frames_of_a_sequence_differ_in_their_picture_and_in_their_random_numbers() {
    let picture = |keys: &str| {
        let place = Place::new();
        place.run(&study(&rendered(keys)), &Watch::default()).unwrap();
        let all = records(&place.out());
        (all[0].cell.clone(), all[0].metrics["mse"])
    };
    let start = picture("id = \"cornell\"");
    let later = picture("id = \"later\"\nscene = \"cornell\"\nframe = 2");
    // Nothing moves in this scene: the same picture with other random numbers.
    assert_ne!(start.1, later.1);
    let turned = picture("id = \"cornell\"\nframe = 2\norbit_degrees = 5");
    assert_ne!(turned.1, later.1);
    assert_eq!(picture("id = \"cornell\"\nframe = 0\norbit_degrees = 0"), start);
}

#[test]
fn a_file_is_a_scene() {
    let place = Place::new();
    std::fs::create_dir_all(place.out()).unwrap();
    let file = place.out().join("lamp.gltf");
    // A square that shines, before the default camera of a file without one.
    let square: Vec<u8> = [[-1.0f32, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]]
        .iter()
        .flatten()
        .flat_map(|v| v.to_le_bytes())
        .collect();
    std::fs::write(place.out().join("lamp.bin"), square).unwrap();
    let text = r#"{ "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0, 1] }],
        "nodes": [{ "mesh": 0 }, { "camera": 0, "translation": [0, 0, 4] }],
        "cameras": [{ "type": "perspective", "perspective": { "yfov": 0.6, "znear": 0.1 } }],
        "materials": [{ "emissiveFactor": [1, 0.5, 0.2] }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "material": 0 }] }],
        "accessors": [{ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                        "min": [-1, -1, 0], "max": [1, 1, 0] }],
        "bufferViews": [{ "buffer": 0, "byteLength": 36 }],
        "buffers": [{ "uri": "lamp.bin", "byteLength": 36 }] }"#;
    std::fs::write(&file, text).unwrap();
    let keys = format!("id = \"mine\"\nfile = {:?}", file.display().to_string());
    let summary = place.run(&study(&rendered(&keys)), &Watch::default()).unwrap();
    assert_eq!(summary.cells.len(), 2);
    assert!(summary.scenes[0].about.contains("lamp.gltf"), "{}", summary.scenes[0].about);
    std::fs::write(&file, "{ not json").unwrap();
    let broken = Place::new().run(&study(&rendered(&keys)), &Watch::default());
    assert!(matches!(broken, Err(HarnessError::Gltf { .. })));
    std::fs::remove_file(&file).unwrap();
    assert!(error(&keys).contains("a glTF file that exists"));
}

#[test]
fn keys_that_do_not_belong_together_are_refused_with_their_line() {
    for (keys, word) in [
        ("id = \"cornell\"\nmaps = \"fresh\"", "for there to be maps"),
        ("id = \"x\"\nscene = \"cornell\"\nfile = \"a.glb\"", "of several kinds"),
        ("id = \"x\"\nfolder = \".\"\nframe = 2", "scenes that are rendered"),
        ("id = \"cornell\"\norbit_degrees = 1000", "within ±360"),
        ("id = \"cornell\"\nintegrator = \"radiosity\"", "unknown variant"),
        ("id = \"cornell\"\nphotons = { path = 3 }", "unknown field"),
        ("id = \"x\"\nscene = \"cornel\"", "nearest names"),
    ] {
        let message = error(keys);
        assert!(message.contains(word) && message.contains("shots.toml, line"), "{message}");
    }
    // What only the scene knows is refused when it is opened.
    let bad = format!("{MAPPED}\nphotons = {{ radius = 7 }}")
        .replace("photons = { paths = 3000, caustic-paths = 3000 }\n", "");
    let message = Place::new().run(&study(&rendered(&bad)), &Watch::default()).unwrap_err().to_string();
    assert!(message.starts_with("radius is 7"), "{message}");
}

#[test]
fn a_scene_by_name_makes_a_study() {
    let rows = || vec![noisefloor_study::MethodRow::new("mc")];
    let shot = Shot { integrator: Integrator::PhotonMapping, maps: Maps::Fresh, ..Shot::default() };
    let study = Study::for_scene("rings", shot, rows()).unwrap();
    assert_eq!((study.name.as_str(), study.scenes[0].shot), ("scene-rings", shot));
    assert!(matches!(Study::for_scene("ringz", shot, rows()), Err(StudyError::Scene { .. })));
}
