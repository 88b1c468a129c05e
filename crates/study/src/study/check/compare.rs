//! Comparisons with the source work.

use crate::error::StudyError;
use crate::study::compare::{PaperComparison, PaperRatio};
use crate::study::lines::Lines;
use crate::study::model::{SceneSource, SceneSpec, Study};

/// Refuses comparisons that name what the study does not have, or ratios that are none.
pub(super) fn check_comparisons(study: &Study, lines: &Lines<'_>) -> Result<(), StudyError> {
    study.compare.iter().enumerate().try_for_each(|(index, compare)| {
        check_one(study, compare).map_err(|(field, value, allowed)| StudyError::Field {
            place: lines.place(lines.compare.get(index).copied()),
            field: format!("compare[{index}].{field}"),
            value,
            allowed,
        })
    })
}

/// Field, value and what is allowed instead.
type Wrong = (String, String, String);

fn check_one(study: &Study, compare: &PaperComparison) -> Result<(), Wrong> {
    let wrong = |field: &str, value: String, allowed: String| Err((field.to_owned(), value, allowed));
    let quoted = |text: &str| format!("`{text}`");
    if compare.what.trim().is_empty() {
        return wrong("what", quoted(&compare.what), "some text".into());
    }
    let labels = || study.methods.iter().map(|row| row.label.as_str());
    for (field, label) in [("row", &compare.row), ("over", &compare.over)] {
        if !labels().any(|known| known == label) {
            let allowed = format!("the label of a row: {}", labels().collect::<Vec<_>>().join(", "));
            return wrong(field, quoted(label), allowed);
        }
    }
    if compare.row == compare.over {
        return wrong("over", quoted(&compare.over), "another row than `row`".into());
    }
    if !study.metrics.contains(&compare.metric) || !crate::metric::lower_is_better(&compare.metric) {
        let errors = study.metrics.iter().filter(|id| crate::metric::lower_is_better(id));
        let allowed = format!("an error: {}", errors.cloned().collect::<Vec<_>>().join(", "));
        return wrong("metric", quoted(&compare.metric), allowed);
    }
    let ids = || study.scenes.iter().map(|scene| scene.id.as_str());
    let of_study = || format!("ids of scenes: {}", ids().collect::<Vec<_>>().join(", "));
    if let Some(bad) = compare.scenes.iter().find(|id| !ids().any(|known| known == **id)) {
        return wrong("scene", quoted(bad), of_study());
    }
    if let Some(bad) = compare.paper_by_scene.keys().find(|id| !ids().any(|known| known == **id)) {
        return wrong("paper_by_scene", quoted(bad), of_study());
    }
    let listed = &compare.scenes;
    if let Some(bad) = compare.paper_by_scene.keys().find(|id| !listed.is_empty() && !listed.contains(id)) {
        return wrong(
            "paper_by_scene",
            quoted(bad),
            format!("scenes that `scene` lists: {}", listed.join(", ")),
        );
    }
    let single = compare.paper_by_scene.values().map(|ratio| ("paper_by_scene", ratio));
    for (field, PaperRatio { low, high }) in compare.paper.iter().map(|r| ("paper", r)).chain(single) {
        if !(*low > 0.0 && low <= high && high.is_finite()) {
            let value = if low == high { low.to_string() } else { format!("[{low}, {high}]") };
            return wrong(field, value, "a positive ratio of errors, or a range [low, high] of them".into());
        }
    }
    if compare.paper.is_none()
        && let Some(bare) = listed.iter().find(|id| !compare.paper_by_scene.contains_key(*id))
    {
        let allowed = format!("`paper`, or a number for `{bare}` in `paper_by_scene`");
        return wrong("paper", "absent".into(), allowed);
    }
    if compare.paper.is_none() && compare.paper_by_scene.is_empty() {
        return wrong("paper", "absent".into(), "the source's ratio, or `paper_by_scene`".into());
    }
    let concerned = || study.scenes.iter().filter(|scene| compare.paper(&scene.id).is_some());
    // Folders know their own levels.
    let open = |scene: &SceneSpec| scene.spp.is_none() && matches!(scene.source, SceneSource::Folder(_));
    if let Some(bad) = compare
        .spp
        .iter()
        .find(|spp| concerned().all(|scene| !open(scene) && !study.levels(scene).contains(spp)))
    {
        return wrong("spp", bad.to_string(), "levels of the scenes that are compared".into());
    }
    Ok(())
}
