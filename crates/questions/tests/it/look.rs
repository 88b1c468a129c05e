//! Ways to look at a document.

use noisefloor_questions::document;
use noisefloor_study::exhibit::{Answer, Chart, Document, Exhibit, Part, Table, TableRow};
use noisefloor_study::summary::Summary;

pub fn answer(summary: &Summary, question: &str) -> Answer {
    let found = document(summary).front.answers.into_iter().find(|a| a.question.contains(question));
    found.unwrap_or_else(|| panic!("{question:?} is asked"))
}

/// All sentences of an answer.
pub fn told(summary: &Summary, question: &str) -> String {
    answer(summary, question).sentences.join(" ")
}

pub fn table(document: &Document, id: &str) -> Table {
    let ids: Vec<&str> = document.tables().iter().map(|t| t.id.as_str()).collect();
    let found = document.tables().into_iter().find(|t| t.id == id).cloned();
    found.unwrap_or_else(|| panic!("{id} is one of {ids:?}"))
}

pub fn chart(document: &Document, id: &str) -> Chart {
    let ids: Vec<&str> = document.charts().iter().map(|c| c.id.as_str()).collect();
    let found = document.charts().into_iter().find(|c| c.id == id).cloned();
    found.unwrap_or_else(|| panic!("{id} is one of {ids:?}"))
}

pub fn exhibit<'a>(document: &'a Document, id: &str) -> Option<&'a Exhibit> {
    document.exhibits.iter().find(|exhibit| exhibit.id == id)
}

/// The row of a table whose first cell says this.
pub fn row<'a>(table: &'a Table, first: &str) -> &'a TableRow {
    let found = table.rows.iter().find(|row| row.cells[0].text == first);
    found.unwrap_or_else(|| panic!("{first} is a row of {}", table.id))
}

/// The words behind the names of a table's rows.
pub fn tags(table: &Table) -> Vec<&str> {
    table.rows.iter().map(|row| row.cells[0].tag.as_ref().map_or("", |tag| tag.word.as_str())).collect()
}

/// Everything that stands in a document, one text per line.
pub fn texts(document: &Document) -> String {
    let mut out = Vec::new();
    for banner in &document.banners {
        out.extend([banner.title.clone(), banner.lead.clone()]);
        out.extend(banner.lines.clone());
    }
    for answer in &document.front.answers {
        out.push(answer.question.clone());
        out.extend(answer.sentences.clone());
    }
    for card in &document.front.cards {
        out.push(card.sentences.join(" "));
    }
    out.extend(document.front.board.iter().map(of_table));
    out.extend(document.front.charts.iter().map(of_chart));
    for exhibit in &document.exhibits {
        out.push(exhibit.title.clone());
        of_parts(&exhibit.parts, &mut out);
    }
    out.join("\n")
}

fn of_parts(parts: &[Part], out: &mut Vec<String>) {
    for part in parts {
        match part {
            Part::Heading(text) | Part::Note(text) => out.push(text.clone()),
            Part::List(lines) => out.extend(lines.clone()),
            Part::Table(table) => out.push(of_table(table)),
            Part::Charts(charts) => out.extend(charts.iter().map(of_chart)),
            Part::Facts(facts) => out.extend(facts.iter().map(|(name, value)| format!("{name}: {value}"))),
            Part::LevelSwitch => {}
            Part::Level { parts, .. } => of_parts(parts, out),
            Part::Folded { title, aside, parts, .. } => {
                out.push(format!("{title} {aside}"));
                of_parts(parts, out);
            }
        }
    }
}

fn of_table(table: &Table) -> String {
    let mut out = vec![table.caption.clone()];
    out.extend(table.columns.iter().map(|column| column.head.clone()));
    for cell in table.rows.iter().flat_map(|row| &row.cells) {
        let tag = cell.tag.as_ref().map_or("", |tag| tag.word.as_str());
        out.push(format!("{} {} {tag} {}", cell.text, cell.aside, cell.about));
    }
    out.extend(table.notes.clone());
    out.join("\n")
}

fn of_chart(chart: &Chart) -> String {
    let series = chart.panels.iter().flat_map(|panel| &panel.series);
    let points = series.flat_map(|series| series.points.iter().map(|point| point.about.clone()));
    std::iter::once(chart.title.clone()).chain(points).collect::<Vec<_>>().join("\n")
}
