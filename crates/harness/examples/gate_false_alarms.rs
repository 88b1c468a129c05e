//! How often `noisefloor gate` raises an alarm although nothing changed, and how often it finds a change that was planted,
//! over the whole of it: folders are written, read, compared.
//!
//! `gate_false_alarms RECORDING [PAIRS]` (1000 unless said; a fifth of them for other laws than the normal and for planted changes) takes a recorded study as the old version. The new one has its errors times
//! exp(σ·z), z half common to the cells of a row and a replicate and half a cell's own, of mean 0 and variance 1; then old
//! and new change places in each replicate with probability one half, so that no version is better whatever the law of z.
//! Rows of plain Monte Carlo stay as they are.

use std::io::Write as _;
use std::path::{Path, PathBuf};

use flate2::Compression;
use flate2::read::MultiGzDecoder;
use flate2::write::GzEncoder;
use noisefloor_harness::gate;
use noisefloor_questions::{GateOutcome, Overall};
use noisefloor_stats::random::Normals;
use noisefloor_stats::{Answer, Level, Terms};
use rayon::prelude::*;
use serde_json::Value;

type Failure = Box<dyn std::error::Error>;

const METRIC: &str = "relmse";

/// Most of a record, which no gate looks at; without it a pair takes a tenth of the time.
const UNUSED: [&str; 13] = [
    "answers",
    "bounds",
    "class_reference",
    "classes",
    "coverage",
    "diagnostics",
    "enclosures",
    "error_estimate",
    "figures",
    "files",
    "findings",
    "metrics_within_se",
    "ratio_within_se",
];

/// Laws of the noise, each of mean 0 and variance 1.
#[derive(Debug, Clone, Copy)]
enum Law {
    Normal,
    /// Student's t with 5 degrees of freedom.
    HeavyTailed,
    /// Exponential, its mean taken out.
    Skewed,
}

impl Law {
    fn draw(self, normals: &mut Normals) -> f64 {
        match self {
            Self::Normal => normals.next(),
            Self::HeavyTailed => {
                let chi: f64 = (0..5).map(|_| normals.next().powi(2)).sum();
                // Variance 5/3; a sum of squares of five normal numbers is not zero.
                normals.next() / (chi / 5.0).sqrt() / (5.0f64 / 3.0).sqrt()
            }
            Self::Skewed => -normals.uniform().ln() - 1.0,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Normal => "normal",
            Self::HeavyTailed => "Student's t, 5 degrees",
            Self::Skewed => "exponential",
        }
    }
}

/// One kind of pair.
#[derive(Debug, Clone, Copy)]
struct Kind<'a> {
    law: Law,
    spread: f64,
    /// A row and the factor on its errors.
    planted: Option<(&'a str, f64)>,
    margin: f64,
}

/// A recorded study of which pairs are made.
struct Recording {
    dir: PathBuf,
    records: Vec<Value>,
    labels: Vec<String>,
}

impl Recording {
    fn read(dir: &Path) -> Result<Self, Failure> {
        let file = std::fs::File::open(dir.join("results.jsonl.gz"))?;
        let text = std::io::read_to_string(MultiGzDecoder::new(file))?;
        let mut records: Vec<Value> = text.lines().map(serde_json::from_str).collect::<Result<_, _>>()?;
        for record in records.iter_mut().filter_map(Value::as_object_mut) {
            record.retain(|name, _| !UNUSED.contains(&name.as_str()));
            record.insert("params".into(), Value::Null);
            for name in ["metrics", "metrics_reference_se", "reference"] {
                if let Some(by_metric) = record.get_mut(name).and_then(Value::as_object_mut) {
                    by_metric.retain(|id, _| id == METRIC);
                }
            }
        }
        let mut labels: Vec<String> = Vec::new();
        for record in records.iter().filter(|record| record["method"] != "mc") {
            let label = record["label"].as_str().unwrap_or_default().to_owned();
            if !labels.contains(&label) {
                labels.push(label);
            }
        }
        Ok(Self { dir: dir.to_owned(), records, labels })
    }

