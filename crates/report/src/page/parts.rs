//! Sections as the template reads them: parts in a row, where what contains others has a beginning and an end.

use std::collections::{BTreeMap, BTreeSet};

use noisefloor_study::exhibit::{Chart, Document, Exhibit, Part, Table};
use serde::Serialize;

use super::tables::TableView;
use crate::charts::{Charts, Formats};
use crate::error::ReportError;
use crate::names::table_names;
use crate::plot::svg::GlyphKey;

/// A section.
#[derive(Serialize)]
pub(super) struct Section<'a> {
    id: &'a str,
    name: &'a str,
    title: &'a str,
    steps: Vec<Step<'a>>,
}

/// A part, or the beginning or end of one that has others inside.
#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
enum Step<'a> {
    Heading {
        text: &'a str,
    },
    Note {
        text: &'a str,
    },
    List {
        items: &'a [String],
    },
    Table {
        table: TableView<'a>,
    },
    Charts {
        charts: Vec<ChartView>,
    },
    Facts {
        facts: &'a [(String, String)],
    },
    /// `group` names the switch: a page may have several, which move together.
    LevelSwitch {
        group: usize,
        levels: Vec<(u32, bool)>,
    },
    Level {
        spp: u32,
        hidden: bool,
    },
    Folded {
        title: &'a str,
        row: Option<usize>,
        aside: &'a str,
    },
    EndLevel,
    EndFolded,
}

/// A chart inside the page.
#[derive(Serialize)]
pub(super) struct ChartView {
    title: String,
    panels: Vec<String>,
    legend: String,
    /// Name of its files in `plots/`, without extension.
    name: String,
    /// What files there are.
    endings: Vec<&'static str>,
}

/// Makes views of a document's parts.
pub(super) struct Maker<'a, 'b> {
    document: &'a Document,
    charts: &'b Charts,
    formats: Formats,
    glyphs: &'b mut BTreeSet<GlyphKey>,
    /// File names by the table's place in memory: ids may come twice.
    names: BTreeMap<*const Table, String>,
    switches: usize,
}

impl<'a, 'b> Maker<'a, 'b> {
    pub(super) fn new(
        document: &'a Document,
        charts: &'b Charts,
        formats: Formats,
        glyphs: &'b mut BTreeSet<GlyphKey>,
    ) -> Self {
        let tables = document.tables().into_iter().map(std::ptr::from_ref);
        let names = tables.zip(table_names(document)).collect();
        Self { document, charts, formats, glyphs, names, switches: 0 }
    }

    pub(super) fn section(&mut self, exhibit: &'a Exhibit) -> Result<Section<'a>, ReportError> {
        let mut steps = Vec::new();
        self.add(&exhibit.parts, &mut steps)?;
        Ok(Section { id: &exhibit.id, name: &exhibit.name, title: &exhibit.title, steps })
    }

    pub(super) fn table(&self, table: &'a Table) -> TableView<'a> {
        let name = self.names.get(&std::ptr::from_ref(table)).cloned();
        TableView::of(table, name.unwrap_or_else(|| table.id.clone()))
    }

    pub(super) fn charts(&mut self, charts: &[Chart]) -> Result<Vec<ChartView>, ReportError> {
        let mut views = Vec::new();
        for named in charts.iter().filter_map(|chart| self.charts.get(&chart.id)) {
            let inline = named.inline(self.glyphs)?;
            let all = [(true, "svg"), (self.formats.png, "png"), (self.formats.pdf, "pdf")];
            views.push(ChartView {
                title: inline.title,
                panels: inline.panels,
                legend: inline.legend,
                name: named.name.clone(),
                endings: all.iter().filter(|(is, _)| *is).map(|(_, ending)| *ending).collect(),
            });
        }
        Ok(views)
    }

    fn add(&mut self, parts: &'a [Part], steps: &mut Vec<Step<'a>>) -> Result<(), ReportError> {
        for part in parts {
            let step = match part {
                Part::Heading(text) => Step::Heading { text },
                Part::Note(text) => Step::Note { text },
                Part::List(items) => Step::List { items },
                Part::Table(table) => Step::Table { table: self.table(table) },
                Part::Charts(charts) => Step::Charts { charts: self.charts(charts)? },
                Part::Facts(facts) => Step::Facts { facts },
                Part::LevelSwitch => {
                    self.switches += 1;
                    let chosen = |n: &u32| (*n, Some(*n) == self.document.chosen);
                    let levels = self.document.levels.iter().map(chosen).collect();
                    Step::LevelSwitch { group: self.switches, levels }
                }
                Part::Level { spp, parts } => {
                    let hidden = self.document.chosen.is_some_and(|chosen| chosen != *spp);
                    steps.push(Step::Level { spp: *spp, hidden });
                    self.add(parts, steps)?;
                    Step::EndLevel
                }
                Part::Folded { title, row, aside, parts } => {
                    steps.push(Step::Folded { title, row: *row, aside });
                    self.add(parts, steps)?;
                    Step::EndFolded
                }
            };
            steps.push(step);
        }
        Ok(())
    }
}
