//! Pipe tables for READMEs.

use noisefloor_study::exhibit::{Table, TableCell};

use super::text::{one_line, shown};

/// A table as Markdown: the first column to the left, the others to the right; rows of the study as code. Caption and
/// notes are not in it.
#[must_use]
pub fn markdown(table: &Table) -> String {
    let cells = shown(table);
    let width = cells.iter().map(Vec::len).max().unwrap_or(0).max(table.columns.len());
    if width == 0 {
        return String::new();
    }
    let heads = (0..width).map(|at| table.columns.get(at).map_or_else(String::new, |c| one_line(&c.head)));
    let mut out = line(heads.map(|head| escaped(&head)));
    out += &format!("| --- |{}\n", " ---: |".repeat(width - 1));
    for (row, texts) in table.rows.iter().zip(&cells) {
        let cell = |at: usize| match (row.cells.get(at), texts.get(at)) {
            (Some(cell), Some(text)) if cell.row.is_some() => coded(cell, text),
            (_, Some(text)) => escaped(text),
            _ => String::new(),
        };
        out += &line((0..width).map(cell));
    }
    out
}

/// A file of its own: caption, table, notes.
pub(super) fn file(table: &Table) -> String {
    let paragraph = |text: &String| format!("{}\n", escaped(&one_line(text)));
    let caption = Some(&table.caption).filter(|c| !c.trim().is_empty()).map(paragraph);
    let notes = table.notes.iter().filter(|n| !n.trim().is_empty()).map(paragraph);
    let parts = caption.into_iter().chain(std::iter::once(markdown(table))).chain(notes);
    parts.collect::<Vec<_>>().join("\n")
}

fn line(cells: impl Iterator<Item = String>) -> String {
    format!("| {} |\n", cells.collect::<Vec<_>>().join(" | "))
}

/// The label of a row as code, and what follows it as text.
fn coded(cell: &TableCell, text: &str) -> String {
    let label = one_line(&cell.text);
    let rest = text.strip_prefix(label.as_str()).unwrap_or_default();
    let fence = if label.contains('`') { "``" } else { "`" };
    // Even in code a bar ends a cell.
    let label = label.replace('|', "\\|");
    let code = if label.is_empty() { String::new() } else { format!("{fence}{label}{fence}") };
    code + &escaped(rest)
}

/// Text that is neither the end of a cell, nor a mark of emphasis, nor HTML.
fn escaped(text: &str) -> String {
    let text = text.replace('|', "\\|").replace(" *", " \\*");
    let mut out = String::with_capacity(text.len());
    let mut rest = text.chars().peekable();
    while let Some(c) = rest.next() {
        let opens = c == '<' && rest.peek().is_some_and(|n| n.is_ascii_alphabetic() || "/!?".contains(*n));
        if opens { out.push_str("&lt;") } else { out.push(c) }
    }
    out
}

#[cfg(test)]
mod tests {
    use noisefloor_study::exhibit::{Column, TableRow, Tone};

    use super::*;

    fn table() -> Table {
        Table {
            id: "t".into(),
            caption: "What\nthis is".into(),
            columns: vec![Column::text("Row"), Column::number("a|b"), Column::text("Why")],
            rows: vec![
                TableRow::new(vec![
                    TableCell::row("x|y", 0).aside("(guarded)"),
                    TableCell::text("0.1").aside("± 0.01").tag("best", Tone::Good, ""),
                    TableCell::text("<script>\nand < 3 *"),
                ]),
                TableRow::new(vec![TableCell::text("short")]),
            ],
            notes: vec!["* a note".into()],
        }
    }

    #[test]
    fn a_pipe_table_keeps_bars_stars_and_markup_harmless() {
        let expected = "| Row | a\\|b | Why |\n\
                        | --- | ---: | ---: |\n\
                        | `x\\|y` (guarded) | 0.1 ± 0.01 best | &lt;script> and < 3 \\* |\n\
                        | short |  |  |\n";
        assert_eq!(markdown(&table()), expected);
    }

    #[test]
    fn a_file_has_caption_and_notes_around_the_table() {
        let made = file(&table());
        assert!(made.starts_with("What this is\n\n| Row |") && made.ends_with("|\n\n* a note\n"), "{made}");
        assert_eq!(file(&Table::default()), "");
    }
}
