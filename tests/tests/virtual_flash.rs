//! What `virtual-flash` holds on rendered scenes with its defaults: nowhere above its input, and no more light lost than is told.

use noisefloor::render::{Prepared, Recorded, RenderRequest, Silent, render};
use noisefloor::scenes::find;
use noisefloor_denoiser::Input;
use noisefloor_frame::{Frame, Image, PixelFilter};
use serde_json::Map;

const SIZE: (usize, usize) = (64, 48);
/// Samples per pixel of the reference, 16 times the longest frame's.
const REFERENCE: u32 = 512;

fn frame(scene: &Prepared, spp: u32, seed: u64, record: Recorded) -> Frame {
    let mut request = RenderRequest::new(scene, SIZE.0, SIZE.1, spp);
    request.seed = seed;
    request.record = record;
    request.filter = PixelFilter::Point;
    render(&request, &Silent).unwrap()
}

/// Sums of squared errors, and of squared errors relative to the truth without the worst 0.1 % of them.
fn errors(image: &Image, truth: &Image) -> [f64; 2] {
    let pairs = || image.data().iter().zip(truth.data()).map(|(&a, &b)| (f64::from(a), f64::from(b)));
    let squared = pairs().map(|(a, b)| (a - b).powi(2)).sum::<f64>();
    let mut relative: Vec<f64> = pairs().map(|(a, b)| (a - b).powi(2) / (b * b + 1e-2)).collect();
    relative.sort_by(f64::total_cmp);
    let kept = relative.len() - relative.len().div_ceil(1000);
    [squared, relative[..kept].iter().sum()]
}

fn light(image: &Image) -> f64 {
    image.data().iter().map(|&v| f64::from(v)).sum()
}

#[test]
fn the_default_is_not_above_its_input_and_keeps_the_light_of_diffuse_and_glossy_scenes() {
    let method = noisefloor_registry::registry([]).build("virtual-flash", &Map::new()).unwrap().denoiser;
    for id in ["cornell-diffuse", "cornell", "toaster"] {
        let scene = Prepared::new(&(find(id).unwrap().build)().at_frame(0)).unwrap();
        let truth = frame(&scene, REFERENCE, 1, Recorded::color_only()).color.mean;
        for spp in [8, 16, 32] {
            let noisy = frame(&scene, spp, 2 + u64::from(spp), Recorded::Available);
            let filtered = method.denoise(&Input::new(&noisy)).unwrap().image;
            let before = errors(&noisy.color.mean, &truth);
            for (after, before) in errors(&filtered, &truth).into_iter().zip(before) {
                assert!(after < 0.9 * before, "{id}, {spp} samples per pixel: {after} of {before}");
            }
            let kept = light(&filtered) / light(&noisy.color.mean);
            if spp >= 32 {
                assert!((kept - 1.0).abs() < 0.05, "{id}, {spp} samples per pixel: {kept} of the light");
            }
        }
    }
}
