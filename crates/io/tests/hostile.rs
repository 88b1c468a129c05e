//! Damaged, hostile and mislabelled files end in an error that says what is wrong and where.

mod common;

use std::path::{Path, PathBuf};
use std::sync::Once;

use common::*;
use exr::prelude::*;
use noisefloor_frame::{Counts, Estimate, FeatureId, Frame, FrameError, Samples, Sampling};
use noisefloor_io::{
    IoError, ReadOptions, read_color, read_frame, read_image, read_reference, write_frame, write_reference,
};

const SPP: ReadOptions = ReadOptions { spp: Some(4), max_decoded_bytes: None };

struct Scratch {
    _folder: tempfile::TempDir,
    path: PathBuf,
}

fn scratch() -> Scratch {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("file.exr");
    Scratch { _folder: folder, path }
}

/// A 4×3 file with these float channels.
fn write_channels(path: &Path, names: &[&str], encoding: Encoding) {
    let channels = names.iter().enumerate().map(|(k, name)| {
        AnyChannel::new(*name, FlatSamples::F32((0..12).map(|p| (p * k) as f32 * 0.37).collect()))
    });
    let layer =
        Layer::new((4, 3), LayerAttributes::default(), encoding, AnyChannels::sort(channels.collect()));
    Image::from_layer(layer).write().to_file(path).unwrap();
}

fn error_of(names: &[&str]) -> (IoError, String) {
    let s = scratch();
    write_channels(&s.path, names, Encoding::FAST_LOSSLESS);
    let error = read_frame(&s.path, &SPP).unwrap_err();
    let message = error.to_string();
    assert!(message.starts_with(&s.path.display().to_string()), "{message}");
    (error, message.rsplit_once("file.exr: ").unwrap().1.to_owned())
}

#[test]
fn incomplete_colour_names_the_missing_channel() {
    let cases: [(&[&str], &str, &str); 3] = [
        (&["R", "G"], "color", "B"),
        (&["R", "G", "B", "variance.R", "variance.B"], "color.variance", "G"),
        (&["R", "G", "B", "halfA.R", "halfB.R"], "color.halfA", "G"),
    ];
    for (names, bad_layer, bad_channel) in cases {
        let (error, message) = error_of(names);
        assert!(
            matches!(&error, IoError::IncompleteLayer { layer, channel, .. } if layer == bad_layer && channel == bad_channel),
            "{message}"
        );
    }
    let (error, message) = error_of(&["R", "G", "B", "variance.X", "variance.Y", "variance.Z"]);
    assert!(matches!(error, IoError::UnexpectedChannel { .. }), "another colour space, perhaps: {message}");
    let (error, _) = error_of(&["R", "G", "B", "samples", "samples.Y"]);
    assert!(
        matches!(&error, IoError::DuplicateChannel { layer, channel, .. } if layer == "samples" && channel == "Y")
    );
}

