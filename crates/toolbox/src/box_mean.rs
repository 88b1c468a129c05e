//! Means over boxes.

use rayon::prelude::*;

/// Mean of `values`, rows of `width`, over the box of `radius` pixels around each pixel, clipped at the border.
///
/// No value is ever taken off a sum again, so a bright pixel leaves nothing behind in sums that it is not in.
#[must_use]
pub fn box_mean(values: &[f64], width: usize, radius: usize) -> Vec<f64> {
    if values.is_empty() || width == 0 {
        return Vec::new();
    }
    let height = values.len() / width;
    let mut rows = vec![0.0; values.len()];
    rows.par_chunks_mut(width)
        .zip(values.par_chunks(width))
        .for_each(|(out, row)| line_sums(row, radius, out));
    let mut out = vec![0.0; values.len()];
    out.par_chunks_mut(width).enumerate().for_each(|(y, out)| {
        let (first, last) = (y.saturating_sub(radius), (y + radius).min(height - 1));
        for j in first..=last {
            for (sum, value) in out.iter_mut().zip(&rows[j * width..]) {
                *sum += value;
            }
        }
        let tall = last - first + 1;
        for (x, sum) in out.iter_mut().enumerate() {
            let wide = (x + radius).min(width - 1) - x.saturating_sub(radius) + 1;
            // The box has the pixel itself at least.
            *sum /= (tall * wide) as f64;
        }
    });
    out
}

/// Sums over 2·`radius`+1 neighbours in a line, zero outside: the end of one run of that length and the start of the
/// next.
fn line_sums(row: &[f64], radius: usize, out: &mut [f64]) {
    let side = 2 * radius + 1;
    let padded = (row.len() + 2 * radius).next_multiple_of(side);
    let mut from_start = vec![0.0; padded];
    from_start[radius..radius + row.len()].copy_from_slice(row);
    let mut to_end = from_start.clone();
    for i in 1..padded {
        if i % side != 0 {
            from_start[i] += from_start[i - 1];
        }
        let j = padded - 1 - i;
        if !(j + 1).is_multiple_of(side) {
            to_end[j] += to_end[j + 1];
        }
    }
    for (x, sum) in out.iter_mut().enumerate() {
        // A window that is exactly one run is in both.
        *sum = if x.is_multiple_of(side) { to_end[x] } else { to_end[x] + from_start[x + side - 1] };
    }
}
