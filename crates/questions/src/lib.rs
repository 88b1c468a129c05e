#![doc = include_str!("../README.md")]

mod bounds;
mod breakage;
pub mod cell;
mod comparison;
mod convergence;
mod cost;
mod coverage;
mod equal_time;
mod error;
mod flicker;
mod measuring;
mod own_error;
mod paper;
mod question;
mod records;
mod summarise;
mod view;

pub use breakage::violations;
pub use cell::{Cell, Measure, MeasureError, PixelClasses, UnknownClass};
pub use error::{BOOTSTRAP_IMAGES, bootstrap_seed, measure_metrics};
pub use flicker::{Images, Sequences, flicker};
pub use measuring::{measuring, measuring_of};
pub use question::{QUESTIONS, Question, measure};
pub use records::median;
pub use summarise::{Kept, summarise};
