//! What a study may ask for: numbers and names beyond the limits are told with value and range before any work.

use std::path::Path;

use noisefloor_denoiser::{Registry, mc};
use noisefloor_harness::{HarnessError, memory_estimate};
use noisefloor_study::{Study, StudyError};

/// A study of one built-in scene, with more lines at its top, in its scene and in its row.
fn toml(top: &str, scene: &str, row: &str) -> String {
    format!(
        "name = \"limits\"\nspp = [4, 16]\nreplicates = 2\n{top}\n[[scene]]\nid = \"two-quads\"\n{scene}\n[[method]]\n{row}\n"
    )
}

fn refused(text: &str) -> String {
    match Study::from_toml(text, Path::new("limits.toml")) {
        Err(error @ StudyError::Field { .. }) => error.to_string(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn numbers_beyond_the_limits_are_told_with_value_and_range() {
    let mc = "id = \"mc\"";
    let levels = format!("spp = [{}]", (1..=300).map(|n| n.to_string()).collect::<Vec<_>>().join(", "));
    for (text, parts) in [
        (toml("", "replicates = 1000000000", mc), ["scene[0].replicates is 1000000000", "1 to 10000"]),
        (
            toml("", "replicates = { default = 1, above = [[4, 1000000000]] }", mc),
            ["scene[0].replicates is 1000000000", "1 to 10000"],
        ),
        (toml("", "replicates = 0", mc), ["scene[0].replicates is 0", "1 to 10000"]),
        (toml("timing = { runs = 1000000000 }", "", mc), ["timing.runs is 1000000000", "1 to 1000"]),
        (toml("timing = { runs = 0 }", "", mc), ["timing.runs is 0", "1 to 1000"]),
        (toml("timing = { warmup = 4000000000 }", "", mc), ["timing.warmup is 4000000000", "0 to 1000"]),
        (toml("", &levels, mc), ["scene[0].spp is a list of 300", "at most 256 levels"]),
        (
            toml("reference = { spp = 4294967288, parts = 8, sampling = \"independent\" }", "", mc),
            ["reference.spp is 4294967288", "at most 1048576 per part"],
        ),
        (toml("coverage = [0.5]", "spp = [1, 4294967295]", mc), ["scene[0].spp", "1048576"]),
        (toml("coverage = [nan]", "", mc), ["coverage is NaN", "between 0 and 1"]),
        (toml("probe = [inf, 0.0]", "", mc), ["probe is inf", "0 to 1"]),
        (toml("", "orbit_degrees = inf", mc), ["orbit_degrees is inf", "360"]),
    ] {
        let told = refused(&text);
        for part in parts {
            assert!(told.contains(part), "{part}: {told}");
        }
    }
}

#[test]
fn more_cells_than_anybody_waits_for_are_counted_and_refused() {
    let scenes: String = (0..60)
        .map(|i| format!("[[scene]]\nid = \"s{i}\"\nscene = \"two-quads\"\nreplicates = 10000\n"))
        .collect();
    let text = format!("name = \"many\"\nspp = [4, 16]\n{scenes}[[method]]\nid = \"mc\"\n");
    let told = refused(&text);
    assert!(told.contains("1200000 cells") && told.contains("at most 1000000"), "{told}");
}

#[test]
fn names_that_make_no_folder_are_refused() {
    let long = "x".repeat(201);
    for (text, parts) in [
        (
            toml("", "", &format!("id = \"mc\"\nlabel = \"{long}\"")),
            ["method[0].label", "at most 200 characters"],
        ),
        (toml("", "", "id = \"mc\"\nlabel = \"a\\nb\""), ["method[0].label", "control"]),
        (
            toml("", "", "id = \"mc\"")
                .replace("id = \"two-quads\"", &format!("scene = \"two-quads\"\nid = \"{long}\"")),
            ["scene[0].id", "at most 200 characters"],
        ),
        (
            toml("", "", "id = \"mc\"").replace("name = \"limits\"", &format!("name = \"{long}\"")),
            ["name is", "at most 200"],
        ),
    ] {
        let told = refused(&text);
        for part in parts {
            assert!(told.contains(part), "{part}: {told}");
        }
        assert!(told.len() < 700, "{told}");
    }
}

#[test]
fn nesting_of_combinators_has_a_limit_that_is_named() {
    for levels in [9, 2000, 100_000] {
        for end in [")".repeat(levels), String::new()] {
            let told = refused(&toml("", "", &format!("id = \"{}mc{end}\"", "guarded(".repeat(levels))));
            assert!(
                told.contains(&format!("guarded {levels} times")) && told.contains("at most 8"),
                "{told}"
            );
            assert!(told.len() < 600, "{told}");
        }
    }
}

#[test]
fn nested_values_and_long_lines_end_in_short_errors() {
    let nested = format!("{}1{}", "[".repeat(100_000), "]".repeat(100_000));
    let tables = format!("{}1{}", "{ a = ".repeat(100_000), " }".repeat(100_000));
    for value in [nested, tables, format!("\"{}\"", "x".repeat(1 << 20))] {
        for text in [
            toml("", "", &format!("id = \"mc\"\nset = {{ a = {value} }}")),
            toml(&format!("width = {value}"), "", "id = \"mc\""),
        ] {
            if let Err(error) = Study::from_toml(&text, Path::new("limits.toml")) {
                assert!(error.to_string().len() < 4000, "{} characters", error.to_string().len());
            }
        }
    }
}

#[test]
fn the_memory_of_the_largest_image_is_known_before_it_is_taken() {
    let study = |width: usize| {
        let text = toml(&format!("width = {width}\nheight = 16384"), "", "id = \"mc\"");
        Study::from_toml(&text, Path::new("limits.toml")).unwrap()
    };
    let registry = Registry::new([mc()]);
    let estimate = memory_estimate(&study(16384), &registry, None).unwrap();
    // Colour with variance and halves, the mean of the reference and its eight parts; a frame and its file.
    assert_eq!(estimate.bytes, (1 << 28) * (12 + 27) * 8);
    let error = estimate.check(64 << 30).unwrap_err();
    assert!(matches!(error, HarnessError::Memory { width: 16384, height: 16384, .. }));
    let told = error.to_string();
    assert!(
        told.contains("83751862272") && told.contains("68719476736") && told.contains("two-quads"),
        "{told}"
    );
    let small = memory_estimate(&study(16384), &registry, Some((16, 16))).unwrap();
    assert_eq!(small.bytes, 256 * 39 * 8);
}
