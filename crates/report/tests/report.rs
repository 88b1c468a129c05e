//! A made-up document becomes a report: complete, self-contained, repeatable, safe.

mod fixture;

use std::fs;
use std::path::{Path, PathBuf};

use base64::Engine as _;
use fixture::{HOSTILE, document, write_images};
use noisefloor_report::{ReportFiles, ReportOptions, write_report, write_report_with};
use noisefloor_study::exhibit::{Document, Part, TableCell};

fn written(dir: &Path, document: &Document) -> (ReportFiles, String) {
    write_images(dir, document);
    let files = write_report(dir, document).unwrap();
    let html = fs::read_to_string(&files.index).unwrap();
    (files, html)
}

/// The page alone, without pictures.
fn page(document: &Document) -> String {
    let dir = tempfile::tempdir().unwrap();
    let options = ReportOptions { png: false, pdf: false, ..ReportOptions::default() };
    let document = Document { gallery: Vec::new(), ..document.clone() };
    let files = write_report_with(dir.path(), &document, &options).unwrap();
    fs::read_to_string(files.index).unwrap()
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
    let from = text.find(start).expect("the element is there") + start.len();
    &text[from..from + text[from..].find(end).expect("the element ends")]
}

fn endings<'a>(files: &'a [PathBuf], ending: &'a str) -> impl Iterator<Item = &'a PathBuf> {
    files.iter().filter(move |p| p.extension().is_some_and(|e| e == ending))
}

#[test]
fn every_section_chart_and_table_is_written() {
    let dir = tempfile::tempdir().unwrap();
    let document = document();
    let (files, html) = written(dir.path(), &document);
    assert_eq!(files.plots.len(), 3 * document.charts().len());
    assert_eq!(files.tables.len(), 4 * document.tables().len());
    let report = dir.path().join("report");
    assert!(files.plots.iter().all(|p| p.is_file() && p.starts_with(report.join("plots"))));
    assert!(files.tables.iter().all(|p| p.is_file() && p.starts_with(report.join("tables"))));
    assert!(files.unreadable.is_empty());
    for id in ["answers", "error", "convergence", "cost", "images", "bounds", "methods"] {
        assert!(html.contains(&format!("<section id=\"{id}\"")), "section {id}");
        assert!(html.contains(&format!("<a href=\"#{id}\">")), "section {id} is in the table of contents");
    }
    for text in [
        "Rings &amp; lamps: do the denoisers agree?",
        "reproduces moon2013flash Fig. 9",
        "<li class=\"strong\">frame and reference share a seed</li><li>The references are short.</li>",
        "<div class=\"answer bad\"><h2>Do the promises hold?</h2><ul><li>One is broken.</li>",
        "<th scope=row colspan=\"",
        "needs albedo and normal, which this frame does not have",
        "title=\"all runs: 61.0 ms to 73.2 ms\"",
        "&lt; 0.00040",
        "<tr class=\"best\">",
        "<span class=\"tag bad\">fails</span>",
        "[moon2013flash]",
        "<dt>steps</dt><dd>2</dd>",
        "Made-up CPU",
        "noisefloor run fixture --size 160x120",
    ] {
        let spanning = text.starts_with("<th scope=row colspan");
        assert!(html.contains(text) != spanning, "{text:?} in the page");
    }
    let at = |id: &str| html.find(&format!("<section id=\"{id}\"")).unwrap();
    assert!(at("cost") < at("images") && at("images") < at("bounds"), "pictures follow the costs");
}

#[test]
fn the_answer_and_its_chart_come_first() {
    let html = page(&document());
    let (answer, chart) = (html.find("Which is closest").unwrap(), html.find("<figure").unwrap());
    let second = html.find("What does it cost?").unwrap();
    assert!(answer < chart && chart < second && second < html.find("<table").unwrap());
    let mut plain = document();
    plain.front.charts.clear();
    let html = page(&plain);
    assert!(html.find("What does it cost?").unwrap() < html.find("<table").unwrap());
    assert!(!html.contains("class=\"winner\""));
}

#[test]
fn only_the_chosen_level_is_shown_at_first() {
    let html = page(&document());
    assert!(html.contains("data-spp=\"64\">") && html.contains("data-spp=\"16\" hidden>"));
    assert_eq!(html.matches("name=\"level-1\"").count(), 5, "four levels, and all");
    assert_eq!(html.matches(" checked>").count(), 1);
    let all = page(&Document { chosen: None, ..document() });
    assert!(!all.contains("hidden>\n") || !all.contains("data-spp=\"16\" hidden"));
    let single = page(&Document { levels: vec![64], ..document() });
    assert!(!single.contains("type=\"radio\""), "one level needs no switch");
}

