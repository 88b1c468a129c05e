//! A made-up study becomes a report: complete, self-contained, repeatable, safe.

mod fixture;

use std::fs;
use std::path::Path;

use base64::Engine as _;
use fixture::{HOSTILE, ROWS, Row, summary, write_images};
use noisefloor_harness::summary::Summary;
use noisefloor_report::{ReportError, ReportFiles, ReportOptions, write_report, write_report_with};

const TITLES: [(&str, &str); 2] = [("rings", "Rings"), ("odd name/№2", "Lamps")];
const SIZE: (u32, u32) = (48, 36);

fn study() -> Summary {
    summary(&TITLES, &ROWS, SIZE)
}

fn written(dir: &Path, summary: &Summary) -> (ReportFiles, String) {
    write_images(dir, summary);
    let files = write_report(dir, summary).unwrap();
    let html = fs::read_to_string(&files.index).unwrap();
    (files, html)
}

/// Checks that tags nest; returns the names met. Enough XML for what the plots write.
fn tags(svg: &str) -> Vec<String> {
    let (mut open, mut all) = (Vec::new(), Vec::new());
    for piece in svg.split('<').skip(1) {
        let (tag, _) = piece.split_once('>').expect("every tag ends");
        assert_eq!(tag.matches('"').count() % 2, 0, "quotes pair up in <{tag}>");
        let name = tag.trim_matches('/').split_whitespace().next().expect("a tag has a name").to_owned();
        if tag.starts_with('/') {
            assert_eq!(open.pop(), Some(name), "tags nest");
        } else if !tag.starts_with('?') {
            if !tag.ends_with('/') {
                open.push(name.clone());
            }
            all.push(name);
        }
    }
    assert!(open.is_empty(), "left open: {open:?}");
    all
}

/// Text of the element that starts with `start`, up to the next closing tag `end`.
fn between<'a>(text: &'a str, start: &str, end: &str) -> &'a str {
    let from = text.find(start).unwrap_or_else(|| panic!("{start} is in the page")) + start.len();
    &text[from..from + text[from..].find(end).expect("the element ends")]
}

#[test]
fn every_section_and_plot_is_written() {
    let dir = tempfile::tempdir().unwrap();
    let (files, html) = written(dir.path(), &study());
    // Per scene: convergence twice, speed twice, coverage, bounds, estimates; each as SVG and PNG.
    assert_eq!(files.plots.len(), 2 * 7 * 2);
    assert!(files.plots.iter().all(|p| p.is_file() && p.starts_with(dir.path().join("report/plots"))));
    assert!(files.unreadable.is_empty());
    for id in [
        "answers",
        "paper",
        "tables",
        "convergence",
        "speed",
        "images",
        "coverage",
        "bounds",
        "estimates",
        "flicker",
        "slopes",
        "methods",
    ] {
        assert!(html.contains(&format!("<section id=\"{id}\"")), "section {id}");
    }
    for text in [
        "The references have only 8 times the samples of the top level.",
        "At 64 spp, virtual-flash is tied for the lowest rMSE",
        "The replicates cannot tell it from guarded(virtual-flash)",
        "needs albedo and normal, which this frame does not have",
        "&lt; 0.00040",
        "Levels off at rMSE 0.00010",
        "noisefloor run fixture --size 160x120",
        "the reference has only 8 times the samples",
        "unproven",
        "0.999998",
        "0.0082 to 0.36",
        "larger gain than the paper&#x27;s",
        "`virtual-flash` did not run here",
        "rMSE of virtual-flash over rMSE of mc",
        "Sequence turning, 3 frames",
        "Over that of mc",
        "0.00012 was subtracted",
        "too optimistic",
        "3 values without a finite estimate are left out",
        "difference −0.0010",
        "Rings &amp; lamps: do the denoisers agree?",
    ] {
        assert!(html.contains(text), "{text:?} is in the page");
    }
}

#[test]
fn the_page_loads_nothing_from_elsewhere() {
    let dir = tempfile::tempdir().unwrap();
    let (_, html) = written(dir.path(), &study());
    assert!(!html.contains("http:") && !html.contains("https:"), "no address of the network");
    assert!(!html.contains("src=") && !html.contains("url(") && !html.contains("@import"));
    assert!(html.split("href=\"").skip(1).all(|rest| rest.starts_with('#')), "links stay inside the page");
}

