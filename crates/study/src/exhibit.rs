//! What a reader sees of a study: sentences, tables and charts as plain data.
//!
//! Who makes exhibits knows what the numbers mean; who shows them knows tables and charts, and no question. Every table
//! and every chart has an id that is unique in its document: it is the name of the files that they are exported to.

mod chart;
mod table;

use serde::Serialize;

pub use chart::{Axis, Chart, Form, Guide, Look, Panel, Point, Scale, Series, Shape};
pub use table::{Column, Forest, Number, RowState, Table, TableCell, TableRow, Tag, Tone};

/// Everything that a page shows of a study.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Document {
    /// Name of the study, such as `vfi-fig09`.
    pub study: String,
    /// Title for people.
    pub title: String,
    /// What it asks.
    pub question: String,
    /// Figure or table that it reproduces.
    pub reproduces: Option<String>,
    /// What the source work reports and what we see; paragraphs.
    pub analysis: Vec<String>,
    /// Command that made it.
    pub command: String,
    /// Program, machine and load: name and value.
    pub environment: Vec<(String, String)>,
    /// Version of the program.
    pub version: String,
    /// Date of the analysis.
    pub date: String,
    /// What a reader must know before everything else.
    pub banners: Vec<Banner>,
    /// Levels that tables can show, in samples per pixel.
    pub levels: Vec<u32>,
    /// The level that a reader sees first.
    pub chosen: Option<u32>,
    /// The rows of the study, which keep their colour everywhere; charts and cells name them by their place here.
    pub rows: Vec<RowLook>,
    /// The first screen.
    pub front: Front,
    /// Sections in order.
    pub exhibits: Vec<Exhibit>,
    /// Which images the page can show.
    pub gallery: Vec<GalleryScene>,
    /// The metric whose values stand beside images.
    pub metric: String,
}

impl Document {
    /// All tables in the order of the page, those of the first screen before the others.
    #[must_use]
    pub fn tables(&self) -> Vec<&Table> {
        let mut out: Vec<&Table> = self.front.board.iter().collect();
        self.exhibits.iter().for_each(|exhibit| {
            visit(&exhibit.parts, &mut |part| {
                if let Part::Table(table) = part {
                    out.push(table);
                }
            })
        });
        out
    }

    /// All charts in the order of the page, each once.
    #[must_use]
    pub fn charts(&self) -> Vec<&Chart> {
        let mut out: Vec<&Chart> = Vec::new();
        for exhibit in &self.exhibits {
            visit(&exhibit.parts, &mut |part| {
                if let Part::Charts(charts) = part {
                    out.extend(charts);
                }
            });
        }
        // The first screen shows charts that may stand in a section as well.
        for chart in &self.front.charts {
            if !out.iter().any(|known| known.id == chart.id) {
                out.push(chart);
            }
        }
        out
    }
}

/// Walks parts and what is folded into them, in order.
fn visit<'a>(parts: &'a [Part], look: &mut dyn FnMut(&'a Part)) {
    for part in parts {
        look(part);
        if let Part::Folded { parts, .. } | Part::Level { parts, .. } = part {
            visit(parts, look);
        }
    }
}

/// A box above the page.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Banner {
    /// Heading.
    pub title: String,
    /// A sentence under it; may be empty.
    pub lead: String,
    /// The statements.
    pub lines: Vec<String>,
    /// How serious it is: [`Tone::Bad`] for what is unfinished, [`Tone::Plain`] otherwise.
    pub tone: Tone,
    /// How many of the lines, from the first, stand out.
    pub strong: usize,
}

/// How a row of the study looks in every chart and table.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RowLook {
    /// Its label.
    pub label: String,
    /// What kind of row it is.
    pub kind: RowKind,
}

/// Kinds of rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum RowKind {
    /// The unfiltered input on the study's own frames: drawn in ink.
    Baseline,
    /// A row with a colour of its own.
    Plain,
    /// The guarded form of the row at this place: its colour, dashed, open marks.
    Guarded(usize),
    /// The method of the row at this place, on frames of its own: its colour, dotted, open marks.
    OtherFrames(usize),
}

/// The first screen: a person should see the answer in ten seconds.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Front {
    /// Questions with their answers.
    pub answers: Vec<Answer>,
    /// Charts beside the answers.
    pub charts: Vec<Chart>,
    /// The best row of every scene and level.
    pub board: Option<Table>,
    /// One per scene.
    pub cards: Vec<Card>,
}

/// A question with its answer in a sentence or a few.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Answer {
    /// The question.
    pub question: String,
    /// The answer.
    pub sentences: Vec<String>,
    /// [`Tone::Good`] for what was tested and held, [`Tone::Bad`] for what did not, else plain.
    pub tone: Tone,
}

/// A scene's verdict, beside its pictures.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Card {
    /// Scene id.
    pub scene: String,
    /// Scene title.
    pub title: String,
    /// The verdict.
    pub sentences: Vec<String>,
    /// Labels of rows whose images stand beside the reference.
    pub shown: Vec<String>,
}

/// One section.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Exhibit {
    /// Id of the question that it answers; anchor in the page.
    pub id: String,
    /// Short name for the table of contents.
    pub name: String,
    /// Heading.
    pub title: String,
    /// What stands below the heading.
    pub parts: Vec<Part>,
}

/// A piece of a section.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Part {
    /// A heading inside the section.
    Heading(String),
    /// An explanation, in small type.
    Note(String),
    /// A list of sentences.
    List(Vec<String>),
    /// A table.
    Table(Table),
    /// Charts side by side.
    Charts(Vec<Chart>),
    /// Named values.
    Facts(Vec<(String, String)>),
    /// The switch that chooses which [`Part::Level`] is shown.
    LevelSwitch,
    /// Shown while this level is chosen.
    Level {
        /// Samples per pixel.
        spp: u32,
        /// What is shown.
        parts: Vec<Part>,
    },
    /// Behind a line that opens it.
    Folded {
        /// The line.
        title: String,
        /// The row that it is about, whose look stands before the line.
        row: Option<usize>,
        /// Beside the line, in small type; may be empty.
        aside: String,
        /// What is behind it.
        parts: Vec<Part>,
    },
}

impl Part {
    /// Something behind a line.
    #[must_use]
    pub fn folded(title: impl Into<String>, parts: Vec<Self>) -> Self {
        Self::Folded { title: title.into(), row: None, aside: String::new(), parts }
    }
}

/// The images of one scene.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct GalleryScene {
    /// Scene id.
    pub id: String,
    /// Scene title.
    pub title: String,
    /// Image of the reference, relative to the study's folder; empty if there is none.
    pub reference: String,
    /// Levels with images, ascending.
    pub levels: Vec<GalleryLevel>,
}

/// The images of one scene at one level.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct GalleryLevel {
    /// Samples per pixel.
    pub spp: u32,
    /// One per row that has an image here, in the study's order.
    pub rows: Vec<GalleryRow>,
}

/// The images of one row.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct GalleryRow {
    /// Row label.
    pub label: String,
    /// Its image, relative to the study's folder; empty if there is none.
    pub image: String,
    /// The metric's value as text; empty if there is none.
    pub value: String,
    /// Diagnostic images: name and path.
    pub diagnostics: Vec<(String, String)>,
}
