//! Folders of frames.

mod common;

use std::path::Path;

use common::estimate;
use noisefloor_frame::{Frame, Reference, Samples, Sampling};
use noisefloor_io::{
    Area, FrameFolder, IoError, ReadOptions, Window, read_origin, scan_scenes, write_frame, write_image,
    write_image_at, write_reference,
};

const HEADER: ReadOptions = ReadOptions { spp: None, max_decoded_bytes: None };

fn frame(path: &Path, spp: u32, seed: Option<u64>, width: usize) {
    let mut frame =
        Frame::from_color(estimate(width, 4, 3, spp), Samples::uniform(spp), Sampling::Independent);
    frame.provenance.seed = seed;
    write_frame(path, &frame).unwrap();
}

fn reference(path: &Path) {
    write_reference(path, &Reference::exact(common::image(5, 4, 3, 1))).unwrap();
}

#[test]
fn frames_are_listed_by_sample_count_and_replicate() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    frame(&at("a.exr"), 16, Some(9), 5);
    frame(&at("b.exr"), 16, Some(2), 5);
    frame(&at("c.EXR"), 4, None, 5);
    frame(&at("refraction_64.exr"), 64, None, 5);
    reference(&at("scene_ref.exr"));
    std::fs::write(at("notes.txt"), "no frame").unwrap();
    std::fs::write(at(".hidden.exr"), "no frame").unwrap();
    let found = FrameFolder::scan(folder.path(), &HEADER).unwrap();
    assert_eq!(found.reference, at("scene_ref.exr"));
    let listed: Vec<_> = found
        .frames
        .iter()
        .map(|f| (f.path.file_name().unwrap().to_str().unwrap(), f.spp, f.replicate))
        .collect();
    assert_eq!(listed, [("c.EXR", 4, 0), ("b.exr", 16, 0), ("a.exr", 16, 1), ("refraction_64.exr", 64, 0)]);
}

#[test]
fn sub_folders_are_scenes_by_name() {
    let folder = tempfile::tempdir().unwrap();
    for scene in ["zoo", "attic"] {
        std::fs::create_dir(folder.path().join(scene)).unwrap();
        frame(&folder.path().join(scene).join("spp4.exr"), 4, None, 5);
        reference(&folder.path().join(scene).join("reference.exr"));
    }
    std::fs::create_dir(folder.path().join("empty")).unwrap();
    let scenes = scan_scenes(folder.path(), &HEADER).unwrap();
    assert_eq!(scenes.iter().map(FrameFolder::name).collect::<Vec<_>>(), ["attic", "zoo"]);
    let one = scan_scenes(folder.path().join("zoo"), &HEADER).unwrap();
    assert_eq!(one.len(), 1);
    // A scene that is not complete is an error, not a scene less.
    std::fs::remove_file(folder.path().join("zoo/reference.exr")).unwrap();
    assert!(matches!(scan_scenes(folder.path(), &HEADER), Err(IoError::NoReference { folder, files: 1 })
        if folder.ends_with("zoo")));
}

#[test]
fn what_is_missing_or_does_not_fit_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let scan = || FrameFolder::scan(folder.path(), &HEADER);
    assert!(matches!(scan(), Err(IoError::NoFrames { children: false, .. })));
    assert!(matches!(scan_scenes(folder.path(), &HEADER), Err(IoError::NoFrames { children: true, .. })));
    assert!(
        matches!(FrameFolder::scan(at("absent"), &HEADER), Err(IoError::Read { file, .. }) if file == at("absent"))
    );
    reference(&at("reference.exr"));
    assert!(matches!(scan(), Err(IoError::NoFrames { .. })), "a reference alone is no frame");
    frame(&at("a.exr"), 4, None, 5);
    reference(&at("gt.exr"));
    let error = scan().unwrap_err().to_string();
    assert!(error.contains("`gt.exr` and `reference.exr`"), "{error}");
    std::fs::remove_file(at("gt.exr")).unwrap();
    frame(&at("wider.exr"), 4, None, 6);
    let error = scan().unwrap_err();
    assert!(
        matches!(&error, IoError::SizeMismatch { file, width: 6, expected_width: 5, .. } if *file == at("wider.exr"))
    );
    std::fs::remove_file(at("wider.exr")).unwrap();
    // The same size at another place of the picture.
    let area = |origin| Area { origin, size: (5, 4) };
    let window = Window { data: area((1, 0)), display: area((1, 0)) };
    write_image_at(at("moved.exr"), &common::image(5, 4, 3, 3), &common::no_attributes(), &window).unwrap();
    let error = scan().unwrap_err();
    assert!(matches!(&error, IoError::WindowMismatch { .. }), "{error}");
    let text = error.to_string();
    assert!(text.contains("moved.exr") && text.contains("5×4 at (1, 0)"), "{text}");
    assert!(text.contains("reference.exr") && text.contains("5×4 at (0, 0)"), "{text}");
    assert_eq!(read_origin(at("moved.exr")).unwrap().window, window);
    std::fs::remove_file(at("moved.exr")).unwrap();
    write_image(at("b.exr"), &common::image(5, 4, 3, 3), &common::no_attributes()).unwrap();
    assert!(matches!(scan(), Err(IoError::MissingSpp { file }) if file == at("b.exr")));
    let known =
        FrameFolder::scan(folder.path(), &ReadOptions { spp: Some(2), ..ReadOptions::default() }).unwrap();
    assert_eq!(known.frames.iter().map(|f| f.spp).collect::<Vec<_>>(), [2, 4]);
    std::fs::remove_file(at("b.exr")).unwrap();
    std::fs::write(at("c.exr"), "nonsense").unwrap();
    assert!(matches!(scan(), Err(IoError::NotExr { file }) if file == at("c.exr")));
}
