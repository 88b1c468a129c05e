//! A plan for people.

use crate::plan::levels::{Level, Told};
use crate::plan::plans::Plans;
use crate::table::aligned;

/// What is told, what it costs, and how rough both are.
pub(super) fn text(plans: &Plans) -> String {
    let Plans { study, cells, finished_cells, pairs, metric, .. } = plans;
    let mut out = format!("{study}: {cells} cells, {finished_cells} of them finished\n\n");
    out.push_str(&format!(
        "ratio of {metric} nearest to 1 that is told from it, by 95 % intervals at the first step of Holm's rule over the {pairs} pairs of a \
         cell\n"
    ));
    out.push_str(&match &plans.spread_from {
        Some(from) => {
            let note = plans.spread_note.as_ref().map_or_else(String::new, |note| format!(", {note}"));
            format!("spread of log ratios over replicates: measured in {from}{note}\n\n")
        }
        None => {
            "spread of log ratios over replicates: not measured; what studies of this repository have\n\n"
                .to_owned()
        }
    });
    out.push_str(&aligned(&table(plans)));
    out.push_str(
        "\nThe noise of a common reference is not in it: it cancels where rows err alike, and no replicate removes it.\n",
    );
    out.push_str(&cost(plans));
    out
}

fn table(plans: &Plans) -> Vec<Vec<String>> {
    let share = format!("{:.0} %", 100.0 * plans.power);
    let ratio = plans.ratio;
    let heads = [
        "scene".to_owned(),
        "spp".into(),
        "replicates".into(),
        "pair".into(),
        "spread".into(),
        "half would tell".into(),
        format!("{share} would tell"),
        format!("for {ratio}: half"),
        share,
    ];
    let mut rows = vec![heads.to_vec()];
    for level in &plans.levels {
        for (place, told) in level.told.iter().enumerate() {
            rows.push(row(level, told, place == 0));
        }
    }
    rows
}

fn row(level: &Level, told: &Told, first: bool) -> Vec<String> {
    let of_level = |text: String| if first { text } else { String::new() };
    let ratio = |ratio: Option<f64>| ratio.map_or_else(|| "–".into(), |ratio| format!("{ratio:.4}"));
    let count = |count: Option<u32>| count.map_or_else(|| "> 65536".into(), |count| count.to_string());
    vec![
        of_level(level.scene.clone().unwrap_or_else(|| "any".into())),
        of_level(level.spp.map_or_else(|| "any".into(), |spp| spp.to_string())),
        of_level(level.replicates.to_string()),
        told.pair.clone(),
        format!("{:.4}", told.spread),
        ratio(told.ratio_told_by_half),
        ratio(told.ratio_told_with_power),
        count(told.replicates_for_half),
        count(told.replicates_with_power),
    ]
}

fn cost(plans: &Plans) -> String {
    let range = |[low, high]: [f64; 2]| format!("{} to {} minutes", minutes(low), minutes(high));
    let mut out = String::from("\nhere, ");
    out.push_str(&match plans.threads {
        1 => "with 1 thread:\n".into(),
        threads => format!("with {threads} threads:\n"),
    });
    out.push_str(&match plans.samples_per_second {
        Some(rate) => format!(
            "  rendering {:.1} million camera samples: {} ({:.2} million a second on a small scene; others take a third to three \
             times as long)\n",
            plans.samples as f64 * 1e-6,
            range(plans.render_minutes),
            rate * 1e-6
        ),
        None => "  nothing to render\n".into(),
    });
    out.push_str(&format!(
        "  denoising: {} (by what the methods' cards say, to a factor of three, if they use all threads)\n",
        range(plans.denoise_minutes)
    ));
    out
}

/// Two digits.
fn minutes(value: f64) -> String {
    match value {
        v if v >= 10.0 => format!("{v:.0}"),
        v if v >= 1.0 => format!("{v:.1}"),
        v if v >= 0.01 => format!("{v:.2}"),
        _ => "0".into(),
    }
}
