#![doc = include_str!("../README.md")]

mod bounds;
mod breakage;
pub mod cell;
mod charts;
mod claims;
mod comparison;
mod convergence;
mod cost;
mod coverage;
mod document;
mod equal_time;
mod error;
mod flicker;
mod growth;
mod list;
mod measuring;
mod own_error;
mod paper;
mod question;
mod readme;
mod records;
mod shown;
mod statistics;
mod summarise;
mod view;

pub use breakage::violations;
pub use cell::{Cell, Measure, MeasureError, PixelClasses, UnknownClass};
pub use document::document;
pub use error::{BOOTSTRAP_IMAGES, bootstrap_seed, measure_metrics};
pub use flicker::{Images, Sequences, flicker};
pub use list::{QUESTIONS, measure};
pub use measuring::{measuring, measuring_of};
pub use question::Question;
pub use readme::{Asked, Block, Kind, readme_table};
pub use records::median;
pub use summarise::{Kept, summarise};
