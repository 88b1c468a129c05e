//! Files as other programs write them: other sample types, tiles, compressions, attribute types.

mod common;

use std::path::{Path, PathBuf};

use exr::prelude::*;
use noisefloor_frame::{Counts, FeatureId, Samples, Sampling};
use noisefloor_io::{IoError, ReadOptions, read_frame, read_image, read_info};

const SIZE: (usize, usize) = (3, 2);

fn channel(name: &str, samples: FlatSamples) -> AnyChannel<FlatSamples> {
    AnyChannel::new(name, samples)
}

fn floats(name: &str) -> AnyChannel<FlatSamples> {
    let offset = name.len() as f32;
    channel(name, FlatSamples::F32((0..6).map(|k| k as f32 * 0.1 + offset).collect()))
}

fn rgb() -> Vec<AnyChannel<FlatSamples>> {
    ["R", "G", "B"].map(floats).into()
}

fn write(
    path: &Path,
    channels: Vec<AnyChannel<FlatSamples>>,
    encoding: Encoding,
    attributes: LayerAttributes,
) {
    let layer = Layer::new(SIZE, attributes, encoding, AnyChannels::sort(channels.into()));
    Image::from_layer(layer).write().to_file(path).unwrap();
}

fn with(attributes: &[(&str, AttributeValue)]) -> LayerAttributes {
    let other = attributes.iter().map(|(name, value)| (Text::from(*name), value.clone())).collect();
    LayerAttributes { other, ..LayerAttributes::default() }
}

fn scratch() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("foreign.exr");
    (folder, path)
}

const NO_SPP: ReadOptions = ReadOptions { spp: None, max_decoded_bytes: None };

#[test]
fn half_and_unsigned_channels_are_read_beside_floats() {
    let (_folder, path) = scratch();
    let halves = [0.0, -0.0, 65504.0, f32::INFINITY, 6e-8, 0.333].map(f16::from_f32);
    let mut channels = rgb();
    for name in ["albedo.R", "albedo.G", "albedo.B"] {
        channels.push(channel(name, FlatSamples::F16(halves.to_vec())));
    }
    channels.push(channel("material.Y", FlatSamples::U32(vec![0, 1, 2, 3, 1 << 24, 7])));
    channels.push(channel(
        "samples.Y",
        FlatSamples::F16([1.0, 2.0, 3.0, 4.0, 5.0, 2048.0].map(f16::from_f32).into()),
    ));
    channels.push(channel("samples.halfA.Y", FlatSamples::F32(vec![1.0, 1.0, 1.0, 4.0, 2.0, 99.0])));
    write(&path, channels, Encoding::FAST_LOSSLESS, LayerAttributes::default());
    let frame = read_frame(&path, &NO_SPP).unwrap();
    let albedo = &frame.features[&FeatureId::Albedo].mean;
    for plane in albedo.planes() {
        assert!(plane.iter().zip(&halves).all(|(a, b)| a.to_bits() == b.to_f32().to_bits()));
    }
    assert_eq!(frame.features[&FeatureId::Material].mean.data(), [0.0, 1.0, 2.0, 3.0, 16777216.0, 7.0]);
    let half = Counts::PerPixel(vec![1, 1, 1, 4, 2, 99]);
    assert_eq!(frame.samples, Samples::per_pixel(vec![1, 2, 3, 4, 5, 2048]).with_half_a(half));
}

#[test]
fn every_lossless_encoding_reads_alike() {
    let (_folder, path) = scratch();
    let tiles = Blocks::Tiles(Vec2(2, 1));
    let mut seen = Vec::new();
    for compression in
        [Compression::Uncompressed, Compression::RLE, Compression::ZIP1, Compression::ZIP16, Compression::PIZ]
    {
        for blocks in [Blocks::ScanLines, tiles] {
            for line_order in [LineOrder::Increasing, LineOrder::Decreasing] {
                let encoding = Encoding { compression, blocks, line_order };
                let attributes =
                    LayerAttributes { layer_position: Vec2(-7, 12), ..LayerAttributes::default() };
                write(&path, rgb(), encoding, attributes);
                seen.push(read_image(&path).unwrap());
            }
        }
    }
    assert_eq!(seen[0].get(2, 1, 1), 1.4);
    assert!(seen.iter().all(|image| *image == seen[0]));
}

#[test]
fn the_sample_count_may_be_an_integer_a_float_or_text() {
    let (_folder, path) = scratch();
    let text = |value: &str| AttributeValue::Text(Text::from(value));
    let accepted = [
        ("spp", AttributeValue::I32(64)),
        ("spp", AttributeValue::F32(64.0)),
        ("spp", AttributeValue::F64(64.0)),
        ("spp", text("64")),
        ("spp", text(" 64.0 ")),
        ("samplesPerPixel", AttributeValue::I32(64)),
    ];
    for (name, value) in accepted {
        write(&path, rgb(), Encoding::FAST_LOSSLESS, with(&[(name, value)]));
        assert_eq!(read_frame(&path, &NO_SPP).unwrap().samples, Samples::uniform(64));
        let other = ReadOptions { spp: Some(3), ..ReadOptions::default() };
        assert_eq!(read_frame(&path, &other).unwrap().samples, Samples::uniform(64), "the header wins");
    }
    let vector = AttributeValue::FloatVec2(Vec2(64.0, 64.0));
    let refused = [
        AttributeValue::I32(0),
        AttributeValue::I32(-4),
        AttributeValue::F32(f32::NAN),
        AttributeValue::F32(15.5),
        AttributeValue::F64(1e300),
        text("many"),
        text(""),
    ];
    for value in refused {
        write(&path, rgb(), Encoding::FAST_LOSSLESS, with(&[("spp", value.clone())]));
        let error = read_frame(&path, &NO_SPP).unwrap_err();
        assert!(matches!(&error, IoError::Attribute { name, .. } if name == "spp"), "{value:?}: {error}");
    }
    write(&path, rgb(), Encoding::FAST_LOSSLESS, with(&[("spp", vector)]));
    assert!(matches!(read_frame(&path, &NO_SPP), Err(IoError::MissingSpp { .. })));
}

