//! The page: one HTML file with style, scripts, charts and pictures inside.

mod parts;
mod tables;

use std::collections::BTreeSet;

use minijinja::Environment;
use minijinja::syntax::SyntaxConfig;
use minijinja::value::{Serde, Value};
use noisefloor_study::exhibit::{Answer, Banner, Document};
use serde::Serialize;

use self::parts::{ChartView, Maker, Section};
use self::tables::TableView;
use crate::charts::{Charts, Formats};
use crate::error::ReportError;
use crate::images::Gallery;
use crate::plot::style::{self, Looks};
use crate::plot::svg::{escape, glyph_definitions};

const TEMPLATE: &str = include_str!("page/index.html");
const PARTS: &str = include_str!("page/parts.html");
const STYLE: &str = include_str!("page/style.css");
const PAGE_SCRIPT: &str = include_str!("page/page.js");
const DECODE_SCRIPT: &str = include_str!("page/decode.js");
const VIEWER_SCRIPT: &str = include_str!("page/viewer.js");

/// Id of the exhibit that the pictures follow.
const BEFORE_IMAGES: &str = "cost";

/// Fills the page of a document whose charts are drawn and whose images are chosen.
pub(crate) fn html(
    document: &Document,
    charts: &Charts,
    formats: Formats,
    gallery: &Gallery,
) -> Result<String, ReportError> {
    let mut environment = Environment::new();
    environment.set_syntax(SyntaxConfig::builder().trim_blocks(true).lstrip_blocks(true).build()?);
    environment.add_filter("words", words);
    // The names end in .html, which turns on escaping of every text.
    environment.add_template("index.html", TEMPLATE)?;
    environment.add_template("parts.html", PARTS)?;
    let mut glyphs = BTreeSet::new();
    let mut maker = Maker::new(document, charts, formats, &mut glyphs);
    let board = document.front.board.as_ref().map(|table| maker.table(table));
    let front = maker.charts(&document.front.charts)?;
    let sections = document.exhibits.iter().map(|e| maker.section(e)).collect::<Result<Vec<_>, _>>()?;
    let has_diagnostics = gallery.scenes.iter().flat_map(|s| &s.levels).any(|l| !l.diagnostics.is_empty());
    let contents = Contents {
        document: &Shown::of(document),
        cards: document.front.cards.iter().map(CardView::of).collect::<Result<_, _>>()?,
        front,
        board,
        images_after: images_after(document),
        sections,
        glyphs: glyph_definitions(&glyphs),
        swatches: Looks::of(&document.rows).swatches()?,
        manifest: script_json(&Manifest {
            gallery,
            labels: document.rows.iter().map(|row| row.label.as_str()).collect(),
            spp: document.chosen,
            metric: &document.metric,
        })?,
        images: gallery.images.iter().map(|i| i.text.as_str()).collect(),
        omitted: &gallery.omitted,
        diagnostics_spp: gallery.diagnostics_spp.filter(|_| has_diagnostics),
        unreadable: &gallery.unreadable,
        image_megabytes: noisefloor_study::format::significant(gallery.bytes() as f64 / 1e6, 2),
        css: format!("{STYLE}\n{}", style::css()),
        scripts: format!("{PAGE_SCRIPT}\n{DECODE_SCRIPT}\n{VIEWER_SCRIPT}"),
    };
    Ok(environment.get_template("index.html")?.render(Value::from(Serde(contents)))?)
}

/// Position of the section that the pictures follow.
fn images_after(document: &Document) -> usize {
    document.exhibits.iter().position(|e| e.id == BEFORE_IMAGES).unwrap_or(0)
}

/// Places where a long name may go on in the next line: behind brackets, hyphens and the like, never inside a word.
fn words(text: &str) -> Value {
    let mut out = String::new();
    for piece in text.split_inclusive(['-', '(', '_', '/', '=']) {
        if !out.is_empty() {
            out.push_str("<wbr>");
        }
        out.push_str(&escape(piece));
    }
    Value::from_safe_string(out)
}

/// What the template reads.
#[derive(Serialize)]
struct Contents<'a> {
    document: &'a Shown<'a>,
    cards: Vec<CardView<'a>>,
    front: Vec<ChartView>,
    board: Option<TableView<'a>>,
    images_after: usize,
    sections: Vec<Section<'a>>,
    glyphs: String,
    swatches: String,
    manifest: String,
    images: Vec<&'a str>,
    omitted: &'a [String],
    /// Level of the diagnostics, if there are any.
    diagnostics_spp: Option<u32>,
    unreadable: &'a [String],
    image_megabytes: String,
    css: String,
    scripts: String,
}

/// Texts of the document that stand in the page as they are.
#[derive(Serialize)]
struct Shown<'a> {
    study: &'a str,
    title: &'a str,
    question: &'a str,
    reproduces: Option<&'a str>,
    analysis: &'a [String],
    command: &'a str,
    environment: &'a [(String, String)],
    version: &'a str,
    date: &'a str,
    banners: &'a [Banner],
    answers: &'a [Answer],
}

impl<'a> Shown<'a> {
    fn of(document: &'a Document) -> Self {
        Self {
            study: &document.study,
            title: &document.title,
            question: &document.question,
            reproduces: document.reproduces.as_deref(),
            analysis: &document.analysis,
            command: &document.command,
            environment: &document.environment,
            version: &document.version,
            date: &document.date,
            banners: &document.banners,
            answers: &document.front.answers,
        }
    }
}

/// A scene's verdict and its pictures.
#[derive(Serialize)]
struct CardView<'a> {
    scene: &'a str,
    title: &'a str,
    sentences: &'a [String],
    shown: &'a [String],
    /// The same as JSON, for the page's script.
    shown_json: String,
}

impl<'a> CardView<'a> {
    fn of(card: &'a noisefloor_study::exhibit::Card) -> Result<Self, ReportError> {
        Ok(Self {
            scene: &card.scene,
            title: &card.title,
            sentences: &card.sentences,
            shown: &card.shown,
            shown_json: serde_json::to_string(&card.shown)?,
        })
    }
}

/// What the viewer's script reads.
#[derive(Debug, Serialize)]
struct Manifest<'a> {
    #[serde(flatten)]
    gallery: &'a Gallery,
    labels: Vec<&'a str>,
    spp: Option<u32>,
    metric: &'a str,
}

/// JSON that cannot end the script element that it stands in.
fn script_json(value: &impl Serialize) -> Result<String, ReportError> {
    let json = serde_json::to_string(value)?;
    Ok(json.replace('<', "\\u003c").replace('>', "\\u003e").replace('&', "\\u0026"))
}

#[cfg(test)]
mod tests {
    use super::words;

    #[test]
    fn names_break_behind_brackets_and_hyphens_and_are_escaped() {
        assert_eq!(
            words("guarded(virtual-flash)<b>").to_string(),
            "guarded(<wbr>virtual-<wbr>flash)&lt;b&gt;"
        );
        assert_eq!(words("mc").to_string(), "mc");
    }
}
