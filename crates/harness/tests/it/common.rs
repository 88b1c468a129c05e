//! Fake methods, tiny studies, and comparison of records without their times.

use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use noisefloor_denoiser::{
    Adaptive, Bound, Citation, Claim, DenoiseError, Denoiser, Input, MethodCard, Need, NoParams, Output,
    Parameters, Registry, Unit, mc, method, parameters,
};
use noisefloor_frame::Image;
use noisefloor_harness::{HarnessError, Observer, StudyRun, Workload};
use noisefloor_stats::Level;
use noisefloor_study::Study;
use noisefloor_study::record::{Outcome, Record, Seconds};
use noisefloor_study::summary::Summary;

const CITATION: Citation = Citation::new("none", "made up for a test");

/// Mean over a square window, with a false claim to stay in the interval if asked.
struct Blur(BlurParams);

parameters! {
    /// For tests.
    struct BlurParams {
        /// Half the window.
        radius: usize = 1, integer(0..=20).unit("px");
        /// Claims an interval that it leaves.
        boast: bool = false, flag();
        /// Needs half buffers.
        halves: bool = false, flag();
    }
}

impl Denoiser for Blur {
    fn card(&self) -> MethodCard {
        let mut card = MethodCard::new("blur", "Box blur", CITATION);
        if self.0.halves {
            card.needs = vec![Need::ColorHalves];
        }
        if self.0.boast {
            let level = Level::TWO_SIDED_95;
            let claim = Claim { name: "boast".into(), terms: vec![(1e-3, level)], level, proven: false };
            card.claims.enclosure = vec![claim.clone()];
            card.claims.error_bound = vec![claim];
        }
        card
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        input.check(&self.card())?;
        let mean = &input.target.color.mean;
        let (r, w, h) = (self.0.radius as isize, mean.width() as isize, mean.height() as isize);
        let image = Image::from_fn(mean.width(), mean.height(), 3, |c, x, y| {
            let (mut sum, mut count) = (0.0, 0.0);
            for j in (y as isize - r).max(0)..=(y as isize + r).min(h - 1) {
                for i in (x as isize - r).max(0)..=(x as isize + r).min(w - 1) {
                    sum += mean.get(c, i as usize, j as usize);
                    count += 1.0;
                }
            }
            sum / count
        });
        let mut output = Output::from_image(image);
        output.figure("radius", Unit::Pixels, self.0.radius as f64);
        if input.diagnostics != noisefloor_denoiser::Diagnostics::Off {
            output.diagnose("window size", Unit::Pixels, Image::filled(mean.width(), mean.height(), 1, 1.0));
        }
        Ok(output)
    }
}

/// The input plus an offset, with `scale` times its variance as the estimate of its squared error: unbiased at 1.
struct Judge(JudgeParams);

parameters! {
    /// For tests.
    struct JudgeParams {
        /// Estimate over variance.
        scale: f32 = 1.0, number(..);
        /// Claims an estimate and gives none.
        silent: bool = false, flag();
        /// Gives an estimate of one channel.
        flat: bool = false, flag();
        /// Added to the input.
        offset: f32 = 0.0, number(..);
    }
}

impl Denoiser for Judge {
    fn card(&self) -> MethodCard {
        let mut card = MethodCard::new("judge", "Judge of itself", CITATION);
        card.needs = vec![Need::ColorVariance];
        card.claims.estimates_error = true;
        card
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        input.check(&self.card())?;
        let color = &input.target.color;
        let mut output = Output::from_image(color.mean.map(|v| v + self.0.offset));
        let variance = color.variance.as_ref().filter(|_| !self.0.silent);
        output.error_estimate = variance.map(|v| v.mean_variance().map(|v| self.0.scale * v));
        if self.0.flat {
            output.error_estimate = Some(Image::new(color.mean.width(), color.mean.height(), 1));
        }
        Ok(output)
    }
}

/// The input, with what it tells of this very image.
struct Talker(TalkerParams);

parameters! {
    /// For tests.
    struct TalkerParams {
        /// Half-width of the bound that it states.
        width: f32 = 1.0, number(0.0..);
        /// Its own seconds.
        seconds: f64 = 0.0, number(..);
    }
}