#[test]
fn plots_are_well_formed_and_need_no_font() {
    let dir = tempfile::tempdir().unwrap();
    let (files, html) = written(dir.path(), &study());
    for path in files.plots.iter().filter(|p| p.extension().is_some_and(|e| e == "svg")) {
        let svg = fs::read_to_string(path).unwrap();
        let tags = tags(&svg);
        assert!(!tags.iter().any(|t| t == "text"), "{}", path.display());
        assert!(!svg.contains("font-family") && !svg.contains("NaN") && !svg.contains("inf"));
        assert!(
            svg.contains("data-text=\"samples per pixel\"")
                || svg.contains("time per frame\"")
                || svg.contains("measured squared error")
        );
        for used in svg.split("<use href=\"#").skip(1) {
            let id = used.split('"').next().unwrap();
            assert!(svg.contains(&format!("<path id=\"{id}\"")), "glyph {id} is defined");
            assert!(html.contains(&format!("<path id=\"{id}\"")), "glyph {id} is defined in the page");
        }
    }
    assert!(!html.contains("<text"), "plots in the page need no font either");
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let (a, b) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let (first, _) = written(a.path(), &study());
    let (second, _) = written(b.path(), &study());
    let relative = |files: &ReportFiles, dir: &Path| -> Vec<_> {
        let all = files.plots.iter().chain([&files.index]);
        all.map(|p| (p.strip_prefix(dir).unwrap().to_owned(), fs::read(p).unwrap())).collect()
    };
    assert_eq!(relative(&first, a.path()), relative(&second, b.path()));
}

#[test]
fn markup_in_names_is_shown_and_not_obeyed() {
    let rows = [Row(HOSTILE, "mc", 2.0, 0.0, 1e-5), ROWS[1], Row("{{ 7*7 }}", "other", 0.4, 0.0, 0.1)];
    let mut study = summary(&[("a", HOSTILE)], &rows, SIZE);
    study.study.title = HOSTILE.into();
    study.study.question = HOSTILE.into();
    study.warnings.push(HOSTILE.into());
    study.skipped[0].reason = HOSTILE.into();
    study.paper[0].what = HOSTILE.into();
    study.flicker[0].sequence = HOSTILE.into();
    study.paper[0].source = HOSTILE.into();
    let dir = tempfile::tempdir().unwrap();
    let (files, html) = written(dir.path(), &study);
    assert!(!html.contains("<script>alert"), "the name is escaped everywhere");
    assert!(html.contains("&lt;script&gt;alert(1)"));
    assert!(html.contains("{{ 7*7 }}"), "names are not templates");
    assert_eq!(html.matches("</script>").count(), html.matches("<script").count());
    let svg = files.plots.iter().find(|p| p.extension().is_some_and(|e| e == "svg")).unwrap();
    assert!(!tags(&fs::read_to_string(svg).unwrap()).contains(&"script".to_owned()));
}

#[test]
fn embedded_images_equal_their_files_within_the_format() {
    let dir = tempfile::tempdir().unwrap();
    let study = study();
    let (_, html) = written(dir.path(), &study);
    let manifest: serde_json::Value = serde_json::from_str(between(
        &html,
        "<script type=\"application/json\" id=\"gallery\">",
        "</script>",
    ))
    .unwrap();
    let scene = &manifest["scenes"][1];
    let levels: Vec<u64> =
        scene["levels"].as_array().unwrap().iter().map(|l| l["spp"].as_u64().unwrap()).collect();
    assert_eq!(levels, [16, 64], "the study's choice of levels");
    let position = scene["levels"][1]["images"]["virtual-flash"].as_u64().unwrap();
    let about = &manifest["images"][position as usize];
    assert_eq!(about["format"], "rgb9e5");
    let text = between(&html, &format!("id=\"image-{position}\">"), "</script>");
    let packed = base64::engine::general_purpose::STANDARD.decode(text).unwrap();
    let planes = miniz_oxide::inflate::decompress_to_vec_zlib(&packed).unwrap();
    let image =
        noisefloor_io::read_image(dir.path().join(&study.scenes[1].images["virtual-flash"][&64])).unwrap();
    let n = image.pixels();
    assert_eq!(planes.len(), 5 * n);
    for p in 0..n {
        let step = 2f64.powi(i32::from(planes[p]) - 31) * about["scale"].as_f64().unwrap();
        for c in 0..3 {
            let mantissa = u32::from(planes[(1 + c) * n + p]) << 1 | u32::from(planes[4 * n + p] >> c & 1);
            let (decoded, source) = (f64::from(mantissa) * step, f64::from(image.data()[c * n + p]));
            assert!((decoded - source).abs() <= 0.5001 * step, "pixel {p}: {source} became {decoded}");
        }
    }
}

