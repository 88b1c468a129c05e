//! Is the mean of the frames that of their reference?
//!
//! S = Σ w(g_x − g_r) over pixels, with g the mean of three channels (a pixel is one cluster) and w the inverse of the
//! brightness around ([`smooth_weights`]). Of several replicates x is the mean image and v the variance of that mean, so that S
//! is the sum over replicates divided by their number, with the reference's noise in it once.

use crate::instrument::outcome::adjust;
use crate::instrument::{Blocks, Outcome, PixelPair, ResidualSums, Tested, shrunk, smooth_weights};
use crate::observed::{LARGEST_GROUPS, expect};
use crate::{Groups, Observed, ShapeError, Truth, t_two_sided_p};

/// Side of the blocks that are tested alone, pixels.
const EDGE: usize = 8;

/// Brightness of a scene's frames relative to the reference: values are Σ w·g_x/Σ w·g_r, expected to be 1.
#[derive(Debug, Clone, PartialEq)]
pub struct BrightnessCheck {
    /// The whole image.
    pub image: Outcome,
    /// Each group.
    pub groups: Vec<Outcome>,
    /// Each block of 8×8 pixels, row by row.
    pub blocks: Vec<Outcome>,
}

impl BrightnessCheck {
    /// All outcomes: image, groups, blocks.
    pub fn all(&self) -> impl Iterator<Item = &Outcome> {
        std::iter::once(&self.image).chain(&self.groups).chain(&self.blocks)
    }

    /// Smallest adjusted p-value, which is that of the scene; `None` if nothing could be tested.
    #[must_use]
    pub fn p(&self) -> Option<f64> {
        self.all().filter_map(|outcome| outcome.tested().map(|t| t.adjusted)).reduce(f64::min)
    }
}

/// A reference, with the number of its samples.
#[derive(Debug, Clone, Copy)]
pub struct SampledTruth<'a> {
    /// r and v_r, three channels; without variance it counts as exact.
    pub truth: Truth<'a>,
    /// Samples per pixel behind it; absent if unknown. With them v_r predicts how the frames spread.
    pub samples: Option<f64>,
}

