//! A command line with places for files.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use noisefloor_denoiser::ParamError;

use crate::buffer::Buffer;

/// How an image is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Format {
    Exr,
    Pfm,
}

/// What stands in for a place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Place {
    /// The whole frame, as this program writes frames.
    Input,
    /// Where the result is looked for.
    Output(Format),
    /// One image of the frame.
    Buffer(Buffer, Format, String),
    /// Where it may write how many seconds it computed.
    Seconds,
    /// How many threads it may use.
    Threads,
}

/// A part of a word.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Piece {
    Text(String),
    Place(Place),
}

/// A command line, split into words.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Template {
    words: Vec<Vec<Piece>>,
}

impl Template {
    /// Reads a command line.
    pub fn parse(line: &str) -> Result<Self, ParamError> {
        let refuse = |range: &str| ParamError {
            parameter: "run".into(),
            value: format!("{line:?}"),
            range: range.into(),
        };
        let Some(words) = shlex::split(line) else { return Err(refuse("a command whose quotes are closed")) };
        if words.is_empty() {
            return Err(refuse("a program and its arguments, such as `python3 mine.py {input} {output}`"));
        }
        let words: Vec<Vec<Piece>> = words
            .iter()
            .map(|word| pieces(word).map_err(|name| refuse(&format!("{{{name}}} names no file: {PLACES}"))))
            .collect::<Result<_, _>>()?;
        let template = Self { words };
        match template.places().filter(|place| matches!(place, Place::Output(_))).count() {
            0 => Err(refuse("a command that names {output} or {output.pfm}")),
            _ => Ok(template),
        }
    }

    /// The places in order.
    pub fn places(&self) -> impl Iterator<Item = &Place> {
        self.words.iter().flatten().filter_map(|piece| match piece {
            Piece::Place(place) => Some(place),
            Piece::Text(_) => None,
        })
    }

    /// Where the result is looked for.
    pub fn output(&self) -> Format {
        let formats = self.places().filter_map(|place| match place {
            Place::Output(format) => Some(*format),
            _ => None,
        });
        formats.last().unwrap_or(Format::Exr) // one is there
    }

    /// Words without a place: the program, scripts, options.
    pub fn fixed(&self) -> impl Iterator<Item = &str> {
        self.words.iter().filter_map(|word| match word.as_slice() {
            [Piece::Text(text)] => Some(text.as_str()),
            _ => None,
        })
    }

    /// The words with files in a folder.
    pub fn fill(&self, folder: &Path, threads: usize) -> Vec<OsString> {
        let word = |pieces: &Vec<Piece>| {
            let mut out = OsString::new();
            for piece in pieces {
                match piece {
                    Piece::Text(text) => out.push(text),
                    Piece::Place(Place::Threads) => out.push(threads.to_string()),
                    Piece::Place(place) => out.push(file(folder, place)),
                }
            }
            out
        };
        self.words.iter().map(word).collect()
    }
}

/// The file of a place.
pub(crate) fn file(folder: &Path, place: &Place) -> PathBuf {
    let ending = |format: &Format| match format {
        Format::Exr => "exr",
        Format::Pfm => "pfm",
    };
    folder.join(match place {
        Place::Input => "input.exr".to_owned(),
        Place::Output(format) => format!("output.{}", ending(format)),
        Place::Buffer(_, format, name) => format!("{name}.{}", ending(format)),
        Place::Seconds => "seconds.txt".to_owned(),
        Place::Threads => String::new(),
    })
}

const PLACES: &str = "{input}, {output}, {output.pfm}, {seconds}, {threads}, or an image of the frame and its format, such \
                      as {color.pfm}, {variance.exr}, {albedo.pfm}, {albedo.variance.pfm}, {normal.pfm}";

/// Text and places of a word; the name of a place that is none.
fn pieces(word: &str) -> Result<Vec<Piece>, String> {
    let mut out = Vec::new();
    let mut rest = word;
    while let Some((before, after)) = rest.split_once('{') {
        let Some((name, behind)) = after.split_once('}') else { return Err(after.to_owned()) };
        if !before.is_empty() {
            out.push(Piece::Text(before.to_owned()));
        }
        out.push(Piece::Place(place(name).ok_or_else(|| name.to_owned())?));
        rest = behind;
    }
    if !rest.is_empty() {
        out.push(Piece::Text(rest.to_owned()));
    }
    Ok(out)
}

fn place(name: &str) -> Option<Place> {
    Some(match name {
        "input" | "input.exr" => Place::Input,
        "output" | "output.exr" => Place::Output(Format::Exr),
        "output.pfm" => Place::Output(Format::Pfm),
        "seconds" => Place::Seconds,
        "threads" => Place::Threads,
        _ => {
            let (buffer, format) = name.rsplit_once('.')?;
            let format = match format {
                "exr" => Format::Exr,
                "pfm" => Format::Pfm,
                _ => return None,
            };
            // A name becomes that of a file.
            let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '_' | '-');
            if buffer.is_empty() || !buffer.chars().all(plain) {
                return None;
            }
            Place::Buffer(Buffer::from_name(buffer), format, buffer.to_owned())
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_split_and_places_filled() {
        let line =
            "python3 'my script.py' --in={input} {output.pfm} {albedo.variance.pfm} -t {threads} {seconds}";
        let template = Template::parse(line).unwrap();
        let words = template.fill(Path::new("/t"), 3);
        let expected = [
            "python3",
            "my script.py",
            "--in=/t/input.exr",
            "/t/output.pfm",
            "/t/albedo.variance.pfm",
            "-t",
            "3",
            "/t/seconds.txt",
        ];
        assert_eq!(words, expected.map(OsString::from));
        assert_eq!(template.fixed().collect::<Vec<_>>(), ["python3", "my script.py", "-t"]);
        assert_eq!((template.output(), template.places().count()), (Format::Pfm, 5));
    }

    #[test]
    fn what_is_no_command_says_what_one_is() {
        for (line, part) in [
            ("", "a program and its arguments"),
            ("a 'b", "quotes"),
            ("a {input}", "{output}"),
            ("a {output} {albedo}", "{albedo} names no file"),
            ("a {output} {albedo.png}", "{albedo.png}"),
            ("a {output} {../x.pfm}", "{../x.pfm}"),
            ("a {output} {", "names no file"),
        ] {
            let error = Template::parse(line).unwrap_err();
            assert!(error.range.contains(part), "{line}: {error}");
        }
    }
}
