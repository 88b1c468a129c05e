use std::sync::Arc;

use noisefloor_denoiser::{
    Alternative, Caveat, DenoiseError, Denoiser, Factory, Input, Invariance, MethodCard, Need, Output,
    ParamError, Parameters, Role, StageTimer, method,
};
use noisefloor_frame::{FeatureId, Image};

use crate::corrected::{describe, needs, no_variance, untested};
use crate::guides::Tests;
use crate::{AsWrittenParams, CITATION, Material, README, algorithm};

const ID: &str = "geometric-as-written";

/// Factory of [`GeometricAsWritten`].
#[must_use]
pub fn geometric_as_written() -> Arc<dyn Factory> {
    let summary = "the same by the letter of its slides, slips included; a fixture, not a baseline";
    method(ID, summary, Some(README), GeometricAsWritten::new)
}

/// The pseudo-code of the slides, literally, line by line. Its output has either sign and is of no use as an image.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct GeometricAsWritten {
    params: AsWrittenParams,
}

impl GeometricAsWritten {
    /// Validates the parameters.
    ///
    /// # Errors
    /// The first parameter that is out of range.
    pub fn new(params: AsWrittenParams) -> Result<Self, ParamError> {
        params.check()?;
        Ok(Self { params })
    }

    /// The parameters.
    #[must_use]
    pub fn params(&self) -> &AsWrittenParams {
        &self.params
    }
}

impl Denoiser for GeometricAsWritten {
    fn card(&self) -> MethodCard {
        let mut card = MethodCard::new(ID, "Geometric, as written", CITATION);
        card.role = Role::Fixture;
        let exposure = "the radius is a variance".to_owned();
        card.varies_with = vec![(Invariance::Exposure, exposure)];
        let p = &self.params;
        if p.depth_test {
            let units = "depths are compared in scene units".to_owned();
            card.varies_with.push((Invariance::FeatureUnits, units));
        }
        let material = if p.material_ids { Material::Ids } else { Material::Off };
        card.needs = needs(Tests { material, depth: p.depth_test, normal: p.normal_test });
        card.alternatives = untested();
        let ids = Need::Feature(FeatureId::Material);
        card.alternatives.insert(0, Alternative::new("material_ids", false, [ids]));
        card.notes.push("a fixture that keeps the slides' slips: no baseline, sets no axis".into());
        let undefined = "wherever the variance is zero, no neighbour has a weight".to_owned();
        let signs = "weights have either sign".to_owned();
        card.caveats = vec![(Caveat::Undefined, undefined), (Caveat::Level, signs)];
        card
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        let card = self.card();
        input.check(&card)?;
        let frame = input.target;
        let mut timer = StageTimer::start();
        let (rows, radii) =
            algorithm::as_written(frame, &self.params, &mut timer).ok_or_else(|| no_variance(&card))?;
        let broken = rows
            .iter()
            .enumerate()
            .flat_map(|(y, row)| row.iter().enumerate().map(move |(x, value)| (x, y, value)))
            .filter(|(_, _, value)| value.is_none());
        if let Some((x, y, _)) = broken.clone().next() {
            let what = "the weight sum is zero or the result is not finite".into();
            return Err(DenoiseError::Undefined { method: ID.into(), what, pixels: broken.count(), x, y });
        }
        let rows: Vec<Vec<_>> = rows.into_iter().map(|row| row.into_iter().flatten().collect()).collect();
        let image = Image::from_fn(frame.width(), frame.height(), 3, |c, x, y| rows[y][x][c]);
        let mut output = Output::from_image(image);
        timer.finish("filter");
        describe(&mut output, radii, input);
        output.stages = timer.into_stages();
        Ok(output)
    }
}
