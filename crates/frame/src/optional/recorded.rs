//! What a frame has of optional statistics.

use super::statistic::{BoxCox, Statistic};
use super::tap::Tapped;
use crate::{Counts, FrameError, Image};

/// Optional statistics of a frame's colour, each an image of 3 channels. Empty unless they were asked for.
///
/// They are of the samples as they were taken: whoever scales or mends the colour of a frame does not change them.
/// Values beyond the range of `f32`, such as the third moment of samples around 10¹³, are infinite. Files keep the images,
/// not the samples of tapped pixels.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Optional {
    recorded: Vec<(Statistic, Vec<Image>)>,
    part_samples: Option<[Counts; 4]>,
    tapped: Vec<Tapped>,
}

/// Means of four disjoint parts of the samples, see [`Statistic::FourParts`].
#[derive(Debug, Clone, Copy)]
pub struct FourParts<'a> {
    /// Means of the parts.
    pub means: [&'a Image; 4],
    /// Samples of each part; they differ by at most one in a pixel.
    pub samples: &'a [Counts; 4],
}

impl FourParts<'_> {
    /// How many samples each part has of `total` that were dealt in turn, from the sample of index `first` on.
    #[must_use]
    pub fn dealt(first: u32, total: &Counts) -> [Counts; 4] {
        std::array::from_fn(|part| {
            let part = part as u64;
            let below = |end: u64| end / 4 + u64::from(end % 4 > part);
            let first = u64::from(first);
            // No part has more samples than there are.
            let of = |n: u32| (below(first + u64::from(n)) - below(first)) as u32;
            match total {
                Counts::Uniform(n) => Counts::Uniform(of(*n)),
                Counts::PerPixel(map) => {
                    let counts = Counts::PerPixel(map.iter().map(|n| of(*n)).collect());
                    counts.uniform().map_or(counts, Counts::Uniform)
                }
            }
        })
    }

    /// The halves that the parts make up: A of parts 0 and 2, B of 1 and 3, by their numbers of samples. They are those
    /// of the frame, to two roundings of `f32`.
    #[must_use]
    pub fn halves(&self) -> [Image; 2] {
        [0, 1].map(|half| {
            let (even, odd) = (self.means[half], self.means[half + 2]);
            let (n, m) = (&self.samples[half], &self.samples[half + 2]);
            let mut out = even.clone();
            for (plane, other) in out.planes_mut().zip(odd.planes()) {
                for (pixel, (value, other)) in plane.iter_mut().zip(other).enumerate() {
                    let (n, m) = (f64::from(n.at(pixel)), f64::from(m.at(pixel)));
                    *value = ((f64::from(*value) * n + f64::from(*other) * m) / (n + m).max(1.0)) as f32;
                }
            }
            out
        })
    }
}

/// Moments of transformed samples g(max(x, floor)).
#[derive(Debug, Clone, Copy)]
pub struct BoxCoxMoments<'a> {
    /// The transform.
    pub transform: BoxCox,
    /// Mean of g.
    pub mean: &'a Image,
    /// Variance of that mean, s²/n: n times it is the unbiased variance of g of one sample.
    pub mean_variance: &'a Image,
    /// Share of the samples below the floor, in 0..=1.
    pub floored: &'a Image,
}

impl Optional {
    /// Puts images together: those of each statistic in the order of its row. `part_samples`: samples of each of four
    /// parts, where these are among the statistics. Statistics are kept in the order of the table, transforms by λ and floor.
    ///
    /// # Errors
    /// [`FrameError::Optional`] if a statistic has another number of images than its row, or parts have no counts.
    pub fn new(
        mut recorded: Vec<(Statistic, Vec<Image>)>,
        part_samples: Option<[Counts; 4]>,
        tapped: Vec<Tapped>,
    ) -> Result<Self, FrameError> {
        recorded.sort_by(|(a, _), (b, _)| a.cmp_in_table(b));
        for (statistic, images) in &recorded {
            let row = statistic.row();
            let (id, got, expected) = (row.id, images.len(), row.images.len());
            if got != expected {
                let problem = format!("{got} images, expected {expected}");
                return Err(FrameError::Optional { id, problem });
            }
            if *statistic == Statistic::FourParts && part_samples.is_none() {
                return Err(FrameError::Optional { id, problem: "no sample counts of the parts".into() });
            }
        }
        Ok(Self { recorded, part_samples, tapped })
    }

