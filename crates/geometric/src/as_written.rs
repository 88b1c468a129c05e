use std::sync::Arc;

use noisefloor_denoiser::{
    Alternative, DenoiseError, Denoiser, Factory, Input, Invariance, MethodCard, Need, Output, ParamError,
    Parameters, Role, StageTimer, method,
};
use noisefloor_frame::{FeatureId, Frame, Image};
use rayon::prelude::*;

use crate::corrected::{describe, needs, no_variance, untested};
use crate::guides::Tests;
use crate::{AsWrittenParams, CITATION, Material, README, radius};

const ID: &str = "geometric-as-written";

/// Factory of [`GeometricAsWritten`].
#[must_use]
pub fn geometric_as_written() -> Arc<dyn Factory> {
    let summary = "the same by the letter of its slides, slips included; a fixture, not a baseline";
    method(ID, summary, Some(README), GeometricAsWritten::new)
}

/// The pseudo-code of the slides, literally. Its output has either sign and is of no use as an image.
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
        let units = "depths are compared in scene units".to_owned();
        card.varies_with = vec![(Invariance::Exposure, exposure), (Invariance::FeatureUnits, units)];
        let p = &self.params;
        let material = if p.material_ids { Material::Ids } else { Material::Off };
        card.needs = needs(Tests { material, depth: p.depth_test, normal: p.normal_test });
        card.alternatives = untested();
        let ids = Need::Feature(FeatureId::Material);
        card.alternatives.insert(0, Alternative::new("material_ids", false, [ids]));
        card.notes.push("a fixture that keeps the slides' slips: no baseline, sets no axis".into());
        card.notes.push("undefined wherever the variance is zero".into());
        card
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        let card = self.card();
        input.check(&card)?;
        let frame = input.target;
        let p = &self.params;
        let mut timer = StageTimer::start();
        let radii = radius::as_written(frame, p.multiplier, p.radius_max_px, p.variance_form)
            .ok_or_else(|| no_variance(&card))?;
        timer.finish("radius");

        let literal = Literal::new(frame, p);
        let rows: Vec<Vec<_>> = (0..frame.height())
            .into_par_iter()
            .map(|y| (0..frame.width()).map(|x| literal.pixel(x, y, radii[y * frame.width() + x])).collect())
            .collect();
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

/// What the pseudo-code reads, one plane each; `None` where a test is off.
struct Literal<'a> {
    width: usize,
    height: usize,
    params: &'a AsWrittenParams,
    mean: [&'a [f32]; 3],
    id: Option<&'a [f32]>,
    depth: Option<&'a [f32]>,
    normal: Option<[&'a [f32]; 3]>,
}

impl<'a> Literal<'a> {
    fn new(frame: &'a Frame, params: &'a AsWrittenParams) -> Self {
        let feature = |on: bool, id| frame.feature(&id).filter(|_| on).map(|feature| &feature.mean);
        Self {
            width: frame.width(),
            height: frame.height(),
            params,
            mean: [0, 1, 2].map(|c| frame.color.mean.plane(c)),
            id: feature(params.material_ids, FeatureId::Material).map(|image| image.plane(0)),
            depth: feature(params.depth_test, FeatureId::Depth).map(|image| image.plane(0)),
            normal: feature(params.normal_test, FeatureId::Normal)
                .map(|image| [0, 1, 2].map(|c| image.plane(c))),
        }
    }

    fn skipped(&self, p: usize, q: usize) -> bool {
        let dot = |n: [&[f32]; 3]| (0..3).map(|c| n[c][p] * n[c][q]).sum::<f32>();
        self.id.is_some_and(|id| id[q] != id[p])
            || self.depth.is_some_and(|z| f64::from((z[q] - z[p]).abs()) > self.params.depth_threshold)
            || self.normal.is_some_and(|n| f64::from(dot(n)) > self.params.normal_threshold)
    }

    /// `None` if the weight sum is zero or the result is not finite.
    fn pixel(&self, x: usize, y: usize, radius: f32) -> Option<[f32; 3]> {
        let p = y * self.width + x;
        let radius = f64::from(radius);
        let reach = radius as usize;
        let mut total = [0, 1, 2].map(|c| f64::from(self.mean[c][p]));
        let mut sum = 0.0;
        for qy in y.saturating_sub(reach)..(y + reach + 1).min(self.height) {
            for qx in x.saturating_sub(reach)..(x + reach + 1).min(self.width) {
                let q = qy * self.width + qx;
                let distance = (qx.abs_diff(x).pow(2) as f64 + qy.abs_diff(y).pow(2) as f64).sqrt();
                if distance > radius || (q == p && !self.params.visits_center) || self.skipped(p, q) {
                    continue;
                }
                // The parenthesis as printed. A zero radius gives an infinity, which is reported.
                let weight = (1.0 - distance) / radius;
                sum += weight;
                for (total, plane) in total.iter_mut().zip(self.mean) {
                    *total += weight * f64::from(plane[q]);
                }
            }
        }
        // The printed guard compares a vector with zero; read per component. A black pixel stays black.
        let value = total.map(|t| if t > 0.0 { (t / sum) as f32 } else { t as f32 });
        (sum != 0.0 && value.iter().all(|v| v.is_finite())).then_some(value)
    }
}
