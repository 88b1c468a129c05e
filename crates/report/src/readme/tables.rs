//! The kinds of tables.
//!
//! | kind | shows | keys |
//! | --- | --- | --- |
//! | `answers` | the first screen's sentences | |
//! | `levels` | a table per scene: levels down, rows of the study across | `metric`, `show`, `scenes`, `spp`, `rows` |
//! | `methods` | rows of the study down, scenes and levels across | the same |
//! | `coverage` | coverage of the input's intervals, per scene | `scenes`, `spp` |
//! | `bounds` | violations of error bounds, per scene | `scenes`, `spp`, `rows` |
//! | `slopes` | slopes and verdicts | `metric`, `scenes`, `rows` |
//! | `paper` | ratios beside the source work's | |
//! | `equal-time` | samples for equal time | |
//! | `estimates` | methods' estimates of their own error | `scenes`, `spp`, `rows` |
//! | `flicker` | errors that change from frame to frame | |
//! | `absent` | rows that did not run or are not ranked, with the reason | |
//! | `machine` | cells, processor, build, load and date | |
//!
//! `show` is `value`, `ratio` (to plain Monte Carlo) or `multiplier` (samples for an equal error); lists are split at `;`.

use noisefloor_harness::summary::{CellSummary, SceneSummary};

use crate::format;
use crate::index::Index;
use crate::readme::Directive;
use crate::view;

/// Rows of cells, the first of them the head.
type Table = Vec<Vec<String>>;

/// Makes a block's contents; the error is a clause for people.
pub(super) fn table(index: &Index<'_>, asked: &Directive) -> Result<String, String> {
    let allowed: &[&str] = match asked.kind.as_str() {
        "levels" | "methods" => &["metric", "show", "scenes", "spp", "rows"],
        "coverage" => &["scenes", "spp"],
        "bounds" | "estimates" => &["scenes", "spp", "rows"],
        "slopes" => &["metric", "scenes", "rows"],
        _ => &[],
    };
    if let Some(key) = asked.keys.keys().find(|key| !allowed.contains(&key.as_str())) {
        return Err(format!("`{}` has no key `{key}`; it has {}", asked.kind, list_or_none(allowed)));
    }
    let chosen = Chosen::new(index, asked)?;
    Ok(match asked.kind.as_str() {
        "answers" => answers(index),
        "levels" => chosen.per_scene(|scene| chosen.levels(scene)),
        "methods" => markdown(&chosen.methods()),
        "coverage" => chosen.per_scene(|scene| chosen.coverage(scene)),
        "bounds" => chosen.per_scene(|scene| chosen.bounds(scene)),
        "estimates" => chosen.per_scene(|scene| chosen.estimates(scene)),
        "slopes" => chosen.slopes(),
        "paper" => markdown(&paper(index)),
        "equal-time" => markdown(&equal_time(index)),
        "flicker" => markdown(&flicker(index)),
        "absent" => absent(index),
        "machine" => machine(index),
        other => return Err(format!("there is no table `{other}`")),
    })
}

fn list_or_none(names: &[&str]) -> String {
    if names.is_empty() { "none".into() } else { format::list(names) }
}

/// What a marker's keys choose of a study.
struct Chosen<'a> {
    index: &'a Index<'a>,
    metric: &'a str,
    show: Show,
    scenes: Vec<&'a SceneSummary>,
    spp: Vec<u32>,
    rows: Vec<&'a str>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Show {
    Value,
    Ratio,
    Multiplier,
}

