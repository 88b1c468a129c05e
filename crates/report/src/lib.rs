//! Records and summaries to plots, tables and one self-contained HTML page.
//!
//! [`write_report`] takes the analysis of a study and the images in its folder, and writes `report/index.html` and
//! `report/plots/*.svg`, `*.png`. It runs no denoiser and computes no number that the summary does not hold (error
//! maps are made in the page, from the images it carries). The same input gives the same bytes.
//!
//! [`write_recording`] puts the tables and plots of a study into a README for a repository.
//!
//! The page opens from disk without a network: style, script, plots and pictures are inside. Text in plots is drawn
//! as outlines of an embedded font, so that it looks the same everywhere.

mod error;
mod format;
mod images;
mod index;
mod panel;
mod picture;
mod plot;
mod readme;
mod record;
mod sheet;
mod view;
mod write;

pub use error::ReportError;
pub use picture::{NON_FINITE_COLOR, Picture, error_picture, picture};
pub use record::{Recording, write_recording};
pub use sheet::{SheetEntry, contact_sheet};
pub use write::{ReportFiles, ReportOptions, write_report, write_report_into, write_report_with};
