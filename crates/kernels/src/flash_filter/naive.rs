//! The filter as nested loops: in `f64` the oracle of the tests, in `f32` the baseline of speed ratios.
//!
//! Both use one thread. The membership test is the shared `f32` expression in both, so that a neighbour on the
//! very edge of the interval is judged alike; all else is in the precision that the name says.

use super::members::Tests;
use super::{FlashFilterError, FlashInputs, FlashParams};

/// Index of the pixel that stands for position `i` of a line of `n` pixels: mirrored at the border without
/// repeating the edge pixel, as often as needed.
pub(super) fn mirror(i: isize, n: usize) -> usize {
    if (0..n as isize).contains(&i) {
        return i as usize;
    }
    let last = n as isize - 1;
    if last == 0 {
        return 0;
    }
    let folded = i.rem_euclid(2 * last);
    folded.min(2 * last - folded) as usize
}

macro_rules! naive_twin {
    ($real:ident, $(#[$doc:meta])* $filter:ident, $weight:ident) => {
        /// Weight of neighbour `q` = (x, y) for pixel `p`, 0 to 1, whether `q` is in the set of `p` or not.
        #[inline]
        pub(super) fn $weight(
            params: &FlashParams,
            inputs: &FlashInputs<'_>,
            (px, py): (isize, isize),
            (qx, qy): (isize, isize),
        ) -> $real {
            let at = |x: isize, y: isize| mirror(y, params.height) * params.width + mirror(x, params.width);
            let offset = ((qx - px).pow(2) + (qy - py).pow(2)) as $real;
            let two_sigma_s2 = 2.0 * f64::from(params.spatial_sigma) * f64::from(params.spatial_sigma);
            let mut weight = (-(offset / two_sigma_s2 as $real)).exp();
            if offset == 0.0 {
                weight = 1.0;
            }
            let Some(guide) = inputs.guide else { return weight };
            let f = params.patch.radius() as isize;
            let mut distance = 0.0;
            for j in -f..=f {
                for i in -f..=f {
                    let (a, b) = (at(px + i, py + j), at(qx + i, qy + j));
                    let mut square = 0.0;
                    for plane in guide.planes {
                        let difference = plane[a] as $real - plane[b] as $real;
                        square += difference * difference;
                    }
                    let tap = params.patch.tap(i.unsigned_abs()) * params.patch.tap(j.unsigned_abs());
                    distance += tap as $real * square;
                }
            }
            // A distance that overflows means "nothing alike".
            if distance < $real::INFINITY {
                weight * (-(distance / 3.0) * guide.inv_two_sigma_r2[params.width * py as usize + px as usize] as $real).exp()
            } else {
                0.0
            }
        }

        $(#[$doc])*
        ///
        /// # Errors
        /// As [`FlashParams::check`].
        pub fn $filter(
            params: &FlashParams,
            inputs: &FlashInputs<'_>,
        ) -> Result<[Vec<$real>; 3], FlashFilterError> {
            params.check(inputs)?;
            let tests = Tests::new(inputs);
            let (w, h, r) = (params.width as isize, params.height as isize, params.window_radius as isize);
            let mut out = [(); 3].map(|()| Vec::with_capacity(params.width * params.height));
            for (py, px) in (0..h).flat_map(|y| (0..w).map(move |x| (y, x))) {
                let p = (py * w + px) as usize;
                let (mut sum, mut weights) = ([0.0 as $real; 3], [0.0 as $real; 3]);
                for qy in (py - r).max(0)..=(py + r).min(h - 1) {
                    for qx in (px - r).max(0)..=(px + r).min(w - 1) {
                        let q = (qy * w + qx) as usize;
                        let members = tests.members(p, q);
                        if members == [false; 3] {
                            continue;
                        }
                        let weight = $weight(params, inputs, (px, py), (qx, qy));
                        for c in (0..3).filter(|&c| members[c]) {
                            sum[c] += weight * (inputs.source[c][q] as $real - inputs.source[c][p] as $real);
                            weights[c] += weight;
                        }
                    }
                }
                for c in 0..3 {
                    // The pixel itself has weight exp(0) = 1, so the sum of weights is at least 1.
                    out[c].push(inputs.source[c][p] as $real + sum[c] / weights[c]);
                }
            }
            Ok(out)
        }
    };
}

naive_twin! {
    f64,
    /// The filter in double precision: the oracle.
    filter_f64, weight_f64
}
naive_twin! {
    f32,
    /// The same loops in single precision: what a first implementation would be, and the baseline of speed ratios.
    filter_f32, weight_f32
}
