#![doc = include_str!("../README.md")]

mod answers;
mod bias_variance;
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
mod gate;
mod growth;
mod instrument;
mod intervals;
mod level;
mod list;
mod measuring;
mod membership;
mod own_error;
mod paper;
mod pit;
mod question;
mod readme;
mod records;
mod reference_free;
mod section;
mod shown;
mod spread;
mod statistics;
mod summarise;
mod view;

pub use breakage::violations;
pub use cell::{Cell, Measure, MeasureError, PixelClasses, UnknownClass};
pub use document::document;
pub use error::{BOOTSTRAP_IMAGES, bootstrap_seed, measure_metrics};
pub use flicker::{Images, Sequences, flicker};
pub use gate::{Broken, CellChange, GateError, GateOutcome, Mismatch, Overall, RowChange, Version, gate};
pub use instrument::{
    Check, SELF_CHECK, SELF_CHECK_SIZE, checks, failed_checks, self_check_study, self_checks,
};
pub use level::{LevelCell, LevelFound, LevelFrame, Map, Outputs};
pub use list::{QUESTIONS, measure, measure_level};
pub use measuring::{measuring, measuring_of, measuring_of_intervals, measuring_of_levels};
pub use question::Question;
pub use readme::{Asked, Block, Kind, readme_table};
pub use records::median;
pub use spread::{Spread, spreads};
pub use summarise::{Kept, summarise};
