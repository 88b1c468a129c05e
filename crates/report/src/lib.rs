//! Exhibits to charts, tables and one self-contained HTML page.
//!
//! What is shown arrives as a [`Document`](noisefloor_study::exhibit::Document): sentences, tables and charts as plain
//! data. This crate knows no question and no method; it draws, lays out and writes.
//!
//! * [`write_report`] writes the page `report/index.html` with its charts in `report/plots/` and its tables in
//!   `report/tables/`. Pictures come from the images in the study's folder; error maps are made in the page.
//! * [`export`] writes every table as CSV, JSON, LaTeX and Markdown, and every chart as SVG, PNG and PDF.
//! * [`write_recording`] puts tables, charts and a panel of pictures into a README for a repository.
//!
//! The page opens from disk without a network: style, script, charts and pictures are inside. Text in charts is drawn as
//! outlines of an embedded font, so that it looks the same everywhere. The same input gives the same bytes.

mod charts;
mod error;
mod export;
mod file;
mod images;
mod names;
mod page;
mod panel;
mod picture;
mod plot;
mod readme;
mod record;
mod sheet;
mod write;

pub use error::ReportError;
pub use export::{export, export_charts, export_tables, markdown};
pub use picture::{NON_FINITE_COLOR, Picture, error_picture, picture};
pub use readme::Directive;
pub use record::{Recording, write_recording};
pub use sheet::{SheetEntry, contact_sheet};
pub use write::{ReportFiles, ReportOptions, write_report, write_report_into, write_report_with};