#[test]
fn colour_layers_that_need_others_say_which() {
    let rgb = ["R", "G", "B"];
    let layer = |name: &str| rgb.map(|c| format!("{name}.{c}"));
    let cases: [(&[&str], &str, &str); 2] =
        [(&["albedo"], "color", "a frame"), (&["", "halfA"], "color.halfB", "`color.halfA`")];
    for (layers, missing, because) in cases {
        let names: Vec<String> = layers
            .iter()
            .flat_map(|l| if l.is_empty() { rgb.map(str::to_owned) } else { layer(l) })
            .collect();
        let (error, message) = error_of(&names.iter().map(String::as_str).collect::<Vec<_>>());
        assert!(
            matches!(&error, IoError::MissingLayer { layer, needed_by, .. } if layer == missing && needed_by == because),
            "{message}"
        );
    }
    let names: Vec<String> = ["flash", "flashBase", "flashLight"].into_iter().flat_map(layer).collect();
    let names: Vec<&str> = rgb.into_iter().chain(names.iter().map(String::as_str)).collect();
    assert!(matches!(error_of(&names).0, IoError::ConflictingLayers { layer, other, .. }
        if layer == "flashBase" && other == "flash"));

    let s = scratch();
    write_channels(&s.path, &["R", "G", "B", "part1.R", "part1.G", "part1.B"], Encoding::FAST_LOSSLESS);
    assert!(read_frame(&s.path, &SPP).is_ok(), "parts are not looked at");
    let error = read_reference(&s.path, &SPP).unwrap_err();
    assert!(matches!(&error, IoError::MissingLayer { layer, .. } if layer == "part0"), "{error}");
    write_channels(&s.path, &["depth.Z"], Encoding::FAST_LOSSLESS);
    assert!(matches!(read_image(&s.path), Err(IoError::MissingLayer { .. })));
    assert!(matches!(read_color(&s.path), Err(IoError::MissingLayer { .. })));
    write_channels(&s.path, &["G", "B"], Encoding::FAST_LOSSLESS);
    assert!(matches!(read_image(&s.path), Err(IoError::IncompleteLayer { channel, .. }) if channel == "R"));
}

#[test]
fn impossible_sample_counts_name_the_pixel() {
    let s = scratch();
    for (value, layer) in [
        (0.0f32, "samples"),
        (1.5, "samples"),
        (-1.0, "samples"),
        (f32::NAN, "samples"),
        (9.0, "samples.halfA"),
    ] {
        let mut counts = vec![8.0f32; 12];
        counts[7] = value;
        let names = ["R", "G", "B"].map(|name| AnyChannel::new(name, FlatSamples::F32(vec![0.5; 12])));
        let mut channels: Vec<AnyChannel<FlatSamples>> = names.into();
        channels.push(AnyChannel::new(format!("{layer}.Y").as_str(), FlatSamples::F32(counts)));
        let layers = Layer::new(
            (4, 3),
            LayerAttributes::default(),
            Encoding::FAST_LOSSLESS,
            AnyChannels::sort(channels.into_iter().collect()),
        );
        Image::from_layer(layers).write().to_file(&s.path).unwrap();
        let error = read_frame(&s.path, &ReadOptions { spp: Some(8), ..ReadOptions::default() }).unwrap_err();
        assert!(matches!(&error, IoError::Count { layer: l, x: 3, y: 1, .. } if l == layer), "{error}");
    }
}

#[test]
fn frames_that_could_not_be_read_back_are_not_written() {
    let s = scratch();
    let good = || Frame::from_color(estimate(3, 2, 3, 1), Samples::uniform(4), Sampling::Independent);
    for name in ["", "variance", "samples", "part3", "flash", "a.halfA", "a..b", "x\0y", "albedo"] {
        let mut frame = good();
        frame.features.insert(FeatureId::Extra(name.into()), Estimate::from_mean(image(3, 2, 1, 1)));
        let error = write_frame(&s.path, &frame).unwrap_err();
        assert!(matches!(error, IoError::Mislabelled { .. }), "{name:?}: {error}");
    }
    for samples in [Samples::uniform(0), Samples::uniform(4).with_half_a(Counts::Uniform(5))] {
        let frame = Frame { samples, ..good() };
        assert!(matches!(write_frame(&s.path, &frame), Err(IoError::Count { x: 0, y: 0, .. })));
    }
    let mut frame = good();
    frame.provenance = provenance();
    frame.provenance.camera.as_mut().unwrap().vertical_fov_degrees = 180.0;
    assert!(
        matches!(write_frame(&s.path, &frame), Err(IoError::Attribute { name, .. }) if name == "verticalFov")
    );
    let mut frame = good();
    frame.provenance.extra.insert("x".repeat(256), String::new());
    assert!(matches!(write_frame(&s.path, &frame), Err(IoError::Attribute { .. })));
    let mut frame = good();
    frame.features.insert(FeatureId::Albedo, Estimate::from_mean(image(3, 3, 3, 1)));
    let misfit = write_frame(&s.path, &frame).unwrap_err();
    assert!(
        matches!(&misfit, IoError::Frame { cause, .. } if matches!(**cause, FrameError::Mismatch { .. })),
        "{misfit}"
    );
    let parts = vec![image(2, 2, 3, 1)];
    let misfit = write_reference(&s.path, &noisefloor_frame::Reference { frame: good(), parts }).unwrap_err();
    assert!(misfit.to_string().contains("part0"), "{misfit}");
    assert!(!s.path.exists());
}

