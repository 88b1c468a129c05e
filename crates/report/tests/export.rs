//! Files for papers, spreadsheets and programs.

mod fixture;

use std::fs;

use fixture::{document, write_images};
use noisefloor_report::{Directive, Recording, ReportError, export, markdown, write_recording};
use noisefloor_study::exhibit::{Document, Table};

#[test]
fn every_table_and_chart_is_a_file_in_every_format() {
    let dir = tempfile::tempdir().unwrap();
    let document = document();
    let files = export(&document, dir.path()).unwrap();
    assert_eq!(files.len(), 4 * document.tables().len() + 3 * document.charts().len());
    assert!(files.iter().all(|file| file.is_file()));
    for name in
        ["tables/board.csv", "tables/bounds-rings.json", "charts/bounds-bars.png", "charts/coverage-0.pdf"]
    {
        assert!(files.contains(&dir.path().join(name)), "{name}");
    }
    assert_eq!(export(&document, dir.path()).unwrap(), files, "again over what is there");
}

#[test]
fn exported_numbers_are_those_of_the_tables() {
    let dir = tempfile::tempdir().unwrap();
    let document = document();
    export(&document, dir.path()).unwrap();
    let read = |name: &str| fs::read_to_string(dir.path().join("tables").join(name)).unwrap();
    let csv = read("cells-rings-256.csv");
    let lines: Vec<&str> = csv.split("\r\n").collect();
    assert_eq!(
        lines[0],
        "Method,Method tag,rMSE,rMSE low,rMSE high,rMSE below,rMSE text,rMSE tag,Ratio to mc,Ratio to mc low,\
         Ratio to mc high,Denoise [s]"
    );
    assert!(lines[2].starts_with("virtual-flash,best,0.0010765625,"), "{}", lines[2]);
    assert!(lines[3].contains(",4e-4,") || lines[3].contains(",0.0004,"), "{}", lines[3]);
    assert!(lines[4].starts_with("oidn,,,,,,\"needs albedo and normal, which"), "{}", lines[4]);
    let json: serde_json::Value = serde_json::from_str(&read("cells-rings-256.json")).unwrap();
    assert_eq!(json["rows"][1]["cells"][1]["number"]["value"], 0.0010765625);
    assert_eq!(json["columns"][3]["unit"], "s");
    assert!(read("cells-rings-256.tex").contains("virtual-flash best & 0.0011 $\\pm$ 0.0004"));
    assert!(read("cells-rings-256.md").contains("| `virtual-flash` best | 0.0011 ± 0.0004 |"));
}

#[test]
fn a_chart_looks_the_same_in_all_formats() {
    let dir = tempfile::tempdir().unwrap();
    export(&document(), dir.path()).unwrap();
    let read = |name: &str| fs::read(dir.path().join("charts").join(name)).unwrap();
    for (name, wide) in [("convergence-0-relmse", 252.0), ("convergence-all-relmse", 504.0)] {
        let svg = String::from_utf8(read(&format!("{name}.svg"))).unwrap();
        assert!(svg.contains(&format!("width=\"{wide}pt\"")), "{name}");
        let decoder =
            png::Decoder::new(std::io::Cursor::new(read(&format!("{name}.png")))).read_info().unwrap();
        assert_eq!(decoder.info().width, (wide / 72.0 * 300.0) as u32);
        let pdf = read(&format!("{name}.pdf"));
        let pdf = String::from_utf8_lossy(&pdf);
        assert!(pdf.contains(&format!("/MediaBox [0 0 {wide} ")), "{name}");
    }
}

fn tables(asked: &Directive) -> Result<String, String> {
    match asked.kind.as_str() {
        "levels" => Ok(markdown(&fixture::tables::cells(64))),
        "answers" | "methods" | "machine" => Ok(format!("made {}", asked.kind)),
        other => Err(format!("there is no table `{other}`")),
    }
}

fn recorded(dir: &std::path::Path, readme: &str) -> Result<(Recording, String), ReportError> {
    fs::write(dir.join("README.md"), readme).unwrap();
    let made = write_recording(dir, &document(), None, &tables)?;
    Ok((made, fs::read_to_string(dir.join("README.md")).unwrap()))
}

