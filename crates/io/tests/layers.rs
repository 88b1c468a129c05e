//! A layer that cannot be used costs itself, not the frame, and every such case is told.

use std::path::Path;

use exr::prelude::*;
use noisefloor_frame::{FeatureId, Finding, FindingKind};
use noisefloor_io::{FrameFile, ReadOptions, read_color, read_frame_file, read_info};

const SPP: ReadOptions = ReadOptions { spp: Some(4), max_decoded_bytes: None };

/// A 4×3 file with these float channels beside R, G and B; channel k of the list has the value k + 1.
fn write(path: &Path, names: &[&str]) {
    let rgb = [("R", 0.25), ("G", 0.5), ("B", 0.75)];
    let more = names.iter().enumerate().map(|(k, name)| (*name, k as f32 + 1.0));
    let channels = rgb.into_iter().chain(more);
    let channels = channels.map(|(name, value)| AnyChannel::new(name, FlatSamples::F32(vec![value; 12])));
    let layer = Layer::new(
        (4, 3),
        LayerAttributes::default(),
        Encoding::FAST_LOSSLESS,
        AnyChannels::sort(channels.collect()),
    );
    Image::from_layer(layer).write().to_file(path).unwrap();
}

fn read(names: &[&str]) -> FrameFile {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("file.exr");
    write(&path, names);
    let file = read_frame_file(&path, &SPP).unwrap_or_else(|e| panic!("{names:?}: {e}"));
    assert_eq!(read_info(&path).unwrap().findings, file.findings, "the header alone says it");
    file
}

fn told(file: &FrameFile) -> Vec<(FindingKind, &str)> {
    file.findings.iter().map(|f| (f.kind, f.subject.as_str())).collect()
}

fn values(file: &FrameFile, id: &FeatureId) -> Vec<f32> {
    file.frame.features[id].mean.planes().map(|plane| plane[5]).collect()
}

#[test]
fn a_fourth_channel_is_left_out() {
    let file = read(&["albedo.A", "albedo.B", "albedo.G", "albedo.R"]);
    assert_eq!(values(&file, &FeatureId::Albedo), [4.0, 3.0, 2.0]);
    assert_eq!(told(&file), [(FindingKind::LayerLeftOut, "albedo")]);
    assert!(file.findings[0].text.contains("`A`"), "{}", file.findings[0]);
    let file = read(&["variance.R", "variance.G", "variance.B", "variance.A"]);
    assert!(file.frame.color.variance.is_some());
    assert_eq!(told(&file), [(FindingKind::LayerLeftOut, "color.variance")]);
}

#[test]
fn channels_of_another_usual_name_are_read() {
    let file = read(&["normal.R", "normal.G", "normal.B", "depth.V", "motion.U", "motion.V"]);
    assert_eq!(values(&file, &FeatureId::Normal), [1.0, 2.0, 3.0]);
    assert_eq!(values(&file, &FeatureId::Depth), [4.0]);
    assert_eq!(values(&file, &FeatureId::Motion), [5.0, 6.0]);
    let read_as = FindingKind::LayerReadAs;
    assert_eq!(told(&file), [(read_as, "normal"), (read_as, "depth"), (read_as, "motion")]);
    assert!(file.findings[0].text.contains("R, G, B were read as X, Y, Z"), "{}", file.findings[0]);
}

#[test]
fn what_is_incomplete_or_means_nothing_is_left_out() {
    for (names, subjects) in [
        (&["albedo.R", "albedo.G"][..], &["albedo"][..]),
        (&["normal.X", "normal.Y"], &["normal"]),
        (&["mine.G", "mine.B"], &["mine"]),
        (&["m.X", "m.Y", "m.variance.X"], &["m.variance"]),
        (&["albedo.variance.R", "albedo.variance.G", "albedo.variance.B"], &["albedo.variance"]),
        (&["depth.Z", "depth.halfA.Z"], &["depth.halfA"]),
        (&["flashBase.R", "flashBase.G", "flashBase.B"], &["flashBase"]),
        (&["flashCov.R", "flashCov.G", "flashCov.B"], &["flashCov"]),
        (&["variance"], &["variance"]),
        (&["albedo"], &["albedo"]),
        (&[".R"], &[".R"]),
        (&["a..b"], &["a..b"]),
        (&["flashCov.variance.R"], &["flashCov.variance.R"]),
        (&["depth", "depth.Z"], &["depth"]),
    ] {
        let file = read(names);
        let expected: Vec<_> = subjects.iter().map(|s| (FindingKind::LayerLeftOut, *s)).collect();
        assert_eq!(told(&file), expected, "{names:?}");
        assert!(file.frame.flash.is_none() && file.frame.color.variance.is_none(), "{names:?}");
        assert!(file.frame.features.values().all(|f| f.variance.is_none() && f.halves.is_none()));
    }
}

#[test]
fn a_layer_that_looks_like_a_feature_is_pointed_out() {
    let says = |names: &[&str]| -> String {
        read(names).findings.iter().map(Finding::to_string).collect::<Vec<_>>().join("\n")
    };
    let albedo = says(&["Albedo.R", "Albedo.G", "Albedo.B"]);
    assert_eq!(albedo, "Albedo: read by no method; did you mean `albedo`?");
    assert!(says(&["N.X", "N.Y", "N.Z"]).contains("did you mean `normal`?"));
    assert!(says(&["Normal.X", "Normal.Y", "Normal.Z"]).contains("did you mean `normal`?"));
    assert!(says(&["Z"]).contains("did you mean `depth`?"));
    assert!(says(&["halfa.R", "halfa.G", "halfa.B"]).contains("did you mean `halfA`?"));
    assert!(says(&["albedo.R", "albedo.G", "albedo.B", "Albedo.R"]).contains("as `albedo` is there too"));
    assert_eq!(says(&["A", "P.X", "P.Y", "P.Z", "u", "dzdx"]), "");
}

#[test]
fn the_variance_of_one_sample_is_not_taken_for_that_of_the_mean() {
    let file = read(&["Variance.R", "Variance.G", "Variance.B"]);
    assert!(file.frame.color.variance.is_none());
    assert_eq!(told(&file), [(FindingKind::UnreadLayer, "Variance")]);
    assert!(file.findings[0].text.contains("that of one sample"), "{}", file.findings[0]);
}

#[test]
fn a_colour_is_read_whatever_stands_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("file.exr");
    write(&path, &["variance.R", "halfA.G", "albedo"]);
    assert_eq!(read_color(&path).unwrap().get(2, 0, 0), 0.75);
}

#[test]
fn an_optional_statistic_without_one_of_its_images_or_of_an_unknown_kind_is_left_out() {
    let rgb = |layer: &str| ["R", "G", "B"].map(|channel| format!("optional.{layer}.{channel}"));
    let layers = ["least", "position.right", "box-cox:0:0.001.mean", "box-cox:9:0.001.mean", "kurtosis"];
    let names: Vec<String> = layers.iter().flat_map(|layer| rgb(layer)).collect();
    let file = read(&names.iter().map(String::as_str).collect::<Vec<_>>());
    let kept: Vec<String> = file.frame.optional.recorded().iter().map(|(s, _)| s.to_string()).collect();
    assert_eq!(kept, ["least"]);
    assert_eq!(file.frame.optional.least().unwrap().get(2, 3, 2), 3.0);
    assert!(file.frame.features.is_empty());
    let subjects: Vec<&str> = file.findings.iter().map(|f| f.subject.as_str()).collect();
    for layer in &layers[1..] {
        assert!(subjects.iter().any(|subject| subject.contains(layer)), "{layer}: {subjects:?}");
    }
}