impl<'a> Chosen<'a> {
    fn new(index: &'a Index<'a>, asked: &Directive) -> Result<Self, String> {
        let study = &index.summary.study;
        let metric = match asked.keys.get("metric") {
            None => study.primary_metric.as_str(),
            Some(id) => &index.metric(id).ok_or_else(|| format!("the study has no metric `{id}`"))?.id,
        };
        let show = match asked.keys.get("show").map(String::as_str) {
            None | Some("value") => Show::Value,
            Some("ratio") => Show::Ratio,
            Some("multiplier") => Show::Multiplier,
            Some(other) => return Err(format!("show is `{other}`, not value, ratio or multiplier")),
        };
        let scenes = match asked.list("scenes") {
            ids if ids.is_empty() => index.summary.scenes.iter().collect(),
            ids => {
                let find = |id: &str| index.scene(id).ok_or_else(|| format!("the study has no scene `{id}`"));
                ids.into_iter().map(find).collect::<Result<_, _>>()?
            }
        };
        let spp = match asked.list("spp") {
            levels if levels.is_empty() => study.spp.clone(),
            levels => {
                let level = |text: &str| {
                    let level = text.parse().ok().filter(|n| study.spp.contains(n));
                    level.ok_or_else(|| format!("the study has no level `{text}`"))
                };
                levels.into_iter().map(level).collect::<Result<_, _>>()?
            }
        };
        let labels = || index.summary.methods.iter().map(|m| m.label.as_str());
        let rows = match asked.list("rows") {
            wanted if wanted.is_empty() => labels().collect(),
            wanted => {
                let find = |label: &str| {
                    labels().find(|l| *l == label).ok_or_else(|| format!("the study has no row `{label}`"))
                };
                wanted.into_iter().map(find).collect::<Result<_, _>>()?
            }
        };
        Ok(Self { index, metric, show, scenes, spp, rows })
    }

    /// One table after the other, each below the scene's id where there are several.
    fn per_scene(&self, of: impl Fn(&SceneSummary) -> Table) -> String {
        let several = self.scenes.len() > 1;
        let one = |scene: &&SceneSummary| {
            let table = of(scene);
            let head = if several { format!("`{}`:\n\n", scene.id) } else { String::new() };
            (table.len() > 1).then(|| head + &markdown(&table))
        };
        self.scenes.iter().filter_map(one).collect::<Vec<_>>().join("\n")
    }

    fn cell(&self, scene: &str, spp: u32, label: &str) -> String {
        let Some(cell) = self.index.cell(scene, spp, label) else { return "–".into() };
        let text = self.number(cell).unwrap_or_else(|| "–".into());
        if cell.left_out.is_some() { format!("{text} \\*") } else { text }
    }

    fn number(&self, cell: &CellSummary) -> Option<String> {
        let ratio = |i: &noisefloor_harness::summary::Interval| {
            let spread = if i.low < i.high { format::bracket(i, format::ratio) } else { String::new() };
            format!("{} {spread}", format::ratio(i.value)).trim_end().to_owned()
        };
        match self.show {
            Show::Value => cell.metrics.get(self.metric).map(|i| format::interval(i).line()),
            Show::Ratio => cell.ratio_to_mc.get(self.metric).map(ratio),
            Show::Multiplier => {
                let beyond = cell.equal_error_extrapolated.get(self.metric) == Some(&true);
                let text = cell.equal_error.get(self.metric).map(ratio)?;
                Some(if beyond { format!("{text} (extrapolated)") } else { text })
            }
        }
    }

