//! Look-ups in a summary that plots, tables and sentences share.

use std::collections::BTreeMap;

use noisefloor_study::exhibit::{RowKind, RowLook, TableCell};
use noisefloor_study::summary::{
    CellSummary, ClaimId, ClaimSummary, Comparison, Completion, MethodSummary, MetricInfo, SceneSummary,
    Summary,
};
use noisefloor_study::{BASELINE, RowFrames};

/// A summary with its look-up tables.
#[derive(Debug)]
pub struct View<'a> {
    /// The summary.
    pub summary: &'a Summary,
    cells: BTreeMap<(&'a str, u32, &'a str), &'a CellSummary>,
    comparisons: BTreeMap<(&'a str, u32, &'a str), &'a Comparison>,
    claims: BTreeMap<&'a ClaimId, &'a ClaimSummary>,
}

impl<'a> View<'a> {
    /// Makes the look-up tables.
    #[must_use]
    pub fn new(summary: &'a Summary) -> Self {
        let cells = summary.cells.iter().map(|c| ((c.scene.as_str(), c.spp, c.label.as_str()), c)).collect();
        let comparisons =
            summary.comparisons.iter().map(|c| ((c.scene.as_str(), c.spp, c.metric.as_str()), c)).collect();
        let claims = summary.claims.iter().map(|claim| (&claim.id, claim)).collect();
        Self { summary, cells, comparisons, claims }
    }