#[test]
fn the_page_loads_nothing_from_elsewhere_and_links_to_its_files() {
    let dir = tempfile::tempdir().unwrap();
    let (_, html) = written(dir.path(), &document());
    assert!(!html.contains("http:") && !html.contains("https:"), "no address of the network");
    assert!(!html.contains("src=") && !html.contains("url(") && !html.contains("@import"));
    let report = dir.path().join("report");
    for link in html.split("href=\"").skip(1).map(|rest| rest.split('"').next().unwrap()) {
        assert!(link.starts_with('#') || report.join(link).is_file(), "{link}");
    }
    for link in ["plots/convergence-0-relmse.pdf", "tables/cells-rings-64.csv", "tables/board.tex"] {
        assert!(html.contains(&format!("href=\"{link}\"")), "{link}");
    }
}

#[test]
fn plots_are_well_formed_and_need_no_font() {
    let dir = tempfile::tempdir().unwrap();
    let (files, html) = written(dir.path(), &document());
    for path in endings(&files.plots, "svg") {
        let svg = fs::read_to_string(path).unwrap();
        assert!(!tags(&svg).iter().any(|t| t == "text"), "{}", path.display());
        assert!(!svg.contains("font-family") && !svg.contains("NaN") && !svg.contains("inf\""));
        for used in svg.split("<use href=\"#").skip(1) {
            let id = used.split('"').next().unwrap();
            assert!(svg.contains(&format!("<path id=\"{id}\"")), "glyph {id} is defined");
        }
    }
    let glyphs = html.split("<use href=\"#").skip(1).map(|rest| rest.split('"').next().unwrap());
    for id in glyphs.filter(|id| !id.starts_with("swatch")) {
        assert!(html.contains(&format!("<path id=\"{id}\"")), "glyph {id} is defined in the page");
    }
    assert!(!html.contains("<text"), "plots in the page need no font either");
}

#[test]
fn every_colour_of_a_plot_has_a_counterpart_in_the_dark() {
    let dir = tempfile::tempdir().unwrap();
    let (files, html) = written(dir.path(), &document());
    for path in endings(&files.plots, "svg") {
        let svg = fs::read_to_string(path).unwrap();
        for attribute in ["fill", "stroke"] {
            for value in svg.split(&format!(" {attribute}=\"#")).skip(1).map(|rest| &rest[..6]) {
                assert!(html.contains(&format!("[{attribute}=\"#{value}\"]{{{attribute}:var(--")), "{value}");
            }
        }
    }
    assert!(html.contains("prefers-color-scheme: dark"));
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let (a, b) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let (first, _) = written(a.path(), &document());
    let (second, _) = written(b.path(), &document());
    let relative = |files: &ReportFiles, dir: &Path| -> Vec<_> {
        let all = files.plots.iter().chain(&files.tables).chain([&files.index]);
        all.map(|p| (p.strip_prefix(dir).unwrap().to_owned(), fs::read(p).unwrap())).collect()
    };
    for (one, other) in relative(&first, a.path()).iter().zip(&relative(&second, b.path())) {
        assert!(one == other, "{}", one.0.display());
    }
}

#[test]
fn markup_in_names_is_shown_and_not_obeyed() {
    let mut nasty = document();
    nasty.title = HOSTILE.into();
    nasty.question = HOSTILE.into();
    nasty.metric = HOSTILE.into();
    nasty.rows[1].label = HOSTILE.into();
    nasty.banners[0].lines.push(HOSTILE.into());
    nasty.front.answers[0].sentences[0] = HOSTILE.into();
    nasty.front.charts[0].title = HOSTILE.into();
    nasty.front.cards[0].shown[0] = HOSTILE.into();
    nasty.exhibits[0].title = "{{ 7*7 }}".into();
    let board = nasty.front.board.as_mut().unwrap();
    board.caption = HOSTILE.into();
    board.rows[0].cells[1] =
        TableCell::row(HOSTILE, 1).aside(HOSTILE).about(HOSTILE).tag(HOSTILE, Default::default(), HOSTILE);
    nasty.gallery[0].title = HOSTILE.into();
    nasty.gallery[0].levels[1].rows[0].label = HOSTILE.into();
    if let Part::Charts(charts) = &mut nasty.exhibits[1].parts[1] {
        charts[0].panels[0].series[0].name = HOSTILE.into();
        charts[0].panels[0].series[0].points[0].about = HOSTILE.into();
    }
    let dir = tempfile::tempdir().unwrap();
    let (files, html) = written(dir.path(), &nasty);
    assert!(!html.contains("<script>alert"), "the name is escaped everywhere");
    assert!(html.contains("&lt;script&gt;alert("));
    assert!(html.contains("{{ 7*7 }}"), "names are not templates");
    assert_eq!(html.matches("</script>").count(), html.matches("<script").count());
    for svg in endings(&files.plots, "svg") {
        assert!(!tags(&fs::read_to_string(svg).unwrap()).contains(&"script".to_owned()));
    }
}

