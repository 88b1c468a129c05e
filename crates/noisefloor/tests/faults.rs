//! What a script sees of a study whose instrument has a fault: the exit code of `noisefloor report`.

use std::path::Path;
use std::process::{self, Command};

use noisefloor::harness::{Laboratory, StudyRun, run};
use noisefloor::questions::{Check, checks, failed_checks};
use noisefloor::registry::registry;
use noisefloor::stats::family;
use noisefloor::study::Study;
use noisefloor::study::check::CheckKind;
use noisefloor::study::summary::Summary;
use noisefloor::{DenoiseError, Denoiser, Input, Method, MethodCard, NoParams, Output, Registry, method};

const STUDY: &str = r#"
name = "planted"
spp = [4]
replicates = 4
timing = { warmup = 0, runs = 1 }
[[scene]]
id = "steps"
synthetic = { image = "edges", law = "gaussian", sd = 0.5, width = 24, height = 16 }
[[method]]
id = "mc"
"#;

fn measured(folder: &Path, registry: &Registry, laboratory: Laboratory<'_>) -> Summary {
    let study = Study::from_toml(STUDY, Path::new("test.toml")).unwrap();
    let (out, cache) = (folder.join("out"), folder.join("cache"));
    run(&StudyRun { laboratory, ..StudyRun::new(&study, registry, &out, &cache) }).unwrap()
}

fn report(folder: &Path) -> process::Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_noisefloor"));
    command.args(["report", "out"]).env("XDG_CACHE_HOME", folder.join("cache")).current_dir(folder);
    command.output().unwrap()
}

#[test]
fn a_report_of_a_faulty_instrument_is_written_and_ends_with_the_code_of_a_fault() {
    let folder = tempfile::tempdir().unwrap();
    // The quantile of the normal distribution in place of Student's t.
    let intervals = family("normal").unwrap();
    let summary = measured(folder.path(), &registry([]), Laboratory { intervals, ..Laboratory::default() });
    let failed = failed_checks(&summary);
    assert!(!failed.is_empty());
    let output = report(folder.path());
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(7), "{errors}");
    for text in &failed {
        assert!(errors.contains(text.as_str()), "{text:?} is not in {errors}");
    }
    let page = std::fs::read_to_string(folder.path().join("out/report/index.html")).unwrap();
    assert!(page.contains("found a fault") && page.contains("I1 (coverage of normal samples)"));
}

#[test]
fn a_report_of_a_sound_instrument_ends_well_and_its_own_methods_know_their_error() {
    let folder = tempfile::tempdir().unwrap();
    let summary = measured(folder.path(), &registry([]), Laboratory::default());
    assert_eq!(failed_checks(&summary), Vec::<String>::new());
    for id in ["rdfc-first", "rdfc-second", "rdfc-third"] {
        let found = known_variance(&summary, id).record.found.unwrap();
        assert!(found.p > 0.05, "{id}: {found:?}");
    }
    let output = report(folder.path());
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
}

fn known_variance(summary: &Summary, id: &str) -> Check {
    let of_method = |check: &Check| {
        check.record.kind == CheckKind::KnownVariance && check.record.what.ends_with(&format!(" {id}"))
    };
    checks(summary).into_iter().find(of_method).unwrap()
}

const SHORT: &str = "without-derivative";

/// A candidate of rousselle2013rdfc whose estimate is (y − x)² − v: SURE without the term of the derivative.
struct WithoutDerivative(Method);

impl Denoiser for WithoutDerivative {
    fn card(&self) -> MethodCard {
        MethodCard { id: SHORT.into(), ..self.0.denoiser.card() }
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        let mut output = self.0.denoiser.denoise(input)?;
        let color = &input.target.color;
        let mut estimate = output.image.clone();
        let variance = color.variance.as_ref().unwrap().mean_variance().data();
        for ((y, x), v) in estimate.data_mut().iter_mut().zip(color.mean.data()).zip(variance) {
            *y = (*y - x).powi(2) - v;
        }
        output.error_estimate = Some(estimate);
        Ok(output)
    }
}

#[test]
fn a_candidate_whose_estimate_lacks_its_derivative_is_named_beside_those_that_have_it() {
    let folder = tempfile::tempdir().unwrap();
    let short = method(SHORT, "for a test", None, |_: NoParams| {
        Ok(WithoutDerivative(registry([]).build("rdfc-first", &serde_json::Map::new()).unwrap()))
    });
    let summary = measured(folder.path(), &registry([short]), Laboratory::default());
    let found = known_variance(&summary, SHORT);
    println!("{:?}", found.record.found);
    assert!(found.failed, "{found:?}");
    let failed = failed_checks(&summary);
    assert!(failed.len() == 1 && failed[0].contains(SHORT), "{failed:?}");
}