    fn replicates(&self) -> usize {
        let number = |record: &Value| record["replicate"].as_u64().unwrap_or(0) as usize;
        self.records.iter().map(number).max().map_or(0, |last| last + 1)
    }

    /// Many pairs of a kind.
    fn rates(&self, kind: Kind<'_>, pairs: u32, seed: u64) -> Result<Rates, Failure> {
        let scratch = tempfile::tempdir()?;
        let (mut normals, mut rates) = (Normals::new(seed), Rates::default());
        for _ in 0..pairs {
            let found = self.pair(kind, &mut normals, scratch.path())?;
            rates.add(&found, kind.planted.map(|(label, _)| label));
        }
        Ok(rates)
    }

    /// Writes an old and a new version and compares them.
    fn pair(&self, kind: Kind<'_>, normals: &mut Normals, folder: &Path) -> Result<GateOutcome, Failure> {
        let replicates = self.replicates();
        let swap: Vec<bool> = (0..replicates).map(|_| normals.uniform() < 0.5).collect();
        let common: Vec<f64> = (0..self.labels.len() * replicates).map(|_| kind.law.draw(normals)).collect();
        let mut versions = [self.records.clone(), self.records.clone()];
        for (place, record) in self.records.iter().enumerate() {
            let row = self.labels.iter().position(|label| record["label"] == **label);
            let (Some(row), Some(error)) = (row, record["metrics"][METRIC].as_f64()) else { continue };
            let replicate = record["replicate"].as_u64().unwrap_or(0) as usize;
            let own = kind.law.draw(normals);
            let noise = kind.spread * (common[row * replicates + replicate] + own) / 2f64.sqrt();
            let mut pair = [error, error * noise.exp()];
            if swap[replicate] {
                pair.reverse();
            }
            if let Some((_, factor)) = kind.planted.filter(|(label, _)| *label == self.labels[row]) {
                pair[1] *= factor;
            }
            for (version, value) in versions.iter_mut().zip(pair) {
                version[place]["metrics"][METRIC] = value.into();
            }
        }
        let terms = Terms { level: Level::TWO_SIDED_95, margin: kind.margin };
        let folders = [folder.join("old"), folder.join("new")];
        for (folder, records) in folders.iter().zip(&versions) {
            self.write(folder, records)?;
        }
        Ok(gate(&folders[0], &folders[1], Some(METRIC), terms)?)
    }

    fn write(&self, folder: &Path, records: &[Value]) -> Result<(), Failure> {
        std::fs::create_dir_all(folder)?;
        for name in ["study.json", "context.json"] {
            std::fs::copy(self.dir.join(name), folder.join(name))?;
        }
        let file = std::fs::File::create(folder.join("results.jsonl.gz"))?;
        let mut packed = GzEncoder::new(file, Compression::fast());
        for record in records {
            writeln!(packed, "{record}")?;
        }
        packed.finish()?;
        Ok(())
    }
}

/// Shares of pairs.
#[derive(Debug, Default)]
struct Rates {
    /// With a "better" or "worse" about a row that did not change, or about its cells.
    alarms: u32,
    /// In which the changed row is worse.
    row: u32,
    /// In which one of its cells is worse.
    cell: u32,
    /// In which the gate says worse.
    worse: u32,
    pairs: u32,
}

impl Rates {
    fn add(&mut self, found: &GateOutcome, changed: Option<&str>) {
        let told = |answer: Answer| matches!(answer, Answer::Better | Answer::Worse);
        let unchanged = |label: &str| Some(label) != changed;
        let rows = || found.rows.iter().filter(|row| unchanged(&row.label)).map(|row| row.judged.answer);
        let cells =
            || found.cells.iter().filter(|cell| unchanged(&cell.label)).map(|cell| cell.judged.answer);
        self.alarms += u32::from(rows().chain(cells()).any(told));
        let row = found.rows.iter().find(|row| !unchanged(&row.label));
        self.row += u32::from(row.is_some_and(|row| row.judged.answer == Answer::Worse));
        self.cell += u32::from(row.is_some_and(|row| row.worse > 0));
        self.worse += u32::from(found.overall == Overall::Worse);
        self.pairs += 1;
    }

