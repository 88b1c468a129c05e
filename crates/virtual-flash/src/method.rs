use std::sync::Arc;

use noisefloor_denoiser::{
    DenoiseError, Denoiser, Diagnostics, Factory, Input, MethodCard, Output, ParamError, StageTimer, Unit,
    method,
};
use noisefloor_frame::{Frame, Image};
use noisefloor_kernels::Level;
use noisefloor_kernels::flash_filter::{
    self, FlashFilterError, FlashInputs, FlashParams, MAX_PIXELS, MAX_SOURCE, PatchWeights,
};

use crate::diagnostics::describe_step;
use crate::guide::Guide;
use crate::params::Step;
use crate::spread::{Along, tested_variance};
use crate::tolerance::Tolerance;
use crate::{Params, card};

const ID: &str = "virtual-flash";

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

    fn kernel_params(&self, frame: &Frame, step: &Step) -> FlashParams {
        FlashParams {
            width: frame.width(),
            height: frame.height(),
            window_radius: step.window_radius,
            spatial_sigma: step.spatial_sigma,
            patch: self.patch,
        }
    }

    /// One step: the filtered image, and the sums of what it carries.
    pub(crate) fn step(
        &self,
        frame: &Frame,
        step: &Step,
        inputs: &FlashInputs<'_>,
        along: Option<&Along<'_>>,
    ) -> Result<(Image, Option<Image>), DenoiseError> {
        let (params, level) = (self.kernel_params(frame, step), Level::best());
        let mut image = Image::new(frame.width(), frame.height(), 3);
        let Some(along) = along else {
            flash_filter::filter_into(&params, inputs, level, planes_mut(&mut image))
                .map_err(kernel_error)?;
            return Ok((image, None));
        };
        let mut sums = Image::new(frame.width(), frame.height(), 3);
        let out = [planes_mut(&mut image), planes_mut(&mut sums)];
        flash_filter::filter_carrying_into(&params, inputs, &along.carried(), level, out)
            .map_err(kernel_error)?;
        Ok((image, Some(sums)))
    }
}

fn planes_mut(image: &mut Image) -> [&mut [f32]; 3] {
    let mut planes = image.planes_mut();
    [(); 3].map(|()| planes.next().expect("three channels"))
}

impl Default for VirtualFlash {
    fn default() -> Self {
        Self::new(Params::default()).expect("the defaults are in range")
    }
}

pub(crate) fn inputs<'a>(
    source: &'a Image,
    guide: Option<&'a Guide>,
    tolerance: &'a Tolerance,
) -> FlashInputs<'a> {
    FlashInputs {
        source: [0, 1, 2].map(|c| source.plane(c)),
        membership: tolerance.membership(),
        guide: guide.map(|guide| flash_filter::Guide {
            planes: [0, 1, 2].map(|c| guide.image.plane(c)),
            sigma_r2: &guide.sigma_r2,
        }),
    }
}

impl Denoiser for VirtualFlash {
    fn card(&self) -> MethodCard {
        card::card(ID, &self.params, &self.steps)
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        input.check(&self.card())?;
        let frame = input.target;
        let probe = probe(input)?;
        DenoiseError::refuse_size(ID, frame, MAX_PIXELS)?;
        DenoiseError::refuse(ID, "colour is not finite or above 1e30", &frame.color.mean, |v| {
            v.abs() <= MAX_SOURCE
        })?;
        let mut timer = StageTimer::start();

        // Sec. 3.1: flash image, or what stands for it, and the width of its range weights.
        let guide = Guide::new(frame, &self.params, &self.patch);
        if let Some(guide) = &guide {
            DenoiseError::refuse(ID, "guide image is not finite", &guide.image, |v| v.is_finite())?;
        }
        timer.finish("guide");

        // Sec. 3.2, 3.3 and 3.5: one or two passes over homogeneous pixels. What the test takes as spread is the input's at
        // first, and then what the first step made of it.
        let tested = tested_variance(frame, &self.params);
        let along = Along::new(frame, &self.params, tested.as_deref());
        if let Some(Along::Variances(variance)) = along {
            DenoiseError::refuse(ID, "variance is negative or not finite", variance, |v| {
                (0.0..=f32::MAX).contains(&v)
            })?;
        }
        let raw = || tested.as_deref().cloned();
        let tolerance =
            |variance, step: &Step| Tolerance::new(&self.params, variance, &frame.samples, step.level);
        let (first, guide_of) = (&self.steps[0], guide.as_ref());
        let first_tolerance = tolerance(raw(), first);
        let first_inputs = inputs(&frame.color.mean, guide_of, &first_tolerance);
        let (mut image, sums) = self.step(frame, first, &first_inputs, along.as_ref())?;
        timer.finish(first.name);
        let mut second = None;
        if let Some(step) = self.steps.get(1) {
            let variance = match (&along, sums) {
                (Some(along), Some(sums)) => {
                    Some(along.variance(sums, self.params.second_spread, &frame.samples))
                }
                _ => raw(),
            };
            let tolerance = tolerance(variance, step);
            let (filtered, _) = self.step(frame, step, &inputs(&image, guide_of, &tolerance), None)?;
            second = Some((step, std::mem::replace(&mut image, filtered), tolerance));
            timer.finish(step.name);
        }

        let mut output = Output::from_image(image);
        figures(&mut output, guide_of);
        if let Some(probe) = probe {
            let params = self.kernel_params(frame, first);
            describe_step(&mut output, first.name, &params, &first_inputs, probe).map_err(kernel_error)?;
            if let Some((step, source, tolerance)) = second {
                let params = self.kernel_params(frame, step);
                let inputs = inputs(&source, guide_of, &tolerance);
                describe_step(&mut output, step.name, &params, &inputs, probe).map_err(kernel_error)?;
                output.diagnose("after step 1", Unit::Radiance, source);
            }
            if let Some(guide) = guide {
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

/// The kernel refuses what was checked before it ran; should it find more, its message is kept.
fn kernel_error(error: FlashFilterError) -> DenoiseError {
    DenoiseError::of_kernel(ID, &error)
}
