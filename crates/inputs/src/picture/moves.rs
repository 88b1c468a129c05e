//! Flips, turns, shifts and exchanged channels.

use noisefloor_frame::Image;

use super::fit::{correlation, position};
use crate::against::{Against, grey};
use crate::number::number;

/// Most pixels by which a shift is looked for, each way.
const REACH: i64 = 8;

/// Rows that are looked at are thinned down to about so many pixels.
const PIXELS: usize = 1 << 16;

/// L from which on the moved reference fits, and its least size in standard errors.
const LEAST: f64 = 0.5;
const LEAST_ERRORS: f64 = 6.0;

/// Brightness ratios outside of this are taken out before moves are tried.
const GAIN: f64 = 1.25;

/// Correlation of x with the moved reference from which on it shows the same.
const ALIKE: f64 = 0.5;

/// A way to move a picture: where the reference's pixel for a place of the frame is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Move {
    /// Flip columns, flip rows, after exchanging them.
    Turn {
        x: bool,
        y: bool,
        exchange: bool,
    },
    Shift {
        x: i64,
        y: i64,
    },
}

impl Move {
    fn of(self, x: usize, y: usize, width: usize, height: usize) -> Option<usize> {
        match self {
            Self::Turn { x: flip_x, y: flip_y, exchange } => {
                let (x, y) = if exchange { (y, x) } else { (x, y) };
                let x = if flip_x { width - 1 - x } else { x };
                let y = if flip_y { height - 1 - y } else { y };
                Some(y * width + x)
            }
            Self::Shift { x: dx, y: dy } => {
                let (x, y) = (x as i64 - dx, y as i64 - dy);
                let inside = x >= 0 && y >= 0 && x < width as i64 && y < height as i64;
                inside.then(|| y as usize * width + x as usize)
            }
        }
    }

    fn name(self) -> String {
        let said = |text: &str| text.to_owned();
        match self {
            Self::Turn { x: true, y: false, exchange: false } => said("a flip from left to right"),
            Self::Turn { x: false, y: true, exchange: false } => said("a flip upside down"),
            Self::Turn { x: true, y: true, exchange: false } => said("a turn by 180°"),
            Self::Turn { x: false, y: false, exchange: true } => said("exchanging rows and columns"),
            Self::Turn { x: true, y: true, exchange: true } => {
                said("exchanging rows and columns and a turn by 180°")
            }
            Self::Turn { .. } => said("a turn by 90°"),
            Self::Shift { x, y } => format!("a shift of the reference by ({x}, {y}) pixels"),
        }
    }
}

/// What makes the frame fit, and the size of its evidence in standard errors.
pub(super) fn find(against: &Against<'_>, x: &Image, invalid: &[bool], ratio: f64) -> Option<(String, f64)> {
    let gain =
        if ratio.is_finite() && ratio > 0.0 && !(1.0 / GAIN..=GAIN).contains(&ratio) { ratio } else { 1.0 };
    channels(against, x, invalid, gain).or_else(|| moves(against, x, invalid, gain))
}

