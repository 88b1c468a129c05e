//! Puts plots, texts and images together and writes the files.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use minijinja::Environment;
use minijinja::syntax::SyntaxConfig;
use minijinja::value::{Serde, Value};
use noisefloor_frame::Image;
use noisefloor_harness::FIGURES;
use noisefloor_harness::summary::{SUMMARY_SCHEMA, Summary};
use serde::Serialize;

use crate::error::ReportError;
use crate::images::{Gallery, Loader, gallery};
use crate::index::Index;
use crate::plot::svg::{Drawing, glyph_definitions};
use crate::plot::{Figure, Time, bounds, convergence, coverage, estimates, png, speed, style};
use crate::view;

const TEMPLATE: &str = include_str!("page/index.html");
const SECTIONS: &str = include_str!("page/sections.html");
const STYLE: &str = include_str!("page/style.css");
const PAGE_SCRIPT: &str = include_str!("page/page.js");
const DECODE_SCRIPT: &str = include_str!("page/decode.js");
const VIEWER_SCRIPT: &str = include_str!("page/viewer.js");

/// How much goes into a report.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReportOptions {
    /// Most bytes of image data (as text) inside the page; 10 MB unless said. Whole levels are left out before
    /// images are cropped, and the page says what is missing.
    pub image_budget_bytes: usize,
    /// Whether plots are written as PNG too, at 300 dpi.
    pub png: bool,
}

impl Default for ReportOptions {
    fn default() -> Self {
        Self { image_budget_bytes: 10_000_000, png: true }
    }
}

/// What was written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReportFiles {
    /// The page.
    pub index: PathBuf,
    /// Plots, in the page's order.
    pub plots: Vec<PathBuf>,
    /// Bytes of image data (as text) inside the page.
    pub image_bytes: usize,
    /// Image files that could not be read, with the reason.
    pub unreadable: Vec<String>,
}

/// Writes `dir/report/index.html` and `dir/report/plots/` from a summary and the images in `dir`, with default options.
///
/// # Errors
/// As [`write_report_with`].
pub fn write_report(dir: &Path, summary: &Summary) -> Result<ReportFiles, ReportError> {
    write_report_with(dir, summary, &ReportOptions::default())
}

/// Writes `dir/report/index.html` and `dir/report/plots/` from a summary and the images in `dir`.
///
/// Images that cannot be read are named in the page and in the result; they do not stop the report.
///
/// # Errors
/// [`ReportError::Schema`] for a summary of a newer format, [`ReportError::Write`] and [`ReportError::Io`] if the folder
/// cannot be written, and the errors of drawing and encoding.
pub fn write_report_with(
    dir: &Path,
    summary: &Summary,
    options: &ReportOptions,
) -> Result<ReportFiles, ReportError> {
    write_report_into(dir, dir, summary, options)
}

/// Like [`write_report_with`], with the report in another folder, `out/report`: the study's folder `dir` is only read.
///
/// # Errors
/// As [`write_report_with`].
pub fn write_report_into(
    dir: &Path,
    out: &Path,
    summary: &Summary,
    options: &ReportOptions,
) -> Result<ReportFiles, ReportError> {
    let read = |path: &Path| -> Result<Image, String> {
        let file = dir.join(path);
        // A file with colour may be a whole frame; anything else is a plain image.
        noisefloor_io::read_color(&file)
            .or_else(|_| noisefloor_io::read_image(&file))
            .map_err(|e| e.to_string())
    };
    write_from(out, summary, options, &read)
}

/// Like [`write_report_with`], with images from anywhere.
pub(crate) fn write_from(
    dir: &Path,
    summary: &Summary,
    options: &ReportOptions,
    load: &Loader<'_>,
) -> Result<ReportFiles, ReportError> {
    if summary.schema > SUMMARY_SCHEMA {
        return Err(ReportError::Schema { found: summary.schema, known: SUMMARY_SCHEMA });
    }
    let report = dir.join("report");
    let folder = report.join("plots");
    fs::create_dir_all(&folder).map_err(ReportError::write(&folder))?;
    let index = Index::new(summary);

    let mut plots = Plots::new(folder, options.png);
    let sets = plots.draw_all(&index)?;
    plots.remove_stale()?;

    let gallery = gallery(&index, load, options.image_budget_bytes);
    let html = fill(&index, &sets, &glyph_definitions(&plots.glyphs), &gallery)?;
    let page = report.join("index.html");
    write_file(&page, html.as_bytes())?;
    Ok(ReportFiles {
        index: page,
        plots: plots.files,
        image_bytes: gallery.bytes(),
        unreadable: gallery.unreadable,
    })
}