#[test]
fn a_file_without_sample_count_is_usable_when_the_caller_knows_it() {
    let (_folder, path) = scratch();
    write(&path, rgb(), Encoding::FAST_LOSSLESS, LayerAttributes::default());
    let error = read_frame(&path, &NO_SPP).unwrap_err().to_string();
    assert!(error.contains("foreign.exr") && error.contains("--spp"), "{error}");
    assert_eq!(read_info(&path).unwrap().spp, None);
    let frame = read_frame(&path, &ReadOptions { spp: Some(8), ..ReadOptions::default() }).unwrap();
    assert_eq!(frame.samples, Samples::uniform(8));
    assert_eq!(frame.sampling, Sampling::Independent, "nothing says otherwise");
    let zero = read_frame(&path, &ReadOptions { spp: Some(0), ..ReadOptions::default() });
    assert!(matches!(zero, Err(IoError::Count { .. })));
}

#[test]
fn the_kind_of_sampling_follows_from_the_sampler() {
    let (_folder, path) = scratch();
    let text = |value: &str| AttributeValue::Text(Text::from(value));
    for (sampler, expected) in [
        ("independent", Sampling::Independent),
        ("Independent, box filter", Sampling::Independent),
        ("random", Sampling::Independent),
        ("stratified", Sampling::LowDiscrepancy),
        ("multijitter, passes of 64", Sampling::LowDiscrepancy),
        ("sobol (not independent)", Sampling::LowDiscrepancy),
    ] {
        let attributes = [("sampler", text(sampler)), ("spp", AttributeValue::I32(4))];
        write(&path, rgb(), Encoding::FAST_LOSSLESS, with(&attributes));
        assert_eq!(read_info(&path).unwrap().sampling, expected, "{sampler}");
    }
    write(&path, rgb(), Encoding::FAST_LOSSLESS, with(&[("sampling", text("blue noise"))]));
    let error = read_info(&path).unwrap_err();
    assert!(
        matches!(&error, IoError::Attribute { name, value, .. } if name == "sampling" && value == "blue noise")
    );
}

#[test]
fn attributes_that_do_not_parse_are_kept_as_they_are() {
    let (_folder, path) = scratch();
    let text = |value: &str| AttributeValue::Text(Text::from(value));
    let attributes = [
        ("seed", text("none")),
        ("filter", text("gaussian")),
        ("renderSeconds", text("12.5")),
        ("title", AttributeValue::Text(Text::from_slice_unchecked(b"caf\xe9"))),
        ("quality", AttributeValue::F32(0.1)),
    ];
    write(&path, rgb(), Encoding::FAST_LOSSLESS, with(&attributes));
    let provenance = read_info(&path).unwrap().provenance;
    assert_eq!((provenance.seed, provenance.filter, provenance.render_seconds), (None, None, Some(12.5)));
    let extra = [("filter", "gaussian"), ("quality", "0.1"), ("seed", "none"), ("title", "café")];
    assert!(provenance.extra.iter().map(|(name, value)| (name.as_str(), value.as_str())).eq(extra));
}

#[test]
fn unknown_layers_become_extra_features_in_a_sensible_order() {
    let (_folder, path) = scratch();
    let mut channels = rgb();
    channels.extend(["View.Pos.Z", "View.Pos.X", "View.Pos.Y", "View.Pos.variance.X"].map(floats));
    channels
        .extend(["View.Pos.variance.Y", "View.Pos.variance.Z", "dzdx", "A", "wide.10", "wide.9"].map(floats));
    write(&path, channels, Encoding::FAST_LOSSLESS, with(&[("spp", AttributeValue::I32(4))]));
    let frame = read_frame(&path, &NO_SPP).unwrap();
    let names: Vec<&str> = frame.features.keys().map(FeatureId::name).collect();
    assert_eq!(names, ["A", "View.Pos", "dzdx", "wide"]);
    let feature = |name: &str| &frame.features[&FeatureId::Extra(name.into())];
    assert_eq!((feature("View.Pos").mean.channels(), feature("dzdx").mean.channels()), (3, 1));
    assert!(feature("View.Pos").variance.is_some());
    // `wide.9` comes before `wide.10`; the values start at the length of the name.
    assert_eq!((feature("wide").mean.get(0, 0, 0), feature("wide").mean.get(1, 0, 0)), (6.0, 7.0));
    assert_eq!(read_image(&path).unwrap().channels(), 5, "R G B, alpha and dzdx have no layer");
}
