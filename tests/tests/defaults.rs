//! What methods hold on rendered scenes with their defaults: nowhere above their input, and no more light lost than is told.

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

/// A method and what it may leave or change.
struct Limits {
    id: &'static str,
    /// Of the input's error.
    error: f64,
    /// Of the light, from so many samples per pixel on.
    light: (f64, u32),
}

const METHODS: [Limits; 4] = [
    Limits { id: "virtual-flash", error: 0.9, light: (0.05, 32) },
    Limits { id: "rdfc", error: 0.9, light: (0.02, 16) },
    Limits { id: "nfor", error: 0.9, light: (0.02, 16) },
    // Glints in metal are blurred: 0.98 of the squared error is left in front of the toaster at 32 samples.
    Limits { id: "robust-first-order", error: 1.0, light: (0.02, 16) },
];

#[test]
fn defaults_are_not_above_their_input_and_keep_the_light_of_diffuse_and_glossy_scenes() {
    let registry = noisefloor_registry::registry([]);
    let methods = METHODS.map(|limits| (registry.build(limits.id, &Map::new()).unwrap().denoiser, limits));
    for scene_id in ["cornell-diffuse", "cornell", "toaster"] {
        let scene = Prepared::new(&(find(scene_id).unwrap().build)().at_frame(0)).unwrap();
        let truth = frame(&scene, REFERENCE, 1, Recorded::color_only()).color.mean;
        for spp in [8, 16, 32] {
            let noisy = frame(&scene, spp, 2 + u64::from(spp), Recorded::Available);
            let before = errors(&noisy.color.mean, &truth);
            for (method, Limits { id, error, light: (lost, from) }) in &methods {
                let filtered = method.denoise(&Input::new(&noisy)).unwrap().image;
                let what = format!("{id}, {scene_id}, {spp} samples per pixel");
                for (after, before) in errors(&filtered, &truth).into_iter().zip(before) {
                    assert!(after < error * before, "{what}: {after} of {before}");
                }
                let kept = light(&filtered) / light(&noisy.color.mean);
                assert!(spp < *from || (kept - 1.0).abs() < *lost, "{what}: {kept} of the light");
            }
        }
    }
}
