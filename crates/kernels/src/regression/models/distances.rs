//! Patch distances between a pixel and all of a window (Eq. 4, Eq. 5).

use std::ops::Range;

use super::Field;

/// Pixels that are worked on together; rows of a window are short.
pub(super) const LANES: usize = 8;
use crate::joint_nlm::squared;

/// P at k = 1 from pixel `center` to the pixels of `columns` and `rows`, into rows of `out` of length `pitch`, a multiple of
/// the lanes that holds the columns.
#[inline(always)]
pub(super) fn from_center(
    field: &Field,
    center: (usize, usize),
    columns: &Range<usize>,
    rows: &Range<usize>,
    out: &mut [f32],
    pitch: usize,
) {
    let side = 2 * field.rules.patch_radius + 1;
    let [m0, m1, m2, v0, v1, v2] = &field.patches;
    let scale = 1.0 / (3 * side * side) as f32;
    // With the border a pixel's patch begins at its own place.
    let here = |i: usize, j: usize| (center.1 + j) * field.pitch + center.0 + i;
    for (row, out) in rows.clone().zip(out.chunks_mut(pitch)) {
        for (block, out) in out.chunks_exact_mut(LANES).enumerate() {
            let first = columns.start + block * LANES;
            if first >= columns.end {
                break;
            }
            let mut sum = [0.0f32; LANES];
            for i in 0..side {
                let mut line = [0.0f32; LANES];
                for j in 0..side {
                    let p = here(i, j);
                    let q = (row + j) * field.pitch + first + i;
                    let end = q + LANES;
                    let (a, b, c) = (&m0[q..end], &m1[q..end], &m2[q..end]);
                    let (va, vb, vc) = (&v0[q..end], &v1[q..end], &v2[q..end]);
                    let own = [(m0[p], v0[p]), (m1[p], v1[p]), (m2[p], v2[p])];
                    for l in 0..LANES {
                        let r = squared(own[0], (a[l], va[l]), 1.0);
                        let g = squared(own[1], (b[l], vb[l]), 1.0);
                        let b = squared(own[2], (c[l], vc[l]), 1.0);
                        line[l] += r + g + b;
                    }
                }
                for l in 0..LANES {
                    sum[l] += line[l];
                }
            }
            for (out, sum) in out.iter_mut().zip(sum) {
                let mean = sum * scale;
                *out = if mean > 0.0 { mean } else { 0.0 };
            }
        }
    }
}
