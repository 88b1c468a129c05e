use thiserror::Error;

use crate::{Level, TTable};

/// Samples per pixel.
#[derive(Debug, Clone, Copy)]
pub enum SampleCounts<'a> {
    /// The same in every pixel.
    Uniform(u32),
    /// Row by row, one entry per pixel.
    PerPixel(&'a [u32]),
}

/// Sample means and what is known of their uncertainty; planar, all channels one after the other.
#[derive(Debug, Clone, Copy)]
pub struct Observed<'a> {
    /// x̄ per channel and pixel.
    pub mean: &'a [f32],
    /// Variance of the mean, s²/n, in the same order.
    pub variance: &'a [f32],
    /// Samples per pixel.
    pub counts: SampleCounts<'a>,
    /// Pixels per channel.
    pub pixels: usize,
    /// Pixels that take part; all if absent.
    pub valid: Option<&'a [bool]>,
}

/// What the means are compared with, in the order of the means.
#[derive(Debug, Clone, Copy)]
pub struct Truth<'a> {
    /// r per channel and pixel.
    pub mean: &'a [f32],
    /// Variance v_r of that mean; absent if the truth is exact (or nothing is known, which then counts as
    /// exact).
    pub variance: Option<&'a [f32]>,
}

/// A group, such as a class, for each pixel.
#[derive(Debug, Clone, Copy)]
pub struct Groups<'a> {
    /// Group of each pixel; entries of at least `count` belong to none.
    pub of_pixel: &'a [u8],
    /// Number of groups.
    pub count: usize,
}

/// Slices that do not belong together.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{what} has {got} entries, expected {expected}")]
pub struct ShapeError {
    /// The offending slice.
    pub what: &'static str,
    /// Its length.
    pub got: usize,
    /// The length it should have.
    pub expected: usize,
}

pub(crate) fn expect(what: &'static str, got: usize, expected: usize) -> Result<(), ShapeError> {
    if got == expected { Ok(()) } else { Err(ShapeError { what, got, expected }) }
}

impl Observed<'_> {
    pub(crate) fn check(&self) -> Result<(), ShapeError> {
        let whole = self.mean.len().checked_div(self.pixels).unwrap_or(0) * self.pixels;
        expect("mean", self.mean.len(), whole)?;
        expect("variance", self.variance.len(), self.mean.len())?;
        if let SampleCounts::PerPixel(map) = self.counts {
            expect("sample counts", map.len(), self.pixels)?;
        }
        self.valid.map_or(Ok(()), |valid| expect("valid pixels", valid.len(), self.pixels))
    }

    pub(crate) fn count_at(&self, pixel: usize) -> u32 {
        match self.counts {
            SampleCounts::Uniform(n) => n,
            SampleCounts::PerPixel(map) => map[pixel],
        }
    }

    fn largest_count(&self) -> u32 {
        match self.counts {
            SampleCounts::Uniform(n) => n,
            SampleCounts::PerPixel(map) => map.iter().copied().max().unwrap_or(0),
        }
    }

    pub(crate) fn takes_part(&self, pixel: usize) -> bool {
        self.valid.is_none_or(|valid| valid[pixel])
    }

    /// Critical value of each pixel at `level`; infinite below 2 samples.
    pub(crate) fn critical_values(&self, level: Level) -> impl Fn(usize) -> f64 {
        let table = TTable::new(level, self.largest_count());
        let uniform = match self.counts {
            SampleCounts::Uniform(n) => Some(table.at(n)),
            SampleCounts::PerPixel(_) => None,
        };
        let counts = self.counts;
        move |pixel| match (uniform, counts) {
            (Some(t), _) => t,
            (None, SampleCounts::PerPixel(map)) => table.at(map[pixel]),
            (None, SampleCounts::Uniform(n)) => table.at(n),
        }
    }
}

impl Truth<'_> {
    pub(crate) fn check(&self, expected: usize) -> Result<(), ShapeError> {
        expect("truth", self.mean.len(), expected)?;
        self.variance.map_or(Ok(()), |v| expect("variance of the truth", v.len(), expected))
    }

    pub(crate) fn variance_at(&self, i: usize) -> f64 {
        self.variance.map_or(0.0, |v| f64::from(v[i]).max(0.0))
    }
}

/// More groups than a map of bytes can name have no members.
pub(crate) const LARGEST_GROUPS: usize = 256;

/// Counts that can be added up.
pub(crate) trait Tally: Default + Clone {
    fn add(&mut self, other: &Self);
}

/// Adds what `visit` counts in each pixel to the tally of all pixels (index 0) and to that of its group (1 +
/// group).
pub(crate) fn tally<T: Tally>(
    groups: Option<Groups<'_>>,
    pixels: usize,
    visit: impl Fn(usize) -> T,
) -> Result<Vec<T>, ShapeError> {
    if let Some(groups) = groups {
        expect("group map", groups.of_pixel.len(), pixels)?;
    }
    let mut tallies = vec![T::default(); 1 + groups.map_or(0, |g| g.count.min(LARGEST_GROUPS))];
    for pixel in 0..pixels {
        let counted = visit(pixel);
        tallies[0].add(&counted);
        if let Some(tally) = groups.and_then(|g| tallies.get_mut(1 + g.of_pixel[pixel] as usize)) {
            tally.add(&counted);
        }
    }
    Ok(tallies)
}

/// 4·eps·max(|a|,|b|) of values stored in f32: what rounding of the two may differ by.
pub(crate) fn rounding(a: f64, b: f64) -> f64 {
    4.0 * f64::from(f32::EPSILON) * a.abs().max(b.abs())
}
