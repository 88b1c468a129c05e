use noisefloor_study::format;

use crate::readme::{Block, Chosen, Kind, lines};

pub(super) const KINDS: &[Kind] = &[Kind { name: "absent", keys: &[], make: absent }];

fn absent(chosen: &Chosen<'_>) -> Vec<Block> {
    let summary = chosen.view.summary;
    let mut out = Vec::new();
    for entry in &summary.skipped {
        out.push(format!(
            "* `{}` {} on {} at {} spp: {}",
            entry.label,
            entry.status,
            entry.scene,
            format::list(&entry.spp.iter().map(u32::to_string).collect::<Vec<_>>()),
            entry.reason
        ));
    }
    for cell in &summary.cells {
        if let Some(reason) = &cell.left_out {
            let (label, scene, spp) = (&cell.label, &cell.scene, cell.spp);
            out.push(format!("* `{label}` on {scene} at {spp} spp is not ranked: {reason}"));
        }
    }
    if out.is_empty() && summary.progress.as_ref().is_some_and(|p| p.complete()) {
        out.push("Every method ran on every frame.".into());
    }
    lines(out)
}
