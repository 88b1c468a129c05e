//! Image and reference must be the same picture, and independent.

use std::path::{Path, PathBuf};

use anyhow::bail;
use noisefloor_frame::{Finding, FindingKind, Frame, Image, Reference, SquaredError};
use noisefloor_inputs::{Against, Mean, Origin, shared_seed};
use noisefloor_io::{FileOrigin, ReadOptions, read_frame, read_info, read_origin};

use crate::args::Compare;

fn origin(file: &FileOrigin) -> Origin<'_> {
    Origin { provenance: &file.provenance, spp: file.spp }
}

/// What all headers say, before anything is decoded.
pub struct Headers {
    path: PathBuf,
    /// Of the reference.
    pub reference: FileOrigin,
}

impl Headers {
    /// Reads them.
    ///
    /// # Errors
    /// Where sizes or windows differ, or where an image and the reference are rendered from the same random numbers.
    pub fn read(args: &Compare) -> anyhow::Result<Self> {
        let reference = read_origin(&args.reference)?;
        for path in &args.images {
            let image = read_origin(path)?;
            image.window.expect(path, &reference.window, &args.reference)?;
            if let Some(shared) =
                shared_seed(origin(&image), origin(&reference)).filter(|shared| shared.proven)
            {
                bail!(
                    "{} and {}: test and reference are not independent: their headers name the same scene, renderer, sampler and \
                     random seed {}",
                    path.display(),
                    args.reference.display(),
                    shared.seed
                );
            }
        }
        Ok(Self { path: args.reference.clone(), reference })
    }

    /// Holds an image against the reference; one that has statistics is held against it as a frame.
    ///
    /// # Errors
    /// If they are equal bit for bit, and the reference has noise: no error can be measured then.
    pub fn check(
        &self,
        against: &Against<'_>,
        reference: &Reference,
        path: &Path,
        image: &Image,
    ) -> anyhow::Result<Vec<Finding>> {
        let found = match self.frame(path) {
            Some((frame, invalid)) => {
                let mapped =
                    frame.provenance.integrator.as_deref().is_some_and(|i| i.starts_with("photon-mapping"));
                let mean = if mapped { Mean::Biased } else { Mean::OfTheReference };
                against.frame(&frame, &invalid, mean).findings
            }
            None => against.image(image),
        };
        let noisy =
            matches!(reference.squared_error(), SquaredError::Halves | SquaredError::SubtractVariance);
        let equal = found.iter().find(|f| f.kind == FindingKind::EqualData && f.text.contains("reference's"));
        if let Some(equal) = equal.filter(|_| noisy) {
            bail!(
                "{} and {}: test and reference are not independent: {}",
                path.display(),
                self.path.display(),
                equal.text
            );
        }
        let mut out: Vec<Finding> =
            found.into_iter().map(|found| found.within(&path.display().to_string())).collect();
        if let Some(shared) = shared_seed(origin(&read_origin(path)?), origin(&self.reference)) {
            let text = format!(
                "names the same scene, renderer, sampler and random seed {} as {}: with many renderers they share samples",
                shared.seed,
                self.path.display()
            );
            out.push(Finding::new(FindingKind::SharedSeed, path.display().to_string(), text));
        }
        Ok(out)
    }

    /// The image as a frame with its invalid pixels, if it has the statistics of one.
    fn frame(&self, path: &Path) -> Option<(Frame, Vec<bool>)> {
        let info = read_info(path).ok()?;
        info.spp?;
        info.layers.iter().find(|layer| *layer == "color.variance" || *layer == "color.halfA")?;
        let mut frame = read_frame(path, &ReadOptions::default()).ok()?;
        let hygiene = frame.sanitize().ok()?;
        Some((frame, hygiene.without_statistics()))
    }
}
