use noisefloor_study::exhibit::{Table, TableCell};
use noisefloor_study::format;
use noisefloor_study::summary::{BoundSummary, SceneSummary};

use super::analyse::id_of;
use super::exhibit::{Promises, promises};
use crate::readme::{Block, Chosen, Kind, headed, push};
use crate::view::View;

pub(super) const KINDS: &[Kind] = &[Kind { name: "bounds", keys: &["scenes", "spp", "rows"], make: bounds }];

fn bounds(chosen: &Chosen<'_>) -> Vec<Block> {
    chosen.per_scene(|scene| Some(table(chosen, scene, &promises(chosen.view, &scene.id)?)))
}

fn table(chosen: &Chosen<'_>, scene: &SceneSummary, promises: &Promises<'_>) -> Table {
    let claims: Vec<_> = promises
        .claims
        .iter()
        .filter(|claim| claim.class == "all" && chosen.rows.contains(&claim.label))
        .collect();
    let names = claims.iter().map(|claim| {
        let alpha = format::percent_short(claim.alpha);
        format!("`{}`: {} ({}, α {alpha})", claim.label, claim.claim, claim.kind())
    });
    let first = std::iter::once("samples per pixel".to_owned());
    let mut out = headed(format!("bounds-{}", scene.id), first.chain(names));
    for (k, spp) in promises.spp.iter().enumerate().filter(|(_, spp)| chosen.spp.contains(spp)) {
        let cells =
            claims.iter().map(|claim| claim.found[k].map_or_else(TableCell::none, |b| rate(chosen.view, b)));
        push(&mut out, std::iter::once(TableCell::count((*spp).into())).chain(cells).collect());
    }
    out
}

fn rate(view: &View<'_>, b: &BoundSummary) -> TableCell {
    let mark = if b.mark.is_some() { " \\*" } else { "" };
    let rate = format::percent_interval(&b.violations).value;
    let verdict = view.claim(&id_of(b)).map_or("", |claim| claim.verdict.name());
    TableCell::text(format!("{rate}{mark} {verdict}")).number((&b.violations).into())
}
