//! Where outputs go: nothing that is not a plain file is ever replaced, and links lead where they lead.
#![cfg(unix)]

use std::collections::BTreeMap;
use std::fs;
use std::io::Read as _;
use std::os::unix::fs::{FileTypeExt as _, MetadataExt as _, symlink};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;

use noisefloor_frame::Image;
use noisefloor_io::{Destination, IoError, read_image, same_file, write_atomically, write_image};

fn image(value: f32) -> Image {
    Image::filled(3, 2, 1, value)
}

fn write(path: &Path, value: f32) -> Result<(), IoError> {
    write_image(path, &image(value), &BTreeMap::new())
}

/// Not named `.tmp…`, which is looked for in messages.
fn folder() -> tempfile::TempDir {
    tempfile::Builder::new().prefix("destination").tempdir().unwrap()
}

fn made(program: &str, args: &[&str], at: &Path) -> bool {
    Command::new(program).args(args).current_dir(at).status().is_ok_and(|status| status.success())
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn a_fifo_gets_the_image_and_stays_a_fifo() {
    let folder = folder();
    assert!(made("mkfifo", &["pipe"], folder.path()));
    let pipe = folder.path().join("pipe");
    let reader = thread::spawn({
        let pipe = pipe.clone();
        move || {
            let mut bytes = Vec::new();
            fs::File::open(pipe).unwrap().read_to_end(&mut bytes).unwrap();
            bytes
        }
    });
    write(&pipe, 0.5).unwrap();
    let file = folder.path().join("copy.exr");
    fs::write(&file, reader.join().unwrap()).unwrap();
    assert_eq!(read_image(&file).unwrap(), image(0.5));
    assert!(fs::symlink_metadata(&pipe).unwrap().file_type().is_fifo());
    assert_eq!(names(folder.path()), ["copy.exr", "pipe"]);
}

#[test]
fn a_device_is_written_to_and_a_full_one_is_an_error() {
    let folder = folder();
    // Twins of /dev/null and /dev/full; where they may not be made or used there is nothing to test.
    for (name, minor, fits) in [("null", "3", true), ("full", "7", false)] {
        let node = folder.path().join(name);
        if !made("mknod", &[name, "c", "1", minor], folder.path())
            || fs::OpenOptions::new().write(true).open(&node).is_err()
        {
            continue;
        }
        let before = fs::symlink_metadata(&node).unwrap();
        let done = write(&node, 0.5);
        assert_eq!(done.is_ok(), fits, "{name}: {done:?}");
        if let Err(error) = done {
            let text = error.to_string();
            assert!(text.contains("full: cannot write") && !text.contains(".tmp"), "{text}");
        }
        let after = fs::symlink_metadata(&node).unwrap();
        assert!(after.file_type().is_char_device());
        assert_eq!((before.ino(), before.rdev()), (after.ino(), after.rdev()));
    }
}

#[test]
fn links_are_followed_and_kept_even_if_they_lead_nowhere_yet() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    fs::create_dir(at("deep")).unwrap();
    write(&at("deep/target.exr"), 0.25).unwrap();
    symlink("target.exr", at("deep/near.exr")).unwrap();
    symlink("deep/near.exr", at("link.exr")).unwrap();
    write(&at("link.exr"), 0.5).unwrap();
    assert!(fs::symlink_metadata(at("link.exr")).unwrap().is_symlink());
    assert!(fs::symlink_metadata(at("deep/near.exr")).unwrap().is_symlink());
    assert_eq!(read_image(at("deep/target.exr")).unwrap(), image(0.5));

    symlink("deep/later.exr", at("dangling.exr")).unwrap();
    write(&at("dangling.exr"), 0.75).unwrap();
    assert!(fs::symlink_metadata(at("dangling.exr")).unwrap().is_symlink());
    assert_eq!(read_image(at("deep/later.exr")).unwrap(), image(0.75));

    symlink("round.exr", at("round.exr")).unwrap();
    let error = write(&at("round.exr"), 1.0).unwrap_err().to_string();
    assert!(error.contains("round.exr: cannot write"), "{error}");
    symlink("absent/x.exr", at("lost.exr")).unwrap();
    let error = write(&at("lost.exr"), 1.0).unwrap_err().to_string();
    assert!(error.contains("lost.exr: cannot write") && !error.contains(".tmp"), "{error}");
}

#[test]
fn what_a_file_descriptor_has_open_is_written_to_as_it_is() {
    let folder = folder();
    let path = folder.path().join("open");
    let open = fs::OpenOptions::new().append(true).create(true).open(&path).unwrap();
    let inode = open.metadata().unwrap().ino();
    let number = format!("/proc/self/fd/{}", std::os::fd::AsRawFd::as_raw_fd(&open));
    if !Path::new(&number).exists() {
        return; // no /proc here
    }
    fs::write(&path, b"before").unwrap();
    write_atomically(Path::new(&number), |out| out.write_all(b" and after")).unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"before and after");
    assert_eq!(fs::metadata(&path).unwrap().ino(), inode, "the file is the one that is open");
}

#[test]
fn the_same_file_is_known_under_every_name() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    fs::create_dir(at("deep")).unwrap();
    write(&at("a.exr"), 0.5).unwrap();
    write(&at("b.exr"), 0.5).unwrap();
    fs::hard_link(at("a.exr"), at("hard.exr")).unwrap();
    symlink("a.exr", at("soft.exr")).unwrap();
    let roundabout = at("deep/../a.exr");
    for name in [at("a.exr"), at("hard.exr"), at("soft.exr"), roundabout] {
        assert!(same_file(&name, &at("a.exr")), "{}", name.display());
        assert!(Destination::from(&name).is_same_file(&at("a.exr")));
    }
    assert!(!same_file(&at("b.exr"), &at("a.exr")), "equal contents are not the same file");
    assert!(!same_file(&at("absent"), &at("absent")), "nothing is no file");
}

#[test]
fn only_a_word_of_the_command_line_means_standard_output() {
    assert_eq!(Destination::from_argument("-"), Destination::Stdout);
    assert_eq!(Destination::from("-"), Destination::Path(PathBuf::from("-")));
    assert_eq!(Destination::from_argument("./-"), Destination::Path(PathBuf::from("./-")));
}

#[test]
fn an_image_is_never_written_under_the_name_of_another_kind_of_file() {
    let folder = folder();
    for name in ["a.png", "a.exr.gz"] {
        let error = write(&folder.path().join(name), 1.0).unwrap_err();
        assert!(matches!(error, IoError::Extension { .. }), "{error}");
    }
    symlink("picture.png", folder.path().join("a.exr")).unwrap();
    assert!(write(&folder.path().join("a.exr"), 1.0).is_err());
    assert_eq!(names(folder.path()), ["a.exr"]);
}

#[test]
fn whether_a_file_can_be_written_is_known_before_any_work() {
    let folder = folder();
    let at = |name: &str| Destination::from(folder.path().join(name));
    assert!(at("new.exr").check().is_ok());
    assert_eq!(names(folder.path()), Vec::<String>::new());
    fs::write(folder.path().join("file"), b"").unwrap();
    for wrong in ["absent/a.exr", "file/a.exr", "."] {
        let error = at(wrong).check().unwrap_err().to_string();
        assert!(error.contains("cannot write") && !error.contains(".tmp"), "{error}");
    }
}
