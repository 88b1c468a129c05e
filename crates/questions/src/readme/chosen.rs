use noisefloor_study::exhibit::Table;
use noisefloor_study::summary::SceneSummary;

use super::asked::{Asked, Block};
use crate::view::View;

/// What a README's keys choose of a study.
#[derive(Debug)]
pub struct Chosen<'a> {
    pub(crate) view: &'a View<'a>,
    pub(crate) metric: &'a str,
    pub(crate) show: Show,
    pub(crate) scenes: Vec<&'a SceneSummary>,
    pub(crate) spp: Vec<u32>,
    pub(crate) rows: Vec<&'a str>,
}

/// Which numbers are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Show {
    Value,
    Ratio,
    Multiplier,
}

impl<'a> Chosen<'a> {
    pub(super) fn new(view: &'a View<'a>, asked: &Asked) -> Result<Self, String> {
        let study = &view.summary.study;
        let metric = match asked.keys.get("metric") {
            None => study.primary_metric.as_str(),
            Some(id) => &view.metric(id).ok_or_else(|| format!("the study has no metric `{id}`"))?.id,
        };
        let show = match asked.keys.get("show").map(String::as_str) {
            None | Some("value") => Show::Value,
            Some("ratio") => Show::Ratio,
            Some("multiplier") => Show::Multiplier,
            Some(other) => return Err(format!("show is `{other}`, not value, ratio or multiplier")),
        };
        let scenes = match asked.list("scenes") {
            ids if ids.is_empty() => view.summary.scenes.iter().collect(),
            ids => {
                let find = |id: &str| view.scene(id).ok_or_else(|| format!("the study has no scene `{id}`"));
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
        let labels = || view.summary.methods.iter().map(|m| m.label.as_str());
        let rows = match asked.list("rows") {
            wanted if wanted.is_empty() => labels().collect(),
            wanted => {
                let find = |label: &str| {
                    labels().find(|l| *l == label).ok_or_else(|| format!("the study has no row `{label}`"))
                };
                wanted.into_iter().map(find).collect::<Result<_, _>>()?
            }
        };
        Ok(Self { view, metric, show, scenes, spp, rows })
    }

    /// One table after the other, each below the scene's id where there are several; those without rows are left out.
    pub(crate) fn per_scene(&self, of: impl Fn(&SceneSummary) -> Option<Table>) -> Vec<Block> {
        let several = self.scenes.len() > 1;
        let one = |scene: &&SceneSummary| {
            let table = of(scene).filter(|table| !table.rows.is_empty())?;
            let head = several.then(|| Block::Text(format!("`{}`:", scene.id)));
            Some(head.into_iter().chain([Block::Table(table)]))
        };
        self.scenes.iter().filter_map(one).flatten().collect()
    }
}