    /// Rows that have a number at one of the chosen places; the ratio of the baseline to itself says nothing.
    fn shown_rows(&self, scenes: &[&SceneSummary]) -> Vec<&'a str> {
        let plain = self.index.baseline().filter(|_| self.show != Show::Value);
        let has = |label: &str| {
            let places = scenes.iter().flat_map(|s| self.spp.iter().map(move |&n| (s.id.as_str(), n)));
            places.into_iter().any(|(scene, spp)| self.cell(scene, spp, label) != "–")
        };
        self.rows.iter().copied().filter(|label| Some(*label) != plain && has(label)).collect()
    }

    fn levels(&self, scene: &SceneSummary) -> Table {
        let rows = self.shown_rows(&[scene]);
        let mut out = vec![head("samples per pixel", rows.iter().map(|row| format!("`{row}`")))];
        for &spp in self.spp.iter().filter(|n| scene.replicates.contains_key(n)) {
            out.push(head(&spp.to_string(), rows.iter().map(|row| self.cell(&scene.id, spp, row))));
        }
        out
    }

    fn methods(&self) -> Table {
        let places: Vec<(&str, u32)> = self
            .scenes
            .iter()
            .flat_map(|s| {
                self.spp.iter().filter(|n| s.replicates.contains_key(n)).map(|&n| (s.id.as_str(), n))
            })
            .collect();
        let mut out = vec![head("row", places.iter().map(|(scene, spp)| format!("{scene}, {spp} spp")))];
        for row in self.shown_rows(&self.scenes) {
            let cells = places.iter().map(|&(scene, spp)| self.cell(scene, spp, row));
            out.push(head(&format!("`{row}`"), cells));
        }
        out
    }

    fn coverage(&self, scene: &SceneSummary) -> Table {
        let Some(view) = view::coverage(self.index, scene) else { return Table::new() };
        let nominal = view.nominal.iter().map(|n| format!("nominal {n}"));
        let mut out =
            vec![head("samples per pixel", nominal.chain(["constant".into(), "missed events".into()]))];
        for row in view.rows.iter().filter(|row| self.spp.contains(&row.spp)) {
            let levels = row.levels.iter().map(|(value, spread, _)| join(value, spread));
            out.push(head(&row.spp.to_string(), levels.chain([row.constant.clone(), row.missed.clone()])));
        }
        marked(&mut out);
        out
    }

    fn bounds(&self, scene: &SceneSummary) -> Table {
        let Some(view) = view::bounds(self.index, scene) else { return Table::new() };
        let claims: Vec<_> = view.rows.iter().filter(|row| self.rows.contains(&row.label.as_str())).collect();
        let names = claims.iter().map(|row| {
            let kind = if row.proven { "proven" } else { "unproven" };
            format!("`{}`: {} ({kind}, α {})", row.label, row.claim, row.alpha)
        });
        let mut out = vec![head("samples per pixel", names)];
        for (k, spp) in view.spp.iter().enumerate().filter(|(_, spp)| self.spp.contains(spp)) {
            let cell = |row: &&view::BoundRow| {
                row.cells[k].as_ref().map_or_else(
                    || "–".into(),
                    |c| {
                        let mark = if c.marked { " \\*" } else { "" };
                        format!("{}{mark} {}", c.rate, c.verdict)
                    },
                )
            };
            out.push(head(&spp.to_string(), claims.iter().map(cell)));
        }
        out
    }

    fn estimates(&self, scene: &SceneSummary) -> Table {
        let Some(view) = view::estimates(self.index, scene) else { return Table::new() };
        let heads = ["row", "estimated", "measured", "estimated / measured", "verdict"];
        let mut out = vec![head("samples per pixel", heads.map(String::from))];
        let here =
            |row: &&view::EstimateRow| self.spp.contains(&row.spp) && self.rows.contains(&row.label.as_str());
        for row in view.rows.iter().filter(here) {
            let effect = join(&row.effect.value, &row.effect.spread);
            let effect = if row.is_ratio { effect } else { format!("difference {effect}") };
            out.push(head(
                &row.spp.to_string(),
                [
                    format!("`{}`", row.label),
                    join(&row.estimated.value, &row.estimated.spread),
                    join(&row.measured.value, &row.measured.spread),
                    effect,
                    row.verdict.clone(),
                ],
            ));
        }
        out
    }

    fn slopes(&self) -> String {
        let several = self.scenes.len() > 1;
        let mut out = String::new();
        for scene in &self.scenes {
            for slope in self.index.summary.slopes.iter().filter(|s| {
                s.scene == scene.id && s.metric == self.metric && self.rows.contains(&s.label.as_str())
            }) {
                let place = if several { format!(" on {}", scene.id) } else { String::new() };
                out.push_str(&format!("* `{}`{place}: {}\n", slope.label, slope.sentence));
            }
        }
        out
    }
}

fn answers(index: &Index<'_>) -> String {
    let answers = view::answers(index);
    answers.iter().map(|a| format!("* **{}** {}\n", a.question, a.sentences.join(" "))).collect()
}

