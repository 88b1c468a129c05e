use std::collections::BTreeMap;
use std::fmt;
use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use noisefloor_denoiser::{
    BuildError, Citation, Cost, DenoiseError, Denoiser, Factory, Input, Invariance, MethodCard, Output,
    Param, ParamError, Parameters, StageTimer, method,
};
use noisefloor_frame::{Frame, Image};
use noisefloor_io::{IoError, read_color, read_image, read_pfm, write_frame, write_image, write_pfm};
use serde_json::{Map, Value};

use crate::buffer::Buffer;
use crate::params::Params;
use crate::process::{self, last_lines};
use crate::template::{Format, Place, Template, file};
use crate::version::version;

const ID: &str = "command";
/// Lines of standard error that go into a message.
const LINES: usize = 4;

/// A program outside: see the crate documentation.
#[derive(Debug, Clone)]
pub struct Command {
    params: Params,
    template: Template,
}

impl Command {
    /// Reads the command line. Nothing is run.
    ///
    /// # Errors
    /// The parameter that is out of range; `run` if it is no command or names no output.
    pub fn new(params: Params) -> Result<Self, ParamError> {
        params.check()?;
        let template = Template::parse(&params.run)?;
        Ok(Self { params, template })
    }

    /// The parameters.
    #[must_use]
    pub fn params(&self) -> &Params {
        &self.params
    }

    fn name(&self) -> String {
        if !self.params.name.is_empty() {
            return self.params.name.clone();
        }
        let program = self.template.fixed().next().unwrap_or(ID);
        Path::new(program)
            .file_name()
            .map_or_else(|| program.to_owned(), |name| name.to_string_lossy().into_owned())
    }

    /// Buffers that the command line or its parameters name.
    fn buffers(&self) -> Vec<Buffer> {
        let places = self.template.places().filter_map(|place| match place {
            Place::Buffer(buffer, ..) => Some(buffer.clone()),
            _ => None,
        });
        places.chain(self.params.needs.iter().map(|name| Buffer::from_name(name))).collect()
    }

    fn trouble(&self, what: impl fmt::Display, stderr: &str) -> DenoiseError {
        let said = last_lines(stderr, LINES);
        let said = if said.is_empty() { String::new() } else { format!("; it said: {said}") };
        DenoiseError::Program { method: self.name(), what: format!("{what}{said}") }
    }

    /// Writes what the command line names.
    fn write(&self, folder: &Path, frame: &Frame) -> Result<(), DenoiseError> {
        let failed = |error: IoError| self.trouble(format!("its input cannot be written: {error}"), "");
        for place in self.template.places() {
            let path = file(folder, place);
            match place {
                Place::Input => write_frame(path, frame).map_err(failed)?,
                Place::Buffer(buffer, format, name) => {
                    let image = buffer
                        .of(frame)
                        .ok_or_else(|| self.trouble(format!("the frame has no {name}"), ""))?;
                    match format {
                        Format::Exr => write_image(path, &image, &BTreeMap::new()).map_err(failed)?,
                        Format::Pfm => write_pfm(path, &for_pfm(image)).map_err(failed)?,
                    }
                }
                Place::Output(_) | Place::Seconds | Place::Threads => {}
            }
        }
        Ok(())
    }

    /// Reads and checks what it wrote.
    fn read(&self, folder: &Path, frame: &Frame, stderr: &str) -> Result<Image, DenoiseError> {
        let format = self.template.output();
        let path = file(folder, &Place::Output(format));
        if !path.is_file() {
            return Err(self.trouble("ended well and wrote no output", stderr));
        }
        let read = match format {
            // Frames and plain images alike.
            Format::Exr => read_color(&path).or_else(|_| read_image(&path)),
            Format::Pfm => read_pfm(&path),
        };
        let image =
            read.map_err(|error| self.trouble(format!("its output cannot be read: {error}"), stderr))?;
        image.expect_shape("output of the program", frame.width(), frame.height(), 3)?;
        let undefined = |p: usize| image.planes().any(|plane| !plane[p].is_finite());
        let mut broken = (0..image.pixels()).filter(|&p| undefined(p));
        if let Some(first) = broken.next() {
            return Err(DenoiseError::Undefined {
                method: self.name(),
                what: "its output is not finite".into(),
                pixels: 1 + broken.count(),
                x: first % image.width(),
                y: first / image.width(),
            });
        }
        Ok(image)
    }

