//! One folder for each question that is put to the data of a study.
//!
//! A question has up to four parts, each in a file of its own: what it *measures* of a finished cell, what it *analyses* of
//! all records, what a reader sees of it (its *exhibit*), and its paragraph of the methodology. [`QUESTIONS`] is the list
//! of all; whoever runs a study asks every one of them and knows none.

mod bounds;
mod breakage;
pub mod cell;
mod charts;
mod comparison;
mod convergence;
mod cost;
mod coverage;
mod document;
mod equal_time;
mod error;
mod flicker;
mod measuring;
mod own_error;
mod paper;
mod question;
mod readme;
mod records;
mod shown;
mod summarise;
mod view;

pub use breakage::violations;
pub use cell::{Cell, Measure, MeasureError, PixelClasses};
pub use document::document;
pub use error::{BOOTSTRAP_IMAGES, bootstrap_seed, measure_metrics};
pub use flicker::{Images, Sequences, flicker};
pub use measuring::measuring;
pub use question::{QUESTIONS, Question, measure};
pub use readme::{Asked, Block, Kind, readme_table};
pub use records::median;
pub use summarise::{Kept, summarise};
