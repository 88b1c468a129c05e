//! Errors over the frames of a sequence.

use std::path::Path;

use noisefloor_harness::{HarnessError, reanalyse};
use noisefloor_study::summary::{FlickerSummary, Source, Summary};
use noisefloor_study::{Study, StudyError};

use crate::common::{Place, Watch, study};

const FRAMES: usize = 4;
const PIXELS: f64 = 64.0 * 48.0;

/// Frames of a constant picture with normal noise, not in the order of the file.
fn sequence(replicates: u32, rows: &str) -> String {
    let frames: String = [2, 0, 3, 1]
        .map(|k| {
            format!(
                "[[scene]]\nid = \"f{k}\"\nframe = {k}\nsequence = \"still\"\nsynthetic = {{ image = \"constant\", \
                 law = \"gaussian\", sd = 0.5, width = 64, height = 48, guides = \"none\" }}\n"
            )
        })
        .concat();
    format!(
        "name = \"flicker\"\nspp = [4, 16]\nreplicates = {replicates}\ntiming = {{ warmup = 0, runs = 1 }}\n{frames}\
         [[method]]\nid = \"mc\"\n[[method]]\nid = \"blur\"\n[[method]]\nid = \"judge\"\nset = {{ offset = 0.5 }}\n{rows}"
    )
}

fn found<'a>(summary: &'a Summary, label: &str, spp: u32) -> &'a FlickerSummary {
    summary.flicker.iter().find(|f| f.label == label && f.spp == spp).unwrap()
}

#[test]
fn noise_flickers_less_after_a_blur_and_an_offset_does_not_flicker() {
    let place = Place::new();
    let replicates = 3;
    let summary = place.run(&study(&sequence(replicates, "")), &Watch::default()).unwrap();
    assert_eq!(summary.flicker.len(), 2 * 3);
    // Windows of 3×3 pixels inside the image; two border pixels of 1/2 each along an axis.
    let along = |n: f64| ((n - 2.0) / 3.0 + 1.0) / n;
    let left = along(64.0) * along(48.0);
    for spp in [4u32, 16] {
        let variance = 0.25 / f64::from(spp);
        // Relative, of normal errors with 3 degrees of freedom per pixel and channel.
        let spread = (2.0 / (3.0 * PIXELS * (FRAMES - 1) as f64 * f64::from(replicates))).sqrt();
        let plain = found(&summary, "mc", spp);
        let off = plain.variance.value / variance - 1.0;
        assert!(off.abs() < 5.0 * spread, "{spp}: {off} with {spread}");
        assert_eq!((plain.scenes.join(" "), plain.sequence.as_str()), ("f0 f1 f2 f3".into(), "still"));
        assert_eq!((&plain.ratio_to_first, plain.reference_variance), (&None, Some(0.0)));
        assert_eq!((plain.variance.source, plain.variance.n), (Source::Replicates, replicates));
        // A ninth as many independent values.
        let blurred = found(&summary, "blur", spp).ratio_to_first.clone().unwrap();
        let off = blurred.value / left - 1.0;
        assert!(off.abs() < 5.0 * spread * 10f64.sqrt(), "{spp}: {off}");
        assert!(blurred.high.unwrap() < 1.0 && found(&summary, "blur", spp).first == "mc");
        let offset = found(&summary, "judge", spp);
        let ratio = offset.ratio_to_first.clone().unwrap().value;
        assert!((ratio - 1.0).abs() < 1e-5, "{spp}: the same noise: {ratio}");
        let off = offset.squared_error.value - variance - 0.25;
        let linear = 2.0 * 0.5 * (variance / (3.0 * PIXELS * FRAMES as f64 * f64::from(replicates))).sqrt();
        assert!(off.abs() < 5.0 * linear.hypot(variance * spread), "{spp}: {off}");
    }
    // The mean squared error over the frames is what their records say.
    let mse: Vec<f64> = summary
        .cells
        .iter()
        .filter(|c| c.label == "judge" && c.spp == 4)
        .map(|c| c.metrics["mse"].value)
        .collect();
    let mean = mse.iter().sum::<f64>() / mse.len() as f64;
    assert_eq!(mse.len(), FRAMES);
    assert!((found(&summary, "judge", 4).squared_error.value / mean - 1.0).abs() < 1e-9);
    let again = reanalyse(&place.out(), false).unwrap();
    assert_eq!(again.flicker, summary.flicker);
}

