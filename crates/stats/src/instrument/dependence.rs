//! Are frames and reference drawn from different random numbers?
//!
//! With halves A and B of a reference and r̄ their mean by samples: Σ w(x̄ − r̄)(A − B). If the frame is independent of the
//! reference its mean is 0: E x̄(A−B) = 0 since A and B have one mean, and r̄ is uncorrelated with A − B, because the shares p
//! and q of the samples weigh the halves' variances alike, p·Var A = q·Var B. Samples of the frame that are in one half only
//! make it differ from 0. Where a frame has halves as well, Σ w(x_A − x_B)(A − B) finds those that are in both, if they are
//! split alike.

use crate::instrument::correlation::correlation;
use crate::instrument::{Blocks, Outcome, Tested, outcome::adjust};
use crate::observed::expect;
use crate::{ShapeError, t_two_sided_p};

/// Mean of a frame, and its halves if it has them; planar, three channels.
#[derive(Debug, Clone, Copy)]
pub struct FrameMeans<'a> {
    /// x̄.
    pub mean: &'a [f32],
    /// x_A and x_B.
    pub halves: Option<[&'a [f32]; 2]>,
}

/// What the frames of one scene have in common with its reference.
#[derive(Debug, Clone, PartialEq)]
pub struct Dependence {
    /// Per frame: correlation of x̄ − r̄ and A − B.
    pub centres: Vec<Outcome>,
    /// Per frame: correlation of x_A − x_B and A − B; absent without halves of the frame.
    pub halves: Vec<Option<Outcome>>,
}

