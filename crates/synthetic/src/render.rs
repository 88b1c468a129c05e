//! Draws the samples of a frame.

use noisefloor_frame::{
    BLOCK_SAMPLES, BlockTree, Camera, Frame, Moments, PixelFilter, Provenance, Samples, Sampling, Variance,
};

use crate::random::Stream;
use crate::sampled::{Sampled, estimate};
use crate::{SyntheticScene, features};

/// Purpose of the colour's random numbers; the features have others.
const COLOR: u64 = 0;

/// The random numbers of a pixel's colour.
pub(crate) fn color_stream(seed: u64, pixel: usize) -> Stream {
    Stream::new(seed, COLOR, pixel)
}

impl SyntheticScene {
    /// Draws `spp` independent samples per pixel (at least one) and keeps their statistics: mean, variance of
    /// the mean, halves by parity of the sample index; variance and halves only from 2 samples on. The guide
    /// images come from other random numbers, independent of the colour's.
    ///
    /// The bits depend on scene, `spp` and `seed` only, not on the number of threads.
    #[must_use]
    pub fn render(&self, spp: u32, seed: u64) -> Frame {
        let spp = spp.max(1);
        let truth = self.image.image(self.width, self.height);
        let plane = truth.pixels();
        let color = estimate(self.width, self.height, spp, |pixel| {
            let mean = [0, 1, 2].map(|c| f64::from(truth.data()[c * plane + pixel]));
            self.sample_pixel(mean, spp, color_stream(seed, pixel))
        });
        let mut frame = Frame::from_color(color, Samples::uniform(spp), Sampling::Independent);
        features::add(self, &mut frame, &truth, spp, seed);
        frame.provenance = self.provenance(seed);
        frame
    }

    /// The variance of the mean of `spp` samples, exactly: that of the law, over the samples.
    #[must_use]
    pub fn variance(&self, spp: u32) -> Variance {
        let n = f64::from(spp.max(1));
        let of_mean = |mean: f32| (self.law.variance(f64::from(mean)) / n) as f32;
        Variance::of_mean(self.image.image(self.width, self.height).map(of_mean))
    }

    fn sample_pixel(&self, mean: [f64; 3], spp: u32, mut stream: Stream) -> Sampled<3> {
        let mut tree = BlockTree::default();
        let mut halves = [Moments::<3>::default(); 2];
        let mut left = spp;
        while left > 0 {
            let mut leaf = Moments::default();
            for index in 0..left.min(BLOCK_SAMPLES) {
                let sample = self.law.draw(mean, self.common_channels, &mut stream);
                leaf.push(sample);
                halves[(index % 2) as usize].push(sample);
            }
            tree.push(leaf);
            left = left.saturating_sub(BLOCK_SAMPLES);
        }
        let total = tree.total();
        Sampled {
            mean: total.mean(),
            variance: total.mean_variance().unwrap_or_default(),
            halves: halves.map(|half| half.mean()),
        }
    }

    fn provenance(&self, seed: u64) -> Provenance {
        Provenance {
            scene: Some("synthetic".into()),
            renderer: Some(concat!("noisefloor-synthetic ", env!("CARGO_PKG_VERSION")).into()),
            integrator: Some(format!("law {}", self.law.name())),
            sampler: Some("independent".into()),
            seed: Some(seed),
            filter: Some(PixelFilter::Point),
            camera: Some(Camera {
                camera_to_world: [[1., 0., 0., 0.], [0., 1., 0., 0.], [0., 0., 1., 0.], [0., 0., 0., 1.]],
                vertical_fov_degrees: 45.0,
            }),
            ..Provenance::default()
        }
    }
}
