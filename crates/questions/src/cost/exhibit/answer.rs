use std::collections::BTreeMap;

use noisefloor_study::exhibit::{Answer, Tone};
use noisefloor_study::summary::SceneSummary;
use noisefloor_study::{BASELINE, format};

use crate::view::View;

/// Times per frame, of frames of one size at a time: larger frames take longer, whatever the method.
pub(in crate::cost) fn answer(view: &View<'_>) -> Option<Answer> {
    let spp = view.default_spp()?;
    let mut sizes: BTreeMap<(u64, u32, u32), Vec<&SceneSummary>> = BTreeMap::new();
    for scene in &view.summary.scenes {
        let pixels = u64::from(scene.width) * u64::from(scene.height);
        sizes.entry((pixels, scene.width, scene.height)).or_default().push(scene);
    }
    let of_size = |((_, w, h), scenes): (&(u64, u32, u32), &Vec<&SceneSummary>)| {
        Some(format!("{}.", of_frame(view, scenes, spp, &format!("a frame of {w}×{h}"))?))
    };
    let sentences: Vec<String> = sizes.iter().rev().filter_map(of_size).collect();
    let question = "What does it cost?".into();
    (!sentences.is_empty()).then_some(Answer { question, sentences, tone: Tone::Plain })
}

/// The fastest and the slowest row on frames of one size, beside their rendering.
fn of_frame(view: &View<'_>, scenes: &[&SceneSummary], spp: u32, frame: &str) -> Option<String> {
    let mut times: Vec<(f64, &str)> = Vec::new();
    for method in view.summary.methods.iter().filter(|m| m.method != BASELINE) {
        let of = |s: &&SceneSummary| view.cell(&s.id, spp, &method.label)?.denoise_seconds;
        let seconds = scenes.iter().filter_map(of).fold(0.0, f64::max);
        if seconds > 0.0 {
            times.push((seconds, &method.label));
        }
    }
    times.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut sentence = match times.as_slice() {
        [] => return None,
        [(t, label)] => format!("{label} takes {} {frame}", format::duration(*t)),
        [fast, .., slow] => format!(
            "From {} ({}) to {} ({}) {frame}",
            format::duration(fast.0),
            fast.1,
            format::duration(slow.0),
            slow.1
        ),
    };
    let rendering: Vec<f64> = scenes.iter().filter_map(|s| s.render_seconds.get(&spp).copied()).collect();
    let longest = rendering.iter().copied().fold(0.0, f64::max);
    let shortest = rendering.iter().copied().fold(f64::INFINITY, f64::min);
    if longest > 0.0 {
        let span = if longest < 1.2 * shortest {
            format::duration(longest)
        } else {
            format!("{} to {}", format::duration(shortest), format::duration(longest))
        };
        sentence += &format!(", beside {span} for rendering its {spp} spp");
    }
    Some(sentence)
}
