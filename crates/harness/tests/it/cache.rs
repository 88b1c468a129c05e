//! Rendered frames are shared, checked and made again when damaged.

use std::path::{Path, PathBuf};

use crate::common::{Place, Watch, study, timeless};
use noisefloor_harness::StudyRun;
use noisefloor_study::Study;

const SPP: usize = 2;
const REFERENCE: usize = 16;
const PIXELS: usize = 16 * 12;

fn rendered() -> Study {
    study(
        r#"
        name = "rendered"
        spp = [2]
        replicates = 2
        width = 16
        height = 12
        depth = 3
        timing = { warmup = 0, runs = 1 }
        [reference]
        spp = 16
        [[scene]]
        id = "cornell"
        [[method]]
        id = "mc"
        [[method]]
        id = "blur"
        "#,
    )
}

fn files(place: &Place, extension: &str) -> Vec<PathBuf> {
    let mut out = Vec::new();
    for folder in std::fs::read_dir(place.cache()).unwrap() {
        for file in std::fs::read_dir(folder.unwrap().path()).unwrap() {
            let path = file.unwrap().path();
            if path.extension().is_some_and(|e| e == extension) {
                out.push(path);
            }
        }
    }
    out.sort();
    out
}

#[test]
fn frames_and_references_are_rendered_once_for_all_studies() {
    let place = Place::new();
    let first = Watch::default();
    place.run(&rendered(), &first).unwrap();
    assert_eq!(first.samples(), PIXELS * (2 * SPP + REFERENCE));
    assert_eq!(first.planned.lock().unwrap().samples, first.samples() as u64);
    assert_eq!(files(&place, "exr").len(), 2 + 8);

    // Another name, and one more replicate: two frames and the reference are there.
    let mut other = rendered();
    other.name = "other".into();
    other.replicates = noisefloor_study::Replicates::uniform(3);
    let second = Watch::default();
    place.run_to(&place.root.path().join("other"), &other, &second).unwrap();
    assert_eq!(second.samples(), PIXELS * SPP);

    // Another study seed gives other frames and the same reference.
    let mut reseeded = rendered();
    reseeded.seed = 1;
    let third = Watch::default();
    place.run_to(&place.root.path().join("reseeded"), &reseeded, &third).unwrap();
    assert_eq!(third.samples(), PIXELS * 2 * SPP);
}

#[test]
fn a_damaged_cache_file_is_noticed_and_made_again() {
    let place = Place::new();
    place.run(&rendered(), &Watch::default()).unwrap();
    let before = timeless(&place.out());
    let good: Vec<Vec<u8>> = files(&place, "exr").iter().map(|path| std::fs::read(path).unwrap()).collect();
    // One flipped bit, a file cut short, an empty one, and a lost one: each in turn, in every file.
    type Harm = fn(&PathBuf);
    let harms: [Harm; 4] = [
        |path| {
            let mut bytes = std::fs::read(path).unwrap();
            let middle = bytes.len() / 2;
            bytes[middle] ^= 1;
            std::fs::write(path, bytes).unwrap();
        },
        |path| {
            let bytes = std::fs::read(path).unwrap();
            std::fs::write(path, &bytes[..bytes.len() / 3]).unwrap();
        },
        |path| std::fs::write(path, b"").unwrap(),
        |path| std::fs::remove_file(path).unwrap(),
    ];
    for harm in harms {
        files(&place, "exr").iter().for_each(harm);
        std::fs::remove_dir_all(place.out()).unwrap();
        let watch = Watch::default();
        place.run(&rendered(), &watch).unwrap();
        assert_eq!(watch.warnings().len(), 10, "{:?}", watch.warnings());
        assert_eq!(watch.samples(), PIXELS * (2 * SPP + REFERENCE));
        assert_eq!(timeless(&place.out()), before);
    }
    let remade: Vec<Vec<u8>> = files(&place, "exr").iter().map(|path| std::fs::read(path).unwrap()).collect();
    assert!(good == remade, "a frame's file depends on nothing but what it carries");
}

#[test]
fn a_frame_without_its_entry_is_made_again_quietly() {
    let place = Place::new();
    place.run(&rendered(), &Watch::default()).unwrap();
    let before = timeless(&place.out());
    assert_eq!(files(&place, "json").len(), 10);
    // As a process leaves it that dies between the two files.
    files(&place, "json").iter().for_each(|path| std::fs::remove_file(path).unwrap());
    std::fs::remove_dir_all(place.out()).unwrap();
    let watch = Watch::default();
    place.run(&rendered(), &watch).unwrap();
    assert_eq!(watch.samples(), PIXELS * (2 * SPP + REFERENCE));
    assert!(watch.warnings().is_empty(), "{:?}", watch.warnings());
    assert_eq!((timeless(&place.out()), files(&place, "exr").len()), (before, 10));
}

