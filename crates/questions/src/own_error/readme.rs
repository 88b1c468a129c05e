use noisefloor_study::exhibit::{Table, TableCell};
use noisefloor_study::summary::SceneSummary;

use super::analyse::id;
use super::exhibit::effect;
use crate::readme::{Block, Chosen, Kind, code, headed_by, plain, push};
use crate::shown;

pub(super) const KINDS: &[Kind] =
    &[Kind { name: "estimates", keys: &["scenes", "spp", "rows"], make: estimates }];

fn estimates(chosen: &Chosen<'_>) -> Vec<Block> {
    chosen.per_scene(|scene| Some(table(chosen, scene)))
}

fn table(chosen: &Chosen<'_>, scene: &SceneSummary) -> Table {
    let heads = ["samples per pixel", "row", "estimated", "measured", "estimated / measured", "verdict"];
    let mut out = headed_by(&format!("estimates-{}", scene.id), &heads);
    let here = chosen.view.summary.estimates.iter().filter(|e| {
        e.scene == scene.id
            && e.class == "all"
            && chosen.spp.contains(&e.spp)
            && chosen.rows.contains(&e.label.as_str())
    });
    for e in here {
        let cells = vec![
            TableCell::count(e.spp.into()),
            code(&e.label),
            plain(&shown::value(&e.estimated)),
            plain(&shown::value(&e.measured)),
            plain(&effect(e)),
            TableCell::text(
                chosen.view.claim(&id(&e.scene, e.spp, &e.label)).map_or("", |c| c.verdict.name()),
            ),
        ];
        push(&mut out, cells);
    }
    out
}