#[test]
fn unwritable_places_are_errors_that_name_the_path() {
    let s = scratch();
    std::fs::write(&s.path, "in the way").unwrap();
    let frame = Frame::from_color(estimate(3, 2, 3, 1), Samples::uniform(4), Sampling::Independent);
    for path in [s.path.join("below a file.exr"), s.path.with_file_name("absent").join("a.exr")] {
        let error = write_frame(&path, &frame).unwrap_err();
        assert!(matches!(&error, IoError::Write { file, .. } if *file == path), "{error}");
    }
}

#[test]
fn files_that_are_no_frame_at_all_are_told_apart() {
    let s = scratch();
    assert!(matches!(read_frame(&s.path, &SPP), Err(IoError::Read { .. })), "absent");
    let folder = s.path.parent().unwrap();
    assert!(matches!(read_frame(folder, &SPP), Err(IoError::Read { .. })), "a folder");
    for contents in [&b""[..], b"v/", b"\x89PNG\r\n\x1a\n"] {
        std::fs::write(&s.path, contents).unwrap();
        assert!(matches!(read_frame(&s.path, &SPP), Err(IoError::NotExr { .. })), "{contents:?}");
    }
    std::fs::write(&s.path, b"v/1\x01").unwrap();
    assert!(matches!(read_frame(&s.path, &SPP), Err(IoError::Truncated { .. })));
    // Version 2 with the flag for deep data.
    std::fs::write(&s.path, b"v/1\x01\x02\x08\x00\x00").unwrap();
    assert!(read_frame(&s.path, &SPP).is_err());

    let channel = || AnyChannels::sort(vec![AnyChannel::new("R", FlatSamples::F32(vec![0.0; 12]))].into());
    let named =
        |name: &str| Layer::new((4, 3), LayerAttributes::named(name), Encoding::FAST_LOSSLESS, channel());
    let attributes = ImageAttributes::with_size((4, 3));
    Image::from_layers(attributes, vec![named("one"), named("two")]).write().to_file(&s.path).unwrap();
    let error = read_frame(&s.path, &SPP).unwrap_err();
    assert!(matches!(&error, IoError::Unsupported { what, .. } if what.starts_with("2 parts")), "{error}");
}

/// Replaces bytes at an offset behind the first occurrence of `after`.
fn patch(path: &Path, after: &[u8], offset: usize, bytes: &[u8]) {
    let mut all = std::fs::read(path).unwrap();
    let found = all.windows(after.len()).position(|w| w == after).expect("the header has it");
    let at = found + after.len() + offset;
    all[at..at + bytes.len()].copy_from_slice(bytes);
    std::fs::write(path, all).unwrap();
}

