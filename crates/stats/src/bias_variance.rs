//! How much of a squared error is bias and how much variance, against a reference that is noisy itself.
//!
//! D_r are images of R replicates, A and B independent halves of a reference of mean μ, D̄ the mean image. Per pixel and
//! channel, with b = E D − μ and V = Var D:
//!
//! * V̂ = Σ(D_r − D̄)²/(R−1), E V̂ = V;
//! * B̂² = (D̄ − A)(D̄ − B) − V̂/R, E B̂² = b², since E (D̄ − A)(D̄ − B) = b² + V/R;
//! * their sum is the mean over replicates of (D_r − A)(D_r − B), the corrected squared error, exactly: that mean is
//!   (D̄ − A)(D̄ − B) + (R−1)/R·V̂.
//!
//! B̂² of a pixel may be negative: it is unbiased, and the bias of most pixels is smaller than their noise.

mod error;
mod jackknife;
mod reference;
mod sums;
mod total;

use crate::observed::{Groups, LARGEST_GROUPS, expect};

pub use error::BiasVarianceError;
pub use reference::{BiasReference, ReferenceNoise};
pub use total::{BiasVarianceTotal, Estimated};

use sums::{Sums, Terms};

/// Images of the same pixels from independent replicates; planar, all channels one after the other.
#[derive(Debug, Clone, Copy)]
pub struct Replicates<'a> {
    /// D_r, at least two.
    pub images: &'a [&'a [f32]],
    /// Pixels per channel.
    pub pixels: usize,
    /// Pixels that take part; all if absent.
    pub valid: Option<&'a [bool]>,
    /// Weight of each pixel-channel in the totals, at least 0; 1 if absent. With w = 1/(max(r,0)²+ε) of the reference's mean
    /// they are relative errors; what the reference's noise in w does to them, of the order of its relative variance, is not
    /// taken out.
    pub weight: Option<&'a [f64]>,
}

/// Estimates per pixel-channel, without weight; not a number where something is not finite or a pixel takes no part.
#[derive(Debug, Clone, PartialEq)]
pub struct BiasVarianceMaps {
    /// D̄ − r, signed.
    pub bias: Vec<f64>,
    /// B̂²; absent where the noise of the reference is unknown.
    pub squared_bias: Option<Vec<f64>>,
    /// V̂ of one replicate.
    pub variance: Vec<f64>,
}

/// Bias and variance of a method's images.
#[derive(Debug, Clone, PartialEq)]
pub struct BiasVariance {
    /// Per pixel-channel.
    pub maps: BiasVarianceMaps,
    /// Over all pixels (index 0) and each group (1 + group); `None` without pixel-channels.
    pub totals: Vec<Option<BiasVarianceTotal>>,
    /// Pixel-channels that take part but are not finite somewhere, or have no weight of at least 0.
    pub left_out: u64,
}

/// Splits the squared error of replicates into bias and variance, with standard errors over replicates and over the
/// reference's parts.
///
/// # Errors
/// [`BiasVarianceError`] below 2 replicates or if slices do not belong together.
pub fn bias_variance(
    replicates: &Replicates<'_>,
    reference: &BiasReference<'_>,
    groups: Option<Groups<'_>>,
) -> Result<BiasVariance, BiasVarianceError> {
    let length = check(replicates, reference, groups)?;
    let group_count = groups.map_or(0, |g| g.count.min(LARGEST_GROUPS));
    let mut sums = vec![Sums::new(replicates.images.len(), reference.parts()); 1 + group_count];
    let mut maps = BiasVarianceMaps {
        bias: vec![f64::NAN; length],
        squared_bias: reference.squared().then(|| vec![f64::NAN; length]),
        variance: vec![f64::NAN; length],
    };
    let mut terms = Terms::new(replicates.images.len(), reference.parts());
    let mut left_out = 0;
    for i in 0..length {
        let pixel = i % replicates.pixels;
        if replicates.valid.is_some_and(|valid| !valid[pixel]) {
            continue;
        }
        let weight = replicates.weight.map_or(1.0, |w| w[i]);
        let known = terms.fill(replicates.images, reference, i) && weight >= 0.0 && weight.is_finite();
        if !known {
            left_out += 1;
            continue;
        }
        maps.bias[i] = terms.bias;
        maps.variance[i] = terms.variance();
        if let Some(map) = &mut maps.squared_bias {
            map[i] = terms.squared_bias();
        }
        sums[0].add(weight, &terms);
        if let Some(own) = groups.and_then(|g| sums.get_mut(1 + usize::from(g.of_pixel[pixel]))) {
            own.add(weight, &terms);
        }
    }
    let totals = sums.iter().map(|sums| sums.total(reference)).collect();
    Ok(BiasVariance { maps, totals, left_out })
}

/// Number of pixel-channels.
fn check(
    replicates: &Replicates<'_>,
    reference: &BiasReference<'_>,
    groups: Option<Groups<'_>>,
) -> Result<usize, BiasVarianceError> {
    let [first, _, ..] = replicates.images else {
        return Err(BiasVarianceError::TooFewReplicates { got: replicates.images.len() });
    };
    let length = first.len().checked_div(replicates.pixels).unwrap_or(0) * replicates.pixels;
    for image in replicates.images {
        expect("image of a replicate", image.len(), length)?;
    }
    reference.check(length)?;
    replicates.weight.map_or(Ok(()), |w| expect("weight", w.len(), length))?;
    replicates.valid.map_or(Ok(()), |v| expect("valid pixels", v.len(), replicates.pixels))?;
    groups.map_or(Ok(()), |g| expect("group map", g.of_pixel.len(), replicates.pixels))?;
    Ok(length)
}

#[cfg(test)]
mod tests;