fn moves(against: &Against<'_>, x: &Image, invalid: &[bool], gain: f64) -> Option<(String, f64)> {
    let r = against.reference.mean();
    let (width, height) = (r.width(), r.height());
    let grey_of = |image: &Image| -> Vec<f32> { (0..image.pixels()).map(|p| grey(image, p)).collect() };
    let (xs, rs) = (grey_of(x), grey_of(r));
    let floor = {
        let finite = rs.iter().filter(|v| v.is_finite());
        let sum: f64 = finite.clone().map(|v| f64::from(v.abs())).sum();
        0.1 * sum / finite.count().max(1) as f64
    };
    let step = (width * height).div_ceil(PIXELS).max(1);
    let mut candidates = Vec::new();
    let square = width == height;
    for exchange in [false, true].into_iter().filter(|exchange| square || !exchange) {
        for (x, y) in [(false, false), (true, false), (false, true), (true, true)] {
            if x || y || exchange {
                candidates.push(Move::Turn { x, y, exchange });
            }
        }
    }
    for y in -REACH..=REACH {
        for x in -REACH..=REACH {
            if (x, y) != (0, 0) {
                candidates.push(Move::Shift { x, y });
            }
        }
    }
    // By how much less is left of the distance: L alone would prefer a small move in the right direction.
    let mut best: Option<(Move, f64, f64)> = None;
    for candidate in candidates {
        let mut rows = vec![[0.0f64; 2]; height.div_ceil(step)];
        let mut used = 0.0f64;
        for (row, y) in rows.iter_mut().zip((0..height).step_by(step)) {
            for column in 0..width {
                let pixel = y * width + column;
                let Some(from) = candidate.of(column, y, width, height) else { continue };
                if !against.usable(pixel, invalid) || !against.usable(from, &[]) || !xs[pixel].is_finite() {
                    continue;
                }
                let (x, r, t) = (f64::from(xs[pixel]) / gain, f64::from(rs[pixel]), f64::from(rs[from]));
                let w = (r.abs() + t.abs() + floor).powi(2);
                if w > 0.0 {
                    row[0] += (t - r) * (2.0 * x - r - t) / w;
                    row[1] += (t - r) * (t - r) / w;
                    used += 1.0;
                }
            }
        }
        let Some((l, error)) = position(&rows) else { continue };
        let gained = rows.iter().map(|row| row[0]).sum::<f64>() / used.max(1.0);
        if l >= LEAST && l >= LEAST_ERRORS * error && best.is_none_or(|(_, other, _)| gained > other) {
            best = Some((candidate, gained, l / error.max(1e-12)));
        }
    }
    let (found, _, z) = best.filter(|(found, ..)| alike(against, &xs, &rs, invalid, *found))?;
    let exposure =
        if gain == 1.0 { String::new() } else { format!(" and a factor of {}", number(1.0 / gain)) };
    Some((format!("{}{exposure}", found.name()), z.min(1e6)))
}

/// Whether the frame shows the same as the moved reference: correlation of block means, of which noise may take away a
/// part.
fn alike(against: &Against<'_>, xs: &[f32], rs: &[f32], invalid: &[bool], found: Move) -> bool {
    let r = against.reference.mean();
    let (width, height) = (r.width(), r.height());
    let mut sums = vec![(0.0, 0.0, 0.0); against.blocks.count()];
    for pixel in (0..r.pixels()).filter(|&p| against.usable(p, invalid) && xs[p].is_finite()) {
        let from = found.of(pixel % width, pixel / width, width, height);
        if let Some(from) = from.filter(|&from| against.usable(from, &[])) {
            let s = &mut sums[against.blocks.of(pixel)];
            *s = (s.0 + f64::from(xs[pixel]), s.1 + f64::from(rs[from]), s.2 + 1.0);
        }
    }
    let means: Vec<(f64, f64)> =
        sums.into_iter().filter(|s| s.2 > 0.0).map(|(a, b, n)| (a / n, b / n)).collect();
    correlation(&means) >= ALIKE
}

/// Exchanged channels, such as BGR for RGB.
fn channels(against: &Against<'_>, x: &Image, invalid: &[bool], gain: f64) -> Option<(String, f64)> {
    const ORDERS: [[usize; 3]; 5] = [[2, 1, 0], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1]];
    let r = against.reference.mean();
    let width = r.width();
    let step = (r.pixels()).div_ceil(PIXELS).max(1);
    let mut best: Option<(String, f64, f64)> = None;
    for order in ORDERS {
        let mut rows = vec![[0.0f64; 2]; r.height().div_ceil(step)];
        for pixel in (0..r.pixels()).filter(|&p| against.usable(p, invalid)) {
            let y = pixel / width;
            if !y.is_multiple_of(step) {
                continue;
            }
            let w = against.weights[against.blocks.of(pixel)].powi(2);
            for (c, from) in order.into_iter().enumerate() {
                let (x, a, t) = (x.plane(c)[pixel], r.plane(c)[pixel], r.plane(from)[pixel]);
                let (x, a, t) = (f64::from(x) / gain, f64::from(a), f64::from(t));
                if x.is_finite() {
                    rows[y / step][0] += w * (t - a) * (2.0 * x - a - t);
                    rows[y / step][1] += w * (t - a) * (t - a);
                }
            }
        }
        let Some((l, error)) = position(&rows) else { continue };
        let gained = rows.iter().map(|row| row[0]).sum::<f64>();
        if l >= LEAST
            && l >= LEAST_ERRORS * error
            && best.as_ref().is_none_or(|(_, other, _)| gained > *other)
        {
            let names = order.map(|c| ["R", "G", "B"][c]).join(", ");
            best = Some((
                format!("taking the channels in the order {names}"),
                gained,
                (l / error.max(1e-12)).min(1e6),
            ));
        }
    }
    best.map(|(text, _, z)| (text, z))
}
