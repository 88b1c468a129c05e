//! Going to a window: distances, scales, columns of X.

use super::distances::{self, Distances, from_center};
use super::field::{Field, GUIDE, IMPORTANCE, TARGET, VARIANCE};
use super::size::{COLUMNS, LANES, MAX_BANDWIDTHS, MAX_FEATURES};
use super::window::Window;
use crate::InstructionSet;
use crate::engine::Vectorised;

impl Window {
    /// Goes to the window of `radius` around `center`, at most the radius that there is room for. Distances that `known` holds
    /// are taken from it, with the same result.
    pub fn open(
        &mut self,
        field: &Field,
        center: (usize, usize),
        radius: usize,
        known: &Distances,
        level: InstructionSet,
    ) {
        level.run(Open { window: self, field, center, radius, known });
    }
}

struct Open<'a> {
    window: &'a mut Window,
    field: &'a Field,
    center: (usize, usize),
    radius: usize,
    known: &'a Distances,
}

impl Vectorised for Open<'_> {
    type Out = ();

    #[inline(always)]
    fn run(self) {
        let Self { window, field, center: (x, y), radius, known } = self;
        let columns = x.saturating_sub(radius)..(x + radius + 1).min(field.width);
        let rows = y.saturating_sub(radius)..(y + radius + 1).min(field.height);
        let pitch = columns.len().next_multiple_of(distances::LANES);
        let map = &mut window.map[..pitch * rows.len()];
        if known.holds((x, y), radius) {
            known.copy((x, y), &columns, &rows, map, pitch);
        } else {
            from_center(field, (x, y), &columns, &rows, map, pitch);
        }

        // Scales from all of the window.
        let own = &field.records[y * field.width + x];
        let (mut low, mut high) = (*own, *own);
        for j in rows.clone() {
            for record in &field.records[j * field.width + columns.start..][..columns.len()] {
                for l in 0..LANES {
                    low[l] = if record[l] < low[l] { record[l] } else { low[l] };
                    high[l] = if record[l] > high[l] { record[l] } else { high[l] };
                }
            }
        }
        let scale = |range: f32, floor: f32| {
            let by = if range > floor { range } else { floor };
            // A column that is constant in the image is 0 and stays so.
            if by > 0.0 { 1.0 / by } else { 1.0 }
        };
        let mut scales = [0.0; 2 + MAX_FEATURES];
        scales[0] = scale((columns.len() - 1) as f32, field.floors[0]);
        scales[1] = scale((rows.len() - 1) as f32, field.floors[1]);
        for i in 0..field.features {
            scales[2 + i] = scale(high[i] - low[i], field.floors[2 + i]);
        }

        // The first bandwidth that gives each pixel a weight, if any does, and how many there are of each.
        let bandwidths = field.rules.bandwidths.len();
        let mut farthest = [f32::INFINITY; MAX_BANDWIDTHS];
        for (k, farthest) in farthest.iter_mut().enumerate().take(bandwidths) {
            // In double precision: libraries differ in the last digit of a logarithm, and this one decides who takes part.
            let least = f64::from(field.rules.least_weight).ln();
            *farthest = (-least / f64::from(field.factor(k))) as f32;
        }
        let farthest = &farthest[..bandwidths];
        // One more place for what no bandwidth gives a weight.
        let mut next = [0; MAX_BANDWIDTHS + 2];
        for distances in window.map[..pitch * rows.len()].chunks(pitch) {
            for distance in &distances[..columns.len()] {
                next[first_of(farthest, *distance) + 1] += 1;
            }
        }
        for k in 0..bandwidths {
            next[k + 1] += next[k];
        }
        window.counts[..bandwidths].copy_from_slice(&next[1..=bandwidths]);
        let n = window.counts[bandwidths - 1];

        window.center = [own[GUIDE], own[GUIDE + 1], own[GUIDE + 2]];
        window.pixels.clear();
        window.pixels.resize(n, 0);
        let stride = window.stride;
        for (j, distances) in rows.clone().zip(window.map.chunks(pitch)) {
            for (i, distance) in columns.clone().zip(distances) {
                let k = first_of(farthest, *distance);
                if k == bandwidths {
                    continue;
                }
                let (p, place) = (j * field.width + i, next[k]);
                next[k] += 1;
                let record = &field.records[p];
                let (g, l) = (place / LANES, place % LANES);
                window.pixels[place] = p as u32;
                window.distances[g][l] = *distance;
                window.x[g][l] = 1.0;
                window.x[stride + g][l] = (i as f32 - x as f32) * scales[0];
                window.x[2 * stride + g][l] = (j as f32 - y as f32) * scales[1];
                for f in 0..field.features {
                    window.x[(3 + f) * stride + g][l] = (record[f] - own[f]) * scales[2 + f];
                }
                for c in 0..3 {
                    window.guide[c][g][l] = record[GUIDE + c] - own[GUIDE + c];
                    window.target[c][g][l] = record[TARGET + c] - own[GUIDE + c];
                }
                window.variance[g][l] = record[VARIANCE];
                window.importance[g][l] = record[IMPORTANCE];
            }
        }
        // The rest of the last lanes weighs nothing.
        for i in n..n.next_multiple_of(LANES) {
            let (g, l) = (i / LANES, i % LANES);
            window.distances[g][l] = f32::INFINITY;
            for column in 0..COLUMNS {
                window.x[column * stride + g][l] = 0.0;
            }
            for c in 0..3 {
                window.guide[c][g][l] = 0.0;
                window.target[c][g][l] = 0.0;
            }
            window.variance[g][l] = 0.0;
            window.importance[g][l] = 0.0;
        }
    }
}

/// Number of the first bandwidth at which a distance is not too far, or how many there are.
#[inline(always)]
fn first_of(farthest: &[f32], distance: f32) -> usize {
    let mut k = 0;
    for limit in farthest {
        k += usize::from(distance > *limit);
    }
    k
}