#[test]
fn how_long_a_frame_took_is_known_when_it_comes_from_the_cache() {
    let place = Place::new();
    place.run(&rendered(), &Watch::default()).unwrap();
    let seconds = |out: &std::path::Path| -> Vec<Option<f64>> {
        crate::common::records(out).iter().map(|record| record.seconds.render).collect()
    };
    let first = seconds(&place.out());
    assert!(first.iter().all(|seconds| seconds.is_some_and(|s| s > 0.0)));
    let elsewhere = place.root.path().join("elsewhere");
    let watch = Watch::default();
    place.run_to(&elsewhere, &rendered(), &watch).unwrap();
    assert_eq!((watch.samples(), seconds(&elsewhere)), (0, first));
}

#[test]
fn a_reference_that_is_stopped_midway_loses_at_most_one_part() {
    let place = Place::new();
    let part = PIXELS * REFERENCE / 8;
    let stopping = Watch { stop_after_samples: Some(3 * part + part / 2), ..Watch::default() };
    assert!(place.run(&rendered(), &stopping).unwrap_err().is_cancelled());
    let kept = files(&place, "exr").len();
    assert!(kept >= 3, "{kept} parts are kept");
    let watch = Watch::default();
    place.run(&rendered(), &watch).unwrap();
    assert_eq!(watch.samples(), PIXELS * 2 * SPP + (8 - kept) * part);
}

#[test]
fn the_size_can_be_chosen_when_running() {
    let place = Place::new();
    let small = |request: StudyRun<'_>| noisefloor_harness::run(&StudyRun { size: Some((8, 6)), ..request });
    let summary = place.run_with(&rendered(), &Watch::default(), small).unwrap();
    assert_eq!((summary.scenes[0].width, summary.scenes[0].height), (8, 6));
    let kept = noisefloor_io::read_color(place.out().join(&summary.scenes[0].reference_image)).unwrap();
    assert_eq!((kept.width(), kept.height()), (8, 6));
}

#[test]
fn independent_frames_of_a_scene_differ_and_repeat() {
    let place = Place::new();
    place.run(&rendered(), &Watch::default()).unwrap();
    let records = timeless(&place.out());
    assert_ne!(records[0].metrics, records[2].metrics, "replicates are independent");
    let elsewhere = Place::new();
    elsewhere.run(&rendered(), &Watch::default()).unwrap();
    assert_eq!(timeless(&elsewhere.out()), records);
}

#[test]
fn frames_carry_the_optional_statistics_that_a_study_asks_for_and_only_then() {
    let place = Place::new();
    place.run(&rendered(), &Watch::default()).unwrap();
    let plain = files(&place, "exr");
    let asking = Study { statistics: vec!["least".into(), "box-cox:0:0.001".into()], ..rendered() };
    let asked = Watch::default();
    place.run(&asking, &asked).unwrap();
    // Frames are others, the reference is the same.
    assert_eq!(asked.samples(), PIXELS * 2 * SPP);
    let read =
        |path: &PathBuf| noisefloor_io::read_frame(path, &noisefloor_io::ReadOptions::default()).unwrap();
    let (before, after): (Vec<_>, Vec<_>) =
        files(&place, "exr").into_iter().partition(|file| plain.contains(file));
    assert_eq!((before.len(), after.len()), (2 + 8, 2));
    assert!(before.iter().all(|file| read(file).optional.is_empty()));
    for file in &after {
        let frame = read(file);
        let names: Vec<String> = frame.optional.recorded().iter().map(|(s, _)| s.to_string()).collect();
        assert_eq!(names, ["least", "box-cox:0:0.001"]);
        let least = frame.optional.least().unwrap();
        assert!(least.data().iter().zip(frame.color.mean.data()).all(|(least, mean)| least <= mean));
        // No sample changes because more is kept of it.
        assert!(before.iter().map(read).any(|other| other.color.mean == frame.color.mean));
    }
}

#[test]
fn statistics_without_a_meaning_are_refused_with_what_there_is() {
    let told = |name: &str, sampling: &str| {
        let toml = format!(
            "name = \"asking\"\nspp = [2]\nstatistics = [{name}]\nsampling = \"{sampling}\"\n\
             [[scene]]\nid = \"cornell\"\n[[method]]\nid = \"mc\"\n"
        );
        Study::from_toml(&toml, Path::new("asking.toml")).unwrap_err().to_string()
    };
    for (names, sampling, words) in [
        ("\"median\"", "independent", "there are third-moment"),
        ("\"least\", \"least\"", "independent", "once"),
        ("\"third-moment\"", "independent", "at least 3 samples"),
        ("\"four-parts\"", "low-discrepancy", "independent sampling"),
    ] {
        let told = told(names, sampling);
        assert!(told.contains(words) && told.contains("asking.toml, line 3"), "{told}");
    }
}
