//! Whether two versions had the same inputs: pairs on unequal ones are none.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use noisefloor_study::RowFrames;
use noisefloor_study::record::{Outcome, Record};

use crate::gate::version::Version;

/// Levels and replicates.
type Cells = Vec<(u32, u32)>;

/// One way in which the inputs of two versions are not known to be the same.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mismatch {
    /// A scene of the old version that the new one does not have.
    NoScene(String),
    /// A row that the new version did not run on a scene.
    NoRow {
        /// Label of the row.
        label: String,
        /// Scene id.
        scene: String,
    },
    /// Levels and replicates of a row that the new version lacks.
    NoCells {
        /// Label of the row.
        label: String,
        /// Scene id.
        scene: String,
        /// Level and replicate of each.
        cells: Cells,
    },
    /// Levels and replicates of a row that the old version lacks, although it has the row, the scene and such cells.
    OldLacks {
        /// Label of the row.
        label: String,
        /// Scene id.
        scene: String,
        /// Level and replicate of each.
        cells: Cells,
    },
    /// The references of a scene differ, or nobody knows what they are.
    Reference(String),
    /// The measuring of a scene's cells differs, or nobody knows what it was.
    Measuring(String),
    /// Frames of a scene differ: level and replicate of each, with the first row whose frame it is.
    Frames {
        /// Label of the row.
        label: String,
        /// Scene id.
        scene: String,
        /// Level and replicate of each.
        cells: Cells,
        /// Whether they are known to differ; else nothing tells that they are the same.
        known: bool,
    },
}

impl fmt::Display for Mismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoScene(scene) => write!(f, "the new version has no scene `{scene}`"),
            Self::NoRow { label, scene } => write!(f, "the new version has no row `{label}` on `{scene}`"),
            Self::NoCells { label, scene, cells } => {
                write!(f, "the new version lacks cells of `{label}` on `{scene}`: {}", list(cells))
            }
            Self::OldLacks { label, scene, cells } => {
                write!(
                    f,
                    "the old version is not finished, it lacks cells of `{label}` on `{scene}`: {}",
                    list(cells)
                )
            }
            Self::Reference(scene) => {
                write!(f, "the references of `{scene}` differ, or are not known to be the same")
            }
            Self::Measuring(scene) => {
                write!(
                    f,
                    "errors on `{scene}` were not measured in the same way, or are not known to have been"
                )
            }
            Self::Frames { label, scene, cells, known: true } => {
                write!(f, "frames of `{label}` on `{scene}` differ: {}", list(cells))
            }
            Self::Frames { label, scene, cells, known: false } => write!(
                f,
                "nothing tells that the frames of `{label}` on `{scene}` are the same: {}",
                list(cells)
            ),
        }
    }
}

/// The first few as words.
fn list(cells: &[(u32, u32)]) -> String {
    let told = |(spp, replicate): &(u32, u32)| format!("{spp} spp, replicate {replicate}");
    match cells {
        [first, rest @ ..] if rest.len() >= 2 => format!("{} and {} more", told(first), rest.len()),
        few => few.iter().map(told).collect::<Vec<_>>().join("; "),
    }
}

/// A cell by what it is of.
type Place<'a> = (&'a str, u32, u32, &'a str);

fn place(record: &Record) -> Place<'_> {
    (&record.scene, record.spp, record.replicate, &record.label)
}

/// What differs between the inputs of all cells that ran in the old version, or is not known to be the same. What the new
/// version has in addition is none of its business.
pub(super) fn mismatches(old: Version<'_>, new: Version<'_>) -> Vec<Mismatch> {
    let mut out = BTreeSet::new();
    let of_new: BTreeMap<Place<'_>, &Record> = new.records.iter().map(|r| (place(r), r)).collect();
    let same_frames = SameFrames::of(old, new);
    let ran = |record: &&Record| record.outcome == Outcome::Done;
    let mut absent: BTreeMap<(&str, &str), Cells> = BTreeMap::new();
    let mut frames: BTreeMap<(&str, &str, bool), Cells> = BTreeMap::new();
    for record in old.records.iter().filter(ran) {
        let (scene, label) = (record.scene.as_str(), record.label.as_str());
        if !new.records.iter().any(|r| r.scene == scene) {
            out.insert(Mismatch::NoScene(scene.to_owned()));
            continue;
        }
        let cell = (record.spp, record.replicate);
        let Some(other) = of_new.get(&place(record)) else {
            absent.entry((label, scene)).or_default().push(cell);
            continue;
        };
        if record.measuring.is_empty() || record.measuring != other.measuring {
            out.insert(Mismatch::Measuring(scene.to_owned()));
        }
        let of_scene = |version: Version<'_>| version.context.scenes.iter().position(|s| s.id == scene);
        let key = |version: Version<'_>| {
            let place = of_scene(version)?;
            let key = version.context.scenes[place].reference.key.clone();
            (!key.is_empty()).then_some(key)
        };
        match (key(old), key(new)) {
            (Some(a), Some(b)) if a == b => {}
            _ => drop(out.insert(Mismatch::Reference(scene.to_owned()))),
        }
        match same_frames.ask(record, other) {
            Some(true) => {}
            told => frames.entry((label, scene, told.is_some())).or_default().push(cell),
        }
    }
    for ((label, scene), cells) in absent {
        let (label, scene) = (label.to_owned(), scene.to_owned());
        let any = new.records.iter().any(|r| r.scene == scene && r.label == label);
        out.insert(if any {
            Mismatch::NoCells { label, scene, cells }
        } else {
            Mismatch::NoRow { label, scene }
        });
    }
    out.extend(unfinished(old, new));
    out.extend(frames.into_iter().map(|((label, scene, known), cells)| Mismatch::Frames {
        label: label.to_owned(),
        scene: scene.to_owned(),
        cells,
        known,
    }));
    out.into_iter().collect()
}