    fn percent(&self, count: u32) -> String {
        format!("{:.1}", 100.0 * f64::from(count) / f64::from(self.pairs.max(1)))
    }
}

fn main() -> Result<(), Failure> {
    let mut args = std::env::args().skip(1);
    let dir = args.next().ok_or("gate_false_alarms RECORDING [PAIRS]")?;
    let pairs: u32 = args.next().map_or(Ok(1000), |text| text.parse())?;
    let recording = Recording::read(Path::new(&dir))?;
    let fewer = pairs.div_ceil(5);
    let label = recording.labels[0].as_str(); // a recording of a study has a method
    let unchanged = [
        (Law::Normal, 0.001, pairs),
        (Law::Normal, 0.01, pairs),
        (Law::Normal, 0.1, pairs),
        (Law::HeavyTailed, 0.01, fewer),
        (Law::Skewed, 0.01, fewer),
    ];
    let planted =
        [0.01, 0.03].into_iter().flat_map(|spread| [1.02, 1.05, 1.1].map(|factor| (spread, factor)));
    let kinds: Vec<(Kind<'_>, u32)> = unchanged
        .into_iter()
        .map(|(law, spread, pairs)| (Kind { law, spread, planted: None, margin: 0.0 }, pairs))
        .chain(planted.map(|(spread, factor)| {
            (Kind { law: Law::Normal, spread, planted: Some((label, factor)), margin: 0.01 }, fewer)
        }))
        .collect();
    let rates: Vec<Rates> = kinds
        .par_iter()
        .enumerate()
        .map(|(seed, (kind, pairs))| recording.rates(*kind, *pairs, seed as u64).map_err(|e| e.to_string()))
        .collect::<Result<_, String>>()?;

    let mut out = std::io::stdout().lock();
    let exact = Terms { level: Level::TWO_SIDED_95, margin: 0.0 };
    let same = gate(Path::new(&dir), Path::new(&dir), Some(METRIC), exact)?;
    writeln!(out, "The recording against itself: {:?}, {} cells.\n", same.overall, same.cells.len())?;
    writeln!(
        out,
        "| noise | σ | pairs | false alarms, % | MCSE at 5 % |\n| --- | ---: | ---: | ---: | ---: |"
    )?;
    let both = || kinds.iter().map(|(kind, ..)| kind).zip(&rates);
    for (Kind { law, spread, .. }, found) in both().filter(|(kind, _)| kind.planted.is_none()) {
        let mcse = 100.0 * (0.05 * 0.95 / f64::from(found.pairs.max(1))).sqrt();
        let alarms = found.percent(found.alarms);
        writeln!(out, "| {} | {spread} | {} | {alarms} | {mcse:.1} |", law.name(), found.pairs)?;
    }
    writeln!(out, "\n`{label}` made worse, margin 1 %, normal noise; % of {fewer} pairs:\n")?;
    writeln!(
        out,
        "| σ | change | row worse | a cell of it worse | gate says worse | false alarms elsewhere |\n\
         | ---: | ---: | ---: | ---: | ---: | ---: |"
    )?;
    for (Kind { spread, planted, .. }, found) in both() {
        let Some((_, factor)) = planted else { continue };
        writeln!(
            out,
            "| {spread} | {:.0} % | {} | {} | {} | {} |",
            100.0 * (factor - 1.0),
            found.percent(found.row),
            found.percent(found.cell),
            found.percent(found.worse),
            found.percent(found.alarms)
        )?;
    }
    Ok(())
}
