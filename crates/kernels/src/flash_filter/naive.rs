//! The filter as nested loops: in `f64` the oracle of the tests, in `f32` the baseline of speed ratios.
//!
//! Both use one thread. The membership test is the shared `f32` expression in both, so that a neighbour on the
//! very edge of the interval is judged alike; all else is in the precision that the name says. Sections and equations are
//! those of moon2013flash.

use super::members::Tests;
use super::volume::Volume;
use super::{Carried, Filtered, FlashFilterError, FlashInputs, FlashParams, Guide};
use crate::engine::mirror;
use crate::real::Real;

/// Weights of neighbours, whether or not they belong to the set.
#[derive(Debug)]
pub(super) struct Weights<'a, R> {
    params: &'a FlashParams,
    inputs: &'a FlashInputs<'a>,
    /// 1/(2σ_s²).
    spatial: R,
    /// Patch weights G of one frame in rows.
    patch: Vec<R>,
}

/// A pixel (x, y) of the frame `time` after the target, (x, y, time).
type Place = (isize, isize, isize);

impl<'a, R: Real> Weights<'a, R> {
    pub fn new(params: &'a FlashParams, inputs: &'a FlashInputs<'a>) -> Self {
        let f = params.patch.radius() as isize;
        let tap = |i: isize| params.patch.tap(i.unsigned_abs());
        let patch = (-f..=f).flat_map(|j| (-f..=f).map(move |i| R::round(tap(j) * tap(i)))).collect();
        // The largest finite number, so that offset 0 has exponent 0 for any σ_s.
        let spatial = R::round((0.5 / f64::from(params.spatial_sigma).powi(2)).min(R::MAX.into()));
        Self { params, inputs, spatial, patch }
    }

    /// Weight of neighbour `q` for pixel `p` of the target, 0 to 1: g_s·g_r of Eq. 1.
    #[inline]
    pub fn weight(&self, (px, py): (isize, isize), (qx, qy, time): Place) -> R {
        // Sec. 4: in a volume of frames the distance has three dimensions.
        let offset = R::round(((qx - px).pow(2) + (qy - py).pow(2) + time.pow(2)) as f64);
        let (Some(p_guide), Some(q_guide)) = (self.guide(0), self.guide(time)) else {
            return (-offset * self.spatial).exp();
        };
        let distance = self.distance((px, py), (qx, qy, time));
        if distance.into().is_finite() {
            // The smaller σ_r² of the pair is ours, as Sec. 4 asks for proportionality and no more.
            let sigma_r2 =
                |guide: Guide<'_>, x, y| R::from(guide.sigma_r2[y as usize * self.params.width + x as usize]);
            let pair = sigma_r2(p_guide, px, py).min(sigma_r2(q_guide, qx, qy));
            (-offset * self.spatial - distance / R::from(3.0) / (R::from(2.0) * pair)).exp()
        } else {
            // Overflow: nothing alike.
            R::from(0.0)
        }
    }

    fn guide(&self, time: isize) -> Option<Guide<'a>> {
        self.inputs.frame(time)?.guide
    }

    /// Sec. 3.2: weighted squared distance of the patches u(F_p) and u(F_q), summed over the channels. In a volume they are
    /// cubes (Sec. 4), of which those taps count whose frames are there for both.
    fn distance(&self, p: (isize, isize), (qx, qy, time): Place) -> R {
        let f = self.params.patch.radius() as isize;
        let tap = |k: isize| self.params.patch.tap(k.unsigned_abs());
        let both = |k: isize| Some((self.guide(k)?, self.guide(time + k)?));
        let sum: f64 = (-f..=f).filter(|&k| both(k).is_some()).map(tap).sum();
        let mut distance = R::from(0.0);
        for k in -f..=f {
            if let Some(guides) = both(k) {
                distance += R::round(tap(k) / sum) * self.flat_distance(guides, p, (qx, qy));
            }
        }
        distance
    }

    /// The part of one frame of p's patch and one of q's.
    fn flat_distance(
        &self,
        (p_guide, q_guide): (Guide<'_>, Guide<'_>),
        (px, py): (isize, isize),
        (qx, qy): (isize, isize),
    ) -> R {
        let (w, h) = (self.params.width, self.params.height);
        let f = self.params.patch.radius() as isize;
        let mut distance = R::from(0.0);
        let mut taps = self.patch.iter();
        for j in -f..=f {
            let (p_row, q_row) = (mirror(py + j, h) * w, mirror(qy + j, h) * w);
            for (i, tap) in (-f..=f).zip(&mut taps) {
                let (a, b) = (p_row + mirror(px + i, w), q_row + mirror(qx + i, w));
                let mut square = R::from(0.0);
                for (p_plane, q_plane) in p_guide.planes.into_iter().zip(q_guide.planes) {
                    let difference = R::from(p_plane[a]) - R::from(q_plane[b]);
                    square += difference * difference;
                }
                distance += *tap * square;
            }
        }
        distance
    }
}

