//! The paper is found in the source by searching for its words.

use std::collections::BTreeMap;

use noisefloor_conformance::cited;

/// Numbered equations of the paper.
const EQUATIONS: u32 = 14;

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

#[test]
fn every_equation_is_cited_in_the_algorithm_and_where_it_is_done() {
    let sources = sources();
    let here = cited(&sources["algorithm.rs"], "Eq.");
    for equation in 1..=EQUATIONS {
        assert!(here.contains(&equation), "algorithm.rs does not cite Eq. {equation}");
    }
    let mut rows = 0;
    for row in
        include_str!("../../src/algorithm.rs").lines().filter_map(|line| line.strip_prefix("//! | Eq."))
    {
        let cells: Vec<&str> = row.split(" | ").collect();
        let equations = cited(&format!("Eq.{}", cells[0]), "Eq.");
        let Some(name) = cells[2].split('`').nth(1).filter(|name| name.ends_with(".rs")) else { continue };
        for equation in equations {
            assert!(cited(&sources[name], "Eq.").contains(&equation), "{name} does not cite Eq. {equation}");
            rows += 1;
        }
    }
    assert_eq!(rows, 11);
}

#[test]
fn no_comment_cites_an_equation_that_the_paper_has_not() {
    for (name, text) in sources() {
        let beyond: Vec<_> =
            cited(&text, "Eq.").into_iter().filter(|e| !(1..=EQUATIONS).contains(e)).collect();
        assert!(beyond.is_empty(), "{name} cites {beyond:?}");
    }
}

#[test]
fn sections_are_found_where_their_step_is() {
    let sources = sources();
    for (section, name) in [
        ("Sec. 3.1", "algorithm.rs"),
        ("Sec. 3.2", "features.rs"),
        ("Sec. 3.3", "guided.rs"),
        ("Sec. 3.4", "models.rs"),
        ("Sec. 3.5", "centres.rs"),
        ("Sec. 3.5", "tile.rs"),
        ("Sec. 4", "settings.rs"),
    ] {
        assert!(sources[name].contains(section), "{name} does not cite {section}");
    }
}
