//! The slides' listing is found in the source by searching for its lines.

use noisefloor_conformance::cited;

/// Lines of the listing, without the blank ones.
const LINES: u32 = 15;

const FILES: [(&str, &str); 4] = [
    ("algorithm.rs", include_str!("../algorithm.rs")),
    ("radius.rs", include_str!("../radius.rs")),
    ("cone.rs", include_str!("../cone.rs")),
    ("row.rs", include_str!("../cone/row.rs")),
];

fn lines(text: &str) -> Vec<u32> {
    cited(text, "Listing, line")
}

#[test]
fn every_line_of_the_listing_is_cited_by_the_letter_in_its_order() {
    let (_, text) = FILES[0];
    let letter = text.split("pub(crate) fn ").nth(1).expect("the function by the letter");
    assert!(letter.starts_with("as_written"));
    // The radius and the loop over pixels come first, and the tests stand in a function of their own.
    let order = [3, 1, 5, 6, 7, 8, 9, 10, 2, 4, 11, 12, 13, 14, 15];
    assert_eq!(lines(letter), order);
    let mended = text.split("pub(crate) fn ").nth(2).expect("the mended function");
    assert!(mended.starts_with("corrected"));
    let beyond = |text| lines(text).into_iter().any(|line| !(1..=LINES).contains(&line));
    assert!(FILES.iter().all(|(_, text)| !beyond(text)));
}

#[test]
fn the_table_names_the_files_that_cite_the_line() {
    let mut rows = Vec::new();
    for row in FILES[0].1.lines().filter_map(|line| line.strip_prefix("//! | ")) {
        let cells: Vec<&str> = row.trim_end_matches(" |").split(" | ").collect();
        let of_row = cited(&format!("line {}", cells[0]), "line");
        if of_row.is_empty() {
            continue;
        }
        for cell in &cells[2..] {
            let name = cell.trim_matches('`');
            let (_, text) = FILES.iter().find(|(file, _)| *file == name).expect("a file of the list");
            for line in &of_row {
                assert!(lines(text).contains(line), "{name} does not cite line {line}");
            }
        }
        rows.extend(of_row);
    }
    assert_eq!(rows, (1..=LINES).collect::<Vec<_>>());
}

#[test]
fn the_slides_on_mean_and_variance_are_cited_where_they_are_done() {
    let text = include_str!("../recurrence.rs");
    for words in [
        "Mean, lines 2-4",
        "Variance, lines 2-5",
        "Incremental mean, line 2",
        "Incremental variance, line 3",
        "Incremental variance, lines 4-5",
    ] {
        assert!(text.contains(words), "recurrence.rs does not cite {words}");
    }
}
