//! A recorded study's README: its tables, the charts that it shows, and a panel of pictures.

use std::path::{Path, PathBuf};

use noisefloor_study::exhibit::Document;

use crate::charts::{Charts, Formats, remove_stale_plots};
use crate::error::ReportError;
use crate::file::write_file;
use crate::readme::{Directive, embedded_plots, skeleton, spliced};

/// What was written beside the numbers.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Recording {
    /// The README with its tables.
    pub readme: PathBuf,
    /// The plots that it shows.
    pub plots: Vec<PathBuf>,
    /// Plots that it asks for and the study does not have.
    pub absent: Vec<String>,
}

/// Makes the tables of `to/README.md` anew and writes the plots that it shows, `plots/NAME.svg`; of plots with other
/// names that an earlier call left there, those of studies are removed. Without a README one is begun.
///
/// A table stands between `<!-- noisefloor:table KIND key=value … -->` and `<!-- /noisefloor -->`: `tables` gives its
/// Markdown, or a clause that says why there is none. `<!-- noisefloor:panel … -->` makes `panel.png` from the gallery of
/// the document, whose paths are relative to `images`; without that folder, or where the gallery is empty, a panel
/// stays as it is.
///
/// # Errors
/// [`ReportError::Readme`] for a marker that cannot be obeyed, [`ReportError::Read`], [`ReportError::Write`] and
/// [`ReportError::Io`] for files, and the errors of drawing.
pub fn write_recording(
    to: &Path,
    document: &Document,
    images: Option<&Path>,
    tables: &dyn Fn(&Directive) -> Result<String, String>,
) -> Result<Recording, ReportError> {
    let readme = to.join("README.md");
    let text = match std::fs::read_to_string(&readme) {
        Ok(text) => text,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => skeleton(document),
        Err(source) => return Err(ReportError::Read { path: readme, source }),
    };
    let images = images.filter(|_| !document.gallery.is_empty());
    let mut panel = None;
    let made = spliced(&text, |directive| match (directive.verb.as_str(), images) {
        ("table", _) => tables(directive).map(Some),
        ("panel", Some(folder)) => {
            panel = Some(crate::panel::panel(document, folder, directive)?);
            Ok(Some("![Pictures of the first replicate](panel.png)".into()))
        }
        // A recording of a recording: the panel stays as it is.
        ("panel", None) => Ok(None),
        (other, _) => Err(format!("there is no `noisefloor:{other}`")),
    })?;
    if let Some(png) = panel {
        write_file(&to.join("panel.png"), &png)?;
    }
    let wanted = embedded_plots(&made);
    let folder = to.join("plots");
    let mut plots = Vec::new();
    if !wanted.is_empty() || folder.exists() {
        plots = Charts::draw(document, Some(&wanted))?.write(&folder, Formats::SVG)?;
        remove_stale_plots(&folder, &plots)?;
    }
    let name = |path: &PathBuf| path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let drawn: Vec<String> = plots.iter().filter_map(name).collect();
    let absent = wanted.into_iter().filter(|name| !drawn.contains(name)).collect();
    write_file(&readme, made.as_bytes())?;
    Ok(Recording { readme, plots, absent })
}
