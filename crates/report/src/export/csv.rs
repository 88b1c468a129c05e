//! Comma-separated values for programs: numbers unrounded, texts whole.

use noisefloor_study::exhibit::{Number, Table, TableCell};

use super::text::{one_line, says_nothing};

/// A table by RFC 4180: a head, lines that end in CR LF, quotes where they are needed.
pub(super) fn csv(table: &Table) -> String {
    let width = table.rows.iter().map(|row| row.cells.len()).max().unwrap_or(0).max(table.columns.len());
    let mut columns: Vec<(String, Vec<String>)> = Vec::new();
    for at in 0..width {
        let cells: Vec<Option<&TableCell>> = table.rows.iter().map(|row| row.cells.get(at)).collect();
        columns.extend(fields(&head(table, at), &unit(table, at), &cells));
    }
    make_unique(&mut columns);
    let mut out = line(columns.iter().map(|(head, _)| head.as_str()));
    for row in 0..table.rows.len() {
        out += &line(columns.iter().map(|(_, values)| values[row].as_str()));
    }
    out
}

fn head(table: &Table, at: usize) -> String {
    let head = table.columns.get(at).map_or_else(String::new, |column| one_line(&column.head));
    if head.is_empty() { format!("column {}", at + 1) } else { head }
}

fn unit(table: &Table, at: usize) -> String {
    let unit = table.columns.get(at).map_or("", |column| column.unit.as_str());
    if unit.is_empty() { String::new() } else { format!(" [{unit}]") }
}

/// The fields of a column: a number with what belongs to it, or a text.
fn fields(head: &str, unit: &str, cells: &[Option<&TableCell>]) -> Vec<(String, Vec<String>)> {
    let of = |field: &dyn Fn(&TableCell) -> String| -> Vec<String> {
        cells.iter().map(|cell| cell.map_or_else(String::new, field)).collect()
    };
    let mut out = Vec::new();
    let mut add = |name: String, values: Vec<String>, always: bool| {
        if always || values.iter().any(|value| !value.is_empty()) {
            out.push((name, values));
        }
    };
    let number = |pick: fn(&Number) -> Option<f64>| {
        move |cell: &TableCell| cell.number.as_ref().and_then(pick).map_or_else(String::new, plain)
    };
    if cells.iter().flatten().any(|cell| cell.number.is_some()) {
        add(format!("{head}{unit}"), of(&number(|n| Some(n.value))), true);
        add(format!("{head} low{unit}"), of(&number(|n| n.low)), false);
        add(format!("{head} high{unit}"), of(&number(|n| n.high)), false);
        add(format!("{head} below{unit}"), of(&number(|n| n.below)), false);
        // Words where other rows have a number.
        let word = |cell: &TableCell| match cell.number {
            None if !says_nothing(&cell.text) => cell.text.clone(),
            _ => String::new(),
        };
        add(format!("{head} text"), of(&word), false);
        add(format!("{head} aside"), of(&remark), false);
    } else {
        add(head.to_owned(), of(&|cell| cell.text.clone()), true);
        add(format!("{head} aside"), of(&|cell| cell.aside.clone()), false);
    }
    let tag = |cell: &TableCell| cell.tag.as_ref().map_or_else(String::new, |tag| tag.word.clone());
    add(format!("{head} tag"), of(&tag), false);
    out
}

/// What stands beside a number and is no rounded copy of its interval.
fn remark(cell: &TableCell) -> String {
    let interval = cell.number.is_some_and(|n| n.low.is_some() || n.high.is_some());
    let words = cell.aside.chars().any(char::is_alphabetic);
    if interval && !words { String::new() } else { cell.aside.clone() }
}

/// As few digits as give the same number again.
fn plain(value: f64) -> String {
    match value {
        0.0 => "0".into(),
        v if v.is_finite() && !(1e-4..1e15).contains(&v.abs()) => format!("{v:e}"),
        v => v.to_string(),
    }
}

