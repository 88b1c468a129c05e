//! Images that models are made from.

use super::size::{LANES, MAX_BANDWIDTHS, MAX_FEATURES, MAX_PATCH_RADIUS};
use crate::KernelError;
use crate::check::{self, count, real};
use crate::engine::mirror;

/// Planes of one value per pixel.
#[derive(Clone, Debug)]
pub struct Planes<'a> {
    /// M, three channels.
    pub guide: [&'a [f32]; 3],
    /// V, the variance of M that its distances are measured against.
    pub guide_variance: [&'a [f32]; 3],
    /// u, the image to fit.
    pub target: [&'a [f32]; 3],
    /// Var_0, mean of the channels.
    pub variance: &'a [f32],
    /// What squared errors are multiplied by before they are added up.
    pub importance: &'a [f32],
    /// Feature channels, at most [`MAX_FEATURES`].
    pub features: Vec<&'a [f32]>,
}

/// What all models share.
#[derive(Clone, Debug, PartialEq)]
pub struct Rules {
    /// Patch radius of distances in pixels, at most [`MAX_PATCH_RADIUS`].
    pub patch_radius: usize,
    /// σ_r, above 0.
    pub range_sigma: f32,
    /// Bandwidths k, ascending, above 0, at most [`MAX_BANDWIDTHS`].
    pub bandwidths: Vec<f32>,
    /// Weights below this are 0; 0 to 0.5.
    pub least_weight: f32,
    /// Ridge on the slopes over Σw, 0 for none.
    pub ridge: f64,
}

/// Most pixels that an image may have: records are numbered in 32 bits.
const MAX_PIXELS: usize = 1 << 31;
/// Largest magnitude of a value.
const MOST: f32 = 1e15;

/// One line of cache for each pixel: features, M, u, Var_0, importance.
pub(super) const GUIDE: usize = MAX_FEATURES;
pub(super) const TARGET: usize = GUIDE + 3;
pub(super) const VARIANCE: usize = TARGET + 3;
pub(super) const IMPORTANCE: usize = VARIANCE + 1;

/// Everything of a pixel in one place, and M and V with a border for patches.
#[derive(Clone, Debug)]
pub struct Field {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) rules: Rules,
    pub(super) records: Vec<[f32; LANES]>,
    pub(super) features: usize,
    /// Least step of each column's scale: 10⁻³ of its range in the image, with x and y before the features.
    pub(super) floors: [f32; 2 + MAX_FEATURES],
    /// M and V, three channels each, mirrored.
    pub(super) patches: [Vec<f32>; 6],
    /// Row length of `patches`.
    pub(super) pitch: usize,
}

impl Field {
    /// Brings planes of `width`·`height` values into place.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn new(width: usize, height: usize, planes: &Planes<'_>, rules: Rules) -> Result<Self, KernelError> {
        rules.check()?;
        check_planes(width, height, planes)?;
        let features = planes.features.len();
        let mut records = vec![[0.0f32; LANES]; width * height];
        let mut put = |at: usize, plane: &[f32]| {
            for (record, value) in records.iter_mut().zip(plane) {
                record[at] = *value;
            }
        };
        for (at, plane) in planes.features.iter().enumerate() {
            put(at, plane);
        }
        for c in 0..3 {
            put(GUIDE + c, planes.guide[c]);
            put(TARGET + c, planes.target[c]);
        }
        put(VARIANCE, planes.variance);
        put(IMPORTANCE, planes.importance);
        let mut floors = [0.0; 2 + MAX_FEATURES];
        floors[0] = 1e-3 * (width - 1) as f32;
        floors[1] = 1e-3 * (height - 1) as f32;
        for (floor, plane) in floors[2..].iter_mut().zip(&planes.features) {
            let (low, high) = plane.iter().fold((f32::MAX, f32::MIN), |(l, h), v| (l.min(*v), h.max(*v)));
            *floor = 1e-3 * (high - low);
        }
        let f = rules.patch_radius;
        // Rows may be read to the end of their last lanes.
        let pitch = (width + 2 * f).next_multiple_of(LANES) + LANES;
        let bordered = |plane: &[f32]| {
            let mut out = vec![0.0; pitch * (height + 2 * f)];
            for (j, row) in out.chunks_mut(pitch).enumerate() {
                let from = mirror(j as isize - f as isize, height) * width;
                for (i, value) in row[..width + 2 * f].iter_mut().enumerate() {
                    *value = plane[from + mirror(i as isize - f as isize, width)];
                }
            }
            out
        };
        let [a, b, c] = planes.guide.map(bordered);
        let [d, e, g] = planes.guide_variance.map(bordered);
        Ok(Self { width, height, rules, records, features, floors, patches: [a, b, c, d, e, g], pitch })
    }

    /// Bandwidths of its models.
    #[must_use]
    pub fn bandwidths(&self) -> &[f32] {
        &self.rules.bandwidths
    }

    /// 1/(2σ_r²k²) of bandwidth number `k`.
    #[inline(always)]
    pub(super) fn factor(&self, k: usize) -> f32 {
        let width = self.rules.range_sigma * self.rules.bandwidths[k];
        0.5 / (width * width)
    }

    /// M at a pixel.
    #[must_use]
    pub fn guide_at(&self, pixel: usize) -> [f32; 3] {
        [0, 1, 2].map(|c| self.records[pixel][GUIDE + c])
    }
}

impl Rules {
    fn check(&self) -> Result<(), KernelError> {
        count("patch radius", self.patch_radius, 0, MAX_PATCH_RADIUS)?;
        real("range sigma", self.range_sigma, 1e-6, 1e6)?;
        count("bandwidths", self.bandwidths.len(), 1, MAX_BANDWIDTHS)?;
        self.bandwidths.iter().try_for_each(|k| real("bandwidth", *k, 1e-6, 1e6))?;
        if !self.bandwidths.is_sorted() {
            return Err(KernelError::Mismatch { what: "bandwidths do not ascend".into() });
        }
        real("least weight", self.least_weight, 0.0, 0.5)?;
        real("ridge", self.ridge as f32, 0.0, 1e6)
    }
}

fn check_planes(width: usize, height: usize, planes: &Planes<'_>) -> Result<(), KernelError> {
    check::size(width, height, MAX_PIXELS)?;
    count("features", planes.features.len(), 0, MAX_FEATURES)?;
    let value = |name: &str, i: usize, plane: &[f32]| {
        let name = || format!("{name} {i}");
        check::plane(name, plane, (width, height), "a magnitude of at most 1e15", |v| v.abs() <= MOST)
    };
    let square = |name: &str, plane: &[f32]| {
        let good = |v: f32| (0.0..=MOST * MOST).contains(&v);
        check::plane(|| name.to_owned(), plane, (width, height), "0 to 1e30", good)
    };
    for c in 0..3 {
        value("guide channel", c, planes.guide[c])?;
        value("target channel", c, planes.target[c])?;
        square("variance of the guide", planes.guide_variance[c])?;
    }
    square("variance", planes.variance)?;
    square("importance", planes.importance)?;
    planes.features.iter().enumerate().try_for_each(|(i, feature)| value("feature", i, feature))
}
