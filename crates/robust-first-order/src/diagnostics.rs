//! What the figures of the source work show.

use noisefloor_denoiser::{Output, Unit};
use noisefloor_frame::Image;

use crate::Params;
use crate::algorithm::Done;
use crate::blend::Heaviest;
use crate::settings::Settings;

/// Adds prefiltered features (Fig. 1), prefiltered colour (Fig. 2), bandwidths (Fig. 3) and windows (Fig. 4).
pub(crate) fn describe(output: &mut Output, done: &Done, (width, height): (usize, usize)) {
    let gray =
        |value: &dyn Fn(usize) -> f32| Image::from_fn(width, height, 3, |_, x, y| value(y * width + x));
    for channel in done.channels.iter().filter(|c| c.name.ends_with(" 0")) {
        let name = channel.name.trim_end_matches(" 0");
        let planes: Vec<_> = done.channels.iter().filter(|c| c.name.starts_with(name)).collect();
        let image = if planes.len() < 3 {
            gray(&|p| channel.value[p])
        } else {
            Image::from_fn(width, height, 3, |c, x, y| planes[c].value[y * width + x])
        };
        output.diagnose(format!("feature {name}, prefiltered"), Unit::None, image);
    }
    let of = |planes: &[Vec<f32>; 3]| Image::from_fn(width, height, 3, |c, x, y| planes[c][y * width + x]);
    output.diagnose("prefiltered colour", Unit::Radiance, of(&done.guide.value));
    output.diagnose("variance of the prefiltered colour", Unit::RadianceSquared, of(&done.guide.variance));
    let heaviest = &done.modelled.sums.heaviest;
    output.diagnose("bandwidth of the heaviest model", Unit::None, gray(&|p| heaviest[p].k));
    output.diagnose("radius of the heaviest model", Unit::Pixels, gray(&|p| heaviest[p].radius));
    output.diagnose("models that cover a pixel", Unit::None, gray(&|p| heaviest[p].models as f32));
    let weights = &done.modelled.sums.planes[0];
    output.diagnose("sum of weights", Unit::None, gray(&|p| weights[p]));
    let mut small = vec![0.0; width * height];
    for tile in done.tiles.iter().filter(|tile| tile.detailed) {
        for y in tile.y..tile.y + tile.height {
            small[y * width + tile.x..][..tile.width].fill(1.0);
        }
    }
    output.diagnose("detailed tiles", Unit::None, gray(&|p| small[p]));
}

/// Adds numbers of models and pixels (Sec. 4.2).
pub(crate) fn figures(
    output: &mut Output,
    done: &Done,
    size: (usize, usize),
    params: &Params,
    settings: &Settings,
) {
    let heaviest = &done.modelled.sums.heaviest;
    let centers = &done.modelled.centers;
    // An image has at least one pixel, and so one model.
    let share = |count: usize, of: usize| count as f64 / of as f64;
    output.figure("models", Unit::None, centers.len() as f64);
    output.figure("models per pixel", Unit::None, share(centers.len(), heaviest.len()));
    let (width, height) = size;
    let side =
        |at: usize, radius: usize, size: usize| (at + radius + 1).min(size) - at.saturating_sub(radius);
    let windows: usize =
        centers.iter().map(|c| side(c.x, c.radius, width) * side(c.y, c.radius, height)).sum();
    output.figure("pixels per window", Unit::Pixels, share(windows, centers.len()));
    let covered: usize = heaviest.iter().map(|h| h.models as usize).sum();
    output.figure("pixels covered per model", Unit::Pixels, share(covered, centers.len()));
    let tiles = done.tiles.iter().filter(|t| t.detailed).map(|t| t.width * t.height).sum();
    output.figure("share of detailed tiles", Unit::None, share(tiles, heaviest.len()));
    let is_small = |h: &&Heaviest| h.radius <= params.small_radius_px as f32;
    let small = heaviest.iter().filter(is_small).count();
    output.figure("share of pixels in small windows", Unit::None, share(small, heaviest.len()));
    for (k, bandwidth) in settings.bandwidths.iter().enumerate() {
        let count = centers.iter().filter(|c| c.k == k).count();
        output.figure(
            format!("share of models with k = {bandwidth}"),
            Unit::None,
            share(count, centers.len()),
        );
    }
}
