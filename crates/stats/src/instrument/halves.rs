//! Is the stated variance that which two halves of the samples show?
//!
//! A and B are means of n_A and n_B disjoint samples of a pixel, n = n_A + n_B. If samples are independent, Var(A−B) =
//! σ²(1/n_A + 1/n_B) = σ²·n/(n_A·n_B), so that (A−B)²·n_A·n_B/n² has the mean σ²/n, which is that of v = s²/n too: in every
//! pixel, for every law of samples. The sum over pixels of their difference has the mean 0, the ratio of their sums is 1.

use crate::instrument::{Blocks, LEAST_EFFECTIVE, Outcome, Tested, shrunk};
use crate::observed::expect;
use crate::{Observed, SampleCounts, ShapeError, t_two_sided_p};

/// A frame with the means of two halves of its samples.
#[derive(Debug, Clone, Copy)]
pub struct HalvedFrame<'a> {
    /// Mean, stated variance and samples per pixel.
    pub observed: Observed<'a>,
    /// A and B, in the order of the means.
    pub halves: [&'a [f32]; 2],
    /// n_A, at least 1 and below n where a pixel takes part.
    pub in_a: SampleCounts<'a>,
}

/// Side of the blocks whose sums count as independent, pixels.
const EDGE: usize = 32;
/// Fewest blocks over all frames of which a spread is taken.
const LEAST_BLOCKS: usize = 16;

/// Sums of a unit: N = (A−B)²·n_A·n_B/n² and V = v, weighted; over channels and pixels.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    shown: f64,
    stated: f64,
    /// Σ of a pixel's V².
    stated2: f64,
    /// Σ of a pixel's (N−V)² and (N−V)³.
    squares: f64,
    cubes: f64,
    /// Σ over pixel-channels of 2V²(n−2)/(n+1): for normal samples Var(N−V) = 2σ⁴(n−2)/(n−1) and E V² = σ⁴(n+1)/(n−1), with
    /// σ² the mean of V.
    normal: f64,
}