#[test]
fn embedded_images_equal_their_files_within_the_format() {
    let dir = tempfile::tempdir().unwrap();
    let document = document();
    let (_, html) = written(dir.path(), &document);
    let manifest = between(&html, "<script type=\"application/json\" id=\"gallery\">", "</script>");
    let manifest: serde_json::Value = serde_json::from_str(manifest).unwrap();
    let scene = &manifest["scenes"][1];
    let levels: Vec<u64> =
        scene["levels"].as_array().unwrap().iter().map(|l| l["spp"].as_u64().unwrap()).collect();
    assert_eq!(levels, [16, 64]);
    assert_eq!(scene["levels"][1]["values"]["mc"], "0.064");
    let position = scene["levels"][1]["images"]["virtual-flash"].as_u64().unwrap();
    let about = &manifest["images"][position as usize];
    assert_eq!(about["format"], "rgb9e5");
    let text = between(&html, &format!("id=\"image-{position}\">"), "</script>");
    let packed = base64::engine::general_purpose::STANDARD.decode(text).unwrap();
    let planes = miniz_oxide::inflate::decompress_to_vec_zlib(&packed).unwrap();
    let file = dir.path().join(&document.gallery[1].levels[1].rows[1].image);
    let image = noisefloor_io::read_image(file).unwrap();
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
    let document = document();
    let (full, _) = written(dir.path(), &document);
    for share in [2, 8] {
        let image_budget_bytes = full.image_bytes / share;
        let options = ReportOptions { image_budget_bytes, png: false, pdf: false };
        let small = write_report_with(dir.path(), &document, &options).unwrap();
        assert!(small.image_bytes <= options.image_budget_bytes, "{} bytes", small.image_bytes);
        assert!(small.image_bytes > 0);
        let html = fs::read_to_string(small.index).unwrap();
        let left_out = html.contains("Left out to keep this page small");
        let cropped = html.contains("\"crop\":[");
        assert!(left_out || cropped, "a smaller page leaves something out, and says so");
    }
}

#[test]
fn plots_and_tables_of_before_are_removed_and_other_files_stay() {
    let dir = tempfile::tempdir().unwrap();
    let (full, _) = written(dir.path(), &document());
    let notes =
        ["plots/notes.txt", "plots/mine.svg", "tables/notes.md"].map(|p| dir.path().join("report").join(p));
    notes.iter().for_each(|path| fs::write(path, "mine").unwrap());
    let mut fewer = document();
    fewer.exhibits.truncate(2);
    let options = ReportOptions { png: false, ..ReportOptions::default() };
    let again = write_report_with(dir.path(), &fewer, &options).unwrap();
    assert_eq!(again.plots.len(), 2 * fewer.charts().len(), "no PNG");
    assert!(full.plots.iter().all(|p| p.exists() == again.plots.contains(p)));
    assert!(full.tables.iter().all(|p| p.exists() == again.tables.contains(p)));
    assert!(again.tables.len() < full.tables.len());
    assert!(notes.iter().all(|path| path.exists()));
    let html = fs::read_to_string(again.index).unwrap();
    assert!(html.contains(".pdf\"") && !html.contains(".png\""), "no link to what is not written");
}

#[test]
fn missing_images_are_named_and_do_not_stop_the_report() {
    let dir = tempfile::tempdir().unwrap();
    let mut document = document();
    write_images(dir.path(), &document);
    let path = "images/not-there.exr".to_owned();
    document.gallery[0].levels[1].rows[0].image.clone_from(&path);
    let files = write_report(dir.path(), &document).unwrap();
    assert!(files.unreadable.len() == 1 && files.unreadable[0].contains(&path), "{:?}", files.unreadable);
    assert!(fs::read_to_string(files.index).unwrap().contains("Not readable"));
}

#[test]
fn a_damaged_image_is_named_even_if_no_other_is_there() {
    let dir = tempfile::tempdir().unwrap();
    let mut document = document();
    document.gallery.truncate(1);
    document.gallery[0].levels.clear();
    fs::create_dir(dir.path().join("images")).unwrap();
    fs::write(dir.path().join(&document.gallery[0].reference), "no image").unwrap();
    let files = write_report(dir.path(), &document).unwrap();
    assert_eq!(files.unreadable.len(), 1);
    let html = fs::read_to_string(files.index).unwrap();
    assert!(html.contains("0-reference.exr") && !html.contains("<section id=\"images\""));
}

#[test]
fn an_empty_document_still_has_a_page() {
    let dir = tempfile::tempdir().unwrap();
    let files =
        write_report(dir.path(), &Document { title: "Nothing yet".into(), ..Document::default() }).unwrap();
    assert!(files.plots.is_empty() && files.tables.is_empty());
    assert!(fs::read_to_string(files.index).unwrap().contains("<h1>Nothing yet</h1>"));
}

#[test]
fn a_study_without_sections_shows_its_pictures() {
    let dir = tempfile::tempdir().unwrap();
    let (_, html) = written(dir.path(), &Document { exhibits: Vec::new(), ..document() });
    assert!(html.contains("<section id=\"images\"") && html.contains("href=\"#images\""));
}

#[test]
#[ignore = "writes a report to be looked at with a browser"]
fn a_report_to_look_at() {
    let dir = Path::new(env!("CARGO_TARGET_TMPDIR")).join("fixture");
    fs::create_dir_all(&dir).unwrap();
    let (files, _) = written(&dir, &document());
    println!("{}", files.index.display());
}
