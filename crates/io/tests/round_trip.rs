//! What is written comes back, bit for bit.

mod common;

use std::collections::BTreeMap;

use common::*;
use noisefloor_frame::{
    Counts, Estimate, FeatureId, Flash, FourParts, Frame, Image, Optional, Reference, Samples, Sampling,
    Statistic,
};
use noisefloor_io::{
    ReadOptions, read_attributes, read_color, read_frame, read_image, read_info, read_reference, write_frame,
    write_image, write_reference,
};

fn there_and_back(frame: &Frame) -> Frame {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("frame.exr");
    write_frame(&path, frame).unwrap();
    read_frame(&path, &ReadOptions::default()).unwrap()
}

#[test]
fn a_frame_with_everything_comes_back_bit_for_bit() {
    // 37 rows: two full blocks of 16 and a partial one.
    for (width, height) in [(33, 37), (1, 1), (5, 16)] {
        let frame = full_frame(width, height);
        assert_same_frame(&frame, &there_and_back(&frame));
    }
}

#[test]
fn how_long_a_frame_took_is_no_part_of_its_file() {
    let folder = tempfile::tempdir().unwrap();
    let bytes = |name: &str, frame: &Frame| {
        let path = folder.path().join(name);
        write_frame(&path, frame).unwrap();
        std::fs::read(path).unwrap()
    };
    let frame = full_frame(5, 4);
    let mut slow = frame.clone();
    slow.provenance.render_seconds = Some(12.5);
    slow.provenance.render_threads = Some(64);
    assert!(bytes("a.exr", &frame) == bytes("b.exr", &slow));
}

#[test]
fn an_image_large_enough_for_the_thread_pool_comes_back() {
    let frame = Frame::from_color(estimate(320, 300, 3, 5), Samples::uniform(7), Sampling::Independent);
    assert_same_frame(&frame, &there_and_back(&frame));
}

#[test]
fn a_frame_with_nothing_but_colour_comes_back() {
    let color = Estimate::from_mean(image(4, 3, 3, 2));
    let mut frame = Frame::from_color(color, Samples::uniform(1), Sampling::Independent);
    assert_same_frame(&frame, &there_and_back(&frame));
    frame.flash = Some(Flash::Ready(estimate(4, 3, 3, 3)));
    frame.provenance.extra.insert("filter".into(), "gaussian".into());
    assert_same_frame(&frame, &there_and_back(&frame));
}

#[test]
fn every_kind_of_sample_count_comes_back() {
    let map = |f: fn(u32) -> u32| Counts::PerPixel((1..=6).map(f).collect());
    let counts = [
        Samples::uniform(1),
        Samples::uniform(u32::MAX),
        Samples::uniform(9),
        Samples::uniform(9).with_half_a(Counts::Uniform(2)),
        Samples::uniform(9).with_half_a(Counts::Uniform(0)),
        Samples::uniform(9).with_half_a(map(|n| n)),
        Samples::per_pixel((1..=6).collect()),
        Samples::per_pixel(vec![4; 6]),
        Samples::per_pixel((1..=6).map(|n| u32::MAX - n).collect()),
        Samples::per_pixel((1..=6).collect()).with_half_a(map(|n| n - 1)),
        Samples::per_pixel((1..=6).collect()).with_half_a(Counts::Uniform(1)),
    ];
    for samples in counts {
        let frame = Frame::from_color(estimate(3, 2, 3, 4), samples, Sampling::Independent);
        assert_same_frame(&frame, &there_and_back(&frame));
    }
}

#[test]
fn a_reference_comes_back_with_its_parts() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("reference.exr");
    // More than ten parts: `part10` sorts before `part2` on disk.
    let parts: Vec<Image> =
        (0..12).map(|k| Image::from_fn(6, 5, 3, |c, x, y| (c + x * y + k) as f32)).collect();
    let mut reference = Reference::from_parts(parts, 64, Sampling::LowDiscrepancy).unwrap();
    reference.frame.features.insert(FeatureId::Albedo, estimate(6, 5, 3, 8));
    write_reference(&path, &reference).unwrap();
    let back = read_reference(&path, &ReadOptions::default()).unwrap();
    assert_same_frame(&reference.frame, &back.frame);
    assert_eq!(reference.parts, back.parts);
    // As a frame it is the same without the parts.
    assert_same_frame(&reference.frame, &read_frame(&path, &ReadOptions::default()).unwrap());

    let exact = Reference::exact(image(3, 3, 3, 9));
    write_reference(&path, &exact).unwrap();
    let back = read_reference(&path, &ReadOptions::default()).unwrap();
    assert_same_frame(&exact.frame, &back.frame);
    assert_eq!((back.parts.len(), back.squared_error()), (0, exact.squared_error()));
}

