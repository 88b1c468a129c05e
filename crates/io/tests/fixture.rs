//! Frames of another renderer: text `spp`, no `sampling`, mixed sample types, a reference without halves.

mod common;

use std::path::PathBuf;

use noisefloor_frame::{FeatureId, Fidelity, FindingKind, Sampling, SquaredError, Variance};
use noisefloor_io::{
    FrameFolder, ReadOptions, read_attributes, read_checked_frame, read_checked_reference, read_frame,
    read_info, read_reference, scan_scenes, write_frame,
};

fn fixture(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../tests/fixtures/tabletop_crop").join(name)
}

#[test]
fn the_frame_reads_as_documented() {
    let frame = read_frame(fixture("spp0016.exr"), &ReadOptions::default()).unwrap();
    assert_eq!((frame.width(), frame.height()), (64, 64));
    assert_eq!((frame.samples.at(0), frame.samples.halves_at(0)), (16, (8, 8)));
    assert_eq!(frame.sampling, Sampling::Independent, "by the sampler's name");
    assert_eq!(frame.provenance.renderer.as_deref(), Some("Mitsuba 3.9.1"));
    assert_eq!(frame.provenance.scene.as_deref(), Some("tabletop_dof"));
    assert!(frame.features.keys().eq([&FeatureId::Albedo, &FeatureId::Normal, &FeatureId::Depth]));
    for estimate in frame.features.values() {
        assert!(estimate.variance.is_some() && estimate.halves.is_none());
        assert_eq!(estimate.mean.count_non_finite(), 0);
    }
    assert!(frame.flash.is_none());
    let attributes = read_attributes(fixture("spp0016.exr")).unwrap();
    assert_eq!(attributes["spp"], "16");
    let normals = &frame.features[&FeatureId::Normal].mean;
    for pixel in 0..64 * 64 {
        let length: f32 = normals.planes().map(|plane| plane[pixel] * plane[pixel]).sum();
        // Means of unit vectors are no longer; half floats round to 2⁻¹¹.
        assert!(length <= 1.0 + 4.0 / 2048.0, "{length}");
    }
}

#[test]
fn halves_average_to_the_mean() {
    let frame = read_frame(fixture("spp0016.exr"), &ReadOptions::default()).unwrap();
    let [a, b] = frame.color.halves.as_ref().unwrap();
    for ((&mean, &a), &b) in frame.color.mean.data().iter().zip(a.data()).zip(b.data()) {
        // Each of the three was rounded to 15 bits of mantissa.
        let tolerance = (mean.abs() + 0.5 * (a.abs() + b.abs())) / 65536.0;
        assert!((0.5 * (a + b) - mean).abs() <= tolerance * 1.01, "{a} {b} {mean}");
    }
}

#[test]
fn the_frame_is_sound_and_a_lost_factor_would_be_noticed() {
    let (mut frame, hygiene) = read_checked_frame(fixture("spp0016.exr"), &ReadOptions::default()).unwrap();
    assert_eq!(hygiene.findings, []);
    assert_eq!(frame, read_frame(fixture("spp0016.exr"), &ReadOptions::default()).unwrap());
    let stored = frame.color.variance.take().unwrap().into_mean_variance();
    frame.color.variance = Some(Variance::of_mean(stored.map(|v| v * 16.0)));
    let found = frame.inspect(Fidelity::Rounded).unwrap().findings;
    assert_eq!(found[0].kind, FindingKind::VarianceAgainstHalves);
    assert!(found[0].value.unwrap() > 4.0, "{}", found[0]);
    assert_eq!(read_checked_reference(fixture("reference.exr"), &ReadOptions::default()).unwrap().1, []);
}

#[test]
fn the_reference_reads_as_documented() {
    let reference = read_reference(fixture("reference.exr"), &ReadOptions::default()).unwrap();
    assert_eq!(reference.frame.samples.at(0), 4096);
    assert_eq!(reference.frame.sampling, Sampling::LowDiscrepancy, "multi-jittered");
    assert!(reference.parts.is_empty() && reference.frame.color.halves.is_none());
    assert_eq!(reference.squared_error(), SquaredError::SubtractVariance);
    // It shows the same picture: the frame's squared error is about its variance. 12288 values of heavy tails, so
    // only the order of magnitude is sure; a shift by one pixel would give many times as much.
    let frame = read_frame(fixture("spp0016.exr"), &ReadOptions::default()).unwrap();
    let variance = frame.color.variance.as_ref().unwrap().mean_variance();
    let values = frame.color.mean.data().iter().zip(reference.mean().data()).zip(variance.data());
    let mut scaled: Vec<f32> = values.map(|((x, r), v)| (x - r).powi(2) / v.max(1e-12)).collect();
    scaled.sort_by(f32::total_cmp);
    let median = scaled[scaled.len() / 2];
    // For Gaussian noise the median of χ² with one degree of freedom: 0.455.
    assert!((0.3..0.7).contains(&median), "{median}");
}

#[test]
fn the_folder_is_one_scene() {
    let options = ReadOptions::default();
    let folder = FrameFolder::scan(fixture(""), &options).unwrap();
    assert_eq!(folder.reference, fixture("reference.exr"));
    assert_eq!(folder.name(), "tabletop_crop");
    let listed: Vec<_> = folder.frames.iter().map(|frame| (frame.spp, frame.replicate)).collect();
    assert_eq!(listed, [(16, 0)]);
    assert_eq!(folder.frames[0].info, read_info(fixture("spp0016.exr")).unwrap());
    assert_eq!(scan_scenes(fixture(""), &options).unwrap(), [folder]);
}

#[test]
fn it_survives_being_written_in_our_own_way() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("again.exr");
    let frame = read_frame(fixture("spp0016.exr"), &ReadOptions::default()).unwrap();
    write_frame(&path, &frame).unwrap();
    common::assert_same_frame(&frame, &read_frame(&path, &ReadOptions::default()).unwrap());
}
