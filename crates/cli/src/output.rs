//! Outputs of the verbs that write images: where they go, in which format, and what is refused before any work.

use std::collections::BTreeMap;
use std::fmt;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use noisefloor_frame::{Frame, Image, Reference};
use noisefloor_io::{Destination, IoError, Window, write_frame, write_image_at, write_reference};
use noisefloor_report::{Picture, picture};
use serde_json::{Value, json};

use crate::exit::usage;
use crate::out::{Out, say};

/// How an image is written.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Format {
    /// OpenEXR: numbers.
    Exr,
    /// PNG: what a display shows at this exposure, in stops.
    Png(f32),
}

/// An output of the command line, checked.
#[derive(Debug, Clone, PartialEq)]
pub struct Output {
    to: Destination,
    format: Format,
}

impl Output {
    /// From a word of the command line. The name decides the format: `.exr`, or `.png` at an exposure of `stops`; `-`,
    /// devices and pipes get OpenEXR unless they are named `.png`.
    ///
    /// # Errors
    /// Another ending, an exposure without a PNG, a folder in the way or a missing one.
    pub fn new(word: &Path, stops: Option<f32>) -> anyhow::Result<Self> {
        let to = Destination::from_argument(word);
        let file = to.file()?;
        // A link may be named as one kind of file and lead to another.
        let names = [Some(word), file.as_deref()];
        let kinds: Vec<_> = names.into_iter().flatten().map(kind).collect();
        let png = match kinds[..] {
            [Some(png)] | [Some(png), None] | [None, Some(png)] => png,
            [Some(one), Some(other)] if one == other => one,
            [None] => false,
            _ => {
                return Err(usage(format!(
                    "output {}: its name must end in .exr (numbers) or .png (a picture), or be - for standard output",
                    word.display()
                )));
            }
        };
        if let (false, Some(_)) = (png, stops) {
            return Err(usage("--exposure is for .png: OpenEXR files keep the numbers as they are"));
        }
        to.check()?;
        Ok(Self { to, format: if png { Format::Png(stops.unwrap_or(0.0)) } else { Format::Exr } })
    }

    /// Refuses to write over one of the inputs, under whatever name.
    ///
    /// # Errors
    /// Names both.
    pub fn spare<'a>(&self, inputs: impl IntoIterator<Item = &'a Path>) -> anyhow::Result<()> {
        spare(&self.to, inputs)
    }

    /// Refuses what needs a folder to put more than one file into.
    ///
    /// # Errors
    /// If the output is no file.
    pub fn need_file(&self, option: &str) -> anyhow::Result<()> {
        if self.to.file()?.is_none() {
            return Err(usage(format!("{option} writes several files, but the output {} is none", self.to)));
        }
        Ok(())
    }

    /// Where messages go, so that they do not mix with the image.
    pub fn messages(&self) -> Out {
        if self.to == Destination::Stdout { Out::Stderr } else { Out::Stdout }
    }

    /// The path, if it has one, else `-`.
    pub fn path(&self) -> PathBuf {
        self.to.path().unwrap_or(Path::new("-")).to_owned()
    }

    /// The same in another file beside it.
    pub fn beside(&self, path: PathBuf) -> Self {
        Self { to: path.into(), ..self.clone() }
    }

    /// Writes an image with attributes, at the place in the picture of what it was made from.
    pub fn image(
        &self,
        image: &Image,
        attributes: &BTreeMap<String, String>,
        window: &Window,
    ) -> anyhow::Result<Written<'_>> {
        self.put(image, || write_image_at(self.to.clone(), image, attributes, window))
    }

    /// Writes a frame; a PNG shows its colour alone.
    pub fn frame(&self, frame: &Frame) -> anyhow::Result<Written<'_>> {
        self.put(&frame.color.mean, || write_frame(self.to.clone(), frame))
    }

    /// Writes a reference; a PNG shows its colour alone.
    pub fn reference(&self, reference: &Reference) -> anyhow::Result<Written<'_>> {
        self.put(reference.mean(), || write_reference(self.to.clone(), reference))
    }

    fn put(&self, color: &Image, exr: impl FnOnce() -> Result<(), IoError>) -> anyhow::Result<Written<'_>> {
        let (done, shown) = match self.format {
            Format::Exr => (exr(), None),
            Format::Png(stops) => {
                let shown = picture(color, stops)?;
                (self.to.write(|out| out.write_all(&shown.png)), Some(shown))
            }
        };
        match done {
            // Whoever reads standard output has seen enough.
            Err(IoError::Write { cause, .. })
                if self.to == Destination::Stdout && cause.kind() == ErrorKind::BrokenPipe => {}
            other => other?,
        }
        Ok(Written { output: self, shown })
    }
}