#[test]
fn a_small_budget_drops_levels_and_then_crops() {
    let dir = tempfile::tempdir().unwrap();
    let study = study();
    let (full, _) = written(dir.path(), &study);
    for share in [2, 8] {
        let options = ReportOptions { image_budget_bytes: full.image_bytes / share, png: false };
        let small = write_report_with(dir.path(), &study, &options).unwrap();
        assert!(small.image_bytes <= options.image_budget_bytes, "{} bytes", small.image_bytes);
        assert!(small.image_bytes > 0);
        let html = fs::read_to_string(small.index).unwrap();
        let left_out = html.contains("Left out to keep this page small");
        let cropped = html.contains("\"crop\":[");
        assert!(left_out || cropped, "a smaller page leaves something out, and says so");
    }
}

#[test]
fn without_png_stale_plots_are_removed_and_other_files_stay() {
    let dir = tempfile::tempdir().unwrap();
    let (full, _) = written(dir.path(), &study());
    let note = dir.path().join("report/plots/notes.txt");
    fs::write(&note, "mine").unwrap();
    let options = ReportOptions { png: false, ..ReportOptions::default() };
    let again = write_report_with(dir.path(), &study(), &options).unwrap();
    assert_eq!(again.plots.len(), full.plots.len() / 2);
    assert!(full.plots.iter().all(|p| p.exists() == again.plots.contains(p)));
    assert!(note.exists());
}

#[test]
fn a_study_chooses_its_plots_and_keeps_its_tables() {
    let dir = tempfile::tempdir().unwrap();
    let (full, _) = written(dir.path(), &study());
    let mut chosen = study();
    chosen.study.figures = vec!["coverage".into()];
    let files = write_report(dir.path(), &chosen).unwrap();
    let kept = |p: &&std::path::PathBuf| p.file_name().unwrap().to_string_lossy().starts_with("coverage-");
    assert_eq!(files.plots, full.plots.iter().filter(kept).cloned().collect::<Vec<_>>());
    assert!(full.plots.iter().all(|p| p.exists() == files.plots.contains(p)), "plots of before are gone");
    let page = fs::read_to_string(files.index).unwrap();
    assert!(!page.contains("id=\"convergence\"") && page.contains("id=\"bounds\""));
}

#[test]
fn missing_images_are_named_and_do_not_stop_the_report() {
    let dir = tempfile::tempdir().unwrap();
    let mut study = study();
    write_images(dir.path(), &study);
    let path = "images/not-there.exr".to_owned();
    study.scenes[0].images.get_mut("mc").unwrap().insert(64, path.clone());
    let files = write_report(dir.path(), &study).unwrap();
    assert!(files.unreadable.len() == 1 && files.unreadable[0].contains(&path), "{:?}", files.unreadable);
    assert!(fs::read_to_string(files.index).unwrap().contains("Not readable"));
}

#[test]
fn a_study_without_results_still_has_a_page() {
    let dir = tempfile::tempdir().unwrap();
    let mut empty = study();
    empty.cells.clear();
    empty.scenes.clear();
    empty.methods.clear();
    empty.coverage.clear();
    empty.bounds.clear();
    empty.estimates.clear();
    empty.flicker.clear();
    empty.paper.clear();
    empty.slopes.clear();
    empty.comparisons.clear();
    empty.skipped.clear();
    empty.study.spp.clear();
    empty.study.viewer_spp.clear();
    let files = write_report(dir.path(), &empty).unwrap();
    assert!(files.plots.is_empty());
    assert!(fs::read_to_string(files.index).unwrap().contains("How to read this page"));
}

#[test]
fn a_summary_of_the_future_is_refused() {
    let dir = tempfile::tempdir().unwrap();
    let mut future = study();
    future.schema += 1;
    assert!(matches!(write_report(dir.path(), &future), Err(ReportError::Schema { .. })));
}