#[test]
fn a_row_that_fails_or_a_replicate_that_is_missing_takes_no_part() {
    let place = Place::new();
    let text = sequence(3, "[[method]]\nid = \"fails\"\n");
    // One frame has fewer replicates: the others' third has no partner.
    let fewer = text.replace("id = \"f3\"\n", "id = \"f3\"\nreplicates = 2\n");
    let summary = place.run(&study(&fewer), &Watch::default()).unwrap();
    assert!(summary.flicker.iter().all(|f| f.variance.n == 2 && f.label != "fails"));
    assert_eq!(summary.flicker.len(), 2 * 3);
    let other_level = text.replace("id = \"f3\"\n", "id = \"f3\"\nspp = [16]\n");
    let place = Place::new();
    let summary = place.run(&study(&other_level), &Watch::default()).unwrap();
    assert!(summary.flicker.len() == 3 && summary.flicker.iter().all(|f| f.spp == 16));
    let place = Place::new();
    let nothing = text.replace("id = \"f3\"\n", "id = \"f3\"\nspp = [8]\n");
    let summary = place.run(&study(&nothing), &Watch::default()).unwrap();
    assert!(summary.flicker.is_empty());
    assert!(
        summary
            .warnings
            .iter()
            .any(|w| w.to_string().contains("sequence still: flicker is left out: no replicate"))
    );
}

#[test]
fn a_stopped_study_has_no_flicker_and_a_lost_image_is_told() {
    let place = Place::new();
    let study = study(&sequence(2, ""));
    place.run(&study, &Watch::stopping_after(15)).unwrap_err();
    let stopped = reanalyse(&place.out(), false).unwrap();
    assert!(
        stopped.flicker.is_empty() && !stopped.warnings.iter().any(|w| w.to_string().contains("flicker"))
    );
    let whole = place.run(&study, &Watch::default()).unwrap();
    assert_eq!(whole.flicker.len(), 2 * 3);
    std::fs::remove_file(place.out().join("images/f1/blur/spp00016-r1.exr")).unwrap();
    let lost = reanalyse(&place.out(), false).unwrap();
    assert!(lost.findings.iter().any(|f| f.subject.ends_with("spp00016-r1.exr")), "{:?}", lost.findings);
    // Its replicate takes no part; everything else stays.
    let others = |summary: &Summary| -> Vec<FlickerSummary> {
        summary.flicker.iter().filter(|f| f.label != "blur" || f.spp != 16).cloned().collect()
    };
    assert_eq!((others(&lost).len(), others(&lost)), (5, others(&whole)));
    assert!(lost.flicker.iter().all(|f| f.label != "blur" || f.spp != 16 || f.variance.n == 1));
    std::fs::write(place.out().join("reference/f2.exr"), "").unwrap();
    let blind = reanalyse(&place.out(), false).unwrap();
    assert!(blind.flicker.is_empty());
    let told =
        |w: &String| w.contains("sequence still: flicker is left out: ") && w.contains("reference/f2.exr");
    assert!(blind.warnings.iter().any(|w| told(&w.to_string())), "{:?}", blind.warnings);
}

