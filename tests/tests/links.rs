//! What the documents of the repository point to is in the repository.

use std::fs;
use std::path::{Path, PathBuf};

/// Folders that hold no document of the project.
const NOT_OURS: [&str; 3] = ["target", ".git", "noisefloor-results"];

fn documents(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder of the repository") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if path.is_dir() && !NOT_OURS.contains(&name.as_str()) {
            documents(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "md") {
            found.push(path);
        }
    }
}

/// Texts between `open` and the next `close`.
fn between<'a>(text: &'a str, open: &'a str, close: char) -> impl Iterator<Item = &'a str> {
    text.split(open).skip(1).filter_map(move |rest| rest.split_once(close)).map(|(inner, _)| inner)
}

#[test]
fn links_and_named_reports_of_the_documents_exist() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the workspace");
    let mut files = Vec::new();
    documents(root, &mut files);
    let (mut checked, mut missing) = (0, Vec::new());
    for file in &files {
        let text = fs::read_to_string(file).expect("text");
        let folder = file.parent().expect("a file is in a folder");
        let links = between(&text, "](", ')').filter(|link| !link.contains("://") && !link.starts_with('#'));
        let links = links.map(|link| folder.join(link.split('#').next().unwrap_or(link)));
        // Also what is named without a link; NAME and the like stand for any.
        let named =
            between(&text, "`reports/", '`').filter(|name| !name.contains(|c: char| c.is_uppercase()));
        let named = named
            .filter_map(|name| name.split([' ', '*']).next())
            .map(|name| root.join("reports").join(name));
        for target in links.chain(named) {
            checked += 1;
            if !target.exists() {
                missing.push(format!("{} points to {}", file.display(), target.display()));
            }
        }
    }
    assert!(checked > 30, "{checked} links were found in {} documents", files.len());
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}
