//! Levels made in memory, for the tests of questions.

use noisefloor_frame::{Image, Reference, Sampling};
use noisefloor_stats::students_t;
use noisefloor_study::{BASELINE, MethodRow, Study};
use noisefloor_synthetic::{Guides, ImageKind, MeanImage, SampleLaw, SyntheticScene};

use super::{LevelCell, LevelFound, LevelFrame, Outputs};
use crate::cell::{MeasureError, PixelClasses};

/// How an output is made of the input.
type Filter = fn(&Image) -> Image;

/// A level with everything that a cell of it borrows.
pub(crate) struct Made {
    pub(crate) study: Study,
    pub(crate) scene: SyntheticScene,
    pub(crate) spp: u32,
    pub(crate) reference: Reference,
    pub(crate) reference_spp: u64,
    pub(crate) frames: Vec<LevelFrame>,
    /// Rows beside the input.
    pub(crate) rows: Vec<(String, Filter)>,
}

impl Made {
    /// Frames of so many samples and replicates of a scene, beside its exact truth.
    pub(crate) fn of(kind: ImageKind, law: SampleLaw, size: usize, spp: u32, replicates: u32) -> Self {
        let scene =
            SyntheticScene::new(MeanImage::of(kind), law, size, size).unwrap().with_guides(Guides::None);
        let frame = |replicate: u32| LevelFrame {
            replicate,
            frame: scene.render(spp, 1 + u64::from(replicate)),
            invalid: Vec::new(),
        };
        let input = MethodRow::new(BASELINE);
        Self {
            study: Study::plain("made".into(), vec![spp], Vec::new(), vec![input]),
            spp,
            reference: scene.truth(),
            reference_spp: 0,
            frames: (0..replicates).map(frame).collect(),
            rows: Vec::new(),
            scene,
        }
    }

    /// A reference of eight parts of so many samples each.
    pub(crate) fn sampled(mut self, spp_per_part: u32) -> Self {
        let part = |part: u64| self.scene.render(spp_per_part, 1000 + part).color.mean;
        self.reference =
            Reference::from_parts((0..8).map(part).collect(), spp_per_part, Sampling::Independent).unwrap();
        self.reference_spp = 8 * u64::from(spp_per_part);
        self
    }

    pub(crate) fn measure(
        &self,
        question: fn(&LevelCell<'_>, &mut LevelFound) -> Result<(), MeasureError>,
    ) -> LevelFound {
        let classes = PixelClasses::from_reference(&self.reference);
        let labels: Vec<String> = std::iter::once(BASELINE.to_owned())
            .chain(self.rows.iter().map(|(label, _)| label.clone()))
            .collect();
        let outputs = |label: &str| -> Outputs {
            let of = |f: &LevelFrame| {
                let input = &f.frame.color.mean;
                let row = self.rows.iter().find(|(name, _)| name == label);
                (f.replicate, row.map_or_else(|| input.clone(), |(_, make)| make(input)))
            };
            self.frames.iter().map(of).collect()
        };
        let cell = LevelCell {
            study: &self.study,
            scene: "made",
            spp: self.spp,
            reference: &self.reference,
            reference_spp: self.reference_spp,
            known_mean: None,
            classes: &classes,
            frames: &self.frames,
            intervals: students_t(),
            rows: &labels,
            outputs: &outputs,
        };
        let mut found = LevelFound::default();
        question(&cell, &mut found).unwrap();
        found
    }
}