#[test]
fn images_of_any_number_of_channels_come_back_with_their_attributes() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("image.exr");
    let attributes: BTreeMap<_, _> =
        [("method", "virtual-flash"), ("comments", "kept although the format has its own"), ("spp", "4")]
            .map(|(name, value)| (name.to_owned(), value.to_owned()))
            .into();
    for channels in [1, 2, 3, 4, 5, 11] {
        let written = image(7, 18, channels, 77);
        write_image(&path, &written, &attributes).unwrap();
        assert_same_image("image", &written, &read_image(&path).unwrap());
        assert_eq!(read_attributes(&path).unwrap(), attributes);
    }
}

#[test]
fn colour_of_a_frame_reads_as_an_image() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("frame.exr");
    let frame = full_frame(9, 8);
    write_frame(&path, &frame).unwrap();
    assert_same_image("color", &frame.color.mean, &read_image(&path).unwrap());
    assert_same_image("color", &frame.color.mean, &read_color(&path).unwrap());
    // Alpha is a fourth plane of an image, and no colour.
    let rgba = image(9, 8, 4, 3);
    write_image(&path, &rgba, &no_attributes()).unwrap();
    let color = read_color(&path).unwrap();
    assert_eq!(color.channels(), 3);
    for c in 0..3 {
        assert!(rgba.plane(c).iter().zip(color.plane(c)).all(|(a, b)| a.to_bits() == b.to_bits()));
    }
}

#[test]
fn the_header_alone_says_what_is_in_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("frame.exr");
    let mut frame = Frame::from_color(estimate(9, 8, 3, 1), Samples::uniform(16), Sampling::LowDiscrepancy);
    frame.features.insert(FeatureId::Depth, Estimate::from_mean(image(9, 8, 1, 2)));
    frame.provenance = provenance();
    write_frame(&path, &frame).unwrap();
    let info = read_info(&path).unwrap();
    assert_eq!(
        (info.width, info.height, info.spp, info.sampling),
        (9, 8, Some(16.0), Sampling::LowDiscrepancy)
    );
    assert_eq!(info.layers, ["color", "color.halfA", "color.halfB", "color.variance", "depth"]);
    assert_eq!(info.provenance, frame.provenance);
    frame.samples = Samples::per_pixel((0..72).map(|p| 1 + p % 2).collect());
    write_frame(&path, &frame).unwrap();
    assert_eq!(read_info(&path).unwrap().spp, Some(1.5));
}

#[test]
fn equal_frames_make_equal_files() {
    let folder = tempfile::tempdir().unwrap();
    let bytes: Vec<Vec<u8>> = ["a.exr", "b.exr"]
        .map(|name| {
            let path = folder.path().join(name);
            write_frame(&path, &full_frame(20, 17)).unwrap();
            std::fs::read(path).unwrap()
        })
        .into();
    assert!(bytes[0] == bytes[1]);
}

/// A frame of these samples, with four parts dealt from the sample of index `first` on and other optional statistics.
fn with_optional(samples: Samples, first: u32) -> Frame {
    let names =
        ["third-moment", "least", "box-cox:0:0.001", "box-cox:-0.5:1000000", "four-parts", "position"];
    let mut frame = Frame::from_color(estimate(5, 4, 3, 1), samples, Sampling::Independent);
    let recorded = names.iter().zip(0..).map(|(name, k)| {
        let statistic: Statistic = name.parse().unwrap();
        let images = (0..statistic.row().images.len() as u32).map(|i| image(5, 4, 3, 100 + 10 * k + i));
        (statistic, images.collect())
    });
    let parts = FourParts::dealt(first, frame.samples.total());
    frame.optional = Optional::new(recorded.collect(), Some(parts), Vec::new()).unwrap();
    frame
}

#[test]
fn optional_statistics_come_back_with_how_samples_were_dealt() {
    let map: Vec<u32> = (4..24).collect();
    for samples in [Samples::uniform(11), Samples::uniform(8), Samples::per_pixel(map)] {
        for first in 0..4 {
            let frame = with_optional(samples.clone(), first);
            let back = there_and_back(&frame);
            assert_same_frame(&frame, &back);
            assert_eq!(back.optional.recorded().len(), 6);
            for ((a, ours), (b, theirs)) in frame.optional.recorded().iter().zip(back.optional.recorded()) {
                assert_eq!(a, b);
                ours.iter().zip(theirs).for_each(|(x, y)| assert_same_image(&a.to_string(), x, y));
            }
            let parts = |frame: &Frame| frame.optional.four_parts().unwrap().samples.clone();
            assert_eq!(parts(&frame), parts(&back));
        }
    }
}

#[test]
fn parts_that_were_not_dealt_in_turn_are_refused() {
    let mut frame = with_optional(Samples::uniform(8), 0);
    let recorded = frame.optional.recorded().to_vec();
    frame.optional = Optional::new(recorded, Some([5, 1, 1, 1].map(Counts::Uniform)), Vec::new()).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("frame.exr");
    let error = write_frame(&path, &frame).unwrap_err();
    assert!(error.to_string().contains("four-parts"), "{error}");
    assert!(!path.exists());
}
