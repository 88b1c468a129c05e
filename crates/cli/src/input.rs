//! The one frame of a command: read, checked, and fit for the method.

use std::path::Path;

use anyhow::anyhow;
use noisefloor_denoiser::{DenoiseError, Input, MethodCard, Setting};
use noisefloor_frame::{Finding, FindingKind, Frame, Hygiene, Image};
use noisefloor_io::{ReadOptions, read_checked_frame};

/// A frame that a method can run on, with what was mended and found.
pub struct Checked {
    pub frame: Frame,
    pub hygiene: Hygiene,
    /// With the file's name.
    pub findings: Vec<Finding>,
}

/// Reads and checks a frame, and refuses it before any work if the method cannot run on it: with the reason, if it
/// was found in the file, and with the settings that would do.
pub fn read(path: &Path, options: &ReadOptions, card: &MethodCard) -> anyhow::Result<Checked> {
    let (frame, mut hygiene) = read_checked_frame(path, options)?;
    // A layer that was asked for by its name is read.
    hygiene.findings.retain(|finding| {
        finding.kind != FindingKind::UnreadLayer || !card.named_features.contains(&finding.subject)
    });
    Input::new(&frame).check(card).map_err(|error| refused(error, &hygiene.findings))?;
    let name = path.display().to_string();
    let findings = std::mem::take(&mut hygiene.findings);
    let findings = findings.into_iter().map(|finding| finding.within(&name)).collect();
    Ok(Checked { frame, hygiene, findings })
}

fn refused(error: DenoiseError, findings: &[Finding]) -> anyhow::Error {
    let because: Vec<String> =
        error.because(findings).into_iter().map(|finding| format!("\n  {finding}")).collect();
    let text = match &error {
        DenoiseError::MissingInputs { method, missing, ways_out } if !ways_out.is_empty() => {
            let missing: Vec<String> = missing.iter().map(ToString::to_string).collect();
            let ways: Vec<String> = ways_out.iter().map(|way| options(way)).collect();
            format!("{method} needs {}, or {}", missing.join(", "), ways.join(", or "))
        }
        error => error.to_string(),
    };
    anyhow!("{text}{}", because.concat())
}

/// Settings as they are typed.
fn options(way: &[Setting]) -> String {
    way.iter().map(|setting| format!("--set {setting}")).collect::<Vec<_>>().join(" ")
}

/// Takes back what was made up: plain Monte Carlo gives what was read, no number included; for other methods what was
/// filled in beyond small holes is no part of the image.
pub fn as_read(method: &str, image: &mut Image, hygiene: &Hygiene) {
    if method == noisefloor_study::BASELINE {
        hygiene.restore(image);
    } else {
        hygiene.mark_absent(image);
    }
}