pub(crate) fn write_file(path: &Path, bytes: &[u8]) -> Result<(), ReportError> {
    Ok(noisefloor_io::write_atomically(path, |out| out.write_all(bytes))?)
}

/// A plot inside the page.
#[derive(Debug, Serialize)]
struct Plot {
    svg: String,
    /// Name of the files in `plots/`, without extension.
    name: String,
    title: String,
}

/// Plots by section.
#[derive(Debug, Default, Serialize)]
struct PlotSets {
    convergence: Vec<Plot>,
    trimmed: Vec<Plot>,
    total: Vec<Plot>,
    denoise: Vec<Plot>,
    coverage: Vec<Plot>,
    bounds: Vec<Plot>,
    estimates: Vec<Plot>,
}

pub(crate) struct Plots {
    folder: PathBuf,
    png: bool,
    /// Names of the plots to write; all of them if absent.
    only: Option<BTreeSet<String>>,
    glyphs: BTreeSet<crate::plot::svg::GlyphKey>,
    files: Vec<PathBuf>,
}

impl Plots {
    fn new(folder: PathBuf, png: bool) -> Self {
        Self { folder, png, only: None, glyphs: BTreeSet::new(), files: Vec::new() }
    }

    /// Writes the plots of these names as SVG into a folder; gives the files that were written.
    pub(crate) fn write_some(
        index: &Index<'_>,
        folder: &Path,
        names: &BTreeSet<String>,
    ) -> Result<Vec<PathBuf>, ReportError> {
        fs::create_dir_all(folder).map_err(ReportError::write(folder))?;
        let mut plots = Self { only: Some(names.clone()), ..Self::new(folder.to_owned(), false) };
        plots.draw_all(index)?;
        plots.remove_stale()?;
        Ok(plots.files)
    }

    fn draw_all(&mut self, index: &Index<'_>) -> Result<PlotSets, ReportError> {
        let metric = index.summary.study.primary_metric.as_str();
        let has_trimmed = metric == "relmse" && index.metric("relmse_trimmed").is_some();
        let mut sets = PlotSets::default();
        let names = file_names(index);
        let chosen = &index.summary.study.figures;
        let wanted = |kind: &str| chosen.is_empty() || chosen.iter().any(|f| f == kind);
        for (scene, name) in index.summary.scenes.iter().zip(&names) {
            if wanted("convergence") {
                let figure = convergence(index, scene, metric);
                self.add(&mut sets.convergence, format!("convergence-{name}-{metric}"), figure)?;
            }
            if wanted("convergence") && has_trimmed {
                let figure = convergence(index, scene, "relmse_trimmed");
                self.add(&mut sets.trimmed, format!("convergence-{name}-relmse_trimmed"), figure)?;
            }
            if wanted("speed") {
                let total = speed(index, scene, metric, Time::Total);
                self.add(&mut sets.total, format!("speed-{name}-total"), total)?;
                let denoise = speed(index, scene, metric, Time::Denoise);
                self.add(&mut sets.denoise, format!("speed-{name}-denoise"), denoise)?;
            }
            if wanted("coverage") {
                self.add(&mut sets.coverage, format!("coverage-{name}"), coverage(index, scene))?;
            }
            if wanted("bounds") {
                self.add(&mut sets.bounds, format!("bounds-{name}"), bounds(index, scene))?;
            }
            if wanted("estimates") {
                self.add(&mut sets.estimates, format!("estimates-{name}"), estimates(index, scene))?;
            }
        }
        Ok(sets)
    }

    fn add(&mut self, set: &mut Vec<Plot>, name: String, figure: Option<Figure>) -> Result<(), ReportError> {
        let Some(figure) = figure.filter(|_| self.only.as_ref().is_none_or(|names| names.contains(&name)))
        else {
            return Ok(());
        };
        let drawing = Drawing::of(&figure, &name)?;
        self.glyphs.extend(drawing.glyphs.iter().copied());
        let svg = self.folder.join(format!("{name}.svg"));
        write_file(&svg, drawing.file().as_bytes())?;
        self.files.push(svg);
        if self.png {
            let file = self.folder.join(format!("{name}.png"));
            write_file(&file, &png(&figure, &name)?)?;
            self.files.push(file);
        }
        set.push(Plot { svg: drawing.inline(), name, title: figure.title });
        Ok(())
    }

