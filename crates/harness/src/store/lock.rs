//! One process at a time in a study's folder.

use std::fs::{File, OpenOptions, TryLockError};

use crate::error::HarnessError;
use crate::store::layout::Layout;

/// Keeps other processes out of a study's folder until it is dropped, or the process dies.
#[derive(Debug)]
pub(crate) struct Lock {
    _file: File,
}

impl Lock {
    pub(crate) fn take(layout: &Layout) -> Result<Self, HarnessError> {
        let root = layout.root();
        std::fs::create_dir_all(root).map_err(HarnessError::io("make folder", root))?;
        let path = root.join(".lock");
        // Not emptied: the name may be a link to a file that is none of ours.
        let file = OpenOptions::new().create(true).write(true).truncate(false).open(&path);
        let file = file.map_err(HarnessError::io("write", &path))?;
        match file.try_lock() {
            Ok(()) => Ok(Self { _file: file }),
            Err(TryLockError::WouldBlock) => Err(HarnessError::Locked { path: root.to_owned() }),
            Err(TryLockError::Error(source)) => Err(HarnessError::Io { action: "lock", path, source }),
        }
    }
}