#[test]
fn frames_that_are_rendered_have_the_noise_of_their_references_taken_out() {
    let frames: String = (0..3)
        .map(|k| {
            format!("[[scene]]\nid = \"spin-{k}\"\nscene = \"spin\"\nframe = {k}\nsequence = \"spin\"\n")
        })
        .collect();
    let text = format!(
        "name = \"spin\"\nspp = [4]\nreplicates = 2\nwidth = 16\nheight = 12\ndepth = 3\nreference = {{ spp = 64 }}\n\
         timing = {{ warmup = 0, runs = 1 }}\n{frames}[[method]]\nid = \"mc\"\n[[method]]\nid = \"blur\"\n"
    );
    let place = Place::new();
    let summary = place.run(&study(&text), &Watch::default()).unwrap();
    let file = |relative: String| place.out().join(relative);
    // The same again in two passes, from the files.
    let references = [0, 1, 2].map(|k| {
        let path = file(format!("reference/spin-{k}.exr"));
        noisefloor_io::read_reference(
            path,
            &noisefloor_io::ReadOptions { spp: Some(1), ..Default::default() },
        )
        .unwrap()
    });
    let (mut variance, mut noise) = (0.0, 0.0);
    let values = 16 * 12 * 3;
    for reference in &references {
        let stated = reference.frame.color.variance.as_ref().unwrap().mean_variance().data();
        noise += stated.iter().map(|&v| f64::from(v)).sum::<f64>() / (3 * values) as f64;
    }
    for replicate in 0..2 {
        let images = [0, 1, 2].map(|k| {
            noisefloor_io::read_color(file(format!("images/spin-{k}/blur/spp00004-r{replicate}.exr")))
                .unwrap()
        });
        for i in 0..values {
            let error =
                [0, 1, 2].map(|k| f64::from(images[k].data()[i]) - f64::from(references[k].mean().data()[i]));
            let mean = error.iter().sum::<f64>() / 3.0;
            variance += error.iter().map(|e| (e - mean).powi(2)).sum::<f64>() / 2.0 / (2 * values) as f64;
        }
    }
    let blurred = found(&summary, "blur", 4);
    assert!(noise > 0.0 && (blurred.reference_variance.unwrap() / noise - 1.0).abs() < 1e-9);
    let expected = variance - noise;
    assert!((blurred.variance.value / expected - 1.0).abs() < 1e-9, "{:?} {expected}", blurred.variance);
    assert!(blurred.ratio_to_first.is_some() && blurred.first == "mc");
    let titles: Vec<&str> = summary.scenes.iter().map(|scene| scene.title.as_str()).collect();
    assert!(titles[1].ends_with(" · spin-1") && titles[0] != titles[1], "{titles:?}");
}

#[test]
fn sequences_that_make_no_sense_are_refused() {
    let refused = |text: &str| Study::from_toml(text, Path::new("flicker.toml")).unwrap_err();
    let text = sequence(2, "");
    let line = |text: &str, id: &str| {
        let at = text.lines().position(|l| l == format!("id = \"{id}\"")).unwrap();
        format!("flicker.toml, line {at}: ")
    };
    let twice = text.replace("frame = 3", "frame = 2");
    let message = refused(&twice).to_string();
    let expected =
        line(&twice, "f3") + "scene[2].frame is 2; allowed: frames that differ within sequence `still`";
    assert_eq!(message, expected);
    let short = text.replacen("sequence = \"still\"", "sequence = \"other\"", 2);
    let message = refused(&short).to_string();
    assert!(message.starts_with(&(line(&short, "f2") + "scene[0].sequence is `other`")), "{message}");
    assert!(message.contains("at least 3 scenes"), "{message}");
    let blank = text.replace("\"still\"", "\"\"");
    assert!(refused(&blank).to_string().contains("scene[0].sequence is ``"), "{}", refused(&blank));
    // A place in a sequence has a meaning without a renderer; a camera has none.
    let orbit = text.replace("frame = 3", "frame = 3\norbit_degrees = 5");
    assert!(refused(&orbit).to_string().contains("scenes that are rendered"));
    // Sizes are known once the scenes are open.
    let wide = text.replacen("width = 64", "width = 32", 1);
    let error = Place::new().run(&study(&wide), &Watch::default()).unwrap_err();
    assert!(matches!(error, HarnessError::Study(StudyError::Field { .. })));
    assert!(error.to_string().contains("sequence `still`: size is 32×48 and 64×48"), "{error}");
}
