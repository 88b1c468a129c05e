//! Rows whose frames are not the study's own.

use std::path::Path;

use crate::common::{Place, Watch, records, study};
use noisefloor_study::Study;
use noisefloor_study::record::Record;

const PIXELS: usize = 16 * 12;

/// A tiny study of one rendered scene.
fn toml(scene: &str, rows: &str) -> String {
    format!(
        "name = \"frames\"\nspp = [8]\nreplicates = 2\nwidth = 16\nheight = 12\ndepth = 3\ncoverage = [0.95]\n\
         [reference]\nspp = 16\n[timing]\nwarmup = 0\nruns = 1\n\
         [[scene]]\nid = \"cornell\"\n{scene}\n[[method]]\nid = \"mc\"\n{rows}"
    )
}

fn error(scene: &str, rows: &str) -> String {
    Study::from_toml(&toml(scene, rows), Path::new("frames.toml")).unwrap_err().to_string()
}

fn of<'a>(all: &'a [Record], label: &'a str) -> impl Iterator<Item = &'a Record> {
    all.iter().filter(move |record| record.label == label)
}

const ADAPTIVE: &str =
    "[[method]]\nid = \"seeker\"\nlabel = \"rounds\"\nadaptive = { rounds = 3, first = 2, most = 2 }\n";

#[test]
fn adaptive_rows_get_all_their_samples_where_their_method_wants_them() {
    let place = Place::new();
    let watch = Watch::default();
    let summary = place.run(&study(&toml("", ADAPTIVE)), &watch).unwrap();
    // Two frames for plain sampling, two in rounds, and the reference.
    assert_eq!(watch.samples(), PIXELS * (2 * 8 + 2 * 8 + 16));
    assert_eq!(watch.planned.lock().unwrap().samples, watch.samples() as u64);
    let all = records(&place.out());
    for record in of(&all, "rounds") {
        let adaptive = record.adaptive.unwrap();
        assert_eq!((adaptive.rounds, adaptive.mean_spp, adaptive.least), (3, 8.0, 2));
        // Twice the rounds' average of 3 in each of two rounds, and the first.
        assert_eq!(adaptive.most, 14);
        assert!(adaptive.density_seconds.unwrap() >= 0.0);
        assert!(record.bounds.is_empty() && record.coverage.is_empty());
        assert_eq!(record.diagnostics.contains_key("samples per pixel"), record.replicate == 0);
    }
    assert!(of(&all, "mc").all(|record| record.adaptive.is_none() && !record.coverage.is_empty()));
    let path = of(&all, "rounds").next().unwrap().diagnostics["samples per pixel"].clone();
    let counts = noisefloor_io::read_image(place.out().join(path)).unwrap();
    assert!((0..16).all(|x| counts.get(0, x, 5) == if x < 8 { 14.0 } else { 2.0 }));
    // Half the picture has more samples than the plain frame.
    assert_eq!(summary.cells.len(), 2);
    let again = Watch::default();
    place.run(&study(&toml("", ADAPTIVE)), &again).unwrap();
    assert_eq!((again.samples(), again.cells()), (0, 0));
}

#[test]
fn adaptive_rows_are_refused_where_they_cannot_be() {
    let place = Place::new();
    let blur = study(&toml("", "[[method]]\nid = \"blur\"\nadaptive = {}\n"));
    let refused = place.run(&blur, &Watch::default()).unwrap_err().to_string();
    assert!(refused.contains("row `blur`: adaptive") && refused.contains("say where"), "{refused}");
    let row = |keys: &str| format!("[[method]]\nid = \"seeker\"\nadaptive = {{ {keys} }}\n");
    for (keys, words) in [
        ("rounds = 1", "2 to 64"),
        ("most = 1", "2 to 4096"),
        ("first = 1", "at least 2"),
        ("first = 8", "less than the level 8"),
    ] {
        let told = error("", &row(keys));
        assert!(told.contains(words) && told.contains("frames.toml, line"), "{told}");
    }
    let told = error("synthetic = { image = \"edges\", law = \"gaussian\", sd = 0.5 }", &row(""));
    assert!(told.contains("scenes that are rendered"), "{told}");
    let lost = study(&toml("", "[[method]]\nid = \"seeker\"\nset = { lost = true }\nadaptive = {}\n"));
    let place = Place::new();
    let summary = place.run(&lost, &Watch::default()).unwrap();
    // The other rows ran.
    let [failed] = summary.skipped.as_slice() else { panic!("{:?}", summary.skipped) };
    assert_eq!((failed.label.as_str(), failed.status.name()), ("seeker", "failed"));
    assert!(
        failed.reason.contains("no sampling density") && failed.reason.contains("way"),
        "{}",
        failed.reason
    );
    assert!(summary.cells.iter().any(|cell| cell.label == "mc"));
}

