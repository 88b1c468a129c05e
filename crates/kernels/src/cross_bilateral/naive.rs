//! The bank as nested loops, straight from the formulas: in `f64` the oracle of the tests, in `f32` the baseline of speed ratios.
//!
//! Both use one thread, one filter after another, and compute every D anew.

use super::Filtered;
use super::params::{BilateralGuide, BilateralParams, Spatial};
use crate::KernelError;
use crate::engine::LEAST_EXPONENT;
use crate::real::Real;

/// [`super::filter`] in `f64`.
///
/// # Errors
/// As [`BilateralParams::check`].
pub fn filter_f64(
    params: &BilateralParams,
    guides: &[BilateralGuide<'_>],
    planes: &[&[f32]],
    bank: &[Spatial],
) -> Result<Vec<Filtered<f64>>, KernelError> {
    filter(params, guides, planes, bank)
}

/// [`super::filter`] in `f32`.
///
/// # Errors
/// As [`BilateralParams::check`].
pub fn filter_f32(
    params: &BilateralParams,
    guides: &[BilateralGuide<'_>],
    planes: &[&[f32]],
    bank: &[Spatial],
) -> Result<Vec<Filtered>, KernelError> {
    filter(params, guides, planes, bank)
}

fn filter<R: Real>(
    params: &BilateralParams,
    guides: &[BilateralGuide<'_>],
    planes: &[&[f32]],
    bank: &[Spatial],
) -> Result<Vec<Filtered<R>>, KernelError> {
    params.check(guides, planes, bank)?;
    let (width, height) = (params.width, params.height);
    let pixels = width * height;
    let zero = R::from(0.0);
    let mut out = Vec::with_capacity(bank.len());
    for spatial in bank {
        let mut of = Filtered { planes: vec![vec![zero; pixels]; planes.len()], weights: vec![zero; pixels] };
        let r = spatial.reach();
        for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
            let p = y * width + x;
            for j in y.saturating_sub(r)..(y + r + 1).min(height) {
                for i in x.saturating_sub(r)..(x + r + 1).min(width) {
                    let q = j * width + i;
                    let mut exponent = distance::<R>(params, guides, p, q);
                    if q != p {
                        let squared = (x.abs_diff(i).pow(2) + y.abs_diff(j).pow(2)) as f64;
                        exponent += R::round(squared / (2.0 * f64::from(spatial.sigma).powi(2)));
                    }
                    let w = weight(exponent);
                    of.weights[p] += w;
                    for (sums, plane) in of.planes.iter_mut().zip(planes) {
                        sums[p] += w * R::from(plane[q]);
                    }
                }
            }
            for sums in &mut of.planes {
                // The pixel's own weight is 1.
                sums[p] = sums[p] / of.weights[p];
            }
        }
        out.push(of);
    }
    Ok(out)
}

/// D of two pixels.
fn distance<R: Real>(params: &BilateralParams, guides: &[BilateralGuide<'_>], p: usize, q: usize) -> R {
    let of = |guide: &BilateralGuide<'_>| {
        let d = R::from(guide.value[p]) - R::from(guide.value[q]);
        let variance = R::from(guide.variance[p]) + R::from(guide.variance[q]);
        let sigma = R::from(guide.sigma);
        d * d / variance.max(R::from(params.floor)) / (R::from(2.0) * sigma * sigma)
    };
    guides.iter().map(of).sum()
}

/// e^−exponent, 0 below the range of normal numbers of the fast form.
fn weight<R: Real>(exponent: R) -> R {
    let most = R::round(f64::from(-LEAST_EXPONENT) * std::f64::consts::LN_2);
    if exponent > most { R::from(0.0) } else { (-exponent).exp() }
}
