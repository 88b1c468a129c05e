//! Optional statistics of the samples of a frame.

use std::sync::Arc;

use noisefloor_frame::{
    BLOCK_SAMPLES, Block, Counts, FourParts, Frame, Gathered, Gathering, Image, Optional, Statistic,
};
use rayon::prelude::*;

use crate::SyntheticScene;
use crate::render::color_stream;

impl SyntheticScene {
    /// [`SyntheticScene::render`] with these statistics of the same samples beside the others; those that so few samples have
    /// no meaning for are left out.
    ///
    /// # Panics
    /// Never: images are made by the table of statistics.
    #[must_use]
    pub fn render_with(&self, spp: u32, seed: u64, statistics: &[Statistic]) -> Frame {
        let mut frame = self.render(spp, seed);
        let spp = spp.max(1);
        let meant: Vec<Statistic> =
            statistics.iter().copied().filter(|statistic| statistic.row().least <= spp).collect();
        if meant.is_empty() {
            return frame;
        }
        let gathering = Arc::new(Gathering::new(meant, 3));
        let means = &self.image.image(self.width, self.height);
        let pixels: Vec<Vec<f64>> = (0..means.pixels())
            .into_par_iter()
            .map(|pixel| {
                let mean = [0, 1, 2].map(|c| f64::from(means.data()[c * means.pixels() + pixel]));
                self.gathered(&gathering, mean, spp, seed, pixel)
            })
            .collect();
        let mut plane = 0;
        let mut image = || {
            let first = plane;
            plane += 3;
            Image::from_fn(self.width, self.height, 3, |c, x, y| pixels[y * self.width + x][first + c] as f32)
        };
        let recorded = gathering.statistics().iter().map(|statistic| {
            let images = statistic.row().images.iter().map(|_| image()).collect();
            (*statistic, images)
        });
        let parts = FourParts::dealt(0, &Counts::Uniform(spp));
        let parts = gathering.statistics().contains(&Statistic::FourParts).then_some(parts);
        frame.optional = Optional::new(recorded.collect(), parts, Vec::new())
            .expect("every statistic has the images of its row");
        frame
    }

    /// The statistics of one pixel, from the random numbers of its colour.
    fn gathered(&self, of: &Arc<Gathering>, mean: [f64; 3], spp: u32, seed: u64, pixel: usize) -> Vec<f64> {
        let mut stream = color_stream(seed, pixel);
        let mut gathered = Gathered::new(of);
        for first in (0..spp).step_by(BLOCK_SAMPLES as usize) {
            let count = BLOCK_SAMPLES.min(spp - first);
            let values: Vec<f32> = (0..count)
                .flat_map(|_| {
                    self.law.draw(mean, self.common_channels, &mut stream).map(|value| value as f32)
                })
                .collect();
            let positions = vec![[0.5; 2]; count as usize];
            gathered.extend(&Block { first, values: &values, stride: 3, positions: &positions });
        }
        let mut out = vec![0.0; 3 * of.images()];
        gathered.finish(&mut out);
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ImageKind, MeanImage, SampleLaw};

    const ALL: [Statistic; 3] = [Statistic::ThirdMoment, Statistic::Least, Statistic::Greatest];

    fn scene(law: SampleLaw) -> SyntheticScene {
        SyntheticScene::new(MeanImage::of(ImageKind::Flats), law, 40, 30).unwrap()
    }

    #[test]
    fn statistics_are_of_the_samples_that_made_the_mean() {
        let scene = scene(SampleLaw::Bernoulli { q: 0.3, bright: 1.0 });
        let (plain, frame) = (scene.render(20, 5), scene.render_with(20, 5, &ALL));
        assert_eq!(frame.color, plain.color);
        assert_eq!((frame.features.clone(), frame.flash.clone()), (plain.features, plain.flash));
        let optional = &frame.optional;
        let (third, least, greatest) =
            (optional.third_moment().unwrap(), optional.least().unwrap(), optional.greatest().unwrap());
        let variance = frame.color.variance.as_ref().unwrap().mean_variance();
        let truth = scene.truth();
        for (i, mean) in frame.color.mean.data().iter().enumerate() {
            // Events are as bright as the mean over q: p = x̄/bright of them make k₃ = p(1−p)(1−2p)·bright³·n²/((n−1)(n−2)).
            let bright = f64::from(truth.mean().data()[i]) / 0.3;
            let p = f64::from(*mean) / bright;
            let expected = p * (1.0 - p) * (1.0 - 2.0 * p) * bright.powi(3) * 400.0 / (19.0 * 18.0);
            let got = f64::from(third.data()[i]);
            assert!((got - expected).abs() < 1e-4 * bright.powi(3), "{i}: {got} instead of {expected}");
            let expected = p * (1.0 - p) * bright * bright / 19.0;
            assert!((f64::from(variance.data()[i]) - expected).abs() < 1e-5 * bright * bright);
            assert!(least.data()[i] <= *mean && *mean <= greatest.data()[i]);
        }
    }

    #[test]
    fn what_too_few_samples_do_not_have_is_left_out() {
        let scene = scene(SampleLaw::Exponential);
        let two = scene.render_with(2, 1, &ALL).optional;
        assert!(two.third_moment().is_none() && two.least().is_some());
        assert!(scene.render_with(16, 1, &[]).optional.is_empty());
        let parts = scene.render_with(70, 1, &[Statistic::FourParts]);
        let halves = parts.optional.four_parts().unwrap().halves();
        for (half, expected) in halves.iter().zip(parts.color.halves.as_ref().unwrap()) {
            let close = half.data().iter().zip(expected.data()).all(|(a, b)| (a - b).abs() <= 1e-6 * b.abs());
            assert!(close);
        }
    }
}
