use noisefloor_study::format;
use noisefloor_study::summary::{Source, Summary};

/// Where the intervals of this study come from.
pub(super) fn sentences(summary: &Summary) -> String {
    let intervals = || summary.cells.iter().flat_map(|c| c.metrics.values());
    let level = intervals().map(|i| i.confidence).next().map_or_else(|| "95 %".into(), format::percent_short);
    let has = |source: Source| intervals().any(|i| i.source == source);
    let mut sentences = Vec::new();
    if has(Source::Replicates) {
        sentences.push(format!(
            "± is half the {level} confidence interval over independent replicates, with the reference's own noise added."
        ));
    }
    if has(Source::WithinImage) {
        sentences.push(format!(
            "± is half the {level} interval from a bootstrap over 32×32 pixel blocks, within one image: it says nothing about other \
             random seeds."
        ));
    }
    if has(Source::None) {
        sentences.push("Numbers without ± have no estimate of their uncertainty.".into());
    }
    if intervals().any(|i| i.below.is_some()) {
        sentences
            .push("“<” marks errors that the reference's noise hides: the number is an upper limit.".into());
    }
    sentences.join(" ")
}
