//! A recorded study's README: its tables, the plots that it shows, and a panel of pictures.

use std::path::{Path, PathBuf};

use noisefloor_harness::summary::Summary;

use crate::error::ReportError;
use crate::index::Index;
use crate::readme::{embedded_plots, skeleton, spliced};
use crate::write::{Plots, write_file};

fn summary_has_images(summary: &Summary) -> bool {
    summary.scenes.iter().any(|scene| !scene.images.is_empty())
}

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
/// A table stands between `<!-- noisefloor:table KIND key=value … -->` and `<!-- /noisefloor -->`; the kinds are listed
/// in the source of this crate and by `noisefloor record --help`. `<!-- noisefloor:panel … -->` makes `panel.png` from the
/// images of `source`, the folder that `images` is the analysis of; where that has none, a panel stays as it is.
///
/// # Errors
/// [`ReportError::Readme`] for a marker that cannot be obeyed, [`ReportError::Read`], [`ReportError::Write`] and
/// [`ReportError::Io`] for files, and the errors of drawing.
pub fn write_recording(
    to: &Path,
    summary: &Summary,
    (source, images): (&Path, &Summary),
) -> Result<Recording, ReportError> {
    let readme = to.join("README.md");
    let text = match std::fs::read_to_string(&readme) {
        Ok(text) => text,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => skeleton(summary),
        Err(source) => return Err(ReportError::Read { path: readme, source }),
    };
    let mut panel = None;
    let made = spliced(&text, summary, |directive| {
        if directive.verb != "panel" {
            return Err(format!("there is no `noisefloor:{}`", directive.verb));
        }
        if summary_has_images(images) {
            panel = Some(crate::panel::panel(images, source, directive)?);
            return Ok(Some("![Pictures of the first replicate](panel.png)".into()));
        }
        // A recording of a recording: the panel stays as it is.
        Ok(None)
    })?;
    if let Some(png) = panel {
        write_file(&to.join("panel.png"), &png)?;
    }
    let wanted = embedded_plots(&made);
    let plots = match wanted.is_empty() && !to.join("plots").exists() {
        true => Vec::new(),
        false => Plots::write_some(&Index::new(summary), &to.join("plots"), &wanted)?,
    };
    let name = |path: &PathBuf| path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let drawn: Vec<String> = plots.iter().filter_map(name).collect();
    let absent = wanted.into_iter().filter(|name| !drawn.contains(name)).collect();
    write_file(&readme, made.as_bytes())?;
    Ok(Recording { readme, plots, absent })
}
