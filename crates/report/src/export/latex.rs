//! Tables for papers.

use noisefloor_study::exhibit::{Column, Table};

use super::text::{one_line, shown};

/// Texts of more letters than this take lines of their own width.
const LONG: usize = 40;

/// A `booktabs` tabular in a document of its own; caption and notes are comments.
pub(super) fn latex(table: &Table, study: &str) -> String {
    let cells = shown(table);
    let width = cells.iter().map(Vec::len).max().unwrap_or(0).max(table.columns.len()).max(1);
    let mut out = format!("% {} of study {}\n", comment(&table.id), comment(study));
    for text in std::iter::once(&table.caption).chain(&table.notes).filter(|text| !text.trim().is_empty()) {
        out += &format!("% {}\n", comment(text));
    }
    out += "% Compiles on its own. In a paper, copy the tabular, or \\input this file after \\usepackage{standalone}.\n";
    out +=
        "\\documentclass[varwidth=30cm,border=2pt]{standalone}\n\\usepackage{booktabs}\n\\begin{document}\n";
    let specification: String = (0..width).map(|at| alignment(table.columns.get(at), at, &cells)).collect();
    out += &format!("\\begin{{tabular}}{{{specification}}}\n\\toprule\n");
    let heads = (0..width).map(|at| table.columns.get(at).map_or_else(String::new, |c| escaped(&c.head)));
    out += &line(heads);
    out += "\\midrule\n";
    for row in &cells {
        let last = row.len().saturating_sub(1);
        // A row that ends early has a text that goes on to the end.
        let cell = |(at, text): (usize, &String)| {
            let (text, rest) = (escaped(text), width - at);
            if at == last && rest > 1 { format!("\\multicolumn{{{rest}}}{{l}}{{{text}}}") } else { text }
        };
        out += &line(row.iter().enumerate().map(cell));
    }
    out + "\\bottomrule\n\\end{tabular}\n\\end{document}\n"
}

fn alignment(column: Option<&Column>, at: usize, cells: &[Vec<String>]) -> &'static str {
    let longest = cells.iter().filter_map(|row| row.get(at)).map(|text| text.chars().count()).max();
    match column {
        _ if longest.unwrap_or(0) > LONG => "p{7cm}",
        Some(column) if at > 0 && !column.text => "r",
        _ => "l",
    }
}

fn line(cells: impl Iterator<Item = String>) -> String {
    cells.collect::<Vec<_>>().join(" & ") + " \\\\\n"
}

/// A comment cannot end before its line does.
fn comment(text: &str) -> String {
    one_line(text).chars().filter(|c| !c.is_control()).collect()
}

/// Text in which no character is a command. What common fonts of LaTeX lack becomes mathematics.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    let chars: Vec<char> = one_line(text).chars().collect();
    let mut at = 0;
    while at < chars.len() {
        let raised = run(&chars[at..], superscript);
        let lowered = run(&chars[at..], subscript);
        if !raised.is_empty() {
            out += &format!("$^{{{raised}}}$");
            at += raised.chars().count();
        } else if !lowered.is_empty() {
            out += &format!("$_{{{lowered}}}$");
            at += lowered.chars().count();
        } else {
            match command(chars[at]) {
                Some(command) => out += command,
                None => out.push(chars[at]),
            }
            at += 1;
        }
    }
    // A bracket after the end of a row would be taken for its argument.
    if out.starts_with(['[', '*']) { format!("{{}}{out}") } else { out }
}

/// Characters from the start that stand above or below the line, as they are on it.
fn run(chars: &[char], on_the_line: fn(char) -> Option<char>) -> String {
    chars.iter().map_while(|&c| on_the_line(c)).collect()
}

fn superscript(c: char) -> Option<char> {
    let place = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺".chars().position(|s| s == c)?;
    "0123456789-+".chars().nth(place)
}

fn subscript(c: char) -> Option<char> {
    let place = "₀₁₂₃₄₅₆₇₈₉₋₊".chars().position(|s| s == c)?;
    "0123456789-+".chars().nth(place)
}

fn command(c: char) -> Option<&'static str> {
    Some(match c {
        '\\' => "\\textbackslash{}",
        '{' => "\\{",
        '}' => "\\}",
        '&' => "\\&",
        '%' => "\\%",
        '$' => "\\$",
        '#' => "\\#",
        '_' => "\\_",
        '^' => "\\textasciicircum{}",
        '~' => "\\textasciitilde{}",
        '<' => "$<$",
        '>' => "$>$",
        '|' => "$|$",
        '"' => "''",
        '`' => "\\textasciigrave{}",
        '−' => "$-$",
        '±' => "$\\pm$",
        '×' => "$\\times$",
        '·' => "$\\cdot$",
        '√' => "$\\surd$",
        '∞' => "$\\infty$",
        '≤' => "$\\leq$",
        '≥' => "$\\geq$",
        '≠' => "$\\neq$",
        '≈' => "$\\approx$",
        '∝' => "$\\propto$",
        '→' => "$\\to$",
        'α' => "$\\alpha$",
        'β' => "$\\beta$",
        'ε' => "$\\varepsilon$",
        'κ' => "$\\kappa$",
        'σ' => "$\\sigma$",
        'µ' | 'μ' => "$\\mu$",
        '†' => "$\\dagger$",
        '°' => "$^{\\circ}$",
        '½' => "$\\frac12$",
        '–' => "--",
        '—' => "---",
        '…' => "\\ldots{}",
        '“' => "``",
        '”' => "''",
        '‘' => "`",
        '’' => "'",
        '\u{a0}' | '\u{202f}' => "~",
        c if c.is_control() => "",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use noisefloor_study::exhibit::{TableCell, TableRow};

    use super::*;

    #[test]
    fn no_character_of_a_text_is_a_command() {
        assert_eq!(
            escaped("50 % & #1_a ^~ \\x{y} $2 <b>|"),
            "50 \\% \\& \\#1\\_a \\textasciicircum{}\\textasciitilde{} \\textbackslash{}x\\{y\\} \\$2 $<$b$>$$|$"
        );
        assert_eq!(escaped("[a] *"), "{}[a] *");
    }

    #[test]
    fn numbers_are_set_as_mathematics() {
        assert_eq!(escaped("−1.2×10⁻⁵ ± 3"), "$-$1.2$\\times$10$^{-5}$ $\\pm$ 3");
        assert_eq!(escaped("log₁₀ ε ≤ 2 µs"), "log$_{10}$ $\\varepsilon$ $\\leq$ 2 $\\mu$s");
    }

    #[test]
    fn a_table_is_a_document_with_a_tabular() {
        let table = Table {
            id: "t%".into(),
            caption: "two\nlines".into(),
            columns: vec![Column::text("Row"), Column::number("x"), Column::text("why & how")],
            rows: vec![
                TableRow::new(vec![
                    TableCell::text("a"),
                    TableCell::count(3),
                    TableCell::text("w".repeat(50)),
                ]),
                TableRow::new(vec![TableCell::text("b"), TableCell::text("skipped: no_albedo")]),
            ],
            notes: vec![],
        };
        let made = latex(&table, "s");
        assert!(
            made.contains("\\begin{tabular}{lrp{7cm}}\n\\toprule\nRow & x & why \\& how \\\\\n\\midrule\n")
        );
        assert!(
            made.contains("b & \\multicolumn{2}{l}{skipped: no\\_albedo} \\\\\n\\bottomrule\n"),
            "{made}"
        );
        assert!(made.contains("% two lines\n") && made.ends_with("\\end{document}\n"));
        let braces = |c: char| made.matches(c).count();
        assert_eq!(braces('{'), braces('}'));
    }
}
