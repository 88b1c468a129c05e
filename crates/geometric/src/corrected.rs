use std::sync::Arc;

use noisefloor_denoiser::{
    Alternative, DenoiseError, Denoiser, Diagnostics, Factory, Input, Invariance, MethodCard, Need, Output,
    ParamError, Parameters, StageTimer, Unit, method,
};
use noisefloor_frame::{FeatureId, Image};

use crate::guides::Tests;
use crate::{CITATION, CorrectedParams, FloorUnit, Material, README, Spread, algorithm};

const ID: &str = "geometric-corrected";

/// Factory of [`GeometricCorrected`].
#[must_use]
pub fn geometric_corrected() -> Arc<dyn Factory> {
    let summary = "cone filter over neighbours of like material, depth and normal, radius from the noise";
    method(ID, summary, Some(README), GeometricCorrected::new)
}

/// The simple geometric denoiser with its evident slips mended: see the crate documentation.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct GeometricCorrected {
    params: CorrectedParams,
}

impl GeometricCorrected {
    /// Validates the parameters.
    ///
    /// # Errors
    /// The first parameter that is out of range.
    pub fn new(params: CorrectedParams) -> Result<Self, ParamError> {
        params.check()?;
        Ok(Self { params })
    }

    /// The parameters.
    #[must_use]
    pub fn params(&self) -> &CorrectedParams {
        &self.params
    }
}

/// The needs that both variants share.
pub(crate) fn needs(tests: Tests) -> Vec<Need> {
    let features = [
        (tests.material == Material::Ids, FeatureId::Material),
        (tests.material == Material::Albedo, FeatureId::Albedo),
        (tests.depth, FeatureId::Depth),
        (tests.normal, FeatureId::Normal),
    ];
    let features = features.into_iter().filter(|(on, _)| *on).map(|(_, id)| Need::Feature(id));
    [Need::ColorVariance, Need::Samples(2)].into_iter().chain(features).collect()
}

/// The switches of the tests of depth and normal, for frames without the feature. Both variants call them alike.
pub(crate) fn untested() -> Vec<Alternative> {
    let switches = [("depth_test", FeatureId::Depth), ("normal_test", FeatureId::Normal)];
    switches.map(|(name, id)| Alternative::new(name, false, [Need::Feature(id)])).into()
}

/// Mean and largest kernel radius, and its picture if asked for.
pub(crate) fn describe(output: &mut Output, radii: Vec<f32>, input: &Input<'_>) {
    let (width, height) = (input.target.width(), input.target.height());
    let mean = radii.iter().map(|&r| f64::from(r)).sum::<f64>() / radii.len() as f64; // an image is never empty
    let largest = radii.iter().copied().fold(0.0, f32::max);
    output.figure("mean kernel radius, px", Unit::Pixels, mean);
    output.figure("largest kernel radius, px", Unit::Pixels, f64::from(largest));
    if input.diagnostics != Diagnostics::Off {
        let image = Image::from_vec(width, height, 1, radii).expect("one radius per pixel");
        output.diagnose("kernel radius", Unit::Pixels, image);
    }
}

impl Denoiser for GeometricCorrected {
    fn card(&self) -> MethodCard {
        let mut card = MethodCard::new(ID, "Geometric, corrected", CITATION);
        card.needs = needs(self.tests());
        card.alternatives = untested();
        // Not `off`: what that gives on a frame with a visible lamp says nothing about the method.
        for (name, lifts, asks) in [
            ("ids", FeatureId::Albedo, FeatureId::Material),
            ("albedo", FeatureId::Material, FeatureId::Albedo),
        ] {
            let other = Alternative::new("material", name, [Need::Feature(lifts)]);
            card.alternatives.push(other.asking([Need::Feature(asks)]));
        }
        card.claims.consistent = self.params.spread != Spread::SampleVariance;
        let relative = self.params.spread == Spread::Relative && self.params.floor_unit == FloorUnit::Median;
        if !relative {
            card.varies_with.push((Invariance::Exposure, "the radius is in radiance".into()));
        }
        if self.params.spread == Spread::Relative {
            card.varies_with
                .push((Invariance::ChannelOrder, "the radius is relative to the luminance".into()));
        }
        card.notes.push(match self.params.spread {
            Spread::SampleVariance => {
                "radius from the variance of one sample: depends on exposure, never shrinks, not consistent"
                    .into()
            }
            Spread::StdOfMean => "radius from the standard error: depends on exposure".into(),
            Spread::Relative => match self.params.floor_unit {
                FloorUnit::Median => "radius from the relative standard error".into(),
                FloorUnit::Radiance => {
                    "radius from the relative standard error over a floor in radiance: depends on exposure"
                        .into()
                }
            },
        });
        match self.params.material {
            Material::Ids => card.notes.push(
                "a pixel that an edge crosses has one material id: the light of antialiased lamps bleeds"
                    .into(),
            ),
            Material::Albedo => {
                card.notes.push("albedo is compared in place of the slides' material ids".into())
            }
            Material::Off => {
                card.notes.push("materials are not told apart: lamps bleed over what is beside them".into())
            }
        }
        card
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        let card = self.card();
        input.check(&card)?;
        let frame = input.target;
        let mut timer = StageTimer::start();
        let (image, radii) = algorithm::corrected(frame, &self.params, self.tests(), &mut timer)
            .ok_or_else(|| no_variance(&card))?;
        let mut output = Output::from_image(image);
        describe(&mut output, radii, input);
        output.stages = timer.into_stages();
        Ok(output)
    }
}

/// For a frame whose variance vanished between check and use, which cannot be; kept as an error all the same.
pub(crate) fn no_variance(card: &MethodCard) -> DenoiseError {
    DenoiseError::MissingInputs {
        method: card.id.clone(),
        missing: vec![Need::ColorVariance],
        ways_out: Vec::new(),
    }
}

impl GeometricCorrected {
    fn tests(&self) -> Tests {
        let p = &self.params;
        Tests { material: p.material, depth: p.depth_test, normal: p.normal_test }
    }
}
