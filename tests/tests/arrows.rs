//! Arrows between the files of a crate go down only: whoever uses a file is not used by it, directly or around. And no
//! file lies in a crate that does not have it. What is `unsafe` stands where it can be read at once.
//!
//! An arrow is a `use` of an item that another file of the same crate defines. That a file is declared by another (`mod`)
//! is no arrow, nor is anything in tests. A name that a file only hands on (`pub use`) leads to where it comes from.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The files of a crate by their module path (`run::cell`; empty for the root).
type Files = BTreeMap<Vec<String>, String>;

fn read(folder: &Path, module: &[String], files: &mut Files) {
    let mut entries: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        let stem = path.file_stem().unwrap().to_str().unwrap().to_owned();
        let mut inner = module.to_vec();
        if path.is_dir() {
            inner.push(stem);
            read(&path, &inner, files);
        } else if path.extension().is_some_and(|e| e == "rs") {
            match stem.as_str() {
                "lib" | "main" | "mod" => {}
                _ => inner.push(stem),
            }
            if !inner.iter().any(|part| part == "tests") {
                files.insert(inner, without_tests(&std::fs::read_to_string(&path).unwrap()));
            }
        }
    }
}

/// The text without comments and without what stands behind `#[cfg(test)]`, which is last in every file.
fn without_tests(text: &str) -> String {
    let heads = ["\n#[cfg(test)]\nmod tests {", "\n#[cfg(test)]\npub(crate) mod tests {"];
    let end = heads.iter().filter_map(|head| text.find(head)).min().unwrap_or(text.len());
    let lines = text[..end].lines().filter(|line| !line.trim_start().starts_with("//"));
    lines.collect::<Vec<_>>().join("\n")
}

/// Every path that a `use` names, with whether it is handed on.
fn uses(text: &str) -> Vec<(Vec<String>, bool)> {
    let mut out = Vec::new();
    for (at, _) in text.match_indices("use ") {
        let before = text[..at].rsplit('\n').next().unwrap_or("").trim();
        let handed_on = before.starts_with("pub");
        if !(before.is_empty() || handed_on && before.len() < 12) {
            continue;
        }
        let Some(end) = text[at..].find(';') else { continue };
        let tree: String = text[at + 4..at + end].split_whitespace().collect::<Vec<_>>().join(" ");
        expand(&tree, &[], &mut |path| out.push((path, handed_on)));
    }
    out
}

/// The exported macros of a file, which the root hands on wherever they stand.
fn macros(text: &str, module: &[String]) -> Vec<(Vec<String>, bool)> {
    let rest = text
        .split("#[macro_export]")
        .skip(1)
        .filter_map(|rest| rest.trim_start().strip_prefix("macro_rules! "));
    let path = |name: &str| {
        let parts = std::iter::once("crate").chain(module.iter().map(String::as_str)).chain([name]);
        parts.map(str::to_owned).collect()
    };
    rest.filter_map(|rest| rest.split_whitespace().next()).map(|name| (path(name), true)).collect()
}

/// Calls `found` with every path of a tree such as `a::{b, c::{d, self}}`; of `x as y` with `x`.
fn expand(tree: &str, before: &[String], found: &mut impl FnMut(Vec<String>)) {
    let tree = tree.trim();
    match tree.find('{') {
        None => {
            let plain = tree.split(" as ").next().unwrap_or(tree);
            let parts = plain
                .split("::")
                .map(|part| part.trim().to_owned())
                .filter(|part| part != "self" || before.is_empty());
            found(before.iter().cloned().chain(parts).collect());
        }
        Some(open) => {
            let mut path = before.to_vec();
            path.extend(tree[..open].split("::").map(str::trim).filter(|p| !p.is_empty()).map(str::to_owned));
            let inside = &tree[open + 1..tree.rfind('}').unwrap_or(tree.len())];
            let (mut depth, mut start) = (0usize, 0);
            for (at, c) in inside.char_indices() {
                match c {
                    '{' => depth += 1,
                    '}' => depth -= 1,
                    ',' if depth == 0 => {
                        expand(&inside[start..at], &path, found);
                        start = at + 1;
                    }
                    _ => {}
                }
            }
            if !inside[start..].trim().is_empty() {
                expand(&inside[start..], &path, found);
            }
        }
    }
}

/// The path from the root of the crate; nothing if it leads outside.
fn absolute(path: &[String], module: &[String], files: &Files) -> Option<Vec<String>> {
    let mut at = match path.first().map(String::as_str)? {
        "crate" => Vec::new(),
        "self" => module.to_vec(),
        "super" => module[..module.len().checked_sub(1)?].to_vec(),
        name => {
            let mut child = module.to_vec();
            child.push(name.to_owned());
            // A child of this file; else another crate, or a name that is in scope.
            files.contains_key(&child).then_some(child)?
        }
    };
    for part in &path[1..] {
        if part == "super" {
            at.pop()?;
        } else {
            at.push(part.clone());
        }
    }
    Some(at)
}

/// The file that defines what a path names: through what files hand on.
fn defining(
    path: &[String],
    files: &Files,
    handed: &BTreeMap<Vec<String>, Vec<(Vec<String>, bool)>>,
    depth: usize,
) -> Option<Vec<String>> {
    let file = (0..=path.len()).rev().map(|n| path[..n].to_vec()).find(|p| files.contains_key(p))?;
    let Some(item) = path.get(file.len()) else { return Some(file) };
    if depth < 8 {
        for (target, _) in handed.get(&file).into_iter().flatten().filter(|(_, handed_on)| *handed_on) {
            if target.last() == Some(item) {
                match absolute(target, &file, files) {
                    Some(full) if full != path => return defining(&full, files, handed, depth + 1),
                    // Handed on from another crate: no file of this one defines it.
                    None if target[0].starts_with("noisefloor_") => return None,
                    _ => {}
                }
            }
        }
    }
    Some(file)
}