/// Ratio of what the halves of `frames` (replicates of one picture or frames of several, all with rows of `width` pixels)
/// show over what they state: Σ(A−B)²·n_A·n_B/n² : Σ v. 1 without a fault. `weight` per pixel of a channel evens out bright
/// and dark regions ([`crate::instrument::smooth_weights`], squared); 1 if absent.
///
/// A stated variance of one sample gives 1/n, s² divided by n once too often n, halves whose spread is twice too large 2,
/// (n−1)/n in place of 1 gives n/(n−1); low-discrepancy samples that pass for independent ones are below 1 or above it,
/// by how their halves were made.
///
/// **Standard error.** The larger of three, each of Σ(N−V)/ΣV without a fault: from the squares of the pixels' N−V (a pixel's
/// channels are one cluster); that of normal and independent values, √(2·Σ V²(n−2)/(n+1))/ΣV, which is √(2/N) for N equal
/// variances and many samples; and, from 16 blocks of 32×32 pixels over all frames on, from the spread of the blocks' sums
/// about the ratio, which knows of correlated neighbours. With fewer blocks, as in a single small image, the first two stand
/// alone.
///
/// The largest of several is somewhat too large: at 5 %, sound images of 144 pixels alarm in 3 %.
///
/// **Power and limits.** In four frames of 48×36 pixels and 3 channels a factor of 1.05 is five standard errors at equal
/// variances: n/(n−1) is found up to n of about 20. Pixels of 2 samples say nothing: there N = V whatever the samples. Below
/// an effective number of 30 pixels, (ΣV)²/ΣV², the outcome is [`Outcome::TooFew`].
///
/// # Errors
/// [`ShapeError`] if slices do not belong together.
pub fn half_variance_ratio(
    frames: &[HalvedFrame<'_>],
    width: usize,
    weight: Option<&[f64]>,
) -> Result<Outcome, ShapeError> {
    let mut blocks = Vec::new();
    for frame in frames {
        check(frame, weight)?;
        let grid = Blocks::with_edge(width, frame.observed.pixels.div_ceil(width.max(1)), EDGE);
        let mut own = vec![Sums::default(); grid.count()];
        for pixel in (0..frame.observed.pixels).filter(|&p| frame.observed.takes_part(p)) {
            add(&mut own[grid.of(pixel)], frame, pixel, weight.map_or(1.0, |w| w[pixel]));
        }
        blocks.extend(own.into_iter().filter(|sums| sums.shown > 0.0 || sums.stated > 0.0));
    }
    Ok(outcome(&blocks))
}

fn check(frame: &HalvedFrame<'_>, weight: Option<&[f64]>) -> Result<(), ShapeError> {
    let observed = &frame.observed;
    observed.check()?;
    frame.halves.iter().try_for_each(|half| expect("half buffer", half.len(), observed.mean.len()))?;
    if let SampleCounts::PerPixel(map) = frame.in_a {
        expect("sample counts of half A", map.len(), observed.pixels)?;
    }
    weight.map_or(Ok(()), |w| expect("weight", w.len(), observed.pixels))
}

fn add(sums: &mut Sums, frame: &HalvedFrame<'_>, pixel: usize, weight: f64) {
    let observed = &frame.observed;
    let n = observed.count_at(pixel);
    let in_a = match frame.in_a {
        SampleCounts::Uniform(n) => n,
        SampleCounts::PerPixel(map) => map[pixel],
    };
    if n < 3 || in_a == 0 || in_a >= n || !(weight > 0.0 && weight.is_finite()) {
        return;
    }
    let n = f64::from(n);
    let share = f64::from(in_a) / n;
    let (mut shown, mut stated, mut normal) = (0.0, 0.0, 0.0);
    for i in (pixel..observed.mean.len()).step_by(observed.pixels) {
        let [a, b] = frame.halves.map(|half| f64::from(half[i]));
        let variance = weight * f64::from(observed.variance[i]);
        let difference = weight * (a - b) * (a - b) * share * (1.0 - share);
        if !(variance + difference).is_finite() || variance < 0.0 {
            return; // the pixel as a whole
        }
        shown += difference;
        stated += variance;
        normal += 2.0 * variance * variance * (n - 2.0) / (n + 1.0);
    }
    let apart = shown - stated;
    sums.shown += shown;
    sums.stated += stated;
    sums.stated2 += stated * stated;
    sums.squares += apart * apart;
    sums.cubes += apart * apart * apart;
    sums.normal += normal;
}

fn outcome(blocks: &[Sums]) -> Outcome {
    let total = |of: fn(&Sums) -> f64| blocks.iter().map(of).sum::<f64>();
    let (shown, stated, stated2) = (total(|s| s.shown), total(|s| s.stated), total(|s| s.stated2));
    let effective = if stated2 > 0.0 { stated * stated / stated2 } else { 0.0 };
    if effective < LEAST_EFFECTIVE {
        return Outcome::TooFew { effective };
    }
    let apart: f64 = blocks.iter().map(|s| s.shown - s.stated).sum();
    let mut variance = total(|s| s.squares).max(total(|s| s.normal)); // above 0: effective is
    let mut freedom = effective;
    if blocks.len() >= LEAST_BLOCKS {
        let excess = apart / stated; // stated > 0: effective is
        let about = |s: &Sums| (s.shown - s.stated - excess * s.stated).powi(2);
        let count = blocks.len() as f64;
        let between = blocks.iter().map(about).sum::<f64>() * count / (count - 1.0);
        if between > variance {
            (variance, freedom) = (between, blocks.len() as f64);
        }
    }
    let z = shrunk(apart, variance, total(|s| s.cubes));
    let p = t_two_sided_p(z, freedom as u64 - 1);
    Outcome::Tested(Tested {
        value: shown / stated,
        expected: 1.0,
        standard_error: variance.sqrt() / stated,
        z,
        p,
        adjusted: p,
        effective,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Normals;
    use crate::rate_standard_error;

    /// Planes of one frame.
    struct Made {
        mean: Vec<f32>,
        variance: Vec<f32>,
        halves: [Vec<f32>; 2],
    }

    fn frame(pixels: usize, n: u32, mut sample: impl FnMut(usize) -> f64) -> Made {
        let mut out = Made { mean: vec![], variance: vec![], halves: [vec![], vec![]] };
        let in_a = n as usize / 2;
        for i in 0..3 * pixels {
            let samples: Vec<f64> = (0..n).map(|_| sample(i % pixels)).collect();
            let (mean, variance) = crate::interval::mean_and_variance(&samples).unwrap();
            let average = |part: &[f64]| (part.iter().sum::<f64>() / part.len() as f64) as f32;
            out.mean.push(mean as f32);
            out.variance.push((variance / f64::from(n)) as f32);
            out.halves[0].push(average(&samples[..in_a]));
            out.halves[1].push(average(&samples[in_a..]));
        }
        out
    }

    fn test(all: &[Made], n: u32, width: usize) -> Outcome {
        let pixels = all[0].mean.len() / 3;
        let frames: Vec<_> = all
            .iter()
            .map(|made| HalvedFrame {
                observed: Observed {
                    mean: &made.mean,
                    variance: &made.variance,
                    counts: SampleCounts::Uniform(n),
                    pixels,
                    valid: None,
                },
                halves: made.halves.each_ref().map(Vec::as_slice),
                in_a: SampleCounts::Uniform(n / 2),
            })
            .collect();
        half_variance_ratio(&frames, width, None).unwrap()
    }

    #[test]
    fn sound_frames_alarm_as_often_as_stated() {
        let mut normals = Normals::new(1);
        for (n, exponential) in [(4, false), (5, false), (16, false), (4, true)] {
            let draws = 800u32;
            let mut alarms = [0u32; 2];
            for _ in 0..draws {
                let made = frame(144, n, |p| {
                    let scale = 0.1 + (p % 7) as f64;
                    scale * if exponential { -normals.uniform().ln() } else { normals.next() }
                });
                let found = test(&[made], n, 16);
                // A skewed frame may have too little light to tell.
                let p = found.tested().map_or(1.0, |tested| tested.p);
                alarms[0] += u32::from(p <= 0.05);
                alarms[1] += u32::from(p <= 0.01);
            }
            for (alarms, alpha) in alarms.into_iter().zip([0.05, 0.01]) {
                let rate = f64::from(alarms) / f64::from(draws);
                let mcse = rate_standard_error(alpha, u64::from(draws));
                assert!(rate <= alpha + 4.0 * mcse, "n = {n}: {rate} at {alpha}");
            }
            let least = 0.05 - 4.0 * rate_standard_error(0.05, u64::from(draws));
            assert!(exponential || f64::from(alarms[0]) / f64::from(draws) >= least, "{alarms:?}");
        }
    }

    /// Four frames of 48×36, scaled as a fault would.
    fn planted(n: u32, scale: impl Fn(&mut Made)) -> Tested {
        let mut normals = Normals::new(u64::from(n));
        let mut all: Vec<_> = (0..4).map(|_| frame(48 * 36, n, |_| 1.0 + 0.5 * normals.next())).collect();
        all.iter_mut().for_each(scale);
        *test(&all, n, 48).tested().unwrap()
    }

    #[test]
    fn wrong_variances_are_found_at_four_replicates() {
        let times = |factor: f32| move |made: &mut Made| made.variance.iter_mut().for_each(|v| *v *= factor);
        for n in [4, 16] {
            let sound = planted(n, |_| ());
            assert!(
                sound.z.abs() < 4.0 && (sound.value - 1.0).abs() < 4.0 * sound.standard_error,
                "{sound:?}"
            );
            let found = planted(n, |made| {
                // (A−B)² twice as large, about the same mean.
                let [a, b] = &mut made.halves;
                for (a, b) in a.iter_mut().zip(b) {
                    let (middle, half) = (0.5 * (*a + *b), 0.5 * 2f32.sqrt() * (*a - *b));
                    (*a, *b) = (middle + half, middle - half);
                }
            });
            assert!(found.z > 20.0 && (found.value - 2.0).abs() < 0.1, "{found:?}");
            let found = planted(n, times(n as f32));
            assert!(found.z < -20.0 && (found.value * f64::from(n) - 1.0).abs() < 0.1, "{found:?}");
            let factor = (n - 1) as f32 / n as f32;
            let found = planted(n, times(factor));
            assert!(found.z > 4.0, "{n}: {found:?}");
            let found = planted(n, times(1.0 / n as f32));
            assert!(found.z > 20.0, "{found:?}");
        }
    }

    #[test]
    fn correlated_neighbours_widen_the_error_where_there_are_blocks() {
        // All pixels of a block of 32×32 are alike: 36 independent blocks in place of 36864 pixels.
        let mut normals = Normals::new(9);
        let draws = 40;
        let mut alarms = 0;
        for _ in 0..draws {
            let block: Vec<[f64; 4]> = (0..36).map(|_| std::array::from_fn(|_| normals.next())).collect();
            let mut at = vec![0usize; 192 * 192];
            let made = frame(192 * 192, 4, |p| {
                let samples = &block[p / 192 / 32 * 6 + p % 192 / 32];
                at[p] += 1;
                samples[(at[p] - 1) % 4]
            });
            alarms += u32::from(test(&[made], 4, 192).tested().unwrap().p <= 0.01);
        }
        // Expected 0.4; from pixels alone nearly all of the 40 would alarm.
        assert!(alarms <= 3, "{alarms}");
    }

    #[test]
    fn too_little_light_is_an_outcome() {
        let mut normals = Normals::new(2);
        let made = frame(100, 4, |p| if p < 7 { normals.next() } else { 0.0 });
        let Outcome::TooFew { effective } = test(&[made], 4, 10) else { panic!() };
        assert!(effective > 1.0 && effective < 8.0);
        let two = frame(100, 2, |p| p as f64 + normals.next());
        assert_eq!(test(&[two], 2, 10), Outcome::TooFew { effective: 0.0 }, "two samples say nothing");
        assert_eq!(half_variance_ratio(&[], 10, None), Ok(Outcome::TooFew { effective: 0.0 }));
    }
}
