//! Guide images of a synthetic frame: what a renderer would record at the first hit, and the virtual flash.

use noisefloor_frame::{Estimate, FeatureId, Flash, Frame, Image};

use crate::random::Stream;
use crate::sampled::{Sampled, estimate};
use crate::{Guides, SyntheticScene};

/// Part of the colour that the flash image's reused light shows.
const REUSED_LIGHT: f64 = 0.4;
/// Radiance of a white surface under the unit eye light.
const EYE_LIGHT: f64 = 0.3;

/// Unit normals of consecutive surfaces, all towards the viewer at +Z.
const NORMALS: [[f64; 3]; 4] = [[0.0, 0.0, 1.0], [0.6, 0.0, 0.8], [0.0, 0.6, 0.8], [-0.6, 0.0, 0.8]];

pub(crate) fn add(scene: &SyntheticScene, frame: &mut Frame, truth: &Image, spp: u32, seed: u64) {
    if scene.guides == Guides::None {
        return;
    }
    let (width, height) = (scene.width, scene.height);
    let regions = scene.image.regions(width, height);
    let brightest = truth.data().iter().fold(0.0f32, |m, v| m.max(v.abs()));
    // The divisor is positive: an all-zero image has an all-zero albedo.
    let scale = if brightest > 0.0 { 1.0 / f64::from(brightest) } else { 0.0 };
    let plane = truth.pixels();
    let color = |pixel: usize, c: usize| f64::from(truth.data()[c * plane + pixel]);
    let albedo = |pixel: usize| [0, 1, 2].map(|c| color(pixel, c).abs() * scale);
    let surface = |pixel: usize| f64::from(regions[pixel]);
    let draw = Draw { width, height, spp, seed };

    let sd = scene.feature_sd;
    let albedo_image = draw.normal(1, |p| albedo(p).map(|a| (a, sd)));
    let normal_image = draw.normal(2, |p| NORMALS[regions[p] as usize % NORMALS.len()].map(|v| (v, sd)));
    let depth_image = draw.normal(3, |p| {
        let depth = 5.0 + 0.25 * surface(p);
        [(depth, sd * depth)]
    });
    let material = Image::from_fn(width, height, 1, |_, x, y| f32::from(regions[y * width + x]));
    frame.features.insert(FeatureId::Albedo, albedo_image);
    frame.features.insert(FeatureId::Normal, normal_image);
    frame.features.insert(FeatureId::Depth, depth_image);
    frame.features.insert(FeatureId::Material, Estimate::from_mean(material));

    let relative = |value: f64| (value, scene.flash_sd * value.abs());
    let base = |p: usize| [0, 1, 2].map(|c| REUSED_LIGHT * color(p, c));
    let light = |p: usize| albedo(p).map(|a| EYE_LIGHT * a);
    frame.flash = match scene.guides {
        Guides::FlashParts => Some(Flash::Parts {
            base: draw.normal(4, |p| base(p).map(relative)),
            light: draw.normal(5, |p| light(p).map(relative)),
            // The two are drawn independently: the true covariance.
            covariance: (spp >= 2).then(|| Image::new(width, height, 3)),
        }),
        Guides::FlashReady => Some(Flash::Ready(draw.normal(6, |p| {
            // The intensity that makes eye light of a white surface as bright as the brightest mean.
            let intensity = f64::from(brightest) / EYE_LIGHT;
            let (base, light) = (base(p), light(p));
            [0, 1, 2].map(|c| relative(base[c] + (1.0 - REUSED_LIGHT) * intensity * light[c]))
        }))),
        Guides::NoFlash | Guides::None => None,
    };
}

struct Draw {
    width: usize,
    height: usize,
    spp: u32,
    seed: u64,
}

impl Draw {
    /// Mean, variance and halves of `spp` normal samples of the given mean and standard deviation, drawn from
    /// the exact joint law of these four numbers instead of sample by sample: the half means are normal, and
    /// the sum of squares within the halves is chi-square with n−2 degrees of freedom, independent of them.
    fn normal<const C: usize>(
        &self,
        purpose: u64,
        law: impl Fn(usize) -> [(f64, f64); C] + Sync,
    ) -> Estimate {
        let n = self.spp;
        let (in_a, in_b) = (n.div_ceil(2), n / 2);
        let (na, nb, total) = (f64::from(in_a), f64::from(in_b), f64::from(n));
        estimate(self.width, self.height, n, |pixel| {
            let mut stream = Stream::new(self.seed, purpose, pixel);
            let mut sampled = Sampled { mean: [0.0; C], variance: [0.0; C], halves: [[0.0; C]; 2] };
            for (c, (mean, sd)) in law(pixel).into_iter().enumerate() {
                let a = mean + sd * stream.normal() / na.sqrt(); // n ≥ 1, so at least one sample is in A
                if in_b == 0 {
                    sampled.mean[c] = a;
                    continue;
                }
                let b = mean + sd * stream.normal() / nb.sqrt();
                let within = sd * sd * stream.chi_square(n - 2);
                let between = na * nb / total * (a - b).powi(2);
                sampled.mean[c] = (na * a + nb * b) / total;
                sampled.variance[c] = (within + between) / ((total - 1.0) * total); // n ≥ 2 here
                sampled.halves[0][c] = a;
                sampled.halves[1][c] = b;
            }
            sampled
        })
    }
}