    /// Seconds that it says it computed for.
    fn seconds(&self, folder: &Path, ended: &process::Ended) -> Option<f64> {
        let number = |text: &str| {
            let number =
                text.trim_start().split(|c: char| !matches!(c, '0'..='9' | '.' | 'e' | 'E' | '-' | '+'));
            number.into_iter().next()?.parse::<f64>().ok()
        };
        let written = fs::read_to_string(file(folder, &Place::Seconds)).ok().as_deref().and_then(number);
        let said = || {
            let mark = Some(self.params.seconds_after.as_str()).filter(|mark| !mark.is_empty())?;
            let told = [&ended.stdout, &ended.stderr];
            let after = told.iter().find_map(|text| text.rsplit_once(mark))?.1;
            number(after).map(|value| value * self.params.seconds_unit)
        };
        written.or_else(said).filter(|seconds| seconds.is_finite() && *seconds >= 0.0)
    }
}

/// One or three planes: motion gets an empty third one.
fn for_pfm(image: Image) -> Image {
    match image.channels() {
        1 | 3 => image,
        n => Image::from_fn(
            image.width(),
            image.height(),
            3,
            |c, x, y| if c < n { image.get(c, x, y) } else { 0.0 },
        ),
    }
}

impl Denoiser for Command {
    fn card(&self) -> MethodCard {
        let source = Citation::new("command", "a program outside this one");
        let mut card = MethodCard::new(ID, self.name(), source);
        for buffer in self.buffers() {
            card.named_features.extend(buffer.extra().map(str::to_owned));
            card.needs.extend(buffer.need().filter(|need| !card.needs.contains(need)));
        }
        let unknown = "what a program outside does is not known";
        card.varies_with = Invariance::ALL.map(|what| (what, unknown.to_owned())).into();
        card.cost = Cost::TenSeconds;
        card.notes.push(format!("runs {}", self.params.run));
        card
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        input.check(&self.card())?;
        let mut timer = StageTimer::start();
        let folder = tempfile::Builder::new()
            .prefix("noisefloor-command-")
            .tempdir()
            .map_err(|error| self.trouble(format!("no folder for its files: {error}"), ""))?;
        self.write(folder.path(), input.target)?;
        timer.finish("files written");

        let words = self.template.fill(folder.path(), rayon::current_num_threads());
        let limit = Duration::from_secs_f64(self.params.limit_s);
        let ended = process::run(&words, folder.path(), limit)
            .map_err(|error| self.trouble(format!("cannot be started: {error}"), ""))?;
        if let Some(trouble) = &ended.trouble {
            return Err(self.trouble(trouble, &ended.stderr));
        }
        timer.finish("program");

        let mut output = Output::from_image(self.read(folder.path(), input.target, &ended.stderr)?);
        timer.finish("file read");
        output.seconds = self.seconds(folder.path(), &ended);
        output.log = [ended.stdout, ended.stderr].concat();
        output.stages = timer.into_stages();
        Ok(output)
    }
}

/// The method of a command: it does nothing until it gets one.
struct Outside(Arc<dyn Factory>);

impl Factory for Outside {
    fn id(&self) -> &str {
        self.0.id()
    }

    fn summary(&self) -> &str {
        self.0.summary()
    }

    fn params(&self) -> &[Param] {
        self.0.params()
    }

    fn build(&self, overrides: &Map<String, Value>) -> Result<Box<dyn Denoiser>, BuildError> {
        self.0.build(overrides)
    }

    fn readme(&self) -> Option<&str> {
        self.0.readme()
    }

    fn version(&self, overrides: &Map<String, Value>) -> Option<String> {
        let line = overrides.get("run").and_then(Value::as_str).unwrap_or_default();
        Some(Template::parse(line).map_or_else(|_| String::new(), |template| version(&template)))
    }

    fn ready(&self) -> bool {
        false
    }
}

/// Factory of [`Command`].
#[must_use]
pub fn command() -> Arc<dyn Factory> {
    let summary = "a program outside: any command that reads and writes images";
    Arc::new(Outside(method(ID, summary, Some(crate::README), Command::new)))
}