const EQUAL: &str =
    "[[method]]\nid = \"blur\"\n[[method]]\nid = \"mc\"\nlabel = \"more\"\nequal_time = \"blur\"\n";

#[test]
fn rows_of_equal_time_get_the_samples_that_the_study_says_and_stand_beside_the_others() {
    let place = Place::new();
    let summary = place.run(&study(&toml("equal_time_spp = 32", EQUAL)), &Watch::default()).unwrap();
    let all = records(&place.out());
    assert!(of(&all, "more").all(|r| r.frame_spp == Some(32) && r.spp == 8));
    assert!(of(&all, "blur").all(|r| r.frame_spp.is_none()));
    let mean = |label| of(&all, label).map(|r| r.metrics["mse"].unwrap()).sum::<f64>();
    assert!(mean("more") < 0.5 * mean("mc"), "four times the samples");
    let [equal] = summary.equal_time.as_slice() else { panic!("{:?}", summary.equal_time) };
    assert_eq!((equal.spp, equal.used, equal.with.as_str()), (8, 32, "blur"));
    let implied = 8.0 + equal.denoise_seconds / equal.seconds_per_sample.unwrap();
    assert_eq!(equal.implied, Some(implied));
    // What it is compared with is the plain row of the level, wherever it stands.
    let of_mc = summary.cells.iter().find(|c| c.label == "mc").unwrap();
    assert_eq!(of_mc.ratio_to_mc["mse"].value, 1.0);
    // A study with that level has the same frames.
    let level = toml("spp = [8, 32]", "");
    let watch = Watch::default();
    place.run_to(&place.root.path().join("level"), &study(&level), &watch).unwrap();
    assert_eq!(watch.samples(), 0);
}

#[test]
fn equal_time_needs_another_row_and_a_number_for_every_scene() {
    let told = error("", EQUAL);
    assert!(told.contains("scene[0].equal_time_spp") && told.contains("`cornell`"), "{told}");
    let told = error("equal_time_spp = 8", "[[method]]\nid = \"blur\"\nequal_time = \"blur\"\n");
    assert!(told.contains("method[1].equal_time") && told.contains("another row: mc"), "{told}");
    let told = error("equal_time_spp = 0", "");
    assert!(told.contains("equal_time_spp") && told.contains("1 to 1048576"), "{told}");
    let both = "[[method]]\nid = \"seeker\"\nadaptive = {}\nequal_time = \"mc\"\n";
    assert!(error("equal_time_spp = 8", both).contains("one of them"));
}

#[test]
fn parameters_of_a_scene_reach_the_rows_that_have_them_and_do_not_set_them() {
    let rows =
        "[[method]]\nid = \"blur\"\n[[method]]\nid = \"blur\"\nlabel = \"own\"\nset = { radius = 2 }\n";
    let place = Place::new();
    place.run(&study(&toml("set = { radius = 3 }", rows)), &Watch::default()).unwrap();
    let all = records(&place.out());
    assert!(of(&all, "blur").all(|r| r.params["radius"] == 3 && r.figures["radius"] == 3.0));
    assert!(of(&all, "own").all(|r| r.figures["radius"] == 2.0));
    let place = Place::new();
    let stray = study(&toml("set = { radius = 3, diameter = 6 }", rows));
    let told = place.run(&stray, &Watch::default()).unwrap_err().to_string();
    assert!(told.contains("`cornell`: set") && told.contains("`diameter`"), "{told}");
}

#[test]
fn neighbouring_moments_come_in_time_order_and_from_the_shared_cache() {
    let rows = "[[method]]\nid = \"seeker\"\n[[method]]\nid = \"seeker\"\nlabel = \"two\"\nset = { neighbors = 2 }\n";
    let one = |frame: u32| toml(&format!("scene = \"spin\"\nframe = {frame}"), rows);
    let place = Place::new();
    let watch = Watch::default();
    place.run(&study(&one(1)), &watch).unwrap();
    // The frames 0 to 3 of two replicates, and the reference.
    assert_eq!(watch.samples(), PIXELS * (2 * 4 * 8 + 16));
    assert_eq!(watch.planned.lock().unwrap().samples, watch.samples() as u64);
    let all = records(&place.out());
    let looking = of(&all, "two").next().unwrap();
    assert_eq!((looking.figures["before"], looking.figures["after"]), (1.0, 2.0));
    assert!(of(&all, "seeker").all(|r| r.figures["before"] + r.figures["after"] == 0.0));
    // The next frame's own and its neighbours: only frame 4 is new.
    let next = place.root.path().join("next");
    let watch = Watch::default();
    place.run_to(&next, &study(&one(2)), &watch).unwrap();
    assert_eq!(watch.samples(), PIXELS * (2 * 8 + 16));
    let later = records(&next);
    let after = of(&later, "two").next().unwrap();
    for k in 0..4 {
        let name = format!("frame {k}");
        assert_eq!(looking.figures[&name], after.figures[&name], "the same frames in the same order");
    }
}
