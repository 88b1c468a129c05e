use noisefloor_stats::Verdict;
use noisefloor_study::exhibit::{Answer, Tone};
use noisefloor_study::format;
use noisefloor_study::summary::{BoundSummary, ClaimSummary, Scale};

use crate::bounds::id_of;
use crate::shown;
use crate::view::View;

pub(super) fn answer(view: &View<'_>) -> Option<Answer> {
    let mut told = Told { sentences: Vec::new(), broken: false };
    told.sentences.extend(family(view));
    told.sentences.extend(coverage(view));
    told.sentences.extend(estimates(view));
    kind(view, true, &mut told);
    kind(view, false, &mut told);
    enclosures(view, &mut told);
    let claims = &view.summary.claims;
    let refuted = told.broken || claims.iter().any(|claim| claim.verdict == Verdict::Refuted);
    // Green is for claims that were shown, every one of them; a study that was stopped shows none.
    let shown = !claims.is_empty() && claims.iter().all(|claim| claim.verdict == Verdict::Shown);
    let tone = match (refuted, shown && view.complete()) {
        (true, _) => Tone::Bad,
        (false, true) => Tone::Good,
        (false, false) => Tone::Plain,
    };
    let question = "Do the statistical claims hold?".into();
    (!told.sentences.is_empty()).then_some(Answer { question, sentences: told.sentences, tone })
}

struct Told {
    sentences: Vec<String>,
    /// Whether an output left where it is promised to stay for certain.
    broken: bool,
}

/// How many claims there are, and how many refutations chance alone would give.
fn family(view: &View<'_>) -> Option<String> {
    let claims = &view.summary.claims;
    if claims.is_empty() {
        return None;
    }
    let all = || claims.iter();
    let family = view.summary.family;
    Some(format!(
        "Of {}, {}. Each taken alone, {} would be refuted; at most {} by chance if all held.",
        format::plural(claims.len(), "claim"),
        counted(all()),
        family.refuted_alone,
        format::significant(family.by_chance, 2),
    ))
}

/// `3 are shown, 2 refuted and 4 not shown`.
fn counted<'a>(claims: impl Iterator<Item = &'a ClaimSummary> + Clone) -> String {
    let count = |verdict| claims.clone().filter(|claim| claim.verdict == verdict).count();
    format!(
        "{} shown, {} refuted, {} not shown",
        count(Verdict::Shown),
        count(Verdict::Refuted),
        count(Verdict::NotShown)
    )
}

/// Coverage of the input's intervals, with the worst cell.
fn coverage(view: &View<'_>) -> Option<String> {
    let claims = || view.summary.claims.iter().filter(|claim| claim.id.question == "coverage");
    let far = |claim: &&ClaimSummary| {
        let region = claim.region.map_or([0.0, 1.0], |region| [region.low, region.high]);
        (region[0] - claim.effect.value).max(claim.effect.value - region[1])
    };
    let worst = claims().max_by(|a, b| far(a).total_cmp(&far(b)))?;
    Some(format!(
        "Intervals of the input: {}; farthest off, {} cover where {} should ({}{}).",
        counted(claims()),
        shown::number(Scale::Share, worst.effect.value),
        worst.id.what,
        view.scene_title(&worst.id.scene),
        worst.id.spp.map_or_else(String::new, |spp| format!(", {spp} spp")),
    ))
}

/// Methods' estimates of their own error.
fn estimates(view: &View<'_>) -> Option<String> {
    let claims = || view.summary.claims.iter().filter(|claim| claim.id.question == "own_error");
    claims().next()?;
    Some(format!(
        "Estimates of a method's own error, within 0.8 to 1.25 of the measured one: {}.",
        counted(claims())
    ))
}

