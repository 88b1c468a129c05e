//! Where the pixels of a file stand in its picture.

use std::fmt;

use exr::math::Vec2;
use exr::meta::attribute::IntegerBounds;
use exr::meta::header::Header;

/// A rectangle of pixels in the coordinates of the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Area {
    /// First column, first row.
    pub origin: (i32, i32),
    /// Columns, rows.
    pub size: (usize, usize),
}

/// Data window and display window of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Window {
    /// The pixels that the file has.
    pub data: Area,
    /// The pixels of the whole picture.
    pub display: Area,
}

impl fmt::Display for Area {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ((x, y), (width, height)) = (self.origin, self.size);
        write!(f, "{width}×{height} at ({x}, {y})")
    }
}

impl fmt::Display for Window {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "data window {}, display window {}", self.data, self.display)
    }
}

impl Window {
    pub(crate) fn of(header: &Header) -> Self {
        let at = |position: Vec2<i32>| (position.x(), position.y());
        let display = header.shared_attributes.display_window;
        Self {
            data: Area {
                origin: at(header.own_attributes.layer_position),
                size: (header.layer_size.width(), header.layer_size.height()),
            },
            display: Area {
                origin: at(display.position),
                size: (display.size.width(), display.size.height()),
            },
        }
    }

    pub(crate) fn display_bounds(&self) -> IntegerBounds {
        let ((x, y), (width, height)) = (self.display.origin, self.display.size);
        IntegerBounds::new((x, y), (width, height))
    }

    pub(crate) fn data_position(&self) -> Vec2<i32> {
        Vec2(self.data.origin.0, self.data.origin.1)
    }
}
