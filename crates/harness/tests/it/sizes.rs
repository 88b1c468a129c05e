//! How large scenes are, and what a study is asked for.

use noisefloor_harness::{StudyRun, run};
use noisefloor_study::Study;

use crate::common::{Place, Watch, study};

fn toml(top: &str, scene: &str) -> Study {
    study(&format!(
        "name = \"sizes\"\n{top}\nreplicates = 1\ntiming = {{ warmup = 0, runs = 1 }}\n[[scene]]\nid = \"drawn\"\n\
         synthetic = {{ image = \"edges\", law = \"gaussian\"{scene} }}\n[[method]]\nid = \"mc\"\n"
    ))
}

fn size(study: &Study, chosen: Option<(usize, usize)>) -> (u32, u32) {
    let place = Place::new();
    let summary = place
        .run_with(study, &Watch::default(), |request| run(&StudyRun { size: chosen, ..request }))
        .unwrap();
    (summary.scenes[0].width, summary.scenes[0].height)
}

#[test]
fn width_and_height_of_a_study_hold_for_its_synthetic_scenes() {
    let small = toml("spp = [4]\nwidth = 5\nheight = 3", "");
    assert_eq!(size(&small, None), (5, 3));
    // What a scene states itself is its own, and the command line's word is the last.
    assert_eq!(size(&toml("spp = [4]\nwidth = 5\nheight = 3", ", width = 7"), None), (7, 3));
    assert_eq!(size(&toml("spp = [4]\nwidth = 5\nheight = 3", ", width = 7, height = 4"), None), (7, 4));
    assert_eq!(size(&small, Some((9, 8))), (9, 8));
    // Nobody says anything: as it always was.
    assert_eq!(size(&toml("spp = [4]", ""), None), (160, 120));
}

#[test]
fn no_reference_is_asked_for_where_the_truth_is_exact() {
    // Sixteen times the top level in eight parts would be more than a low-discrepancy sequence has.
    let long = toml("spp = [1048576]\nwidth = 1\nheight = 1", "");
    assert_eq!(size(&long, None), (1, 1));
    let rendered = Study::from_toml(
        "name = \"sizes\"\nspp = [1048576]\n[[scene]]\nid = \"cornell\"\n[[method]]\nid = \"mc\"\n",
        std::path::Path::new("sizes.toml"),
    );
    assert!(rendered.unwrap_err().to_string().contains("reference.spp"));
}
