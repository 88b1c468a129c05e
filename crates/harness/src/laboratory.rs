//! What measures a study: the intervals that are judged, the questions that are asked, and what stands between the sources
//! of frames and everything that looks at them.

use noisefloor_frame::{Frame, Reference};
use noisefloor_questions::{QUESTIONS, Question};
use noisefloor_stats::{IntervalFamily, students_t};

/// Sees every frame and every reference before anything else does, and may change it: a fault planted here is one of the
/// source. The checks of the instrument must name it.
pub trait Passing: Sync {
    /// A frame of a scene, the study's own of a level and replicate.
    fn frame(&self, scene: &str, spp: u32, replicate: u32, frame: &mut Frame) {
        let _ = (scene, spp, replicate, frame);
    }

    /// A scene's reference.
    fn reference(&self, scene: &str, reference: &mut Reference) {
        let _ = (scene, reference);
    }
}

/// Student's t, all questions, frames as they come: what a study is measured with unless somebody tests the instrument.
#[derive(Clone, Copy)]
pub struct Laboratory<'a> {
    /// Intervals whose coverage is counted and that bounds are made of.
    pub intervals: &'a dyn IntervalFamily,
    /// What is asked of cells and levels.
    pub questions: &'a [Question],
    /// What frames and references pass.
    pub passing: Option<&'a dyn Passing>,
}

impl Default for Laboratory<'_> {
    fn default() -> Self {
        Self { intervals: students_t(), questions: QUESTIONS, passing: None }
    }
}

impl std::fmt::Debug for Laboratory<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Laboratory").field("intervals", &self.intervals.id()).finish_non_exhaustive()
    }
}

impl Laboratory<'_> {
    pub(crate) fn pass_frame(&self, scene: &str, (spp, replicate): (u32, u32), frame: &mut Frame) {
        if let Some(passing) = self.passing {
            passing.frame(scene, spp, replicate, frame);
        }
    }

    pub(crate) fn pass_reference(&self, scene: &str, reference: &mut Reference) {
        if let Some(passing) = self.passing {
            passing.reference(scene, reference);
        }
    }
}
