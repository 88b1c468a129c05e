use std::sync::Arc;

use noisefloor_denoiser::{
    DenoiseError, Denoiser, Diagnostics, Factory, Input, MethodCard, Output, ParamError, StageTimer, Unit,
    method,
};
use noisefloor_frame::Image;
use noisefloor_kernels::flash_filter::{MAX_PIXELS, PatchWeights};

use crate::Params;
use crate::algorithm::{self, Done};
use crate::card::{self, ID};
use crate::diagnostics::describe_step;
use crate::filter::{inputs, kernel_error, kernel_params, planes};
use crate::guide::Guide;
use crate::params::Step;
use crate::tolerance::Tolerance;
use crate::volume::Volume;

/// Factory of [`VirtualFlash`].
#[must_use]
pub fn virtual_flash() -> Arc<dyn Factory> {
    let summary = "patch-weighted mean over statistically equal pixels, guided by a virtual flash image";
    method(ID, summary, Some(crate::README), VirtualFlash::new)
}

/// The method of Moon et al. 2013: see the crate documentation.
#[derive(Debug, Clone, PartialEq)]
pub struct VirtualFlash {
    params: Params,
    steps: Vec<Step>,
    patch: PatchWeights,
}

impl VirtualFlash {
    /// Validates the parameters.
    ///
    /// # Errors
    /// The first parameter that is out of range.
    pub fn new(params: Params) -> Result<Self, ParamError> {
        let steps = params.steps()?;
        let patch = PatchWeights::gaussian(params.patch_radius_px, params.patch_sigma_px as f32).map_err(
            |error| ParamError {
                parameter: "patch_sigma_px".into(),
                value: params.patch_sigma_px.to_string(),
                range: error.to_string(),
            },
        )?;
        Ok(Self { params, steps, patch })
    }

    /// The parameters.
    #[must_use]
    pub fn params(&self) -> &Params {
        &self.params
    }
}

impl Default for VirtualFlash {
    fn default() -> Self {
        Self::new(Params::default()).expect("the defaults are in range")
    }
}

impl Denoiser for VirtualFlash {
    fn card(&self) -> MethodCard {
        card::card(ID, &self.params, &self.steps)
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        let card = self.card();
        input.check(&card)?;
        let probe = probe(input)?;
        DenoiseError::refuse_size(ID, input.target, MAX_PIXELS)?;
        let volume = Volume::new(input, self.params.neighbors);
        volume.check(&card)?;
        let mut timer = StageTimer::start();
        let Done { image, mut guides, first, second } =
            algorithm::denoise(&volume, &self.params, &self.steps, &self.patch, &mut timer)?;

        let mut output = Output::from_image(image);
        figures(&mut output, guides.get(volume.target));
        if let Some(probe) = probe {
            let describe = |output: &mut Output, step: &Step, sources: Vec<&Image>, tolerance: &Tolerance| {
                let params = kernel_params(input.target, step, &self.patch);
                let planes = planes(sources, &guides, &[]);
                let inputs = inputs(&planes, volume.target, volume.neighbors, tolerance);
                describe_step(output, step.name, &params, &inputs, probe).map_err(kernel_error)
            };
            let means = volume.frames.iter().map(|frame| &frame.color.mean).collect();
            describe(&mut output, &self.steps[0], means, &first)?;
            if let Some((mut images, tolerance)) = second {
                describe(&mut output, &self.steps[1], images.iter().collect(), &tolerance)?;
                output.diagnose("after step 1", Unit::Radiance, images.swap_remove(volume.target));
            }
            if volume.target < guides.len() {
                let guide = guides.swap_remove(volume.target);
                output.diagnose("guide image", Unit::Radiance, guide.image);
            }
            timer.finish("diagnostics");
        }
        output.stages = timer.into_stages();
        Ok(output)
    }
}

fn figures(output: &mut Output, guide: Option<&Guide>) {
    let Some(guide) = guide else { return };
    let figures = [
        ("flash intensity", Unit::None, guide.intensity),
        ("least sigma_r", Unit::Radiance, Some(guide.sigma_r.0)),
        ("largest sigma_r", Unit::Radiance, Some(guide.sigma_r.1)),
    ];
    for (name, unit, value) in figures {
        if let Some(value) = value.filter(|v| v.is_finite()) {
            output.figure(name, unit, value);
        }
    }
}

/// The pixel to look at, if diagnostics are wanted.
fn probe(input: &Input<'_>) -> Result<Option<(usize, usize)>, DenoiseError> {
    let (width, height) = (input.target.width(), input.target.height());
    let (x, y) = match input.diagnostics {
        Diagnostics::Off => return Ok(None),
        Diagnostics::On { probe } => probe.unwrap_or((width / 2, height / 2)),
    };
    if x < width && y < height {
        return Ok(Some((x, y)));
    }
    Err(DenoiseError::Parameter {
        method: ID.into(),
        parameter: "probe".into(),
        value: format!("({x}, {y})"),
        allowed: format!("columns 0 to {}, rows 0 to {}", width - 1, height - 1),
    })
}
