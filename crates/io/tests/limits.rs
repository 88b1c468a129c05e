//! Files that unfold into far more than they are: refused by their headers, whatever reads them.

mod common;

use std::path::Path;

use common::*;
use exr::prelude::*;
use noisefloor_frame::{Frame, Samples, Sampling};
use noisefloor_io::{
    IoError, MAX_DECODED_BYTES, ReadOptions, read_color, read_frame, read_image, read_info, read_reference,
    write_frame,
};

/// A file of `bytes` that says `side`² pixels with twelve half channels, behind a sound header.
fn bomb(path: &Path, side: i32, bytes: usize) {
    let names = ["R", "G", "B"]
        .into_iter()
        .flat_map(|c| ["", "halfA.", "halfB.", "variance."].map(|l| format!("{l}{c}")));
    let channels = names.map(|name| AnyChannel::new(name.as_str(), FlatSamples::F16(vec![f16::ZERO; 4])));
    let mut attributes = LayerAttributes::default();
    attributes.other.insert("spp".into(), attribute::AttributeValue::I32(16));
    let blocks = Blocks::ScanLines;
    let encoding = Encoding { compression: Compression::ZIP16, blocks, line_order: LineOrder::Increasing };
    let layer = Layer::new((2, 2), attributes, encoding, AnyChannels::sort(channels.collect()));
    Image::from_layer(layer).write().to_file(path).unwrap();
    let mut all = std::fs::read(path).unwrap();
    // Behind the name and type of an attribute stands its length.
    let mut patch = |name: &[u8], offset: usize, numbers: &[i32]| {
        let at = all.windows(name.len()).position(|w| w == name).unwrap() + name.len() + 4 + offset;
        let bytes: Vec<u8> = numbers.iter().flat_map(|n| n.to_le_bytes()).collect();
        all[at..at + bytes.len()].copy_from_slice(&bytes);
    };
    patch(b"dataWindow\0box2i\0", 8, &[side - 1, side - 1]);
    patch(b"chunkCount\0int\0", 0, &[(side + 15) / 16]);
    all.resize(bytes, 0);
    std::fs::write(path, all).unwrap();
}

#[test]
fn a_file_that_unfolds_a_thousand_times_is_refused_by_every_reader_with_size_and_limit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bomb.exr");
    bomb(&path, 8192, 1_600_000);
    let info = read_info(&path).unwrap();
    assert_eq!((info.width, info.height, info.layers.len()), (8192, 8192, 4));
    let none = ReadOptions::default();
    let errors = [
        read_frame(&path, &none).map(drop).unwrap_err(),
        read_reference(&path, &none).map(drop).unwrap_err(),
        read_image(&path).map(drop).unwrap_err(),
        read_color(&path).map(drop).unwrap_err(),
    ];
    for error in errors {
        let IoError::Memory { bytes, allowed, file_bytes: 1_600_000, .. } = error else { panic!("{error}") };
        // 2 bytes of each of 12 channels; 512 MiB.
        assert_eq!((bytes, allowed), ((12 * 2) << 26, 1 << 29));
        let told = error.to_string();
        for part in ["bomb.exr", "8192×8192", "1610612736 bytes", "536870912", "1600000"] {
            assert!(told.contains(part), "{part}: {told}");
        }
    }
}

#[test]
fn the_limit_on_what_is_kept_can_be_set() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("frame.exr");
    let frame = Frame::from_color(estimate(8, 5, 3, 1), Samples::uniform(4), Sampling::Independent);
    write_frame(&path, &frame).unwrap();
    // Mean, variance and halves of three channels, 4 bytes each.
    let needed = 8 * 5 * 4 * 3 * 4;
    let within =
        |limit| read_frame(&path, &ReadOptions { max_decoded_bytes: Some(limit), ..ReadOptions::default() });
    assert!(within(needed).is_ok());
    let error = within(needed - 1).unwrap_err();
    assert!(
        matches!(error, IoError::Memory { bytes, allowed, .. } if bytes == needed && allowed == needed - 1)
    );
    // Set by hand, it also lets pass what is unlikely: then it is the file's end that is missed.
    bomb(&path, 8192, 1_600_000);
    let error = within(1 << 34).unwrap_err();
    assert!(!matches!(error, IoError::Memory { .. }), "{error}");
}

#[test]
fn large_files_that_hold_what_they_say_are_read_up_to_the_limit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("large.exr");
    // Twelve planes of floats from a file that is large enough: 2.9 GiB pass, 4.2 GiB do not.
    for (side, refused) in [(8000, false), (9700, true)] {
        bomb(&path, side, 20_000_000);
        let error = read_frame(&path, &ReadOptions::default()).unwrap_err();
        assert_eq!(matches!(error, IoError::Memory { allowed: MAX_DECODED_BYTES, .. }), refused, "{error}");
    }
    // Half a gigabyte passes whatever the file.
    bomb(&path, 3000, 110_000);
    let error = read_frame(&path, &ReadOptions::default()).unwrap_err();
    assert!(!matches!(error, IoError::Memory { .. }), "{error}");
}