fn paper(index: &Index<'_>) -> Table {
    let heads = ["scene", "samples per pixel", "ours, 95 %", "source", "in words"];
    let mut out = vec![head("what", heads.map(String::from))];
    for row in view::paper(index) {
        let words = match row.reason.as_str() {
            "" => row.verdict.clone(),
            reason => format!("{}: {reason}", row.verdict),
        };
        out.push(head(
            &row.what,
            [
                row.scene.clone(),
                row.spp.to_string(),
                join(&row.ours.value, &row.ours.spread),
                format!("{} ({})", row.paper, row.source),
                words,
            ],
        ));
    }
    out
}

fn equal_time(index: &Index<'_>) -> Table {
    let heads = ["row", "as much time as", "level", "used", "implied by this run", "denoising", "one sample"];
    let mut out = vec![head("scene", heads.map(String::from))];
    for row in view::equal_time(index.summary) {
        out.push(head(
            &row.scene,
            [
                row.label,
                row.with,
                row.spp.to_string(),
                row.used.to_string(),
                row.implied,
                row.denoise,
                row.per_sample,
            ],
        ));
    }
    out
}

fn flicker(index: &Index<'_>) -> Table {
    let heads = ["samples per pixel", "row", "temporal variance", "ratio to the first row", "squared error"];
    let mut out = vec![head("sequence", heads.map(String::from))];
    for view in view::flicker(index) {
        for row in view.rows {
            out.push(head(
                &view.sequence,
                [
                    row.spp.to_string(),
                    format!("`{}`", row.label),
                    join(&row.variance.value, &row.variance.spread),
                    join(&row.ratio.value, &row.ratio.spread),
                    join(&row.squared.value, &row.squared.spread),
                ],
            ));
        }
    }
    out
}

fn absent(index: &Index<'_>) -> String {
    let mut out = String::new();
    for entry in &index.summary.skipped {
        let spp: Vec<String> = entry.spp.iter().map(u32::to_string).collect();
        out.push_str(&format!(
            "* `{}` {} on {} at {} spp: {}\n",
            entry.label,
            entry.status,
            entry.scene,
            format::list(&spp),
            entry.reason
        ));
    }
    for cell in &index.summary.cells {
        if let Some(reason) = &cell.left_out {
            let (label, scene, spp) = (&cell.label, &cell.scene, cell.spp);
            out.push_str(&format!("* `{label}` on {scene} at {spp} spp is not ranked: {reason}\n"));
        }
    }
    if out.is_empty() && index.summary.progress.as_ref().is_some_and(|p| p.complete()) {
        out.push_str("Every method ran on every frame.\n");
    }
    out
}

fn machine(index: &Index<'_>) -> String {
    let environment = &index.summary.environment;
    let cells = match &index.summary.progress {
        Some(progress) if progress.complete() => {
            format!("All {} cells of the study ended. ", progress.planned)
        }
        Some(progress) => format!("**Unfinished**: {progress}. "),
        None => String::new(),
    };
    let load = environment
        .load_at_start
        .map_or_else(String::new, |load| format!("; load {} when it began", format::significant(load, 2)));
    format!(
        "{cells}Made by noisefloor {} ({} build) on {}, {}, {}{load}.\n",
        environment.version,
        environment.profile,
        environment.cpu,
        format::plural(environment.threads as usize, "thread"),
        environment.simd
    )
}

fn head(first: &str, others: impl IntoIterator<Item = String>) -> Vec<String> {
    std::iter::once(first.to_owned()).chain(others).collect()
}

/// A star in Markdown text is one that is not obeyed.
fn marked(table: &mut Table) {
    for cell in table.iter_mut().flatten() {
        if cell.contains(" *") {
            *cell = cell.replace(" *", " \\*");
        }
    }
}

fn join(value: &str, spread: &str) -> String {
    format!("{value} {spread}").trim_end().to_owned()
}

/// A pipe table: the first column to the left, the others to the right.
fn markdown(table: &Table) -> String {
    let mut out = String::new();
    for (k, row) in table.iter().enumerate() {
        let cells: Vec<String> = row.iter().map(|cell| cell.replace('|', "\\|")).collect();
        out.push_str(&format!("| {} |\n", cells.join(" | ")));
        if k == 0 {
            out.push_str(&format!("| --- |{}\n", " ---: |".repeat(row.len() - 1)));
        }
    }
    out
}
