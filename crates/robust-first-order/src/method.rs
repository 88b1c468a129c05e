use std::sync::Arc;

use noisefloor_denoiser::{
    DenoiseError, Denoiser, Diagnostics, Exposed, Factory, Input, MethodCard, Output, ParamError, Parameters,
    StageTimer, Unit,
};
use noisefloor_frame::{Frame, Image};

use crate::algorithm;
use crate::card::{self, ID};
use crate::diagnostics::{describe, figures};
use crate::settings::Settings;
use crate::{Params, VarianceKind};

/// Factory of [`RobustFirstOrder`].
#[must_use]
pub fn method() -> Arc<dyn Factory> {
    let summary = "first-order models of whole windows at few centres, weighed by a prefiltered colour";
    noisefloor_denoiser::method(ID, summary, Some(crate::README), RobustFirstOrder::new)
}

/// The method of Liu, Zheng, Yuan 2018: see the crate documentation.
#[derive(Debug, Clone, PartialEq)]
pub struct RobustFirstOrder {
    params: Params,
    settings: Settings,
}

impl RobustFirstOrder {
    /// Checks the parameters.
    ///
    /// # Errors
    /// The first parameter that is out of range.
    pub fn new(params: Params) -> Result<Self, ParamError> {
        params.check()?;
        let settings = Settings::new(&params);
        Ok(Self { params, settings })
    }

    /// The parameters.
    #[must_use]
    pub fn params(&self) -> &Params {
        &self.params
    }

    /// [`Denoiser::denoise`] at the exposure of all frames.
    fn filter(&self, frame: &Frame, diagnostics: bool) -> Result<Output, DenoiseError> {
        let mut timer = StageTimer::start();
        let done = algorithm::denoise(frame, &self.params, &self.settings, &mut timer)?;
        let (width, height) = (frame.width(), frame.height());
        let sums = &done.modelled.sums;
        // Weights are above 0 in every pixel: one that no model covered is the centre of one.
        let plane = |i: usize| sums.mean(i, 0, &done.variance);
        let image =
            |planes: [Vec<f32>; 3]| Image::from_fn(width, height, 3, |c, x, y| planes[c][y * width + x]);
        let blended = image([1, 2, 3].map(plane));
        let below = blended.data().iter().filter(|v| **v < 0.0).count();
        let mut output = Output::from_image(blended.map(|v| v.max(0.0)));
        output.estimate_of =
            Some(("refitted from the prefiltered colour".into(), image([4, 5, 6].map(plane))));
        let error = plane(7);
        output.error_estimate = Some(image([error.clone(), error.clone(), error]));
        figures(&mut output, &done, (width, height), &self.params, &self.settings);
        output.figure("share of clamped values", Unit::None, below as f64 / blended.data().len() as f64);
        if diagnostics {
            describe(&mut output, &done, (width, height));
        }
        timer.finish("blend");
        output.stages = timer.into_stages();
        Ok(output)
    }
}

impl Default for RobustFirstOrder {
    fn default() -> Self {
        Self::new(Params::default()).expect("the defaults are in range")
    }
}

impl Denoiser for RobustFirstOrder {
    fn card(&self) -> MethodCard {
        card::card(&self.params)
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        input.check(&self.card())?;
        let color = &input.target.color;
        let finite = |image| DenoiseError::refuse(ID, "a value is not finite", image, f32::is_finite);
        finite(&color.mean)?;
        if self.params.variance == VarianceKind::Residual {
            color.halves.iter().flatten().try_for_each(finite)?;
        }
        DenoiseError::refuse_size(ID, input.target, MOST_PIXELS)?;
        // No neighbouring frame is used.
        let alone = input.with_neighbors(&[], &[]);
        let exposed = Exposed::new(&alone, BRIGHT);
        let mut output = self.filter(exposed.input(&alone).target, input.diagnostics != Diagnostics::Off)?;
        exposed.undo(&mut output);
        Ok(output)
    }
}

/// Largest value that goes to the kernels; ours. Squares of it are within their range.
const BRIGHT: f32 = 1e12;
/// Most pixels: their indices are kept in 32 bits.
const MOST_PIXELS: usize = 1 << 31;
