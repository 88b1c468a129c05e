//! What the figures of the source work show.

use noisefloor_denoiser::{Output, Unit};
use noisefloor_frame::Image;

use crate::candidates::Candidate;
use crate::first_pass::FirstPass;
use crate::prepare::Prepared;
use crate::selection::Choice;
use crate::sure::sum_of_channels;

/// Names of the candidates in diagnostics and figures.
pub(crate) fn name(choice: Choice) -> &'static str {
    match choice {
        Choice::First => "FIRST",
        Choice::Second => "SECOND",
        Choice::Third => "THIRD",
    }
}

/// Adds the prefiltered features with their residual variances and the colour's variance (Fig. 3).
pub(crate) fn describe_inputs(output: &mut Output, target: &Prepared<'_>) {
    output.diagnose("variance of the colour", Unit::RadianceSquared, target.variance.clone());
    for feature in &target.features {
        output.diagnose(format!("feature {}, prefiltered", feature.name), Unit::None, three(&feature.mean));
        output.diagnose(
            format!("feature {}, residual variance", feature.name),
            Unit::None,
            three(&feature.variance),
        );
    }
}

/// Adds candidates, estimates and the choice (Fig. 2).
pub(crate) fn describe_choice(output: &mut Output, candidates: &[Candidate], pass: &FirstPass) {
    for (k, (choice, candidate)) in Choice::ALL.into_iter().zip(candidates).enumerate() {
        let name = name(choice);
        output.diagnose(format!("candidate {name}"), Unit::Radiance, candidate.mean.clone());
        output.diagnose(
            format!("error estimate {name}"),
            Unit::RadianceSquared,
            three(&sum_of_channels(&candidate.sure)),
        );
        let filtered = pass.errors.plane(k).to_vec();
        let filtered = Image::from_vec(pass.errors.width(), pass.errors.height(), 1, filtered);
        let filtered = filtered.expect("one value per pixel");
        output.diagnose(format!("error estimate {name}, filtered"), Unit::RadianceSquared, three(&filtered));
    }
    output.diagnose("selection, binary", Unit::None, pass.binary.clone());
    output.diagnose("selection", Unit::None, pass.weights.clone());
    output.diagnose("first pass", Unit::Radiance, pass.mean.clone());
}

/// Adds the share of the image that each candidate has.
pub(crate) fn figures(output: &mut Output, pass: &FirstPass) {
    for choice in Choice::ALL {
        let plane = pass.weights.plane(choice.index());
        // An image has at least one pixel.
        let share = plane.iter().copied().map(f64::from).sum::<f64>() / plane.len() as f64;
        output.figure(format!("share of {}", name(choice)), Unit::None, share);
    }
}

/// Three channels for viewers: one channel repeated, two with a black third, of more the first three.
fn three(image: &Image) -> Image {
    let channels = image.channels();
    Image::from_fn(image.width(), image.height(), 3, |c, x, y| match channels {
        1 => image.get(0, x, y),
        _ if c < channels => image.get(c, x, y),
        _ => 0.0,
    })
}