impl Denoiser for Talker {
    fn card(&self) -> MethodCard {
        MethodCard::new("talker", "Talker", CITATION)
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        let mean = &input.target.color.mean;
        let mut output = Output::from_image(mean.clone());
        let half_width = Image::filled(mean.width(), mean.height(), 3, self.0.width);
        output.bounds = vec![Bound { name: "of this image".into(), level: Level::TWO_SIDED_95, half_width }];
        output.seconds = Some(self.0.seconds);
        output.log = "read, thought, wrote\n".into();
        Ok(output)
    }
}

/// The input, which wants samples on the left only, and looks at frames beside it.
struct Seeker(SeekerParams);

parameters! {
    /// For tests.
    struct SeekerParams {
        /// Frames on each side.
        neighbors: usize = 0, integer(0..=99);
        /// Fails to say where samples are needed.
        lost: bool = false, flag();
    }
}

impl Denoiser for Seeker {
    fn card(&self) -> MethodCard {
        MethodCard { neighbors: self.0.neighbors, ..MethodCard::new("seeker", "Seeker", CITATION) }
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        input.check(&self.card())?;
        let mut output = Output::from_image(input.target.color.mean.clone());
        output.figure("before", Unit::None, input.before.len() as f64);
        output.figure("after", Unit::None, input.after.len() as f64);
        // The frames in time order tell themselves by their first value.
        for (k, frame) in input.before.iter().chain([input.target]).chain(input.after).enumerate() {
            output.figure(format!("frame {k}"), Unit::Radiance, f64::from(frame.color.mean.data()[0]));
        }
        Ok(output)
    }

    fn adaptive(&self) -> Option<&dyn Adaptive> {
        Some(self)
    }
}

impl Adaptive for Seeker {
    fn density(&self, input: &Input<'_>) -> Result<Image, DenoiseError> {
        if self.0.lost {
            return Err(DenoiseError::Undefined {
                method: "seeker".into(),
                what: "way".into(),
                pixels: 1,
                x: 0,
                y: 0,
            });
        }
        let (width, height) = (input.target.width(), input.target.height());
        Ok(Image::from_fn(width, height, 1, |_, x, _| f32::from(2 * x < width)))
    }
}