/// Cells that the new version has and that belong to what the old one set out to do: of its rows and its scenes, at a level
/// and a replicate that it has somewhere. Without them it was stopped, or lost them, and what is left speaks for a part alone.
fn unfinished(old: Version<'_>, new: Version<'_>) -> Vec<Mismatch> {
    let of_old: BTreeSet<Place<'_>> = old.records.iter().map(place).collect();
    let rows: BTreeSet<&str> = old.context.methods.iter().map(|row| row.summary.label.as_str()).collect();
    let scenes: BTreeSet<&str> = old.context.scenes.iter().map(|scene| scene.id.as_str()).collect();
    let levels: BTreeSet<u32> = old.records.iter().map(|r| r.spp).collect();
    let replicates: BTreeSet<u32> = old.records.iter().map(|r| r.replicate).collect();
    let mut missing: BTreeMap<(&str, &str), Cells> = BTreeMap::new();
    for record in new.records.iter().filter(|record| record.outcome == Outcome::Done) {
        let (scene, label, cell) =
            (record.scene.as_str(), record.label.as_str(), (record.spp, record.replicate));
        let its_own = rows.contains(label)
            && scenes.contains(scene)
            && levels.contains(&record.spp)
            && replicates.contains(&record.replicate);
        if its_own && !of_old.contains(&place(record)) {
            missing.entry((label, scene)).or_default().push(cell);
        }
    }
    let lacks = |((label, scene), cells): ((&str, &str), Cells)| Mismatch::OldLacks {
        label: label.to_owned(),
        scene: scene.to_owned(),
        cells,
    };
    missing.into_iter().map(lacks).collect()
}

/// What tells that two frames are the same: their keys, or for records of earlier programs, which do not have them, the
/// numbers of plain Monte Carlo. Its output is the frame, so that equal frames have equal numbers to the bit, and
/// unequal ones do not by chance.
struct SameFrames<'a> {
    plain: [BTreeMap<(&'a str, u32, u32), &'a Record>; 2],
}

impl<'a> SameFrames<'a> {
    fn of(old: Version<'a>, new: Version<'a>) -> Self {
        Self { plain: [plain(old), plain(new)] }
    }

    /// `None` if nothing tells.
    fn ask(&self, old: &Record, new: &Record) -> Option<bool> {
        if !old.frames.is_empty() && !new.frames.is_empty() {
            return Some(old.frames == new.frames);
        }
        // A row with frames of its own is not the same input as plain Monte Carlo's.
        let own = |record: &Record| record.adaptive.is_some() || record.frame_spp.is_some();
        if own(old) || own(new) {
            return None;
        }
        let at = |k: usize, r: &Record| self.plain[k].get(&(r.scene.as_str(), r.spp, r.replicate)).copied();
        let (a, b) = (at(0, old)?, at(1, new)?);
        (a.outcome == Outcome::Done && b.outcome == Outcome::Done).then(|| bits(a) == bits(b))
    }
}

/// The records of plain Monte Carlo on the study's own frames.
fn plain<'a>(version: Version<'a>) -> BTreeMap<(&'a str, u32, u32), &'a Record> {
    let rows = version.context.methods.iter().map(|row| &row.summary);
    let baseline = rows
        .filter(|row| row.method == noisefloor_study::BASELINE && row.frames == RowFrames::Uniform)
        .map(|row| row.label.as_str())
        .next();
    let of_row = version.records.iter().filter(|record| Some(record.label.as_str()) == baseline);
    of_row.map(|r| ((r.scene.as_str(), r.spp, r.replicate), r)).collect()
}

fn bits(record: &Record) -> Vec<(&String, Option<u64>)> {
    record.metrics.iter().map(|(id, value)| (id, value.map(f64::to_bits))).collect()
}