/// The loop itself, on checked inputs: Eq. 1 over the set of Eq. 2.
fn sums<R: Real>(
    params: &FlashParams,
    inputs: &FlashInputs<'_>,
    carried: Option<&Carried<'_>>,
) -> Filtered<R> {
    let volume = Volume::new(params, inputs);
    let tests = Tests::new(inputs, &volume);
    let weights = Weights::<R>::new(params, inputs);
    let (w, h, r) = (params.width as isize, params.height as isize, params.window_radius as isize);
    let planes = || [(); 3].map(|()| Vec::with_capacity(params.width * params.height));
    let mut out = Filtered { image: planes(), carried: planes() };
    let (along, squared) = carried.map_or(([&[][..]; 3], false), Carried::parts);
    // The cube clipped to the frames that are there, as each of them is clipped to the image.
    let window: Vec<_> = (-r..=r).filter_map(|t| Some((t, volume.place(t)?, inputs.frame(t)?))).collect();
    for (py, px) in (0..h).flat_map(|y| (0..w).map(move |x| (y, x))) {
        let p = (py * w + px) as usize;
        let [mut sum, mut total, mut other] = [[R::from(0.0); 3]; 3];
        for &(time, place, frame) in &window {
            let along = frame.carried.unwrap_or(along);
            for qy in (py - r).max(0)..=(py + r).min(h - 1) {
                for qx in (px - r).max(0)..=(px + r).min(w - 1) {
                    let q = (qy * w + qx) as usize;
                    // Eq. 2.
                    let members = tests.members(p, place, q);
                    if members == [false; 3] {
                        continue;
                    }
                    let weight = weights.weight((px, py), (qx, qy, time));
                    for c in (0..3).filter(|&c| members[c]) {
                        sum[c] += weight * (R::from(frame.source[c][q]) - R::from(inputs.source[c][p]));
                        total[c] += weight;
                        if carried.is_some() {
                            let weight = if squared { weight * weight } else { weight };
                            other[c] += weight * R::from(along[c][q]);
                        }
                    }
                }
            }
        }
        for c in 0..3 {
            // Eq. 1. The pixel itself has weight exp(0) = 1, so k(p), the sum of weights, is at least 1.
            out.image[c].push(R::from(inputs.source[c][p]) + sum[c] / total[c]);
            if carried.is_some() {
                out.carried[c].push(other[c] / if squared { total[c] * total[c] } else { total[c] });
            }
        }
    }
    out
}

/// The filter in double precision: the oracle.
///
/// # Errors
/// As [`FlashParams::check`].
pub fn filter_f64(params: &FlashParams, inputs: &FlashInputs<'_>) -> Result<[Vec<f64>; 3], FlashFilterError> {
    params.check(inputs)?;
    Ok(sums(params, inputs, None).image)
}

/// The same loops in single precision: what a first implementation would be, and the baseline of speed ratios.
///
/// # Errors
/// As [`FlashParams::check`].
pub fn filter_f32(params: &FlashParams, inputs: &FlashInputs<'_>) -> Result<[Vec<f32>; 3], FlashFilterError> {
    params.check(inputs)?;
    Ok(sums(params, inputs, None).image)
}

/// [`super::filter_carrying`] in double precision: its oracle.
///
/// # Errors
/// As [`super::filter_carrying`].
pub fn filter_carrying_f64(
    params: &FlashParams,
    inputs: &FlashInputs<'_>,
    carried: &Carried<'_>,
) -> Result<Filtered<f64>, FlashFilterError> {
    params.check(inputs)?;
    params.check_carried(inputs, carried)?;
    Ok(sums(params, inputs, Some(carried)))
}