    /// Whether nothing was asked for.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.recorded.is_empty() && self.tapped.is_empty()
    }

    /// Every statistic with the images of its row.
    #[must_use]
    pub fn recorded(&self) -> &[(Statistic, Vec<Image>)] {
        &self.recorded
    }

    /// Unbiased third central moment of one sample, n·Σ(x − x̄)³/((n − 1)(n − 2)), in cubed units of the colour.
    #[must_use]
    pub fn third_moment(&self) -> Option<&Image> {
        self.images(Statistic::ThirdMoment)?.first()
    }

    /// Smallest samples.
    #[must_use]
    pub fn least(&self) -> Option<&Image> {
        self.images(Statistic::Least)?.first()
    }

    /// Largest samples.
    #[must_use]
    pub fn greatest(&self) -> Option<&Image> {
        self.images(Statistic::Greatest)?.first()
    }

    /// Means of four parts.
    #[must_use]
    pub fn four_parts(&self) -> Option<FourParts<'_>> {
        let [a, b, c, d] = self.images(Statistic::FourParts)? else { return None };
        Some(FourParts { means: [a, b, c, d], samples: self.part_samples.as_ref()? })
    }

    /// Moments of transformed samples, for each transform that was asked for.
    pub fn box_cox(&self) -> impl Iterator<Item = BoxCoxMoments<'_>> {
        self.recorded.iter().filter_map(|(statistic, images)| match (statistic, images.as_slice()) {
            (Statistic::BoxCox(transform), [mean, mean_variance, floored]) => {
                Some(BoxCoxMoments { transform: *transform, mean, mean_variance, floored })
            }
            _ => None,
        })
    }

    /// Unbiased covariances of one sample with its position, right and down, in units of the colour times pixel widths.
    /// Zero where camera rays go through the centres of pixels.
    #[must_use]
    pub fn position(&self) -> Option<[&Image; 2]> {
        let [right, down] = self.images(Statistic::Position)? else { return None };
        Some([right, down])
    }

    /// Pixels of which all samples are kept, row by row.
    #[must_use]
    pub fn tapped(&self) -> &[Tapped] {
        &self.tapped
    }

    /// Checks that everything fits an image of this size.
    ///
    /// # Errors
    /// [`FrameError::Mismatch`], [`FrameError::CountMap`], and [`FrameError::Optional`] for a tapped pixel beyond it.
    pub(crate) fn check(&self, width: usize, height: usize) -> Result<(), FrameError> {
        for (statistic, images) in &self.recorded {
            let row = statistic.row();
            for (image, name) in images.iter().zip(row.images) {
                image.expect_shape(&format!("{}.{name}", row.id), width, height, 3)?;
            }
        }
        for counts in self.part_samples.iter().flatten() {
            if let Counts::PerPixel(map) = counts
                && map.len() != width * height
            {
                let what = "samples of a part".into();
                return Err(FrameError::CountMap { what, pixels: width * height, got: map.len() });
            }
        }
        match self.tapped.iter().find(|tapped| tapped.x >= width || tapped.y >= height) {
            Some(Tapped { x, y, .. }) => {
                let problem = format!("pixel ({x}, {y}) is outside the image");
                Err(FrameError::Optional { id: "tap", problem })
            }
            None => Ok(()),
        }
    }

    /// The rectangle that starts at `(x, y)`. Panics like [`Image::crop`].
    pub(crate) fn crop(
        &self,
        [x, y]: [usize; 2],
        [width, height]: [usize; 2],
        cut: impl Fn(&Counts) -> Counts,
    ) -> Self {
        let crop = |images: &[Image]| images.iter().map(|image| image.crop(x, y, width, height)).collect();
        let inside =
            |tapped: &&Tapped| (x..x + width).contains(&tapped.x) && (y..y + height).contains(&tapped.y);
        let moved = |tapped: &Tapped| Tapped { x: tapped.x - x, y: tapped.y - y, ..tapped.clone() };
        Self {
            recorded: self.recorded.iter().map(|(statistic, images)| (*statistic, crop(images))).collect(),
            part_samples: self.part_samples.as_ref().map(|parts| parts.each_ref().map(cut)),
            tapped: self.tapped.iter().filter(inside).map(moved).collect(),
        }
    }

    fn images(&self, of: Statistic) -> Option<&[Image]> {
        self.recorded.iter().find(|(statistic, _)| *statistic == of).map(|(_, images)| images.as_slice())
    }
}