#[test]
fn hostile_sizes_are_refused_before_allocation() {
    let s = scratch();
    // A box2i attribute: its length (4 bytes), then the corners.
    for (corner, limit) in [(0x3FFF_0000, "at most"), (1 << 20, "at most"), (16_000, "cannot hold")] {
        let corner: i32 = corner;
        write_channels(&s.path, &["R", "G", "B"], Encoding::FAST_LOSSLESS);
        patch(&s.path, b"dataWindow\0box2i\0", 12, &[corner.to_le_bytes(), corner.to_le_bytes()].concat());
        let error = read_frame(&s.path, &SPP).unwrap_err();
        assert!(matches!(&error, IoError::TooLarge { limit: l, .. } if l.contains(limit)), "{error}");
    }
    write_channels(&s.path, &["R", "G", "B"], Encoding::FAST_LOSSLESS);
    patch(&s.path, b"dataWindow\0box2i\0", 12, &[0xFF; 8]);
    assert!(read_frame(&s.path, &SPP).is_err(), "a window upside down");
    let tiled = Encoding { blocks: Blocks::Tiles(Vec2(2, 2)), ..Encoding::FAST_LOSSLESS };
    write_channels(&s.path, &["R", "G", "B"], tiled);
    patch(&s.path, b"tiles\0tiledesc\0", 4, &[0, 0, 0, 0x20, 0, 0, 0, 0x20]);
    let error = read_frame(&s.path, &SPP).unwrap_err();
    assert!(matches!(&error, IoError::TooLarge { limit, .. } if limit.contains("tiles")), "{error}");
}

#[test]
fn subsampled_and_doubled_channels_are_named() {
    let s = scratch();
    write_channels(&s.path, &["B", "G", "R", "mine.Y"], Encoding::FAST_LOSSLESS);
    // A channel: name NUL, type, linear flag and padding (4 bytes each), then the sampling steps.
    patch(&s.path, b"mine.Y\0", 8, &[2, 0, 0, 0, 1, 0, 0, 0]);
    let error = read_frame(&s.path, &SPP).unwrap_err();
    assert!(
        matches!(&error, IoError::Subsampled { channel, x: 2, y: 1, .. } if channel == "mine.Y"),
        "{error}"
    );
    write_channels(&s.path, &["B", "G", "R", "mine.Y", "mine.Z"], Encoding::FAST_LOSSLESS);
    patch(&s.path, b"mine.Z", 0, b"\0");
    patch(&s.path, b"mine.", 17 + 6, b"Y");
    let error = read_frame(&s.path, &SPP).unwrap_err();
    assert!(
        matches!(&error, IoError::DuplicateChannel { layer, channel, .. }
        if layer == "mine" && channel == "mine.Y"),
        "{error}"
    );
}

#[test]
fn a_block_that_is_there_twice_does_not_pass_for_a_whole_image() {
    let s = scratch();
    let frame = Frame::from_color(estimate(8, 40, 3, 1), Samples::uniform(4), Sampling::Independent);
    write_frame(&s.path, &frame).unwrap();
    let mut bytes = std::fs::read(&s.path).unwrap();
    // The table of positions: three increasing numbers of 8 bytes, the first pointing right behind the table.
    let table = (0..bytes.len() - 24)
        .find(|&at| {
            let entry = |k: usize| u64::from_le_bytes(bytes[at + 8 * k..at + 8 * k + 8].try_into().unwrap());
            entry(0) == at as u64 + 24 && entry(1) > entry(0) && entry(2) > entry(1)
        })
        .expect("three blocks of 16 rows");
    bytes.copy_within(table..table + 8, table + 8);
    std::fs::write(&s.path, &bytes).unwrap();
    let error = read_frame(&s.path, &SPP).unwrap_err();
    assert!(matches!(&error, IoError::Malformed { what, .. } if what.contains("twice")), "{error}");
}

/// Keeps panics that the decoder catches from flooding the output; those of the tests still show.
fn silence_decoder() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let show = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |info| {
            if info.location().is_some_and(|at| at.file().ends_with("hostile.rs")) {
                show(info);
            }
        }));
    });
}

#[test]
fn every_truncation_is_an_error() {
    silence_decoder();
    let s = scratch();
    write_frame(&s.path, &full_frame(3, 18)).unwrap();
    let bytes = std::fs::read(&s.path).unwrap();
    let last = bytes.len() - 1;
    for length in (0..last).step_by(last / 150).chain(last - 20..=last) {
        std::fs::write(&s.path, &bytes[..length]).unwrap();
        let error = read_frame(&s.path, &SPP).unwrap_err();
        let names_it = matches!(error, IoError::Truncated { .. })
            || (length < 4) == matches!(error, IoError::NotExr { .. });
        assert!(names_it, "{length}: {error}");
    }
}

