//! Whole studies with the real methods: what is proven must hold where its conditions do.

use std::path::Path;

use noisefloor::harness::{StudyRun, run};
use noisefloor::questions::violations;
use noisefloor::study::summary::Summary;
use noisefloor::study::{Study, builtin_studies};

fn run_study(text: &str) -> (tempfile::TempDir, Summary) {
    let folder = tempfile::tempdir().unwrap();
    let study = Study::from_toml(text, Path::new("test.toml")).unwrap_or_else(|e| panic!("{e}"));
    let registry = noisefloor::registry::registry([]);
    let (out, cache) = (folder.path().join("out"), folder.path().join("cache"));
    let summary = run(&StudyRun::new(&study, &registry, &out, &cache)).unwrap_or_else(|e| panic!("{e}"));
    (folder, summary)
}

const ROWS: &str = r#"
[[method]]
id = "mc"
[[method]]
id = "virtual-flash"
[[method]]
id = "virtual-flash"
label = "virtual-flash steps=1"
set = { steps = 1 }
[[method]]
id = "guarded(virtual-flash)"
[[method]]
id = "guarded(geometric-corrected)"
"#;

#[test]
fn rows_of_builtin_studies_name_methods_and_parameters_that_exist() {
    let registry = noisefloor::registry::registry([]);
    for study in builtin_studies() {
        let study = study.study().unwrap_or_else(|e| panic!("{e}"));
        for row in &study.methods {
            registry.build(&row.id, &row.set).unwrap_or_else(|e| panic!("{}: {e}", study.name));
        }
    }
}

#[test]
fn proven_bounds_hold_and_intervals_cover_on_normal_samples() {
    let (_folder, summary) = run_study(&format!(
        r#"
        name = "normal"
        spp = [4, 16]
        replicates = 4
        timing = {{ warmup = 0, runs = 1 }}
        [[scene]]
        id = "mixed"
        synthetic = {{ image = "mixed", law = "gaussian", sd = 0.5, width = 80, height = 60 }}
        {ROWS}"#
    ));
    assert_eq!(summary.skipped, []);
    assert_eq!(violations(&summary), Vec::<String>::new());
    let proven: Vec<_> = summary.bounds.iter().filter(|b| b.proven && b.class == "all").collect();
    // Four rows claim one proven bound each, at two levels.
    assert_eq!(proven.len(), 8);
    for bound in proven {
        let high = bound.violations.high.unwrap();
        assert!(high <= bound.alpha, "{} at {} spp: {high} > {}", bound.label, bound.spp, bound.alpha);
    }
    for row in summary.coverage.iter().filter(|c| c.class == "all") {
        // 80·60·3 independent pixel-channels in 4 replicates.
        let sd = (row.confidence * (1.0 - row.confidence) / (80.0 * 60.0 * 3.0 * 4.0)).sqrt();
        let off = (row.covered.value - row.confidence).abs();
        assert!(off < 5.0 * sd, "{} spp, {}: {}", row.spp, row.confidence, row.covered.value);
    }
}

#[test]
fn outputs_stay_in_their_intervals_on_rendered_and_on_heavy_tailed_frames() {
    let (_folder, summary) = run_study(&format!(
        r#"
        name = "hard"
        spp = [2, 8]
        replicates = 2
        width = 40
        height = 30
        depth = 4
        timing = {{ warmup = 0, runs = 1 }}
        reference = {{ spp = 128 }}
        [[scene]]
        id = "cornell"
        [[scene]]
        id = "outdoor"
        [[scene]]
        id = "rare"
        synthetic = {{ image = "texture", law = "bernoulli", q = 0.02, width = 40, height = 30 }}
        [[scene]]
        id = "heavy"
        synthetic = {{ image = "edges", law = "log-normal", sigma = 3.0, width = 40, height = 30 }}
        {ROWS}"#
    ));
    assert_eq!(summary.skipped, []);
    assert_eq!(violations(&summary), Vec::<String>::new());
    let checked = summary.cells.iter().filter(|cell| cell.enclosure_worst_ratio.is_some()).count();
    assert_eq!(checked, 4 * 2 * 4, "four rows claim an enclosure, on four scenes at two levels");
    for cell in &summary.cells {
        assert_eq!(cell.metrics.len(), 7, "{} on {}", cell.label, cell.scene);
        assert_eq!((cell.non_finite_output, cell.replicates), (0, 2));
    }
}
