//! Verdicts on claims.

use noisefloor_stats::{Needed, Verdict};
use noisefloor_study::exhibit::{TableCell, Tone};
use noisefloor_study::format;
use noisefloor_study::summary::{ClaimSummary, Scale};

/// How a verdict sounds: only what was shown is green.
fn tone(verdict: Verdict) -> Tone {
    match verdict {
        Verdict::Shown => Tone::Good,
        Verdict::Refuted => Tone::Bad,
        Verdict::NotShown => Tone::Plain,
    }
}

/// A cell with the verdict behind it, and what it stands on shown on demand.
pub(crate) fn judged(cell: TableCell, claim: Option<&ClaimSummary>) -> TableCell {
    let Some(claim) = claim else { return cell };
    let tone = tone(claim.verdict);
    let about = super::joined(&[&cell.about, &details(claim)], "; ");
    TableCell { about, ..cell }.tag(claim.verdict.name(), tone, "").tone(tone)
}

/// The verdict alone.
pub(crate) fn word(claim: Option<&ClaimSummary>) -> TableCell {
    let Some(claim) = claim else { return TableCell::none() };
    TableCell::text(claim.verdict.name()).tone(tone(claim.verdict)).about(details(claim))
}

/// Region, p-values and what is missing.
fn details(claim: &ClaimSummary) -> String {
    let region = region(claim);
    let claimed = if region.is_empty() { String::new() } else { format!("claimed: {region}") };
    let p = claim.p.filter(|p| *p < 1.0).map_or_else(String::new, |p| {
        let adjusted =
            claim.p_adjusted.map_or_else(String::new, |p| format!(", {} after Holm", probability(p)));
        format!("p = {}{adjusted}", probability(p))
    });
    super::joined(&[&claimed, &p, &changed_by(claim)], "; ")
}

/// Where the effect must lie.
pub(crate) fn region(claim: &ClaimSummary) -> String {
    let Some(region) = claim.region else { return String::new() };
    let show = |v: f64| number(claim.scale, v);
    match (claim.scale, region.low, region.high) {
        (Scale::Share, low, high) if low <= 0.0 => format!("at most {}", show(high)),
        (Scale::Share, low, high) if high >= 1.0 => format!("at least {}", show(low)),
        (_, low, high) => format!("{} to {}", show(low), show(high)),
    }
}

/// A number on the scale of a claim.
pub(crate) fn number(scale: Scale, value: f64) -> String {
    match scale {
        Scale::Share => format::percent(value),
        Scale::Ratio => format::ratio(value),
        Scale::Number => format::significant(value, 3),
    }
}

/// `0.012`, or `< 0.0001`.
pub(crate) fn probability(p: f64) -> String {
    if p < 1e-4 { "< 0.0001".into() } else { format::significant(p, 2) }
}

/// What would change a verdict, in words.
pub(crate) fn changed_by(claim: &ClaimSummary) -> String {
    let needed = needed(claim.needed);
    if claim.alone == Verdict::Refuted && claim.verdict == Verdict::NotShown {
        return super::joined(&["refuted alone, but one of so many may be by chance", &needed], "; ");
    }
    needed
}

fn needed(needed: Needed) -> String {
    match needed {
        Needed::Nothing => String::new(),
        Needed::Interval => "needs a second replicate".into(),
        Needed::Replicates(count) => format!("needs about {count} replicates if the estimate stays"),
        Needed::Reference => "needs a longer reference".into(),
        Needed::Ratio => "cannot be judged: no positive ratio".into(),
        Needed::TooMany => {
            "at the edge of what is claimed: no number of replicates that anybody renders".into()
        }
    }
}