/// 20×18 pixels in coarse steps, so that every compression has something to compress, half floats among them.
fn write_compressible(path: &Path, encoding: Encoding) {
    let steps = |k: usize| (0..360).map(move |p| ((p % 20 / 6 + p / 20 / 5) * k) as f32 * 0.25);
    let channels =
        [("R", 1), ("G", 2), ("B", 3), ("part0.R", 4), ("part0.G", 5), ("part0.B", 0), ("samples.Y", 9)];
    let channels = channels.map(|(name, k)| {
        let samples = match k {
            9 => FlatSamples::U32(steps(4).map(|v| v as u32 + 1).collect()),
            4.. => FlatSamples::F16(steps(k).map(f16::from_f32).collect()),
            _ => FlatSamples::F32(steps(k).collect()),
        };
        AnyChannel::new(name, samples)
    });
    let layer = Layer::new(
        (20, 18),
        LayerAttributes::default(),
        encoding,
        AnyChannels::sort(channels.into_iter().collect()),
    );
    Image::from_layer(layer).write().to_file(path).unwrap();
}

#[test]
fn a_block_that_claims_a_terabyte_is_refused() {
    let s = scratch();
    let encoding = Encoding {
        compression: Compression::DWAA(None),
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    write_compressible(&s.path, encoding);
    let mut bytes = std::fs::read(&s.path).unwrap();
    // The table of positions has one entry, pointing right behind it.
    let entry = |at: usize| u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap());
    let table = (0..bytes.len() - 8).find(|&at| entry(at) == at as u64 + 8).expect("one block of 32 rows");
    // Row and length (4 bytes each), then eleven numbers of which the eighth is the size of unpacked run lengths.
    let size = table + 8 + 8 + 7 * 8;
    bytes[size..size + 8].copy_from_slice(&(1u64 << 40).to_le_bytes());
    std::fs::write(&s.path, &bytes).unwrap();
    let error = read_frame(&s.path, &SPP).unwrap_err();
    assert!(
        matches!(&error, IoError::Malformed { what, .. } if what.contains("1099511627776 bytes")),
        "{error}"
    );
}

#[test]
fn no_damaged_byte_makes_reading_panic_or_hang() {
    silence_decoder();
    let s = scratch();
    let compressions = [
        Compression::ZIP16,
        Compression::Uncompressed,
        Compression::RLE,
        Compression::PIZ,
        Compression::PXR24,
        Compression::B44,
        Compression::DWAA(None),
    ];
    let tiles = Blocks::Tiles(Vec2(11, 16));
    for (compression, blocks) in compressions.into_iter().flat_map(|c| [(c, Blocks::ScanLines), (c, tiles)]) {
        let encoding = Encoding { compression, blocks, line_order: LineOrder::Increasing };
        write_compressible(&s.path, encoding);
        let good = std::fs::read(&s.path).unwrap();
        assert!(read_reference(&s.path, &SPP).is_ok(), "{compression} {blocks:?}");
        // Headers differ little: one file of each kind gets damage everywhere, the others behind their header, of
        // 430 bytes or a few more, and not too often.
        let (from, step) = match compression {
            Compression::ZIP16 => (4, 2),
            _ => (430, good.len() / 120),
        };
        for at in (from..good.len()).step_by(step) {
            let mut bytes = good.clone();
            // Another kind of damage at each place, to keep the test short.
            bytes[at] = [0x00, 0xFF, bytes[at] ^ 0x01, bytes[at] ^ 0x80][at / step % 4];
            std::fs::write(&s.path, &bytes).unwrap();
            let _ = read_reference(&s.path, &SPP);
        }
    }
}