/// Does what its id says.
struct Trouble(&'static str);

impl Denoiser for Trouble {
    fn card(&self) -> MethodCard {
        let mut card = MethodCard::new(self.0, self.0, CITATION);
        if self.0 == "needy" {
            card.needs = vec![Need::Flash, Need::ColorHalves];
        }
        card
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        let mean = &input.target.color.mean;
        match self.0 {
            "panics" => panic!("no reason"),
            "shrinks" => Ok(Output::from_image(Image::new(1, 1, 3))),
            "nan" => {
                let mut image = mean.clone();
                image.set(0, 0, 0, f32::NAN);
                Ok(Output::from_image(image))
            }
            _ => Err(DenoiseError::Undefined {
                method: self.0.into(),
                what: "weight".into(),
                pixels: 7,
                x: 1,
                y: 2,
            }),
        }
    }
}

pub fn registry() -> Registry {
    let blur = method("blur", "box blur", None, |p: BlurParams| p.check().map(|()| Blur(p)));
    let judge = method("judge", "judge of itself", None, |p: JudgeParams| Ok(Judge(p)));
    let seeker = method("seeker", "seeks samples", None, |p: SeekerParams| Ok(Seeker(p)));
    let talker = method("talker", "tells of its image", None, |p: TalkerParams| Ok(Talker(p)));
    let troubles = ["needy", "fails", "panics", "shrinks", "nan"]
        .map(|id| method(id, "a test", None, move |_: NoParams| Ok(Trouble(id))));
    Registry::new([mc(), blur, judge, seeker, talker].into_iter().chain(troubles))
}

/// Counts, and stops after a number of cells if asked.
#[derive(Default)]
pub struct Watch {
    pub cells: AtomicUsize,
    pub samples: AtomicUsize,
    pub planned: Mutex<Workload>,
    pub warnings: Mutex<Vec<String>>,
    pub stop_after: Option<usize>,
    pub stop_after_samples: Option<usize>,
}

impl Watch {
    pub fn stopping_after(cells: usize) -> Self {
        Self { stop_after: Some(cells), ..Self::default() }
    }

    pub fn cells(&self) -> usize {
        self.cells.load(Ordering::Relaxed)
    }

    pub fn samples(&self) -> usize {
        self.samples.load(Ordering::Relaxed)
    }

    pub fn warnings(&self) -> Vec<String> {
        self.warnings.lock().unwrap().clone()
    }
}

impl Observer for Watch {
    fn planned(&self, work: &Workload) {
        *self.planned.lock().unwrap() = *work;
    }
    fn rendered(&self, samples: u64) {
        self.samples.fetch_add(samples as usize, Ordering::Relaxed);
    }
    fn cell(&self, _: &Record, _: &Outcome) {
        self.cells.fetch_add(1, Ordering::Relaxed);
    }
    fn warning(&self, text: &str) {
        self.warnings.lock().unwrap().push(text.into());
    }
    fn cancelled(&self) -> bool {
        self.stop_after.is_some_and(|stop| self.cells() >= stop)
            || self.stop_after_samples.is_some_and(|stop| self.samples() >= stop)
    }
}

/// Folders for one test.
pub struct Place {
    pub root: tempfile::TempDir,
}

impl Place {
    pub fn new() -> Self {
        Self { root: tempfile::tempdir().unwrap() }
    }

    pub fn out(&self) -> PathBuf {
        self.root.path().join("out")
    }

    pub fn cache(&self) -> PathBuf {
        self.root.path().join("cache")
    }

    pub fn run(&self, study: &Study, watch: &Watch) -> Result<Summary, HarnessError> {
        self.run_to(&self.out(), study, watch)
    }

    pub fn run_to(&self, out: &Path, study: &Study, watch: &Watch) -> Result<Summary, HarnessError> {
        self.run_with(study, watch, |request| noisefloor_harness::run(&StudyRun { out_dir: out, ..request }))
    }

    /// Runs a request that `go` may change.
    pub fn run_with(
        &self,
        study: &Study,
        watch: &Watch,
        go: impl FnOnce(StudyRun<'_>) -> Result<Summary, HarnessError>,
    ) -> Result<Summary, HarnessError> {
        go(StudyRun {
            study,
            registry: &registry(),
            out_dir: &self.out(),
            cache_dir: &self.cache(),
            size: None,
            again: &[],
            command: "test".into(),
            simd: "none".into(),
            laboratory: noisefloor_harness::Laboratory::default(),
            observer: watch,
        })
    }
}

pub fn study(toml: &str) -> Study {
    Study::from_toml(toml, Path::new("test.toml")).unwrap_or_else(|e| panic!("{e}"))
}

/// Two levels, two replicates, two rows: eight cells.
pub fn small() -> Study {
    study(SMALL)
}

pub const SMALL: &str = r#"
name = "small"
spp = [4, 16]
replicates = 2
timing = { warmup = 0, runs = 1 }
[[scene]]
id = "steps"
synthetic = { image = "edges", law = "gaussian", sd = 0.5, width = 24, height = 16 }
[[method]]
id = "mc"
[[method]]
id = "blur"
"#;

pub fn records(out: &Path) -> Vec<Record> {
    let text = std::fs::read_to_string(out.join("results.jsonl")).unwrap();
    text.lines().map(|line| serde_json::from_str(line).unwrap_or_else(|e| panic!("{e}: {line}"))).collect()
}

/// Records that were set aside.
pub fn superseded(out: &Path) -> Vec<Record> {
    let text = std::fs::read_to_string(out.join("results.superseded.jsonl")).unwrap_or_default();
    text.lines().map(|line| serde_json::from_str(line).unwrap_or_else(|e| panic!("{e}: {line}"))).collect()
}

/// Records as they must agree between runs: without times and memory.
pub fn timeless(out: &Path) -> Vec<Record> {
    let mut all = records(out);
    for record in &mut all {
        record.seconds = Seconds::default();
        record.peak_memory_bytes = None;
    }
    all
}