    /// Removes plots of an earlier report that this one does not have.
    fn remove_stale(&self) -> Result<(), ReportError> {
        let entries = fs::read_dir(&self.folder).map_err(ReportError::write(&self.folder))?;
        for path in entries.filter_map(Result::ok).map(|e| e.path()) {
            let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
            let kind = name.split_once('-').map(|(kind, _)| kind);
            let ours = kind.is_some_and(|kind| FIGURES.contains(&kind))
                && (name.ends_with(".svg") || name.ends_with(".png"));
            if ours && !self.files.contains(&path) {
                fs::remove_file(&path).map_err(ReportError::write(&path))?;
            }
        }
        Ok(())
    }
}

/// Scene ids as file names: letters, digits, `-` and `_`, made unique by their position.
fn file_names(index: &Index<'_>) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for (i, scene) in index.summary.scenes.iter().enumerate() {
        let safe = |c: char| if c.is_ascii_alphanumeric() || c == '-' || c == '_' { c } else { '-' };
        let mut name: String = scene.id.chars().map(safe).take(60).collect();
        if name.is_empty() || names.contains(&name) {
            name = format!("{name}-{}", i + 1);
        }
        names.push(name);
    }
    names
}

fn fill(index: &Index<'_>, plots: &PlotSets, glyphs: &str, gallery: &Gallery) -> Result<String, ReportError> {
    let mut environment = Environment::new();
    environment.set_syntax(SyntaxConfig::builder().trim_blocks(true).lstrip_blocks(true).build()?);
    // The names end in .html, which turns on escaping of every text.
    environment.add_template("index.html", TEMPLATE)?;
    environment.add_template("sections.html", SECTIONS)?;
    let has_diagnostics = gallery.scenes.iter().flat_map(|s| &s.levels).any(|l| !l.diagnostics.is_empty());
    let contents = Contents {
        page: view::page(index),
        plots,
        glyphs,
        swatches: style::swatches(index)?,
        manifest: script_json(&manifest(index, gallery))?,
        images: gallery.images.iter().map(|i| i.text.as_str()).collect(),
        omitted: &gallery.omitted,
        diagnostics_spp: gallery.diagnostics_spp.filter(|_| has_diagnostics),
        unreadable: &gallery.unreadable,
        image_megabytes: crate::format::significant(gallery.bytes() as f64 / 1e6, 2),
        css: format!("{STYLE}\n{}", style::css()),
        scripts: format!("{PAGE_SCRIPT}\n{DECODE_SCRIPT}\n{VIEWER_SCRIPT}"),
    };
    Ok(environment.get_template("index.html")?.render(Value::from(Serde(contents)))?)
}

/// What the template reads.
#[derive(Serialize)]
struct Contents<'a> {
    page: view::Page,
    plots: &'a PlotSets,
    glyphs: &'a str,
    swatches: String,
    manifest: String,
    images: Vec<&'a str>,
    omitted: &'a [String],
    /// Level of the diagnostics, if there are any.
    diagnostics_spp: Option<u32>,
    unreadable: &'a [String],
    image_megabytes: String,
    css: String,
    scripts: String,
}

/// What the viewer's script reads.
#[derive(Debug, Serialize)]
struct Manifest<'a> {
    #[serde(flatten)]
    gallery: &'a Gallery,
    labels: Vec<&'a str>,
    baseline: Option<&'a str>,
    spp: Option<u32>,
    metric: String,
}

fn manifest<'a>(index: &Index<'a>, gallery: &'a Gallery) -> Manifest<'a> {
    Manifest {
        gallery,
        labels: index.summary.methods.iter().map(|m| m.label.as_str()).collect(),
        baseline: index.baseline(),
        spp: index.default_spp(),
        metric: index.metric_name(&index.summary.study.primary_metric),
    }
}

/// JSON that cannot end the script element that it stands in.
fn script_json(value: &impl Serialize) -> Result<String, ReportError> {
    let json = serde_json::to_string(value)?;
    Ok(json.replace('<', "\\u003c").replace('>', "\\u003e").replace('&', "\\u0026"))
}