/// Tests the mean of the replicates `frames` against the reference, over the image, each group and each block of 8×8
/// pixels; all tests are one family under Holm's rule. `states` says whether the frames' v is the variance of their means:
/// not with low-discrepancy samples.
///
/// **Standard error.** The largest of what the residuals show, pixel by pixel and between blocks, of v and v_r, and of v_r
/// alone scaled to the samples of the frames, which knows of light that their own samples missed; the latter two times how
/// much larger residuals of the channels' mean are than independent channels' would be. z is shrunk for skewness (Hall 1992)
/// and judged by Student's t for the effective number of bright pixels, (Σ w²v)²/Σ(w²v)², less one.
///
/// **Where it cannot tell** the outcome is [`Outcome::TooFew`]: effective numbers below 30, by v or as predicted; without a
/// prediction, regions where more pixels have v = 0 up to rounding than are constant; and without a prediction of a
/// reference that is not exact, all blocks: a block that no event reached looks like one without events, so that of rare
/// light on top of other noise (probability 0.002, 4 samples) every block that passes the other rules would alarm.
///
/// **Power and limits.** A factor 1 + δ is δ/c·√N standard errors in N pixels (and replicates) whose grey means have a relative
/// standard deviation c: 1 % is found in four frames of 48×36 pixels below c = 0.15. Frames and reference that are too
/// bright alike show nothing. The prediction is too small where the reference's samples are of low discrepancy and the
/// frames' are not.
///
/// # Errors
/// [`ShapeError`] if slices do not belong together or have not three channels.
pub fn brightness(
    frames: &[Observed<'_>],
    reference: &SampledTruth<'_>,
    states: bool,
    width: usize,
    groups: Option<Groups<'_>>,
) -> Result<BrightnessCheck, ShapeError> {
    let pixels = frames.first().map_or(0, |frame| frame.pixels);
    for frame in frames {
        frame.check()?;
        expect("pixels of a channel", frame.pixels, pixels)?;
        expect("mean", frame.mean.len(), 3 * pixels)?;
    }
    let truth = &reference.truth;
    truth.check(3 * pixels)?;
    groups.map_or(Ok(()), |g| expect("group map", g.of_pixel.len(), pixels))?;
    let height = pixels.div_ceil(width.max(1));
    let (around, tested) = (Blocks::new(width, height), Blocks::with_edge(width, height, EDGE));
    let at = |plane: &[f32], p: usize| [0, 1, 2].map(|c| f64::from(plane[c * pixels + p]));
    let known = |p: usize| at(truth.mean, p).iter().all(|r| r.is_finite());
    let weights = smooth_weights(&around, |p| {
        (p < pixels && known(p)).then(|| at(truth.mean, p).iter().sum::<f64>() / 3.0)
    });
    let mut by_weight = vec![ResidualSums::default(); around.count()];
    let mut by_block = vec![ResidualSums::default(); tested.count()];
    let group_count = groups.map_or(0, |g| g.count.min(LARGEST_GROUPS));
    let mut by_group = vec![ResidualSums::default(); group_count];
    for p in 0..pixels {
        let Some(pair) = pair(frames, reference, p, weights[around.of(p)]) else { continue };
        by_weight[around.of(p)].add_pixel(&pair);
        by_block[tested.of(p)].add_pixel(&pair);
        if let Some(own) = groups.and_then(|g| by_group.get_mut(usize::from(g.of_pixel[p]))) {
            own.add_pixel(&pair);
        }
    }
    let all = ResidualSums::total(&by_weight);
    let together = all.together();
    let test = |sums: &ResidualSums, between: f64| outcome(sums, states, together, between);
    let block = |sums: &ResidualSums| match truth.variance.is_none() || sums.predicted > 0.0 {
        true => test(sums, 0.0),
        false => Outcome::TooFew { effective: 0.0 },
    };
    let mut out = BrightnessCheck {
        image: test(&all, ResidualSums::between(&by_weight, &all)),
        groups: by_group.iter().map(|sums| test(sums, 0.0)).collect(),
        blocks: by_block.iter().map(block).collect(),
    };
    adjust(std::iter::once(&mut out.image).chain(&mut out.groups).chain(&mut out.blocks));
    Ok(out)
}

/// A pixel of the mean over the frames; `None` where it takes no part or something is not finite.
fn pair(
    frames: &[Observed<'_>],
    reference: &SampledTruth<'_>,
    pixel: usize,
    weight: f64,
) -> Option<PixelPair> {
    let pixels = frames.first()?.pixels;
    let count = frames.len() as f64; // at least 1
    let mean =
        |of: &dyn Fn(&Observed<'_>) -> f32| frames.iter().map(|f| f64::from(of(f))).sum::<f64>() / count;
    let channel = |c: usize| c * pixels + pixel;
    let truth = &reference.truth;
    let drawn: f64 = frames.iter().map(|frame| f64::from(frame.count_at(pixel))).sum();
    let pair = PixelPair {
        weight,
        seen: [0, 1, 2].map(|c| mean(&|frame| frame.mean[channel(c)])),
        truth: [0, 1, 2].map(|c| f64::from(truth.mean[channel(c)])),
        variance: Some([0, 1, 2].map(|c| mean(&|frame| frame.variance[channel(c)]) / count)),
        truth_variance: truth.variance.map(|v| [0, 1, 2].map(|c| f64::from(v[channel(c)]))),
        scale: reference.samples.filter(|n| *n > 0.0 && drawn > 0.0).map(|n| n / drawn),
        exact: false,
    };
    let numbers = pair.seen.iter().chain(&pair.truth).chain(pair.variance.iter().flatten());
    let finite = numbers.chain(pair.truth_variance.iter().flatten()).all(|v| v.is_finite());
    (finite && frames.iter().all(|frame| frame.takes_part(pixel))).then_some(pair)
}

fn outcome(sums: &ResidualSums, states: bool, together: f64, between: f64) -> Outcome {
    if sums.light <= 0.0 {
        return Outcome::TooFew { effective: 0.0 };
    }
    match sums.spread(states, together, between) {
        Err(effective) => Outcome::TooFew { effective },
        Ok(spread) => {
            let z = shrunk(sums.e, spread.variance, spread.third);
            let freedom = sums.effective_freedom(states);
            let p = t_two_sided_p(z, freedom);
            Outcome::Tested(Tested {
                value: sums.seen / sums.light,
                expected: 1.0,
                standard_error: spread.variance.sqrt() / sums.light,
                z,
                p,
                adjusted: p,
                effective: freedom as f64 + 1.0,
            })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Normals;
    use crate::{SampleCounts, rate_standard_error};

    /// Means and variances of the mean, planar.
    type Planes = (Vec<f32>, Vec<f32>);

    /// What a sample of mean 1 is.
    #[derive(Clone, Copy, PartialEq)]
    enum Law {
        Normal(f64),
        Exponential,
        /// 0, or 1/q with probability q.
        Event(f64),
        /// Half of it such an event, half normal with a standard deviation of 0.3.
        Mixed(f64),
    }

    impl Law {
        fn draw(self, normals: &mut Normals) -> f64 {
            match self {
                Self::Normal(sd) => 1.0 + sd * normals.next(),
                Self::Exponential => -normals.uniform().ln(),
                Self::Event(q) => f64::from(u8::from(normals.uniform() < q)) / q,
                Self::Mixed(q) => 0.5 + 0.3 * normals.next() + 0.5 * Self::Event(q).draw(normals),
            }
        }

        fn variance(self) -> f64 {
            match self {
                Self::Normal(sd) => sd * sd,
                Self::Exponential => 1.0,
                Self::Event(q) => (1.0 - q) / q,
                Self::Mixed(q) => 0.09 + 0.25 * Self::Event(q).variance(),
            }
        }
    }

    fn picture(i: usize) -> f64 {
        0.3 + (i % 13) as f64 / 4.0
    }

    fn frame(normals: &mut Normals, pixels: usize, n: u32, law: Law) -> Planes {
        let mut pixel = |i: usize| {
            let samples: Vec<f64> = (0..n).map(|_| picture(i) * law.draw(normals)).collect();
            let (mean, variance) = crate::interval::mean_and_variance(&samples).unwrap();
            (mean as f32, (variance / f64::from(n)) as f32)
        };
        (0..3 * pixels).map(&mut pixel).unzip()
    }

    /// Samples of the reference.
    const LONG: f64 = 16384.0;

    fn reference(normals: &mut Normals, pixels: usize, law: Law) -> Planes {
        let pixel = |i: usize| {
            let variance = picture(i).powi(2) * law.variance() / LONG;
            ((picture(i) + variance.sqrt() * normals.next()) as f32, variance as f32)
        };
        (0..3 * pixels).map(pixel).unzip()
    }

    fn test(frames: &[Planes], n: u32, width: usize, truth: SampledTruth<'_>) -> BrightnessCheck {
        let pixels = truth.truth.mean.len() / 3;
        let frames: Vec<_> = frames.iter().map(|planes| observed(planes, n, pixels)).collect();
        let of_pixel: Vec<u8> = (0..pixels).map(|p| u8::from(p % width < width / 2)).collect();
        let groups = Groups { of_pixel: &of_pixel, count: 2 };
        brightness(&frames, &truth, true, width, Some(groups)).unwrap()
    }

    fn noisy(planes: &Planes) -> SampledTruth<'_> {
        SampledTruth { truth: Truth { mean: &planes.0, variance: Some(&planes.1) }, samples: Some(LONG) }
    }

    fn exact(mean: &[f32]) -> SampledTruth<'_> {
        SampledTruth { truth: Truth { mean, variance: None }, samples: None }
    }

    fn observed(planes: &Planes, n: u32, pixels: usize) -> Observed<'_> {
        Observed {
            mean: &planes.0,
            variance: &planes.1,
            counts: SampleCounts::Uniform(n),
            pixels,
            valid: None,
        }
    }

    #[test]
    fn sound_frames_alarm_as_often_as_stated() {
        let (width, pixels) = (24, 24 * 16);
        let mut normals = Normals::new(2);
        for (law, n, replicates) in [
            (Law::Normal(0.5), 4, 1),
            (Law::Normal(0.5), 8, 3),
            (Law::Exponential, 4, 2),
            (Law::Event(0.05), 4, 2),
            (Law::Mixed(0.002), 4, 1),
            (Law::Mixed(0.02), 16, 1),
        ] {
            let draws = 200u32;
            let (mut family, mut alone) = (0u32, 0u32);
            for _ in 0..draws {
                let frames: Vec<_> = (0..replicates).map(|_| frame(&mut normals, pixels, n, law)).collect();
                let truth = reference(&mut normals, pixels, law);
                let found = test(&frames, n, width, noisy(&truth));
                family += u32::from(found.p().is_some_and(|p| p <= 0.05));
                alone += u32::from(found.image.tested().is_some_and(|t| t.p <= 0.05));
            }
            let most = 0.05 + 4.0 * rate_standard_error(0.05, u64::from(draws));
            let [family, alone] = [family, alone].map(|k| f64::from(k) / f64::from(draws));
            assert!(family <= most && alone <= most, "n = {n}: {family} {alone}");
            if law == Law::Normal(0.5) {
                assert!(alone > 0.005, "n = {n}: {alone}");
            }
        }
    }

    #[test]
    fn frames_that_are_one_percent_brighter_are_found_at_four_replicates() {
        let (width, pixels, n) = (48, 48 * 36, 16);
        let mut normals = Normals::new(3);
        let mut frames: Vec<_> = (0..4).map(|_| frame(&mut normals, pixels, n, Law::Normal(0.5))).collect();
        let truth = reference(&mut normals, pixels, Law::Normal(0.5));
        let sound = test(&frames, n, width, noisy(&truth));
        assert!(sound.p().unwrap() > 0.001 && sound.blocks.len() == 30 && sound.groups.len() == 2);
        for (mean, variance) in &mut frames {
            mean.iter_mut().for_each(|v| *v *= 1.01);
            variance.iter_mut().for_each(|v| *v *= 1.01 * 1.01);
        }
        let found = test(&frames, n, width, noisy(&truth));
        let image = found.image.tested().unwrap();
        assert!(image.z > 5.0 && image.adjusted < 1e-4, "{image:?}");
        assert!((image.value - 1.01).abs() < 4.0 * image.standard_error && image.standard_error < 0.002);
    }

    #[test]
    fn a_block_that_is_brighter_is_found_where_it_is() {
        let (width, pixels, n) = (48, 48 * 36, 16);
        let mut normals = Normals::new(4);
        let mut frames: Vec<_> = (0..2).map(|_| frame(&mut normals, pixels, n, Law::Normal(0.5))).collect();
        let truth = reference(&mut normals, pixels, Law::Normal(0.5));
        for (mean, _) in &mut frames {
            for i in (0..3 * pixels).filter(|i| i % pixels % width < 8 && i % pixels / width < 8) {
                mean[i] *= 1.1;
            }
        }
        let found = test(&frames, n, width, noisy(&truth));
        let failing: Vec<usize> = (0..30).filter(|&b| found.blocks[b].fails(0.01)).collect();
        assert_eq!(failing, [0]);
    }

    #[test]
    fn rare_light_is_too_few_bright_samples_to_tell() {
        let (width, pixels, n) = (48, 48 * 36, 4);
        let mut normals = Normals::new(5);
        let frames = [frame(&mut normals, pixels, n, Law::Event(0.002))];
        let truth: Vec<f32> = (0..3 * pixels).map(|i| picture(i) as f32).collect();
        let found = test(&frames, n, width, exact(&truth));
        assert!(found.all().all(|outcome| matches!(outcome, Outcome::TooFew { .. })), "{found:?}");
        assert_eq!(found.p(), None);
        // Blocks that no event reached are not dark: without a prediction no block is tested.
        let law = Law::Mixed(0.002);
        let frames = [frame(&mut normals, pixels, n, law)];
        let truth = reference(&mut normals, pixels, law);
        let unknown = SampledTruth { samples: None, ..noisy(&truth) };
        let found = test(&frames, n, width, unknown);
        assert!(found.blocks.iter().all(|outcome| matches!(outcome, Outcome::TooFew { .. })));
        let found = test(&frames, n, width, noisy(&truth));
        assert!(found.blocks.iter().any(|outcome| outcome.tested().is_some()));
        assert!(found.blocks.iter().all(|outcome| !outcome.fails(0.05)));
    }

    #[test]
    fn shapes_that_do_not_belong_together_are_refused() {
        let planes: Planes = (vec![1.0; 6], vec![0.1; 6]);
        let frame = observed(&planes, 4, 2);
        let truth = exact(&planes.0);
        let none = brightness(&[frame], &truth, true, 2, None).unwrap();
        assert!(matches!(none.image, Outcome::TooFew { .. }) && none.groups.is_empty());
        let one_channel = Observed { pixels: 6, ..frame };
        let told = brightness(&[one_channel], &truth, true, 2, None).unwrap_err().to_string();
        assert_eq!(told, "mean has 6 entries, expected 18");
        assert!(brightness(&[frame], &exact(&planes.0[..3]), true, 2, None).is_err());
        let other = Observed { mean: &planes.0[..3], variance: &planes.1[..3], pixels: 1, ..frame };
        assert!(brightness(&[frame, other], &truth, true, 2, None).is_err());
        assert!(brightness(&[], &exact(&[]), true, 0, None).is_ok());
    }
}
