//! What opposite neighbours share: see [`Pairs`](crate::nlm::Pairs).

use crate::nlm::PAIR_LIMIT;

/// a: share of the weight `mean` of both neighbours' mean in their own weights.
#[inline(always)]
pub(super) fn share(first: f32, second: f32, mean: f32) -> f32 {
    let more = mean / (first + second) - 1.0;
    // 0 of 0 is NaN and shares nothing.
    let share = if more > 0.0 { more } else { 0.0 };
    if share < 1.0 { share } else { 1.0 }
}

/// Whether both neighbours are near enough to share.
#[inline(always)]
pub(super) fn near(first: f32, second: f32) -> bool {
    // Not `&&`: a branch here would keep the loop from vectorising.
    (first < PAIR_LIMIT) & (second < PAIR_LIMIT)
}

/// A neighbour's weight with this share.
#[inline(always)]
pub(super) fn shared(share: f32, weight: f32, mean: f32) -> f32 {
    share * mean + (1.0 - share) * weight
}

/// Shares a row of weights, whatever their distances.
#[inline(always)]
pub(super) fn share_all(first: &mut [f32], second: &mut [f32], mean: &[f32]) {
    for ((first, second), mean) in first.iter_mut().zip(second).zip(mean) {
        let a = share(*first, *second, *mean);
        *first = shared(a, *first, *mean);
        *second = shared(a, *second, *mean);
    }
}

/// Shares a row of weights where both distances are near; leaves the shares in `shares`.
#[inline(always)]
pub(super) fn share_near(
    (first, second): (&mut [f32], &mut [f32]),
    mean: &[f32],
    distances: (&[f32], &[f32]),
    shares: &mut [f32],
) {
    let weights = first.iter_mut().zip(second).zip(mean);
    for ((((first, second), mean), (d1, d2)), kept) in
        weights.zip(distances.0.iter().zip(distances.1)).zip(shares)
    {
        let a = share(*first, *second, *mean);
        let a = if near(*d1, *d2) { a } else { 0.0 };
        *kept = a;
        *first = shared(a, *first, *mean);
        *second = shared(a, *second, *mean);
    }
}