/// Heads that come twice get a number.
fn make_unique(columns: &mut [(String, Vec<String>)]) {
    for at in 1..columns.len() {
        let (before, rest) = columns.split_at_mut(at);
        let taken = |name: &str| before.iter().any(|(head, _)| head == name);
        let head = &mut rest[0].0;
        if taken(head) {
            let free = (2..=at + 1).map(|n| format!("{head} ({n})")).find(|name| !taken(name));
            *head = free.unwrap_or_default();
        }
    }
}

fn line<'a>(fields: impl Iterator<Item = &'a str>) -> String {
    fields.map(quoted).collect::<Vec<_>>().join(",") + "\r\n"
}

fn quoted(text: &str) -> String {
    let needs = text.contains([',', '"', '\r', '\n']) || text.trim() != text;
    if needs { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use noisefloor_study::exhibit::{Column, TableRow, Tone};

    use super::*;

    fn table(columns: Vec<Column>, rows: Vec<Vec<TableCell>>) -> Table {
        let rows = rows.into_iter().map(TableRow::new).collect();
        Table { id: "t".into(), columns, rows, ..Table::default() }
    }

    fn measured(value: f64, low: f64, high: f64) -> TableCell {
        let number = Number { low: Some(low), high: Some(high), ..Number::exact(value) };
        TableCell::text("rounded").aside("± 0.1").number(number)
    }

    #[test]
    fn numbers_keep_all_digits_and_have_their_ends_beside_them() {
        let columns = vec![Column::text("Row"), Column::number("Time").unit("s")];
        let rows = vec![
            vec![TableCell::text("mc"), measured(1.0 / 3.0, 1e-7, 2.5)],
            vec![TableCell::text("b"), TableCell::none()],
        ];
        let expected = "Row,Time [s],Time low [s],Time high [s]\r\n\
                        mc,0.3333333333333333,1e-7,2.5\r\n\
                        b,,,\r\n";
        assert_eq!(csv(&table(columns, rows)), expected);
    }

    #[test]
    fn nasty_texts_are_quoted_by_the_rule() {
        let columns = vec![Column::text("a,b"), Column::text("say \"x\"")];
        let rows = vec![vec![TableCell::text("one\ntwo"), TableCell::text(" edge ")]];
        assert_eq!(csv(&table(columns, rows)), "\"a,b\",\"say \"\"x\"\"\"\r\n\"one\ntwo\",\" edge \"\r\n");
    }

    #[test]
    fn words_in_a_column_of_numbers_and_remarks_have_columns_of_their_own() {
        let columns = vec![Column::text("Row"), Column::number("Error")];
        let floor = Number { below: Some(0.5), ..Number::exact(-0.1) };
        let rows = vec![
            vec![TableCell::text("mc"), measured(1.0, 0.5, 2.0).tag("best", Tone::Good, "")],
            vec![TableCell::text("b"), TableCell::text("< 0.5").number(floor)],
            vec![TableCell::text("c"), TableCell::text("needs albedo")],
            vec![TableCell::text("d"), measured(2.0, 1.0, 3.0).aside("over 3 of 9 pixels")],
            vec![TableCell::text("e")],
        ];
        let made = csv(&table(columns, rows));
        let lines: Vec<&str> = made.lines().collect();
        assert_eq!(lines[0], "Row,Error,Error low,Error high,Error below,Error text,Error aside,Error tag");
        assert_eq!(lines[1], "mc,1,0.5,2,,,,best");
        assert_eq!(lines[2], "b,-0.1,,,0.5,,,");
        assert_eq!(lines[3], "c,,,,,needs albedo,,");
        assert_eq!(lines[4], "d,2,1,3,,,over 3 of 9 pixels,");
        assert_eq!(lines[5], "e,,,,,,,", "a row that ends early has empty fields");
    }

    #[test]
    fn every_field_has_a_head_of_its_own() {
        let columns = vec![Column::text("a"), Column::text("a"), Column::text("")];
        let rows = vec![vec![
            TableCell::text("1"),
            TableCell::text("2"),
            TableCell::text("3"),
            TableCell::text("4"),
        ]];
        assert_eq!(csv(&table(columns, rows)), "a,a (2),column 3,column 4\r\n1,2,3,4\r\n");
        assert_eq!(csv(&Table::default()), "\r\n");
    }
}
