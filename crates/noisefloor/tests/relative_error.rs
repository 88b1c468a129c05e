//! `compare` with references of few samples: the bias of relative errors is told, and a doubtful value is a limit.

use std::path::Path;
use std::process::Command;

use noisefloor_synthetic::{Guides, ImageKind, MeanImage, SampleLaw, SyntheticScene};
use serde_json::Value;

fn told(folder: &Path, args: &[&str]) -> String {
    let output =
        Command::new(env!("CARGO_BIN_EXE_noisefloor")).args(args).current_dir(folder).output().unwrap();
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn a_reference_of_four_samples_gives_an_upper_limit_and_a_long_one_a_value() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    // Samples with half the mean as standard deviation.
    let law = SampleLaw::LogNormal { sigma: 1.25f64.ln().sqrt() };
    let scene = SyntheticScene::new(MeanImage::of(ImageKind::Mixed), law, 40, 30).unwrap();
    let scene = scene.with_guides(Guides::None);
    let frame = scene.render(16, 1);
    noisefloor_io::write_frame(at.join("frame.exr"), &frame).unwrap();
    for (name, spp) in [("short.exr", 4), ("long.exr", 4096)] {
        noisefloor_io::write_frame(at.join(name), &scene.render(spp, 2)).unwrap();
    }
    let truth = scene.truth();
    let pairs = frame.color.mean.data().iter().zip(truth.mean().data());
    let terms = pairs.map(|(&x, &r)| {
        let (x, r) = (f64::from(x), f64::from(r));
        (x - r).powi(2) / (r * r + 0.01)
    });
    let exact = terms.sum::<f64>() / truth.mean().data().len() as f64;

    let json = |name: &str| -> Value {
        serde_json::from_str(&told(at, &["compare", "frame.exr", name, "--json"])).unwrap()
    };
    let short = json("short.exr");
    let limit = short["upper_limits"]["relmse"].as_f64().unwrap();
    assert!(limit > exact, "{limit} against {exact}");
    // No looser than all noise of the reference, (σ/μ)² = 1/16 to first order, left in.
    assert!(limit < 3.0 * (exact + 1.0 / 16.0), "{limit} against {exact}");
    assert!(short["reference_bias_removed"]["relmse"].as_f64().unwrap() != 0.0);
    let text = told(at, &["compare", "frame.exr", "short.exr"]);
    let line = text.lines().find(|line| line.starts_with("relmse ")).unwrap();
    assert!(line.contains("< ") && text.contains("bias of relmse"), "{text}");

    let long = json("long.exr");
    assert!(long["upper_limits"].as_object().unwrap().is_empty(), "{long}");
    let value = long["metrics"]["relmse"].as_f64().unwrap();
    let error = long["reference_standard_error"]["relmse"].as_f64().unwrap();
    assert!((value - exact).abs() < 4.0 * error, "{value} ± {error}, exactly {exact}");
    assert!(error < 0.02 * exact, "the test means something");
    // 3ρ² of the value with ρ² = 1/16384.
    let bias = long["reference_bias_removed"]["relmse"].as_f64().unwrap();
    assert!(bias != 0.0 && bias.abs() < 0.01 * exact, "{bias}");
}
