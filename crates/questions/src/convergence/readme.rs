use crate::readme::{Block, Chosen, Kind, lines};

pub(super) const KINDS: &[Kind] =
    &[Kind { name: "slopes", keys: &["metric", "scenes", "rows"], make: slopes }];

fn slopes(chosen: &Chosen<'_>) -> Vec<Block> {
    let several = chosen.scenes.len() > 1;
    let mut out = Vec::new();
    for scene in &chosen.scenes {
        let here = chosen.view.summary.slopes.iter().filter(|s| {
            s.scene == scene.id && s.metric == chosen.metric && chosen.rows.contains(&s.label.as_str())
        });
        for slope in here {
            let place = if several { format!(" on {}", scene.id) } else { String::new() };
            out.push(format!("* `{}`{place}: {}", slope.label, slope.sentence));
        }
    }
    lines(out)
}
