//! Images of sample means under a known law, and how often intervals hold the truth.

use noisefloor_stats::random::Normals;
use noisefloor_stats::{IntervalFamily, IntervalPlanes, Level, Observed, SampleCounts, SamplePlanes};

use crate::laws::Law;

/// Pixels of a row and rows of an image.
pub const WIDTH: usize = 40;
pub const HEIGHT: usize = 25;
pub const PIXELS: usize = WIDTH * HEIGHT;

/// One image, of one channel: every pixel has its own samples.
pub struct Image {
    pub n: u32,
    pub truth: Vec<f64>,
    mean: Vec<f32>,
    variance: Vec<f32>,
    third_moment: Vec<f32>,
    least: Vec<f32>,
    greatest: Vec<f32>,
}

impl Image {
    /// With `n` ≥ 3 samples in every pixel.
    pub fn new(law: Law, n: u32, random: &mut Normals) -> Self {
        let plane = || Vec::with_capacity(PIXELS);
        let mut image = Self {
            n,
            truth: Vec::with_capacity(PIXELS),
            mean: plane(),
            variance: plane(),
            third_moment: plane(),
            least: plane(),
            greatest: plane(),
        };
        let count = f64::from(n);
        for pixel in 0..PIXELS {
            let column = (pixel % WIDTH) as f64 / WIDTH as f64;
            let samples: Vec<f64> = (0..n).map(|_| law.sample(column, random)).collect();
            let mean = samples.iter().sum::<f64>() / count;
            let moment = |power| samples.iter().map(|x| (x - mean).powi(power)).sum::<f64>();
            image.truth.push(law.mean(column));
            image.mean.push(mean as f32);
            image.variance.push((moment(2) / ((count - 1.0) * count)) as f32);
            image.third_moment.push((moment(3) * count / ((count - 1.0) * (count - 2.0))) as f32);
            image.least.push(samples.iter().fold(f64::INFINITY, |a, b| a.min(*b)) as f32);
            image.greatest.push(samples.iter().fold(f64::NEG_INFINITY, |a, b| a.max(*b)) as f32);
        }
        image
    }

    /// What a family gets of it.
    pub fn planes(&self) -> SamplePlanes<'_> {
        SamplePlanes {
            observed: Observed {
                mean: &self.mean,
                variance: &self.variance,
                counts: SampleCounts::Uniform(self.n),
                pixels: PIXELS,
                valid: None,
            },
            width: WIDTH,
            third_moment: Some(&self.third_moment),
            least: Some(&self.least),
            greatest: Some(&self.greatest),
        }
    }

    pub fn intervals(&self, family: &dyn IntervalFamily, level: Level) -> IntervalPlanes {
        family.intervals(&self.planes(), level).unwrap().unwrap()
    }
}

/// Where truths lay, over images.
#[derive(Debug, Clone, Default)]
pub struct Count {
    images: u64,
    covered: u64,
    below: u64,
    above: u64,
}

impl Count {
    pub fn add(&mut self, image: &Image, intervals: &IntervalPlanes) {
        let ends = image.truth.iter().zip(&intervals.low).zip(&intervals.high);
        for ((truth, low), high) in ends {
            self.below += u64::from(truth < low);
            self.above += u64::from(truth > high);
            self.covered += u64::from(low <= truth && truth <= high);
        }
        self.images += 1;
    }

    fn share(&self, of: u64) -> f64 {
        of as f64 / (self.images * PIXELS as u64) as f64
    }

    /// Share of truths inside, below the interval, above it.
    pub fn shares(&self) -> [f64; 3] {
        [self.covered, self.below, self.above].map(|of| self.share(of))
    }
}