#[test]
fn tables_of_a_readme_are_made_anew_and_the_rest_is_the_authors() {
    let dir = tempfile::tempdir().unwrap();
    let text = "# Title\n\nMine.\n\n<!-- noisefloor:table levels scenes=rings -->\nold\n<!-- /noisefloor -->\n\n\
                ![a](plots/convergence-0-relmse.svg) ![b](plots/speed-nothing.svg)\n\nEnd.\n";
    let (made, readme) = recorded(dir.path(), text).unwrap();
    assert!(
        readme.starts_with("# Title\n\nMine.\n") && readme.ends_with("\nEnd.\n") && !readme.contains("old")
    );
    assert!(readme.contains("| Method | rMSE | Ratio to mc | Denoise |\n| --- | ---: |"), "{readme}");
    // Only the plot that it shows, and the same again.
    assert_eq!(made.plots, [dir.path().join("plots/convergence-0-relmse.svg")]);
    assert_eq!(made.absent, ["speed-nothing"]);
    assert_eq!(recorded(dir.path(), &readme).unwrap().1, readme);
}

#[test]
fn a_marker_that_cannot_be_obeyed_is_an_error_with_its_line() {
    let dir = tempfile::tempdir().unwrap();
    let end = "<!-- /noisefloor -->";
    for (marker, part) in [
        ("<!-- noisefloor:table pie -->", "no table `pie`"),
        ("<!-- noisefloor:cake -->", "no `noisefloor:cake`"),
        ("<!-- noisefloor:table a b -->", "neither the kind nor a key"),
    ] {
        let told = recorded(dir.path(), &format!("a\nb\n{marker}\n{end}\n")).unwrap_err().to_string();
        assert!(told.contains("line 3") && told.contains(part), "{told}");
    }
    let told = recorded(dir.path(), "<!-- noisefloor:table machine -->\n").unwrap_err().to_string();
    assert!(told.contains("line 1"), "{told}");
}

#[test]
fn without_a_readme_one_is_begun() {
    let dir = tempfile::tempdir().unwrap();
    let made = write_recording(dir.path(), &document(), None, &tables).unwrap();
    let text = fs::read_to_string(made.readme).unwrap();
    assert!(text.contains("Rings & lamps") && text.contains("made methods"), "{text}");
}

#[test]
fn a_panel_is_made_from_the_images_of_the_run_and_stays_without_them() {
    let (run, to) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    write_images(run.path(), &document());
    let text = "<!-- noisefloor:panel scenes=rings spp=64 show=\"mc; virtual-flash / count; reference\" shrink=2 -->\n\
                <!-- /noisefloor -->\n";
    fs::write(to.path().join("README.md"), text).unwrap();
    write_recording(to.path(), &document(), Some(run.path()), &tables).unwrap();
    let readme = fs::read_to_string(to.path().join("README.md")).unwrap();
    assert!(readme.contains("](panel.png)"), "{readme}");
    let first = fs::read(to.path().join("panel.png")).unwrap();
    let decoder = png::Decoder::new(std::io::Cursor::new(first.clone())).read_info().unwrap();
    // Three pictures of 24×18 with 4 pixels between them, below a line of 22.
    assert_eq!((decoder.info().width, decoder.info().height), (3 * 28, 40));
    let without = Document { gallery: Vec::new(), ..document() };
    for images in [None, Some(run.path())] {
        write_recording(to.path(), &without, images, &tables).unwrap();
        assert_eq!(fs::read_to_string(to.path().join("README.md")).unwrap(), readme);
        assert_eq!(fs::read(to.path().join("panel.png")).unwrap(), first);
    }
}

#[test]
fn a_panel_that_the_gallery_does_not_have_is_an_error() {
    let run = tempfile::tempdir().unwrap();
    write_images(run.path(), &document());
    for (keys, part) in [
        ("scenes=nowhere spp=64 show=mc", "no scene `nowhere`"),
        ("spp=4 show=mc", "no image `mc` of rings at 4 spp"),
        ("spp=64 show=\"mc / count\"", "no image `mc / count`"),
        ("show=mc", "a panel needs"),
    ] {
        let text = format!("<!-- noisefloor:panel {keys} -->\n<!-- /noisefloor -->\n");
        fs::write(run.path().join("README.md"), text).unwrap();
        let told =
            write_recording(run.path(), &document(), Some(run.path()), &tables).unwrap_err().to_string();
        assert!(told.contains(part), "{told}");
    }
}

#[test]
fn an_empty_table_has_files() {
    let dir = tempfile::tempdir().unwrap();
    let mut document = Document::default();
    document.front.board = Some(Table { id: "../empty".into(), ..Table::default() });
    let files = export(&document, dir.path()).unwrap();
    assert_eq!(files.len(), 4);
    assert!(files.iter().all(|f| f.parent() == Some(dir.path().join("tables").as_path())), "{files:?}");
}
