//! A denoiser of one's own, and the whole command with it:
//!
//! ```text
//! cargo run --release --example box_filter -- methods
//! cargo run --release --example box_filter -- denoise frame.exr --method box-filter --set radius_px=2 -o out.exr
//! ```
//!
//! In your own crate this file is `src/main.rs`, with `noisefloor`, `serde` and `serde_json` as dependencies. A study
//! file names the method like any other: `[[method]]`, `id = "box-filter"`, `set = { radius_px = 2 }`.

use std::process::ExitCode;

use noisefloor::{
    Citation, DenoiseError, Denoiser, Image, Input, MethodCard, Output, ParamError, Parameters, StageTimer,
    method, parameters,
};

parameters! {
    /// One table: names, defaults, ranges and texts of checks, help and lists come from here.
    struct Params {
        /// Half the window's side.
        radius_px: usize = 1, integer(0..=32).unit("px").symbol("r");
    }
}

/// Mean over a square window, clipped at the border.
struct BoxFilter {
    params: Params,
}

impl BoxFilter {
    /// Checks the parameters once: an error names the offending one.
    fn new(params: Params) -> Result<Self, ParamError> {
        params.check()?;
        Ok(Self { params })
    }
}

impl Denoiser for BoxFilter {
    fn card(&self) -> MethodCard {
        let mut card = MethodCard::new(
            "box-filter",
            "Box filter",
            Citation::new("example", "the simplest filter there is"),
        );
        card.notes.push("blurs everything, consistent for no window wider than a pixel".into());
        card
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        // Refuse before any work if something is missing or does not fit together.
        input.check(&self.card())?;
        let mut timer = StageTimer::start();
        let noisy = &input.target.color.mean;
        let (width, height) = (noisy.width(), noisy.height());
        let radius = self.params.radius_px;
        let image = Image::from_fn(width, height, 3, |c, x, y| {
            let (mut sum, mut count) = (0.0f64, 0u32);
            for j in y.saturating_sub(radius)..=(y + radius).min(height - 1) {
                for i in x.saturating_sub(radius)..=(x + radius).min(width - 1) {
                    sum += f64::from(noisy.get(c, i, j));
                    count += 1;
                }
            }
            (sum / f64::from(count)) as f32 // the window always contains (x, y)
        });
        timer.finish("filter");
        let mut output = Output::from_image(image);
        output.stages = timer.into_stages();
        Ok(output)
    }
}

fn main() -> ExitCode {
    noisefloor::main_with([method("box-filter", "mean over a square window", None, BoxFilter::new)])
}
