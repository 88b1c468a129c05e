use noisefloor_denoiser::{
    DenoiseError, Denoiser, Diagnostics, Entry, Input, MethodCard, Output, StageTimer, build_with,
};
use noisefloor_frame::{Frame, Image, Variance};
use noisefloor_kernels::flash_filter::{
    self, FlashFilterError, FlashInputs, FlashParams, MAX_PIXELS, MAX_SOURCE, PatchWeights,
};

use crate::diagnostics::describe_step;
use crate::guide::Guide;
use crate::params::Step;
use crate::spread::FirstStep;
use crate::tolerance::Tolerance;
use crate::{Params, card};

const ID: &str = "virtual-flash";

/// Registry entry of [`VirtualFlash`].
pub const ENTRY: Entry = Entry {
    id: ID,
    summary: "patch-weighted mean over statistically equal pixels, guided by a virtual flash image",
    params: Params::DOCS,
    defaults: || serde_json::to_value(Params::default()).unwrap_or_default(),
    build: |overrides| build_with(ID, Params::DOCS, overrides, VirtualFlash::new),
};

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
    /// The name of the first parameter that is out of range, see [`Params::DOCS`].
    pub fn new(params: Params) -> Result<Self, &'static str> {
        params.validate()?;
        let steps = params.steps()?;
        let patch = PatchWeights::gaussian(params.patch_radius_px, params.patch_sigma_px as f32)
            .map_err(|_| "patch_sigma_px")?;
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

    /// Half-widths of a step's test: step 1 always takes the input's standard error, step 2 what `second_spread` says.
    fn tolerance(
        &self,
        frame: &Frame,
        guide: Option<&Guide>,
        before: Option<&Tolerance>,
        step: &Step,
    ) -> Tolerance {
        let raw = frame.color.variance.as_ref().map(Variance::mean_variance);
        let filtered = before.filter(|_| self.params.homogeneous).and_then(|tolerance| {
            let first = FirstStep { frame, guide, patch: &self.patch, step: &self.steps[0], tolerance };
            first.variance(self.params.second_spread)
        });
        Tolerance::new(&self.params, filtered.as_ref().or(raw), &frame.samples, step.level)
    }
}

impl Default for VirtualFlash {
    fn default() -> Self {
        Self::new(Params::default()).expect("the defaults are in range")
    }
}

fn inputs<'a>(source: &'a Image, guide: Option<&'a Guide>, tolerance: &'a Tolerance) -> FlashInputs<'a> {
    FlashInputs {
        source: [0, 1, 2].map(|c| source.plane(c)),
        membership: tolerance.membership(),
        guide: guide.map(|guide| flash_filter::Guide {
            planes: [0, 1, 2].map(|c| guide.image.plane(c)),
            inv_two_sigma_r2: &guide.inv_two_sigma_r2,
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
        check_size(frame)?;
        check_values(&frame.color.mean, MAX_SOURCE, "colour is not finite or above 1e30")?;
        let mut timer = StageTimer::start();

        // Sec. 3.1: flash image, or what stands for it, and the width of its range weights.
        let guide = Guide::new(frame, &self.params, &self.patch);
        if let Some(guide) = &guide {
            check_values(&guide.image, f32::MAX, "guide image is not finite")?;
        }
        timer.finish("guide");

        // Sec. 3.2, 3.3 and 3.5: one or two passes over homogeneous pixels.
        let mut output = Output::from_image(frame.color.mean.clone());
        let mut looked_at: Vec<(Image, Tolerance)> = Vec::new();
        let mut before = None;
        for step in &self.steps {
            let tolerance = self.tolerance(frame, guide.as_ref(), before.as_ref(), step);
            let planes = flash_filter::filter(
                &self.kernel_params(frame, step),
                &inputs(&output.image, guide.as_ref(), &tolerance),
            )
            .map_err(kernel_error)?;
            let filtered = Image::from_vec(frame.width(), frame.height(), 3, planes.concat())
                .expect("the kernel gives one value per pixel and channel");
            let source = std::mem::replace(&mut output.image, filtered);
            if probe.is_some() {
                looked_at.push((source, tolerance.clone()));
            }
            before = Some(tolerance);
            timer.finish(step.name);
        }

        figures(&mut output, guide.as_ref());
        if let Some(probe) = probe {
            for (step, (source, tolerance)) in self.steps.iter().zip(&looked_at) {
                let inputs = inputs(source, guide.as_ref(), tolerance);
                let params = self.kernel_params(frame, step);
                describe_step(&mut output, step.name, &params, &inputs, probe).map_err(kernel_error)?;
            }
            if let Some((after_first, _)) = looked_at.into_iter().nth(1) {
                output.diagnostics.push(("after step 1".into(), after_first));
            }
            if let Some(guide) = guide {
                output.diagnostics.push(("guide image".into(), guide.image));
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
        ("flash intensity", guide.intensity),
        ("least sigma_r", Some(guide.sigma_r.0)),
        ("largest sigma_r", Some(guide.sigma_r.1)),
    ];
    for (name, value) in figures {
        if let Some(value) = value.filter(|v| v.is_finite()) {
            output.figures.push((name.into(), value));
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
        parameter: "probe",
        value: format!("({x}, {y})"),
        allowed: format!("columns 0 to {}, rows 0 to {}", width - 1, height - 1),
    })
}

fn check_size(frame: &Frame) -> Result<(), DenoiseError> {
    if frame.pixels() <= MAX_PIXELS {
        return Ok(());
    }
    Err(DenoiseError::Parameter {
        method: ID.into(),
        parameter: "image size",
        value: format!("{} pixels", frame.pixels()),
        allowed: format!("at most {MAX_PIXELS}"),
    })
}

/// Refuses values that the filter has no answer for, with the number of pixels that hold one.
fn check_values(image: &Image, limit: f32, what: &'static str) -> Result<(), DenoiseError> {
    // The usual case, without bookkeeping; a NaN fails the comparison.
    let good = |v: f32| v.abs() <= limit;
    if image.data().iter().fold(true, |all, &v| all & good(v)) {
        return Ok(());
    }
    let bad: Vec<usize> =
        (0..image.pixels()).filter(|&p| image.planes().any(|plane| !good(plane[p]))).collect();
    let (x, y) = (bad[0] % image.width(), bad[0] / image.width());
    Err(DenoiseError::Undefined { method: ID.into(), what, pixels: bad.len(), x, y })
}

/// The kernel refuses what was checked before it ran; should it find more, its message is kept.
fn kernel_error(error: FlashFilterError) -> DenoiseError {
    DenoiseError::Parameter {
        method: ID.into(),
        parameter: "kernel input",
        value: error.to_string(),
        allowed: "what the kernel's documentation says".into(),
    }
}
