//! A reference that shares samples with the frames that are held against it.

use std::collections::BTreeMap;
use std::sync::Mutex;

use noisefloor_frame::{Frame, Image, Reference};
use noisefloor_harness::{Laboratory, Passing};
use noisefloor_study::check::CheckKind;

use super::planted::{SMALL, measured, named, silent};

const SCENE: &str = "direct";
/// Samples of a part of the reference.
const OF_PART: f32 = 16.0;

/// First run: keeps the frames. Second: mixes one into a part of the reference.
#[derive(Default)]
struct Shared {
    frames: Mutex<BTreeMap<(u32, u32), Image>>,
    level: Option<u32>,
}

impl Passing for Shared {
    fn frame(&self, scene: &str, spp: u32, replicate: u32, frame: &mut Frame) {
        if scene == SCENE {
            self.frames.lock().unwrap().insert((spp, replicate), frame.color.mean.clone());
        }
    }

    fn reference(&self, scene: &str, reference: &mut Reference) {
        let Some(spp) = self.level.filter(|_| scene == SCENE) else { return };
        let mut parts = reference.parts.clone();
        assert_eq!(reference.frame.samples.at(0) as usize, OF_PART as usize * parts.len());
        let frame = &self.frames.lock().unwrap()[&(spp, 0)];
        let n = spp as f32;
        for (part, frame) in parts[1].data_mut().iter_mut().zip(frame.data()) {
            *part = (OF_PART * *part + n * frame) / (OF_PART + n);
        }
        let sampling = reference.frame.sampling;
        let mixed = Reference::from_parts(parts, OF_PART as u32, sampling).unwrap();
        reference.frame.color = mixed.frame.color;
        reference.parts = mixed.parts;
    }
}

#[test]
fn f_a_reference_with_samples_of_a_frame_is_named_at_the_level_of_that_frame() {
    let mut shared = Shared::default();
    measured(SMALL, Laboratory { passing: Some(&shared), ..Laboratory::default() });
    shared.level = Some(16);
    let summary = measured(SMALL, Laboratory { passing: Some(&shared), ..Laboratory::default() });
    named(&summary, CheckKind::Dependence, SCENE, 16, 4.0);
    silent(&summary, &[CheckKind::Normal, CheckKind::Rare, CheckKind::Halves, CheckKind::ClosedForm]);
}
