//! Writes a report: the page, its charts and its tables.

use std::path::{Path, PathBuf};

use noisefloor_frame::Image;
use noisefloor_study::exhibit::Document;

use crate::charts::{Charts, Formats, remove_stale_plots, remove_stale_tables};
use crate::error::ReportError;
use crate::export::export_tables;
use crate::file::write_file;
use crate::images::{Loader, gallery};
use crate::names::TABLE_ENDINGS;
use crate::page;

/// How much goes into a report.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReportOptions {
    /// Most bytes of image data (as text) inside the page; 10 MB unless said. Whole levels are left out before
    /// images are cropped, and the page says what is missing.
    pub image_budget_bytes: usize,
    /// Whether plots are written as PNG too, at 300 dpi.
    pub png: bool,
    /// Whether plots are written as PDF too.
    pub pdf: bool,
}

impl Default for ReportOptions {
    fn default() -> Self {
        Self { image_budget_bytes: 10_000_000, png: true, pdf: true }
    }
}

/// What was written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReportFiles {
    /// The page.
    pub index: PathBuf,
    /// Plots, in the page's order.
    pub plots: Vec<PathBuf>,
    /// Tables, in the page's order.
    pub tables: Vec<PathBuf>,
    /// Bytes of image data (as text) inside the page.
    pub image_bytes: usize,
    /// Image files that could not be read, with the reason.
    pub unreadable: Vec<String>,
}

/// Writes `dir/report/index.html`, `dir/report/plots/` and `dir/report/tables/` from a document and the images in `dir`,
/// with default options.
///
/// # Errors
/// As [`write_report_with`].
pub fn write_report(dir: &Path, document: &Document) -> Result<ReportFiles, ReportError> {
    write_report_with(dir, document, &ReportOptions::default())
}

/// Writes `dir/report/index.html`, `dir/report/plots/` and `dir/report/tables/` from a document and the images in `dir`.
///
/// Images that cannot be read are named in the page and in the result; they do not stop the report. Plots and tables of
/// an earlier report that this one does not have are removed; other files stay.
///
/// # Errors
/// [`ReportError::Write`] and [`ReportError::Io`] if the folder cannot be written, and the errors of drawing and
/// encoding.
pub fn write_report_with(
    dir: &Path,
    document: &Document,
    options: &ReportOptions,
) -> Result<ReportFiles, ReportError> {
    write_report_into(dir, dir, document, options)
}

/// Like [`write_report_with`], with the report in another folder, `out/report`: the study's folder `dir` is only read.
///
/// # Errors
/// As [`write_report_with`].
pub fn write_report_into(
    dir: &Path,
    out: &Path,
    document: &Document,
    options: &ReportOptions,
) -> Result<ReportFiles, ReportError> {
    let read = |path: &Path| read_image(&dir.join(path));
    write_from(out, document, options, &read)
}

/// An image of a study; the error is a sentence for people.
pub(crate) fn read_image(file: &Path) -> Result<Image, String> {
    // A file with colour may be a whole frame; anything else is a plain image.
    let image = noisefloor_io::read_color(file).or_else(|_| noisefloor_io::read_image(file));
    image.map_err(|e| e.to_string())
}

fn write_from(
    out: &Path,
    document: &Document,
    options: &ReportOptions,
    load: &Loader<'_>,
) -> Result<ReportFiles, ReportError> {
    let report = out.join("report");
    let formats = Formats { png: options.png, pdf: options.pdf };
    let charts = Charts::draw(document, None)?;
    let folder = report.join("plots");
    let plots = charts.write(&folder, formats)?;
    remove_stale_plots(&folder, &plots)?;
    let folder = report.join("tables");
    let tables = export_tables(document, &folder)?;
    remove_stale_tables(&folder, &tables, &TABLE_ENDINGS)?;

    let gallery = gallery(document, load, options.image_budget_bytes);
    let html = page::html(document, &charts, formats, &gallery)?;
    let index = report.join("index.html");
    write_file(&index, html.as_bytes())?;
    let image_bytes = gallery.bytes();
    Ok(ReportFiles { index, plots, tables, image_bytes, unreadable: gallery.unreadable })
}
