//! The charts of a document: each drawn once, for the page and for files.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use noisefloor_study::FIGURES;
use noisefloor_study::exhibit::Document;

use crate::error::ReportError;
use crate::file::write_file;
use crate::names::free_name;
use crate::plot::style::Looks;
use crate::plot::svg::{Drawing, GlyphKey};
use crate::plot::{Drawn, draw, pdf, png};

/// Which files a chart becomes beside its SVG.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Formats {
    pub png: bool,
    pub pdf: bool,
}

impl Formats {
    pub(crate) const ALL: Self = Self { png: true, pdf: true };
    pub(crate) const SVG: Self = Self { png: false, pdf: false };
}

/// A chart with the name of its files.
#[derive(Debug)]
pub(crate) struct Named {
    pub name: String,
    drawn: Drawn,
}

/// What a page shows of a chart.
#[derive(Debug, Default)]
pub(crate) struct Inline {
    pub title: String,
    /// One drawing with everything; or, where there are several, one for each panel, without the title.
    pub panels: Vec<String>,
    /// What panels share.
    pub legend: String,
}

/// All charts of a document.
#[derive(Debug)]
pub(crate) struct Charts {
    charts: Vec<Named>,
    /// Chart id to position.
    by_id: BTreeMap<String, usize>,
}

impl Charts {
    /// Draws the charts, or those of these names. Charts of one id are one chart.
    pub(crate) fn draw(document: &Document, only: Option<&BTreeSet<String>>) -> Result<Self, ReportError> {
        let looks = Looks::of(&document.rows);
        let (mut charts, mut by_id, mut taken) = (Vec::new(), BTreeMap::new(), BTreeSet::new());
        for chart in document.charts() {
            if by_id.contains_key(&chart.id) {
                continue;
            }
            let name = free_name(&chart.id, &mut taken);
            if only.is_none_or(|names| names.contains(&name)) {
                by_id.insert(chart.id.clone(), charts.len());
                charts.push(Named { name, drawn: draw(chart, &looks) });
            }
        }
        Ok(Self { charts, by_id })
    }

    /// The chart of an id.
    pub(crate) fn get(&self, id: &str) -> Option<&Named> {
        self.by_id.get(id).and_then(|&at| self.charts.get(at))
    }

    /// Writes all of them into a folder; gives the files.
    pub(crate) fn write(&self, folder: &Path, formats: Formats) -> Result<Vec<PathBuf>, ReportError> {
        fs::create_dir_all(folder).map_err(ReportError::write(folder))?;
        let mut files = Vec::new();
        for Named { name, drawn } in &self.charts {
            let svg = Drawing::of(&drawn.sheet(), name)?.file();
            let mut add = |ending: &str, bytes: &[u8]| -> Result<(), ReportError> {
                let file = folder.join(format!("{name}.{ending}"));
                write_file(&file, bytes)?;
                files.push(file);
                Ok(())
            };
            add("svg", svg.as_bytes())?;
            if formats.png {
                add("png", &png(&svg, name)?)?;
            }
            if formats.pdf {
                add("pdf", &pdf(&svg, name)?)?;
            }
        }
        Ok(files)
    }
}

impl Named {
    /// The chart as parts of a page; glyphs that these need are added to `glyphs`.
    pub(crate) fn inline(&self, glyphs: &mut BTreeSet<GlyphKey>) -> Result<Inline, ReportError> {
        let mut part = |figure| -> Result<String, ReportError> {
            let drawing = Drawing::of(figure, &self.name)?;
            glyphs.extend(drawing.glyphs.iter().copied());
            Ok(drawing.inline())
        };
        let title = self.drawn.title.clone();
        if self.drawn.panels.len() < 2 {
            return Ok(Inline { title, panels: vec![part(&self.drawn.sheet())?], legend: String::new() });
        }
        let panels = self.drawn.panels.iter().map(&mut part).collect::<Result<_, _>>()?;
        let legend = self.drawn.legend().as_ref().map(part).transpose()?.unwrap_or_default();
        Ok(Inline { title, panels, legend })
    }
}

/// Removes plots of an earlier report that this one does not have.
pub(crate) fn remove_stale_plots(folder: &Path, files: &[PathBuf]) -> Result<(), ReportError> {
    let ours = |name: &str| {
        let kind = name.split_once('-').map(|(kind, _)| kind);
        let known = kind.is_some_and(|kind| FIGURES.contains(&kind));
        known && [".svg", ".png", ".pdf"].iter().any(|ending| name.ends_with(ending))
    };
    for path in entries(folder)? {
        if path.file_name().is_some_and(|n| ours(&n.to_string_lossy())) && !files.contains(&path) {
            fs::remove_file(&path).map_err(ReportError::write(&path))?;
        }
    }
    Ok(())
}

/// Removes tables of an earlier report that this one does not have: those that are there in all formats.
pub(crate) fn remove_stale_tables(
    folder: &Path,
    files: &[PathBuf],
    endings: &[&str],
) -> Result<(), ReportError> {
    let known: BTreeSet<PathBuf> = entries(folder)?.into_iter().collect();
    for first in known.iter().filter(|path| path.extension().is_some_and(|e| e == endings[0])) {
        // Not `with_extension`: names have dots of their own.
        let stem = first.to_string_lossy().trim_end_matches(endings[0]).to_owned();
        let all: Vec<PathBuf> =
            endings.iter().map(|ending| PathBuf::from(format!("{stem}{ending}"))).collect();
        if !files.contains(first) && all.iter().all(|path| known.contains(path)) {
            for path in all {
                fs::remove_file(&path).map_err(ReportError::write(&path))?;
            }
        }
    }
    Ok(())
}

fn entries(folder: &Path) -> Result<Vec<PathBuf>, ReportError> {
    let listed = fs::read_dir(folder).map_err(ReportError::write(folder))?;
    Ok(listed.filter_map(Result::ok).map(|entry| entry.path()).collect())
}