    pub(crate) fn cell(&self, scene: &str, spp: u32, label: &str) -> Option<&'a CellSummary> {
        self.cells.get(&(scene, spp, label)).copied()
    }

    /// The claim of this name, if it was judged.
    pub(crate) fn claim(&self, id: &ClaimId) -> Option<&'a ClaimSummary> {
        self.claims.get(id).copied()
    }

    pub(crate) fn comparison(&self, scene: &str, spp: u32, metric: &str) -> Option<&'a Comparison> {
        self.comparisons.get(&(scene, spp, metric)).copied()
    }

    /// Levels of a scene that have cells, ascending.
    pub(crate) fn levels(&self, scene: &str) -> impl Iterator<Item = u32> + use<> {
        let mut levels: Vec<u32> = self.cells.keys().filter(|k| k.0 == scene).map(|k| k.1).collect();
        levels.sort_unstable();
        levels.dedup();
        levels.into_iter()
    }

    pub(crate) fn metric(&self, id: &str) -> Option<&'a MetricInfo> {
        self.summary.study.metrics.iter().find(|m| m.id == id)
    }

    pub(crate) fn metric_name(&self, id: &str) -> String {
        self.metric(id).map_or_else(|| id.to_owned(), |m| m.name.clone())
    }

    /// Name with unit, for axes.
    pub(crate) fn metric_label(&self, id: &str) -> String {
        match self.metric(id) {
            Some(m) if !m.unit.is_empty() => format!("{} ({})", m.name, m.unit),
            _ => self.metric_name(id),
        }
    }

    /// Label of the row that is the unfiltered input.
    pub(crate) fn baseline(&self) -> Option<&'a str> {
        self.summary
            .methods
            .iter()
            .find(|m| m.method == BASELINE && m.frames == RowFrames::Uniform)
            .map(|m| m.label.as_str())
    }

    /// The level that a reader sees first: the middle one, the upper of two.
    pub(crate) fn default_spp(&self) -> Option<u32> {
        let spp = &self.summary.study.spp;
        spp.get(spp.len() / 2).copied()
    }

    /// Ranked rows of a level, best first: the comparison's ranking, else by the value itself. Rows that are left out of
    /// it are not among them.
    pub(crate) fn ranking(&self, scene: &str, spp: u32, metric: &str) -> Vec<&'a str> {
        let lower = self.lower_is_better(metric);
        let mut rows: Vec<(&'a str, f64)> = self
            .summary
            .methods
            .iter()
            .filter_map(|m| {
                let cell = self.cell(scene, spp, &m.label).filter(|cell| cell.left_out.is_none())?;
                let value = cell.metrics.get(metric)?.value;
                Some((m.label.as_str(), if lower { value } else { -value }))
            })
            .collect();
        // Values that are not numbers go last.
        rows.sort_by(|a, b| a.1.is_nan().cmp(&b.1.is_nan()).then(a.1.total_cmp(&b.1)));
        if let Some(comparison) = self.comparison(scene, spp, metric) {
            let place = |label: &str| comparison.ranking.iter().position(|l| l == label);
            rows.sort_by_key(|(label, _)| place(label).unwrap_or(usize::MAX));
        }
        rows.into_iter().map(|(label, _)| label).collect()
    }

    /// Rows that have numbers at a level and are left out of its ranking, with the reason.
    pub(crate) fn left_out(&self, scene: &str, spp: u32) -> Vec<(&'a CellSummary, &'a str)> {
        let rows = self.summary.methods.iter().filter_map(|m| self.cell(scene, spp, &m.label));
        rows.filter_map(|cell| Some((cell, cell.left_out.as_deref()?))).collect()
    }

    /// Whether a level of a scene has so few replicates behind its ranking that no rows can be told apart there.
    pub(crate) fn single(&self, scene: &str, spp: u32) -> bool {
        let here = self.summary.methods.iter().filter_map(|m| self.cell(scene, spp, &m.label));
        let counts = here.filter(|cell| cell.left_out.is_none()).map(|cell| cell.replicates);
        self.scene(scene).and_then(|s| s.replicates.get(&spp)) == Some(&1) || counts.max() == Some(1)
    }

    /// Rows other than `label` that the replicates cannot tell from the best; none where they tell nothing.
    pub(crate) fn tied(&self, scene: &str, spp: u32, metric: &str, label: &str) -> Vec<&'a str> {
        let group = self.comparison(scene, spp, metric).filter(|_| !self.single(scene, spp));
        let others = group.into_iter().flat_map(|c| &c.best_group).map(String::as_str);
        others.filter(|l| *l != label).collect()
    }

    /// Whether every cell that the study asks for ended; also where that is not known, which is told elsewhere.
    pub(crate) fn complete(&self) -> bool {
        self.summary.progress.as_ref().is_none_or(Completion::complete)
    }

    /// The same for a level of a scene.
    pub(crate) fn complete_at(&self, scene: &str, spp: u32) -> bool {
        self.summary.progress.as_ref().is_none_or(|progress| progress.complete_at(scene, spp))
    }

    /// Scenes that the study asks for at a level, begun or not.
    pub(crate) fn planned_scenes(&self, spp: u32) -> usize {
        let begun = self.summary.scenes.iter().filter(|s| s.replicates.contains_key(&spp));
        let mut ids: Vec<&str> = begun.map(|s| s.id.as_str()).collect();
        let missing = self.summary.progress.iter().flat_map(|p| &p.missing);
        ids.extend(missing.filter(|m| m.spp.contains(&spp)).map(|m| m.scene.as_str()));
        ids.sort_unstable();
        ids.dedup();
        ids.len()
    }

    pub(crate) fn scene(&self, id: &str) -> Option<&'a SceneSummary> {
        self.summary.scenes.iter().find(|s| s.id == id)
    }

    pub(crate) fn scene_title(&self, id: &str) -> String {
        self.scene(id).map_or_else(|| id.to_owned(), |s| s.title.clone())
    }

    /// Place of a row in the study; that of the first for one that is not there.
    pub(crate) fn row(&self, label: &str) -> usize {
        self.summary.methods.iter().position(|m| m.label == label).unwrap_or(0)
    }

    /// The name of a row with its look.
    pub(crate) fn row_cell(&self, label: &str) -> TableCell {
        TableCell::row(label, self.row(label))
    }

    /// Whether smaller values of a metric are better; also where that is not known.
    pub(crate) fn lower_is_better(&self, metric: &str) -> bool {
        self.metric(metric).is_none_or(|m| m.lower_is_better)
    }

    /// What the best value of a metric is called.
    pub(crate) fn best_word(&self, metric: &str) -> &'static str {
        if self.lower_is_better(metric) { "lowest" } else { "highest" }
    }

    /// Id and name of the study's first metric.
    pub(crate) fn primary(&self) -> (&'a str, String) {
        let id = self.summary.study.primary_metric.as_str();
        (id, self.metric_name(id))
    }

    /// How the rows look: a guarded row takes the colour of the row that it guards, one on frames of its own that of the
    /// same method on the study's.
    pub(crate) fn looks(&self) -> Vec<RowLook> {
        let methods = &self.summary.methods;
        let kind = |method: &MethodSummary| match inner(method, methods) {
            Some(of) if method.frames == RowFrames::Uniform => RowKind::Guarded(of),
            Some(of) => RowKind::OtherFrames(of),
            None if method.method == BASELINE && method.frames == RowFrames::Uniform => RowKind::Baseline,
            None => RowKind::Plain,
        };
        methods.iter().map(|m| RowLook { label: m.label.clone(), kind: kind(m) }).collect()
    }

    /// Scene ids as parts of file names, in the order of the scenes: letters, digits, `-` and `_`, made unique by their
    /// position.
    pub(crate) fn file_names(&self) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for (i, scene) in self.summary.scenes.iter().enumerate() {
            let mut name = file_name(&scene.id);
            if name.is_empty() || names.contains(&name) {
                name = format!("{name}-{}", i + 1);
            }
            names.push(name);
        }
        names
    }

    /// The scenes with their ids as parts of file names.
    pub(crate) fn named_scenes(&self) -> impl Iterator<Item = (&'a SceneSummary, String)> + use<'a> {
        self.summary.scenes.iter().zip(self.file_names())
    }

    /// Whether the study wants charts of this kind.
    pub(crate) fn draws(&self, kind: &str) -> bool {
        let chosen = &self.summary.study.figures;
        chosen.is_empty() || chosen.iter().any(|figure| figure == kind)
    }
}

/// A name as part of file names: letters, digits, `-` and `_`.
pub(crate) fn file_name(name: &str) -> String {
    let safe = |c: char| if c.is_ascii_alphanumeric() || c == '-' || c == '_' { c } else { '-' };
    name.chars().map(safe).take(60).collect()
}

/// Place of the row that this one is a variant of, if both are rows of the study: `guarded(x) more` guards `x more`, else a
/// row of the method `x`; a row on frames of its own belongs to the same method and parameters on the study's.
fn inner(method: &MethodSummary, methods: &[MethodSummary]) -> Option<usize> {
    if method.frames != RowFrames::Uniform {
        let same = |m: &MethodSummary| {
            m.frames == RowFrames::Uniform && (&m.method, &m.params) == (&method.method, &method.params)
        };
        return methods.iter().position(same);
    }
    let (name, suffix) =
        method.label.strip_prefix("guarded(").and_then(|l| l.rsplit_once(')')).unwrap_or_default();
    let label = format!("{name}{suffix}");
    let id = method.method.strip_prefix("guarded(").and_then(|m| m.strip_suffix(')'));
    let by_label = methods.iter().position(|m| !name.is_empty() && m.label == label);
    by_label.or_else(|| methods.iter().position(|m| Some(m.method.as_str()) == id))
}
