//! The paper is found in the source by searching for its words.

use noisefloor_conformance::cited;

/// Source files with their text, and what of the paper is done in each: the words of the table in `algorithm.rs`.
const FILES: [(&str, &str, &[&str]); 8] = [
    (
        "algorithm.rs",
        include_str!("../algorithm.rs"),
        &["Sec. 3.1", "Sec. 3.3", "Sec. 3.4", "Sec. 3.5", "Eq. 1", "Eq. 2", "Theorem 3.1"],
    ),
    ("flash.rs", include_str!("../flash.rs"), &["Sec. 3.1"]),
    ("filter.rs", include_str!("../filter.rs"), &["Sec. 3.2", "Eq. 1", "Eq. 5"]),
    ("tolerance.rs", include_str!("../tolerance.rs"), &["Sec. 3.3", "Eq. 2", "Eq. 3", "Eq. 4"]),
    ("card.rs", include_str!("../card.rs"), &["Sec. 3.4", "Theorem 3.1", "Eq. 6", "Eq. 7"]),
    ("spread.rs", include_str!("../spread.rs"), &["Sec. 3.5"]),
    ("guide.rs", include_str!("../guide.rs"), &["Sec. 4", "Eq. 1"]),
    ("volume.rs", include_str!("../volume.rs"), &["Sec. 4"]),
];

/// Whether a text has the words, as such and not as the start of a longer number.
fn has(text: &str, words: &str) -> bool {
    text.match_indices(words)
        .any(|(at, _)| !text[at + words.len()..].starts_with(|c: char| c.is_ascii_digit()))
}

#[test]
fn words_end_where_their_number_does() {
    assert!(has("as Eq. 1.", "Eq. 1") && has("Eq. 12, Eq. 1", "Eq. 1"));
    assert!(!has("Eq. 12", "Eq. 1") && !has("Equation 1", "Eq. 1"));
}

#[test]
fn every_step_of_the_paper_is_cited_where_it_is_done() {
    for (name, text, cited) in FILES {
        // The table is not the code.
        let text: String = text.lines().filter(|line| !line.starts_with("//! |")).collect();
        for words in cited {
            assert!(has(&text, words), "{name} does not cite {words}");
        }
    }
}

#[test]
fn the_table_names_the_file_that_cites_the_step() {
    let mut rows = 0;
    for row in FILES[0].1.lines().filter_map(|line| line.strip_prefix("//! | ")).skip(1) {
        let cells: Vec<&str> = row.split(" | ").collect();
        let file = cells[2].split('`').nth(1).expect("a file in each row");
        let (_, _, cited) = FILES.iter().find(|(name, _, _)| *name == file).expect("a file of the list");
        for words in cells[0].split(", ").filter(|words| *words != "App. A") {
            assert!(cited.contains(&words), "the table says {words} of {file}");
        }
        rows += 1;
    }
    assert_eq!(rows, 12);
    for words in (1..=7).map(|number| format!("Eq. {number}")) {
        assert!(FILES[1..].iter().any(|(_, text, _)| has(text, &words)), "no step cites {words}");
    }
}

#[test]
fn no_comment_cites_an_equation_that_the_paper_has_not() {
    for (name, text, _) in FILES {
        let beyond: Vec<_> = cited(text, "Eq.").into_iter().filter(|e| !(1..=7).contains(e)).collect();
        assert!(beyond.is_empty(), "{name} cites {beyond:?}");
    }
}
