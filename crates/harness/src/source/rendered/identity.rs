//! What tells rendered frames and scenes apart.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use noisefloor_frame::Statistic;
use noisefloor_render::{Keep, Prepared, Quantity};
use noisefloor_study::{Bits, Key};
use serde_json::{Value, json};

use crate::error::HarnessError;
use crate::source::probe::PROBE;

/// Everything that determines a frame.
pub(super) fn frame_identity(
    look: &Value,
    record: &BTreeMap<Quantity, Keep>,
    statistics: &[Statistic],
    spp: u32,
    seed: u64,
) -> Value {
    let mut all = json!({
        "look": look, "spp": spp, "seed": seed,
        "record": record.iter().map(|(q, k)| (q.name(), k)).collect::<BTreeMap<_, _>>(),
    });
    // Frames without any have the keys that they always had.
    if !statistics.is_empty() {
        let names: BTreeSet<String> = statistics.iter().map(ToString::to_string).collect();
        all["statistics"] = json!(names);
    }
    all
}

/// Hash of which pixels of a tiny image are of the scene's own classes.
pub(super) fn classes_of_probe(prepared: &Prepared) -> Result<Key, HarnessError> {
    let mut bits = Bits::of("classes");
    for class in noisefloor_render::pixel_classes(prepared, PROBE[0], PROBE[1])?.classes {
        bits.text(class.name());
    }
    Ok(bits.finish())
}

/// Hash of a scene's description: plain data without random state, so its printed form tells it completely.
pub(super) fn content_hash(scene: &noisefloor_scenes::Scene) -> String {
    struct Sink(blake3::Hasher);
    impl std::fmt::Write for Sink {
        fn write_str(&mut self, text: &str) -> std::fmt::Result {
            self.0.update(text.as_bytes());
            Ok(())
        }
    }
    let mut sink = Sink(blake3::Hasher::new());
    write!(sink, "{scene:?}").expect("hashing cannot fail");
    sink.0.finalize().to_hex()[..32].to_owned()
}
