//! Whether the pixels of two files stand at the same places of the picture.

use std::path::Path;

use crate::{IoError, Window};

impl Window {
    /// Checks that the pixels of `file` are those of `other`, so that one can be held against the other: equal sizes, equal
    /// origins of the data windows and of the display windows.
    ///
    /// # Errors
    /// [`IoError::SizeMismatch`], [`IoError::WindowMismatch`].
    pub fn expect(&self, file: &Path, other: &Self, other_file: &Path) -> Result<(), IoError> {
        if self.data.size != other.data.size {
            return Err(IoError::SizeMismatch {
                file: file.to_owned(),
                width: self.data.size.0,
                height: self.data.size.1,
                other: other_file.to_owned(),
                expected_width: other.data.size.0,
                expected_height: other.data.size.1,
            });
        }
        if self.data.origin != other.data.origin || self.display.origin != other.display.origin {
            return Err(IoError::WindowMismatch {
                file: file.to_owned(),
                other: other_file.to_owned(),
                windows: Box::new([*self, *other]),
            });
        }
        Ok(())
    }
}