/// A circle of files, if there is one.
fn circle(arrows: &BTreeMap<Vec<String>, BTreeSet<Vec<String>>>) -> Vec<Vec<String>> {
    // What can be reached from a file and reaches it: small numbers, so that a plain search will do.
    let reach = |from: &Vec<String>| {
        let (mut seen, mut open) = (BTreeSet::new(), vec![from.clone()]);
        while let Some(file) = open.pop() {
            for next in arrows.get(&file).into_iter().flatten() {
                if seen.insert(next.clone()) {
                    open.push(next.clone());
                }
            }
        }
        seen
    };
    arrows.keys().filter(|file| reach(file).contains(*file)).cloned().collect()
}

#[test]
fn arrows_inside_crates_go_down_only() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates");
    let mut wrong = Vec::new();
    let mut looked = 0;
    for entry in std::fs::read_dir(crates).unwrap() {
        let source = entry.unwrap().path().join("src");
        let mut files = Files::new();
        read(&source, &[], &mut files);
        let mut handed: BTreeMap<_, _> =
            files.iter().map(|(module, text)| (module.clone(), uses(text))).collect();
        let root: Vec<_> = files.iter().flat_map(|(module, text)| macros(text, module)).collect();
        handed.entry(Vec::new()).or_default().extend(root);
        let mut arrows: BTreeMap<Vec<String>, BTreeSet<Vec<String>>> = BTreeMap::new();
        for (module, used) in &handed {
            for (path, _) in used {
                let Some(full) = absolute(path, module, &files) else { continue };
                if let Some(file) = defining(&full, &files, &handed, 0).filter(|file| file != module) {
                    arrows.entry(module.clone()).or_default().insert(file);
                    looked += 1;
                }
            }
        }
        let found = circle(&arrows);
        if !found.is_empty() {
            let name = |file: &[String]| if file.is_empty() { "lib".to_owned() } else { file.join("::") };
            let inside = |file: &Vec<String>| -> Vec<String> {
                let near = arrows[file].iter().filter(|near| found.contains(near));
                near.map(|near| format!("  {} uses {}", name(file), name(near))).collect()
            };
            let lines: Vec<String> = found.iter().flat_map(inside).collect();
            wrong.push(format!("{}:\n{}", source.display(), lines.join("\n")));
        }
    }
    assert!(looked > 500, "only {looked} arrows: the files are not read as they are written");
    assert!(wrong.is_empty(), "files in circles:\n{}", wrong.join("\n"));
}

#[test]
fn every_file_is_part_of_its_crate() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates");
    for entry in std::fs::read_dir(crates).unwrap() {
        let source = entry.unwrap().path().join("src");
        let mut files = Files::new();
        read(&source, &[], &mut files);
        for module in files.keys() {
            let Some((name, parent)) = module.split_last() else { continue };
            // By `mod`, or by its name in a list that a macro declares.
            let declares = |line: &str| {
                let declared =
                    line.rsplit("mod ").next().unwrap_or_default().trim().trim_end_matches([';', ',']);
                declared == name
            };
            let declared = files.get(parent).is_some_and(|text| text.lines().any(declares));
            assert!(declared, "{}: no file declares {}", source.display(), module.join("::"));
        }
    }
}

/// Crates of ours that a crate needs, itself among them, development dependencies left out.
fn needs(name: &str, crates: &Path, found: &mut BTreeSet<String>) {
    if !found.insert(name.to_owned()) {
        return;
    }
    let manifest = std::fs::read_to_string(crates.join(name).join("Cargo.toml")).unwrap();
    let sections = manifest.split("\n[").filter(|section| section.starts_with("dependencies]"));
    for line in sections.flat_map(str::lines).filter_map(|line| line.strip_prefix("noisefloor-")) {
        let other = line.split(['.', ' ', '=']).next().unwrap_or_default();
        needs(if other == "gltf" { "gltf-scene" } else { other }, crates, found);
    }
}

#[test]
fn pages_and_records_do_without_the_renderer() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates");
    for name in ["study", "questions", "report"] {
        let mut found = BTreeSet::new();
        needs(name, &crates, &mut found);
        assert!(found.len() > 3, "{name}: its manifest is not read as it is written: {found:?}");
        for absent in ["render", "harness", "registry", "cli"] {
            assert!(!found.contains(absent), "{name} needs {absent}");
        }
    }
    let mut of_report = BTreeSet::new();
    needs("report", &crates, &mut of_report);
    assert!(!of_report.contains("questions"), "the report knows a question");
}

#[test]
fn unsafe_is_in_the_engine_and_where_its_planes_are_vouched_for() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates/kernels/src");
    let mut files = Files::new();
    read(&source, &[], &mut files);
    let word = |line: &&str| line.split(|c: char| !c.is_alphanumeric() && c != '_').any(|w| w == "unsafe");
    let lines = |text: &str| text.lines().filter(word).count();
    let found: Vec<(String, usize)> = files
        .iter()
        .map(|(module, text)| (module.join("::"), lines(text)))
        .filter(|(_, count)| *count > 0)
        .collect();
    for (module, count) in &found {
        let places = [
            "nlm::tiled",
            "flash_filter::tiled",
            "regression::dense::fit",
            "regression::dense::means",
            "inside",
        ];
        let vouches = places.contains(&module.as_str());
        assert!(module.starts_with("engine::") || vouches && *count == 1, "{count} lines of {module}");
    }
    let all: usize = found.iter().map(|(_, count)| count).sum();
    assert!((1..=15).contains(&all), "{all} lines: {found:?}");
}