/// What holds of all bounds that are proven, or of all that are not.
fn kind(view: &View<'_>, proven: bool, told: &mut Told) {
    let of_kind = view.summary.bounds.iter().filter(|b| b.class == "all" && b.proven == proven);
    let of_kind: Vec<(&BoundSummary, &ClaimSummary)> =
        of_kind.filter_map(|b| Some((b, view.claim(&id_of(b))?))).collect();
    if of_kind.is_empty() {
        return;
    }
    let kind = if proven { "proven (for normal samples)" } else { "printed but unproven" };
    let counts = counted(of_kind.iter().map(|(_, claim)| *claim));
    let refuted = of_kind.iter().filter(|(_, claim)| claim.verdict == Verdict::Refuted);
    let broken: Vec<&BoundSummary> = refuted.map(|(b, _)| *b).collect();
    let example = worst(&broken).map_or_else(String::new, |worst| example(view, worst));
    told.sentences.push(format!("Error bounds, {kind}: {counts}{example}."));
    if let Some(worst) = worst(&broken).filter(|_| proven) {
        told.sentences.extend(cause(view, &broken, worst));
    }
}

/// The cell with the largest rate for what was promised.
fn worst<'a>(broken: &[&'a BoundSummary]) -> Option<&'a BoundSummary> {
    let by_rate = |a: &&&BoundSummary, b: &&&BoundSummary| {
        (a.violations.value * b.alpha).total_cmp(&(b.violations.value * a.alpha))
    };
    broken.iter().max_by(by_rate).copied()
}

fn example(view: &View<'_>, b: &BoundSummary) -> String {
    let missed = match b.missed > 0.0 {
        true => format!("; {} from missed events", format::percent(b.missed)),
        false => String::new(),
    };
    format!(
        "; worst {} beside a promised {} ({}, {} spp, {}{missed})",
        format::percent(b.violations.value),
        format::percent_short(b.alpha),
        view.scene_title(&b.scene),
        b.spp,
        b.label
    )
}

/// What breaks a bound whose proof assumes normal samples. If the output stayed where it promises to stay for certain, in an
/// interval around the noisy mean, then it can be farther from the truth than its bound only where the mean itself is
/// farther from the truth than normal samples would let it be that often. Nothing is said where that half of the claim is
/// unknown or did not hold.
fn cause(view: &View<'_>, broken: &[&BoundSummary], worst: &BoundSummary) -> Option<String> {
    let ratio = |b: &BoundSummary| view.cell(&b.scene, b.spp, &b.label)?.enclosure_worst_ratio;
    let held = |b: &&BoundSummary| ratio(b).is_some_and(|ratio| ratio <= 1.0);
    let nowhere_else = view.summary.cells.iter().filter_map(|c| c.enclosure_worst_ratio).all(|r| r <= 1.0);
    // Of an instrument with a fault nothing is concluded.
    let trusted = crate::failed_checks(view.summary).is_empty();
    if !(trusted && nowhere_else && broken.iter().all(held)) {
        return None;
    }
    let missed = match worst.missed > 0.0 {
        true => format!(
            " ({} of the violations in the worst cell are at pixels that met none)",
            // A mean over replicates and a share of all counts: rounding may part them.
            format::percent((worst.missed / worst.violations.value).min(1.0))
        ),
        false => String::new(),
    };
    Some(format!(
        "The light breaks them, not the program: no output left its interval around the noisy mean, so it is this mean that misses the \
         truth more often than the normal samples that the bound assumes would let it. Skewed light does that: its rare bright events \
         are met too seldom by many pixels, or never{missed}."
    ))
}

fn enclosures(view: &View<'_>, told: &mut Told) {
    let Some(worst) = view.summary.cells.iter().filter_map(|c| c.enclosure_worst_ratio).reduce(f64::max)
    else {
        return;
    };
    told.broken = worst > 1.0;
    told.sentences.push(if told.broken {
        format!(
            "An output left the interval that its method promises, by a factor of {}.",
            format::ratio(worst)
        )
    } else {
        "No output left its confidence interval where the method promises that.".into()
    });
}
