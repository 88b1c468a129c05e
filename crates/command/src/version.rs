//! What a command's results depend on, as far as it can be seen from outside: its program and scripts.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

use crate::template::Template;

/// Hash of every file that the command line names: the program, found as the system finds it, and scripts.
pub(crate) fn version(template: &Template) -> String {
    let mut hash = blake3::Hasher::new();
    for (place, word) in template.fixed().enumerate() {
        let path = if place == 0 { program(word) } else { Some(PathBuf::from(word)) };
        let contents = path.filter(|path| path.is_file()).and_then(|path| fs::read(path).ok());
        hash.update(word.as_bytes());
        hash.update(&[0, u8::from(contents.is_some())]);
        if let Some(contents) = contents {
            hash.update(blake3::hash(&contents).as_bytes());
        }
    }
    hash.finalize().to_hex()[..32].to_owned()
}

/// The file of a program: where it is said to be, or in the first folder of `PATH` that has it.
fn program(word: &str) -> Option<PathBuf> {
    if Path::new(word).components().count() > 1 {
        return Some(word.into());
    }
    let folders = env::var_os("PATH")?;
    env::split_paths(&folders).map(|folder| folder.join(word)).find(|path| path.is_file())
}