/// Correlations of each frame's errors with the difference of the reference's halves, one channel mean per pixel; all
/// adjusted as one family. `mean` is r̄ of the reference, `valid` the pixels that take part (all if absent).
///
/// **Standard error**, [`correlation`]'s: the larger of those over pixels and over blocks. A jackknife over the reference's
/// parts has none of the power: if one of n_A parts of half A is the frame, that part's influence is as large as the
/// statistic, and z stays near √(n_A/(n_A−1)), however many pixels there are.
///
/// **Power and limits.** One of n_A parts that has the frame's samples correlates by up to 1/√(2·n_A), times √N standard
/// errors in N pixels: about 10 in a frame of 48×36 and 4 parts per half. Where all parts share equally with the frame A − B
/// cancels, and only seeds and hashes tell.
///
/// # Errors
/// [`ShapeError`] if slices do not belong together or have not three channels.
pub fn dependence(
    frames: &[FrameMeans<'_>],
    mean: &[f32],
    halves: [&[f32]; 2],
    blocks: &Blocks,
    valid: Option<&[bool]>,
) -> Result<Dependence, ShapeError> {
    let pixels = blocks.pixels();
    expect("reference", mean.len(), 3 * pixels)?;
    valid.map_or(Ok(()), |valid| expect("valid pixels", valid.len(), pixels))?;
    let shape = |half: &[f32]| expect("half of the reference", half.len(), 3 * pixels);
    halves.iter().try_for_each(|half| shape(half))?;
    for frame in frames {
        expect("frame", frame.mean.len(), 3 * pixels)?;
        frame.halves.iter().flatten().try_for_each(|half| expect("half buffer", half.len(), 3 * pixels))?;
    }
    let usable = |p: usize| valid.is_none_or(|valid| valid[p]);
    let apart = |a: &[f32], b: &[f32], p: usize| -> f64 {
        (p..a.len()).step_by(pixels).map(|i| f64::from(a[i]) - f64::from(b[i])).sum::<f64>() / 3.0
    };
    let reference = |p: usize| apart(halves[0], halves[1], p);
    let of = |a: &[f32], b: &[f32]| match correlation(blocks, usable, |p| apart(a, b, p), reference) {
        None => Outcome::TooFew { effective: 0.0 },
        Some(found) => {
            let p = t_two_sided_p(found.z, found.freedom);
            // z is not 0 where ρ is not; with ρ = 0 any error stands for it.
            let standard_error = if found.z == 0.0 { 1.0 } else { found.rho / found.z };
            let effective = found.freedom as f64 + 1.0;
            Outcome::Tested(Tested {
                value: found.rho,
                expected: 0.0,
                standard_error,
                z: found.z,
                p,
                adjusted: p,
                effective,
            })
        }
    };
    let mut out = Dependence {
        centres: frames.iter().map(|frame| of(frame.mean, mean)).collect(),
        halves: frames.iter().map(|frame| frame.halves.map(|[a, b]| of(a, b))).collect(),
    };
    adjust(out.centres.iter_mut().chain(out.halves.iter_mut().flatten()));
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Normals;
    use crate::rate_standard_error;

    const SIZE: (usize, usize) = (48, 36);
    const PARTS: usize = 4;

    /// A frame's part or a reference's: normal errors about a picture that is not constant.
    fn part(normals: &mut Normals, pixels: usize) -> Vec<f32> {
        (0..3 * pixels).map(|i| ((i % 11) as f64 * (1.0 + 0.3 * normals.next())) as f32).collect()
    }

    fn average(parts: &[&[f32]]) -> Vec<f32> {
        let n = parts.len() as f32;
        (0..parts[0].len()).map(|i| parts.iter().map(|p| p[i]).sum::<f32>() / n).collect()
    }

    /// `reference` has first the parts of half A, then those of B.
    fn test(frames: &[[Vec<f32>; 2]], reference: &[Vec<f32>], blocks: &Blocks) -> Dependence {
        let slices: Vec<&[f32]> = reference.iter().map(Vec::as_slice).collect();
        let means: Vec<Vec<f32>> = frames.iter().map(|[a, b]| average(&[a, b])).collect();
        let frames: Vec<_> = frames
            .iter()
            .zip(&means)
            .map(|([a, b], mean)| FrameMeans { mean, halves: Some([a, b]) })
            .collect();
        let in_a = slices.len() / 2;
        let halves = [average(&slices[..in_a]), average(&slices[in_a..])];
        dependence(&frames, &average(&slices), [&halves[0], &halves[1]], blocks, None).unwrap()
    }

    #[test]
    fn independent_frames_alarm_as_often_as_stated() {
        let (w, h) = (24, 18);
        let blocks = Blocks::new(w, h);
        let mut normals = Normals::new(4);
        let (draws, mut alarms, mut alone) = (600u32, 0u32, 0u32);
        for _ in 0..draws {
            let reference: Vec<_> = (0..2).map(|_| part(&mut normals, w * h)).collect();
            let frames = [(); 2].map(|()| [(); 2].map(|()| part(&mut normals, w * h)));
            let found = test(&frames, &reference, &blocks);
            let all = || found.centres.iter().chain(found.halves.iter().flatten());
            alarms += u32::from(all().any(|outcome| outcome.fails(0.05)));
            alone += u32::from(found.halves[0].unwrap().tested().unwrap().p <= 0.05);
        }
        let mcse = rate_standard_error(0.05, u64::from(draws));
        let [family, alone] = [alarms, alone].map(|k| f64::from(k) / f64::from(draws));
        assert!(family <= 0.05 + 4.0 * mcse, "{family}");
        // The larger of two standard errors is somewhat too large.
        assert!(alone <= 0.05 + 4.0 * mcse && alone > 0.005, "{alone}");
    }

    #[test]
    fn samples_that_a_reference_shares_with_a_frame_are_found() {
        let pixels = SIZE.0 * SIZE.1;
        let blocks = Blocks::new(SIZE.0, SIZE.1);
        let mut normals = Normals::new(5);
        let mut reference: Vec<_> = (0..2 * PARTS).map(|_| part(&mut normals, pixels)).collect();
        let frames: Vec<_> = (0..4).map(|_| [(); 2].map(|()| part(&mut normals, pixels))).collect();
        let sound = test(&frames, &reference, &blocks);
        assert!(!sound.centres.iter().any(|o| o.fails(0.001)), "{sound:?}");
        // The third frame is one of the parts.
        reference[1] = average(&[&frames[2][0], &frames[2][1]]);
        let found = test(&frames, &reference, &blocks);
        assert!(found.centres[2].fails(1e-9) && found.centres[2].tested().unwrap().z > 8.0, "{found:?}");
        assert!(!found.centres[0].fails(0.001) && !found.centres[3].fails(0.001));
        // Its halves are parts of both halves: the centre sees nothing, the halves do.
        reference[1] = frames[2][0].clone();
        reference[PARTS + 1] = frames[2][1].clone();
        let found = test(&frames, &reference, &blocks);
        assert!(!found.centres[2].fails(0.001) && found.halves[2].unwrap().fails(1e-9), "{found:?}");
    }

    #[test]
    fn a_jackknife_over_parts_would_not_see_the_part_that_is_shared() {
        // z of T = Σ(x − r̄)(A − B) with the influences L_k of the parts as its variance.
        let pixels = SIZE.0 * SIZE.1;
        let mut normals = Normals::new(6);
        let reference: Vec<_> = (0..2 * PARTS).map(|_| part(&mut normals, pixels)).collect();
        let x = &reference[1];
        let slices: Vec<&[f32]> = reference.iter().map(Vec::as_slice).collect();
        let (a, b) = (average(&slices[..PARTS]), average(&slices[PARTS..]));
        let n = PARTS as f64;
        let sum = |of: &dyn Fn(usize) -> f64| (0..x.len()).map(of).sum::<f64>();
        let f = |v: &[f32], i: usize| f64::from(v[i]);
        let residual = |i: usize| f(x, i) - 0.5 * (f(&a, i) + f(&b, i));
        let t = sum(&|i| residual(i) * (f(&a, i) - f(&b, i)));
        let influence = |k: usize| {
            let half = if k < PARTS { &a } else { &b };
            sum(&|i| residual(i) * (f(slices[k], i) - f(half, i))) / (n * (n - 1.0)).sqrt()
        };
        let z = t / (0..2 * PARTS).map(|k| influence(k).powi(2)).sum::<f64>().sqrt();
        assert!(z > 0.5 && z < 1.5, "{z}");
    }

    #[test]
    fn small_images_tell_nothing_and_wrong_shapes_are_refused() {
        let plane = vec![0.5; 3 * 4];
        let frame = FrameMeans { mean: &plane, halves: None };
        let blocks = Blocks::new(2, 2);
        let found = dependence(&[frame], &plane, [&plane, &plane], &blocks, None).unwrap();
        assert_eq!((found.centres, found.halves), (vec![Outcome::TooFew { effective: 0.0 }], vec![None]));
        assert!(dependence(&[frame], &plane, [&plane, &plane[1..]], &blocks, None).is_err());
        assert!(dependence(&[frame], &plane, [&plane, &plane], &blocks, Some(&[true])).is_err());
    }
}