/// `Some(whether it is PNG)` by the ending of a name.
fn kind(name: &Path) -> Option<bool> {
    let extension = name.extension()?;
    let is = |kind: &str| extension.eq_ignore_ascii_case(kind);
    (is("png") || is("exr")).then(|| is("png"))
}

/// Refuses a destination that is one of the inputs.
///
/// # Errors
/// Names both.
pub fn spare<'a>(to: &Destination, inputs: impl IntoIterator<Item = &'a Path>) -> anyhow::Result<()> {
    for input in inputs {
        if to.is_same_file(input) {
            return Err(usage(format!(
                "the output {to} and the input {} are the same file: choose another output",
                input.display()
            )));
        }
    }
    Ok(())
}

/// Told after an image is written.
#[derive(Debug)]
pub struct Written<'a> {
    output: &'a Output,
    shown: Option<Picture>,
}

impl Written<'_> {
    /// One line for the terminal; `more` follows the name.
    ///
    /// # Errors
    /// If standard output cannot take it.
    pub fn tell(&self, more: impl fmt::Display) -> anyhow::Result<()> {
        say!(self.output.messages(), "wrote {}{more}{}", self.output.to, self.note())
    }

    /// What a PNG does to the numbers, for programs; nothing for OpenEXR.
    pub fn describe(&self) -> Option<Value> {
        let (Format::Png(stops), Some(shown)) = (self.output.format, &self.shown) else { return None };
        Some(json!({
            "bits": 8, "exposure_stops": stops, "curve": "sRGB",
            "clipped_pixels": shown.clipped_pixels, "non_finite_pixels": shown.non_finite_pixels,
        }))
    }

    /// What a PNG does to the numbers; nothing for OpenEXR.
    pub fn note(&self) -> String {
        let (Format::Png(stops), Some(shown)) = (self.output.format, &self.shown) else {
            return String::new();
        };
        let mut note = format!(": a picture of 8 bits, exposure {stops:+} stops, sRGB curve");
        let count = |n: usize| if n == 1 { "1 pixel".to_owned() } else { format!("{n} pixels") };
        if shown.clipped_pixels > 0 {
            note.push_str(&format!(", {} brighter than white", count(shown.clipped_pixels)));
        }
        if shown.non_finite_pixels > 0 {
            note.push_str(&format!(", {} not finite (magenta)", count(shown.non_finite_pixels)));
        }
        note
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_decides_the_format() {
        assert_eq!(kind(Path::new("a/b.EXR")), Some(false));
        assert_eq!(kind(Path::new("b.noisy.png")), Some(true));
        for other in ["a", ".exr", "a.jpg", "a.exr.gz", "png"] {
            assert_eq!(kind(Path::new(other)), None, "{other}");
        }
    }

    #[test]
    fn an_exposure_without_a_picture_and_other_endings_are_refused() {
        assert!(Output::new(Path::new("a.png"), Some(1.0)).is_ok());
        let error = Output::new(Path::new("a.exr"), Some(1.0)).unwrap_err().to_string();
        assert!(error.contains("--exposure"), "{error}");
        for name in ["a", "a.jpg", "a.exr.gz"] {
            let error = Output::new(Path::new(name), None).unwrap_err().to_string();
            assert!(error.contains(name) && error.contains(".exr") && error.contains(".png"), "{error}");
        }
        assert_eq!(Output::new(Path::new("-"), None).unwrap().messages(), Out::Stderr);
    }
}
