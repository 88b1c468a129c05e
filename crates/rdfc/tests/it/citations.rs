//! The paper is found in the source by searching for its words.

use std::collections::BTreeMap;

use noisefloor_conformance::cited;

/// Lines of Algorithm 1.
const LINES: u32 = 29;
/// Numbered equations of the paper; it has no others.
const EQUATIONS: u32 = 5;

/// Name and comments of each source file but the tests.
fn sources() -> BTreeMap<String, String> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let comments = |text: &str| {
        let lines = text.lines().filter_map(|line| line.split_once("//"));
        lines.map(|(_, comment)| comment.trim_start_matches(['/', '!', ' '])).collect::<Vec<_>>().join(" ")
    };
    files
        .map(|path| {
            let name = path.file_name().unwrap().to_str().unwrap().to_owned();
            (name, comments(&std::fs::read_to_string(&path).unwrap()))
        })
        .filter(|(name, _)| name != "tests.rs")
        .collect()
}

fn lines(text: &str) -> Vec<u32> {
    cited(text, "Alg. 1, line")
}

fn equations(text: &str) -> Vec<u32> {
    cited(text, "Eq.")
}

#[test]
fn every_line_of_algorithm_1_is_cited_in_its_order_and_where_it_is_done() {
    let sources = sources();
    let algorithm = &sources["algorithm.rs"];
    for line in 1..=LINES {
        assert!(lines(algorithm).contains(&line), "algorithm.rs does not cite line {line}");
        let elsewhere = sources.iter().filter(|(name, _)| *name != "algorithm.rs");
        let done: Vec<_> = elsewhere.filter(|(_, text)| lines(text).contains(&line)).collect();
        assert!(!done.is_empty(), "no step cites line {line}");
    }
    for (name, text) in &sources {
        let beyond: Vec<_> = lines(text).into_iter().filter(|line| !(1..=LINES).contains(line)).collect();
        assert!(beyond.is_empty(), "{name} cites lines that there are not: {beyond:?}");
    }
    // The steps of the function follow each other.
    let body = algorithm.split("checked input").last().unwrap();
    assert_eq!(lines(body), (1..=LINES).collect::<Vec<_>>());
}

#[test]
fn every_file_cites_what_the_table_says_of_it() {
    let text = include_str!("../../src/algorithm.rs");
    let sources = sources();
    let (mut all_lines, mut all_equations) = (Vec::new(), Vec::new());
    for row in text.lines().filter_map(|line| line.strip_prefix("//! | ")) {
        let cells: Vec<&str> = row.split(" | ").collect();
        let Some(name) = cells[2].split('`').nth(1) else { continue };
        let there = &sources[name];
        if cells[0].starts_with("Eq. ") {
            let equation = equations(cells[0]);
            assert!(equation.iter().all(|e| equations(there).contains(e)), "{name} lacks {}", cells[0]);
            all_equations.extend(equation);
        } else {
            let of_row = cited(&format!("line {}", cells[0]), "line");
            for line in of_row {
                assert!(lines(there).contains(&line), "{name} does not cite line {line}");
                all_lines.push(line);
            }
        }
    }
    assert_eq!(all_lines, (1..=LINES).collect::<Vec<_>>());
    assert_eq!(all_equations, (1..=EQUATIONS).collect::<Vec<_>>());
}

#[test]
fn no_comment_cites_an_equation_that_the_paper_has_not() {
    for (name, text) in sources() {
        let beyond: Vec<_> = equations(&text).into_iter().filter(|e| !(1..=EQUATIONS).contains(e)).collect();
        assert!(beyond.is_empty(), "{name} cites {beyond:?}");
    }
}

#[test]
fn sections_are_found_where_their_step_is() {
    let sources = sources();
    for (section, name) in [
        ("Sec. 4", "prepare.rs"),
        ("Sec. 5", "features.rs"),
        ("Sec. 6", "candidates.rs"),
        ("Sec. 6", "selection.rs"),
        ("Sec. 7", "algorithm.rs"),
        ("Sec. 8", "density.rs"),
        ("Sec. 8", "algorithm.rs"),
    ] {
        assert!(sources[name].contains(section), "{name} does not cite {section}");
    }
}
