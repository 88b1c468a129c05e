use std::fmt::Write;

use noisefloor_denoiser::Param;

/// Markdown table of a method's parameters. Empty if it takes none.
#[must_use]
pub fn params_table(params: &[Param]) -> String {
    if params.is_empty() {
        return String::new();
    }
    let mut out = String::from(
        "| symbol | parameter | range | default | section | what it does |\n|---|---|---|---|---|---|\n",
    );
    for param in params {
        let or_dash = |text: &'_ str| if text.is_empty() { "–".to_owned() } else { text.to_owned() };
        line(
            &mut out,
            &[
                &or_dash(&param.symbol),
                &format!("`{}`", param.name),
                &param.range(),
                &format!("`{}`", param.default),
                &or_dash(&param.section),
                param.about.trim_end_matches('.'),
            ],
        );
    }
    out
}

/// One row; a vertical bar inside a cell is escaped.
fn line(out: &mut String, cells: &[&str]) {
    for cell in cells {
        // Writing to a string cannot fail.
        let _ = write!(out, "| {} ", cell.replace('|', "\\|"));
    }
    out.push_str("|\n");
}
