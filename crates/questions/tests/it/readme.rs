//! Tables for a README.

use std::collections::BTreeMap;

use noisefloor_questions::{Asked, Block, QUESTIONS, readme_table};

use crate::fixture::study;

fn asked(kind: &str, keys: &[(&str, &str)]) -> Asked {
    let keys = keys.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned()));
    Asked { kind: kind.into(), keys: keys.collect::<BTreeMap<_, _>>() }
}

/// Heads and rows of every table, texts between them.
fn made(kind: &str, keys: &[(&str, &str)]) -> Vec<String> {
    let blocks = readme_table(&study(), &asked(kind, keys)).unwrap();
    let lines = |block: Block| match block {
        Block::Text(text) => text.lines().map(str::to_owned).collect::<Vec<_>>(),
        Block::Table(table) => {
            let heads = table.columns.iter().map(|column| column.head.clone()).collect::<Vec<_>>();
            let cells = |cells: &[noisefloor_study::exhibit::TableCell]| -> Vec<String> {
                cells.iter().map(|cell| cell.text.clone()).collect()
            };
            let rows = table.rows.iter().map(|row| cells(&row.cells).join(" | "));
            std::iter::once(heads.join(" | ")).chain(rows).collect()
        }
    };
    blocks.into_iter().flat_map(lines).collect()
}

#[test]
fn levels_and_rows_are_those_that_were_asked_for() {
    let one = made("levels", &[("scenes", "rings"), ("spp", "4; 64"), ("rows", "mc; virtual-flash")]);
    assert_eq!(one[0], "samples per pixel | `mc` | `virtual-flash`");
    assert_eq!(one.len(), 3);
    assert!(one[1].starts_with("4 | 0.5") && one[2].starts_with("64 | 0.0312"), "{one:?}");
    let all = made("levels", &[("show", "ratio")]);
    assert_eq!(all[0], "`rings`:");
    assert!(all.contains(&"`lamps`:".to_owned()));
    assert!(!all[1].contains("`mc`"), "the ratio of the baseline to itself says nothing");
}

#[test]
fn every_kind_has_its_table() {
    for (kind, text) in [
        ("answers", "* **Which is closest to the truth?** At 64 spp,"),
        ("methods", "row | rings, 4 spp | rings, 16 spp"),
        (
            "coverage",
            "samples per pixel | nominal 95 % | nominal 99 % | nominal 99.8 % | constant | missed events",
        ),
        ("bounds", "`virtual-flash`: Theorem 3.1 for two steps (unproven, α 0.2 %)"),
        ("slopes", "* `virtual-flash` on rings: Levels off at rMSE 0.00010 ± 0.00003."),
        ("paper", "0.7 (Fig. 7) | larger gain than the paper's"),
        ("equal-time", "scene | row | as much time as | level | used"),
        ("estimates", "samples per pixel | row | estimated | measured | estimated / measured | verdict"),
        ("flicker", "turning | 4 | `mc` | "),
        ("absent", "* `oidn` skipped on rings at 4, 16, 64 and 256 spp: needs albedo and normal"),
        (
            "machine",
            "All 96 cells of the study ended. Made by noisefloor 0.1.0 (release build) on Made-up CPU, 2 threads",
        ),
    ] {
        let made = made(kind, &[]);
        assert!(made.iter().any(|line| line.contains(text)), "{kind}: {made:?}");
    }
}

#[test]
fn a_star_is_not_obeyed_as_markup() {
    let made = made("coverage", &[("scenes", "rings"), ("spp", "256")]);
    assert!(made[1].contains(" \\* [") && !made[1].contains(" * "), "{made:?}");
}

#[test]
fn what_the_study_does_not_have_is_an_error() {
    for (kind, keys, part) in [
        ("pie", &[][..], "no table `pie`"),
        ("levels", &[("scenes", "nowhere")], "no scene `nowhere`"),
        ("levels", &[("color", "red")], "no key `color`; it has metric, show, scenes, spp and rows"),
        ("levels", &[("spp", "5")], "no level `5`"),
        ("levels", &[("rows", "none")], "no row `none`"),
        ("levels", &[("metric", "beauty")], "no metric `beauty`"),
        ("methods", &[("show", "all")], "show is `all`"),
        ("paper", &[("spp", "4")], "no key `spp`; it has none"),
    ] {
        let told = readme_table(&study(), &asked(kind, keys)).unwrap_err();
        assert!(told.contains(part), "{told}");
    }
}

#[test]
fn kinds_have_names_of_their_own() {
    let mut names: Vec<&str> = QUESTIONS.iter().flat_map(|q| q.readme).map(|kind| kind.name).collect();
    let all = names.len();
    names.sort_unstable();
    names.dedup();
    assert_eq!((names.len(), all), (10, 10));
}
