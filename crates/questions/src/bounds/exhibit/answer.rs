use noisefloor_study::exhibit::{Answer, Tone};
use noisefloor_study::format;
use noisefloor_study::summary::{BoundState, BoundSummary};

use crate::view::View;

pub(in crate::bounds) fn answer(view: &View<'_>) -> Option<Answer> {
    // Green is for promises that were tested and held; coverage alone, or a study that was stopped, shows none.
    let good = if view.complete() { Tone::Good } else { Tone::Plain };
    let mut told = Told { sentences: coverage(view).into_iter().collect(), tone: Tone::Plain, good };
    kind(view, true, &mut told);
    kind(view, false, &mut told);
    enclosures(view, &mut told);
    let Told { sentences, tone, .. } = told;
    let question = "Do the statistical claims hold?".into();
    (!sentences.is_empty()).then_some(Answer { question, sentences, tone })
}

struct Told {
    sentences: Vec<String>,
    tone: Tone,
    /// How a promise that held sounds.
    good: Tone,
}

impl Told {
    fn held(&mut self, sentence: String) {
        if self.tone == Tone::Plain {
            self.tone = self.good;
        }
        self.sentences.push(sentence);
    }

    fn broken(&mut self, sentence: String) {
        self.tone = Tone::Bad;
        self.sentences.push(sentence);
    }
}

/// What holds of all bounds that are proven, or of all that are not.
fn kind(view: &View<'_>, proven: bool, told: &mut Told) {
    let of_kind: Vec<&BoundSummary> =
        view.summary.bounds.iter().filter(|b| b.class == "all" && b.proven == proven).collect();
    if of_kind.is_empty() {
        return;
    }
    let kind = if proven { "proven (for normal samples)" } else { "printed but unproven" };
    let cells = of_kind.len();
    let broken: Vec<&BoundSummary> =
        of_kind.iter().copied().filter(|b| b.verdict == BoundState::Fails).collect();
    let undecided = of_kind.iter().filter(|b| b.verdict == BoundState::Undecided).count();
    if let Some(worst) = worst(&broken) {
        told.broken(format!(
            "Error bounds, {kind}: broken more often than promised in {} of {cells} cells{}.",
            broken.len(),
            example(view, worst)
        ));
        told.sentences.extend(cause(view, &broken, worst).filter(|_| proven));
    } else if undecided > 0 {
        told.sentences.push(format!(
            "Error bounds, {kind}: undecided in {undecided} of {cells} cells, where one replicate gives no interval; broken no more \
             often than promised in the others."
        ));
    } else {
        told.held(format!("Error bounds, {kind}: broken no more often than promised in all {cells} cells."));
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
    if !(nowhere_else && broken.iter().all(held)) {
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
    if worst <= 1.0 {
        told.held("No output left its confidence interval where the method promises that.".into());
    } else {
        told.broken(format!(
            "An output left the interval that its method promises, by a factor of {}.",
            format::ratio(worst)
        ));
    }
}

/// Range of the coverage over the scenes at the first and the last level, for the lowest nominal level.
fn coverage(view: &View<'_>) -> Option<String> {
    let all = || view.summary.coverage.iter().filter(|c| c.class == "all");
    let nominal = all().map(|c| c.confidence).fold(f64::INFINITY, f64::min);
    let (first, last) = (all().map(|c| c.spp).min()?, all().map(|c| c.spp).max()?);
    let range = |spp: u32| {
        let values = all().filter(|c| c.spp == spp && c.confidence == nominal).map(|c| c.covered.value);
        let (low, high) =
            values.fold((f64::INFINITY, 0.0f64), |(low, high), v| (f64::min(low, v), high.max(v)));
        let (low, high) = (format::percent(low), format::percent(high));
        let text = if low == high { low } else { format!("{} to {high}", low.trim_end_matches(" %")) };
        format!("{text} of the pixels at {spp} spp")
    };
    let at_last = if last > first { format!(", {}", range(last)) } else { String::new() };
    let nominal = format::percent_short(nominal);
    Some(format!("Nominal {nominal} intervals of the input cover {}{at_last}.", range(first)))
}
