//! The grammar of a study file. Everything optional gets its default here.

use std::path::{Path, PathBuf};

use noisefloor_frame::{FeatureHit, Integrator, Maps, PhotonSettings, PixelFilter, Sampling};
use serde::Deserialize;
use serde_json::{Map, Value};
use toml::Spanned;

use crate::error::{Place, StudyError};
use crate::study::check::check;
use crate::study::compare::RawCompare;
use crate::study::lines::Lines;
use crate::study::{
    AdaptiveFrames, Family, MethodRow, ReferenceSpec, Replicates, RowFrames, SceneSource, SceneSpec, Shot,
    Study, Timing,
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Raw {
    name: String,
    title: Option<String>,
    #[serde(default)]
    question: String,
    #[serde(default)]
    analysis: Vec<String>,
    reproduces: Option<String>,
    #[serde(default)]
    spp: Vec<u32>,
    #[serde(default)]
    replicates: RawReplicates,
    width: Option<usize>,
    height: Option<usize>,
    #[serde(default = "default_depth")]
    depth: u32,
    #[serde(default = "default_filter")]
    filter: PixelFilter,
    #[serde(default)]
    feature_hit: FeatureHit,
    #[serde(default)]
    intervals: Vec<String>,
    #[serde(default)]
    membership: bool,
    #[serde(default)]
    statistics: Vec<String>,
    #[serde(default)]
    seed: u64,
    #[serde(default = "default_sampling")]
    sampling: Sampling,
    #[serde(default)]
    reference: RawReference,
    #[serde(rename = "scene")]
    scenes: Vec<Spanned<RawScene>>,
    #[serde(rename = "method")]
    methods: Vec<Spanned<RawMethod>>,
    metrics: Option<Vec<String>>,
    primary_metric: Option<String>,
    coverage: Option<Vec<f64>>,
    #[serde(default)]
    timing: Timing,
    #[serde(default)]
    comparison: Family,
    #[serde(default)]
    viewer_spp: Vec<u32>,
    probe: Option<[f64; 2]>,
    #[serde(default)]
    figures: Vec<String>,
    #[serde(default)]
    compare: Vec<Spanned<RawCompare>>,
}

/// Columns and rows of scenes in studies that state neither; synthetic scenes have their own then.
const SIZE: (usize, usize) = (256, 192);

fn default_depth() -> u32 {
    8
}
fn default_filter() -> PixelFilter {
    PixelFilter::Box
}
fn default_sampling() -> Sampling {
    Sampling::Independent
}

/// `4` or `{ default = 8, above = [[256, 4]] }`.
#[derive(Deserialize)]
#[serde(untagged, expecting = "a number, or a table like { default = 8, above = [[256, 4]] }")]
enum RawReplicates {
    Number(u32),
    Table(Replicates),
}

impl Default for RawReplicates {
    fn default() -> Self {
        Self::Number(4)
    }
}

impl From<RawReplicates> for Replicates {
    fn from(raw: RawReplicates) -> Self {
        match raw {
            RawReplicates::Number(count) => Self::uniform(count),
            RawReplicates::Table(table) => table,
        }
    }
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields)]
struct RawReference {
    spp: Option<u32>,
    parts: Option<u32>,
    sampling: Option<Sampling>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawScene {
    id: String,
    synthetic: Option<noisefloor_synthetic::SyntheticSpec>,
    folder: Option<PathBuf>,
    spp: Option<Vec<u32>>,
    replicates: Option<RawReplicates>,
    /// Name of the built-in scene, if the id is another.
    scene: Option<String>,
    /// A glTF file.
    file: Option<PathBuf>,
    #[serde(default)]
    frame: u32,
    #[serde(default)]
    orbit_degrees: f32,
    #[serde(default)]
    integrator: Integrator,
    photons: Option<PhotonSettings>,
    maps: Option<Maps>,
    sequence: Option<String>,
    #[serde(default)]
    set: Map<String, Value>,
    equal_time_spp: Option<u32>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawMethod {
    id: String,
    label: Option<String>,
    #[serde(default)]
    set: Map<String, Value>,
    adaptive: Option<AdaptiveFrames>,
    variance: Option<String>,
    equal_time: Option<String>,
}

impl Study {
    /// Reads a study. `path` is named in messages, and folders of frames are found relative to the folder it is in.
    ///
    /// # Errors
    /// [`StudyError::Syntax`], [`StudyError::Field`] or [`StudyError::Scene`], each with the line. Methods are
    /// looked up when the study is run, because only then is there a registry.
    pub fn from_toml(text: &str, path: &Path) -> Result<Self, StudyError> {
        let file = path.display().to_string();
        let line_at = |offset: usize| text[..offset.min(text.len())].matches('\n').count() + 1;
        let raw: Raw = toml::from_str(text).map_err(|error| StudyError::Syntax {
            place: Place { file: file.clone(), line: error.span().map(|span| line_at(span.start)) },
            message: shortened(error.to_string().trim_end()),
        })?;
        let base = path.parent().unwrap_or(Path::new(""));
        let mut lines = Lines { file, text, ..Lines::default() };

        let size = (raw.width.unwrap_or(SIZE.0), raw.height.unwrap_or(SIZE.1));
        let of_study = (raw.width.is_some() || raw.height.is_some()).then_some(size);
        let mut scenes = Vec::new();
        for (index, scene) in raw.scenes.into_iter().enumerate() {
            let line = line_at(scene.span().start);
            lines.scenes.push(line);
            scenes.push(scene.into_inner().resolve(index, line, base, of_study, &lines)?);
        }
        let mut methods = Vec::new();
        for (index, row) in raw.methods.into_iter().enumerate() {
            let line = line_at(row.span().start);
            methods.push(row.into_inner().resolve(index, line, &lines)?);
        }
        let top = raw.spp.iter().copied().max().unwrap_or(1);
        let reference = ReferenceSpec {
            // 16 times the largest level is what the coverage correction assumes.
            spp: raw.reference.spp.unwrap_or_else(|| top.saturating_mul(16).max(1024).next_multiple_of(8)),
            parts: raw.reference.parts.unwrap_or(8),
            sampling: raw.reference.sampling.unwrap_or(Sampling::LowDiscrepancy),
        };
        let metrics = raw.metrics.unwrap_or_else(crate::metric::ids);
        let primary_metric = raw.primary_metric.unwrap_or_else(|| crate::metric::primary(&metrics));
        lines.compare = raw.compare.iter().map(|compare| line_at(compare.span().start)).collect();
        let compare = raw.compare.into_iter().map(|compare| compare.into_inner().resolve(&primary_metric));
        let study = Self {
            title: raw.title.unwrap_or_else(|| raw.name.clone()),
            name: raw.name,
            question: raw.question,
            analysis: raw.analysis,
            reproduces: raw.reproduces,
            spp: raw.spp,
            replicates: raw.replicates.into(),
            width: size.0,
            height: size.1,
            depth: raw.depth,
            filter: raw.filter,
            feature_hit: raw.feature_hit,
            intervals: raw.intervals,
            membership: raw.membership,
            statistics: raw.statistics,
            seed: raw.seed,
            sampling: raw.sampling,
            reference,
            scenes,
            methods,
            compare: compare.collect(),
            primary_metric,
            metrics,
            coverage: raw.coverage.unwrap_or_else(|| vec![0.95, 0.99, 0.998]),
            timing: raw.timing,
            comparison: raw.comparison,
            viewer_spp: raw.viewer_spp,
            probe: raw.probe,
            figures: raw.figures,
        };
        check(&study, &lines)?;
        Ok(study)
    }

    /// Reads a study file.
    ///
    /// # Errors
    /// [`StudyError::Read`], or as [`Study::from_toml`].
    pub fn from_file(path: &Path) -> Result<Self, StudyError> {
        let text = std::fs::read_to_string(path)
            .map_err(|source| StudyError::Read { path: path.to_owned(), source })?;
        Self::from_toml(&text, path)
    }
}

/// The parser's message without the far ends of long lines, which it shows whole.
fn shortened(message: &str) -> String {
    let short = |line: &str| match line.char_indices().nth(LONGEST_LINE) {
        Some((end, _)) => format!("{}…", &line[..end]),
        None => line.to_owned(),
    };
    message.lines().map(short).collect::<Vec<_>>().join("\n")
}

/// Characters of a line that messages show.
const LONGEST_LINE: usize = 300;

impl RawMethod {
    fn resolve(self, index: usize, line: usize, lines: &Lines<'_>) -> Result<MethodRow, StudyError> {
        if let Some(other) = self.variance.as_ref().filter(|variance| variance.as_str() != "known") {
            return Err(StudyError::Field {
                place: lines.place(Some(line)),
                field: format!("method[{index}].variance"),
                value: format!("`{other}`"),
                allowed: "`known`, or nothing for that of the samples".into(),
            });
        }
        let frames = match (self.adaptive, self.equal_time, self.variance) {
            (None, None, None) => RowFrames::Uniform,
            (Some(adaptive), None, None) => RowFrames::Adaptive(adaptive),
            (None, Some(with), None) => RowFrames::EqualTime { with },
            (None, None, Some(_)) => RowFrames::KnownVariance,
            _ => {
                return Err(StudyError::Field {
                    place: lines.place(Some(line)),
                    field: format!("method[{index}]"),
                    value: "several of `adaptive`, `equal_time` and `variance`".into(),
                    allowed: "one of them".into(),
                });
            }
        };
        let label = self.label.unwrap_or_else(|| self.id.clone());
        Ok(MethodRow { label, id: self.id, set: self.set, frames, line: Some(line) })
    }
}

impl RawScene {
    fn resolve(
        self,
        index: usize,
        line: usize,
        base: &Path,
        size: Option<(usize, usize)>,
        lines: &Lines<'_>,
    ) -> Result<SceneSpec, StudyError> {
        let place = || Place { line: Some(line), ..lines.place(None) };
        let wrong = |value: &str, allowed: &str| StudyError::Field {
            place: place(),
            field: format!("scene[{index}]"),
            value: value.into(),
            allowed: allowed.into(),
        };
        let rendered = self.synthetic.is_none() && self.folder.is_none();
        let source = match (self.synthetic, self.folder, self.file, self.scene) {
            (Some(spec), None, None, None) => {
                let scene =
                    spec.scene(size).map_err(|error| wrong("of no allowed size", &error.to_string()))?;
                SceneSource::Synthetic(scene)
            }
            (None, Some(folder), None, None) => SceneSource::Folder(base.join(folder)),
            (None, None, Some(file), None) => SceneSource::Gltf(base.join(file)),
            (None, None, None, name) => match noisefloor_scenes::find(name.as_ref().unwrap_or(&self.id)) {
                Ok(entry) => SceneSource::Builtin(entry.id.into()),
                Err(source) => return Err(StudyError::Scene { place: place(), source }),
            },
            _ => {
                let allowed = "one of `synthetic`, `folder`, `file` and `scene`, or none for the built-in scene of this id";
                return Err(wrong("of several kinds", allowed));
            }
        };
        let shot = Shot {
            frame: self.frame,
            orbit_degrees: self.orbit_degrees,
            integrator: self.integrator,
            photons: self.photons,
            maps: self.maps.unwrap_or_default(),
        };
        // A sequence of anything has an order.
        let moment = if self.sequence.is_some() { Shot { frame: 0, ..shot } } else { shot };
        if !rendered && moment != Shot::default() {
            let allowed = "no `frame` (but as the place in a `sequence`), `orbit_degrees`, `integrator`, `photons` or `maps`: they are for scenes that are rendered";
            return Err(wrong("not rendered", allowed));
        }
        if self.maps.is_some() && shot.photons().is_none() {
            let allowed = "`integrator = \"photon-mapping\"` or `photons`, for there to be maps";
            return Err(wrong("`maps` without photon maps", allowed));
        }
        let replicates = self.replicates.map(Into::into);
        Ok(SceneSpec {
            id: self.id,
            source,
            spp: self.spp,
            replicates,
            shot,
            set: self.set,
            equal_time_spp: self.equal_time_spp,
            sequence: self.sequence,
        })
    }
}
