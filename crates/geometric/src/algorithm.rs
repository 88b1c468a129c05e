//! The pseudo-code of the slides (finalstage2020), in its order: by the letter, and with its slips mended.
//!
//! The slides print no line numbers. Ours count the lines of the listing, without the blank ones:
//!
//! | line | what it does | by the letter | mended |
//! |---|---|---|---|
//! | 1 | pixel p after pixel | `algorithm.rs` | `cone.rs` |
//! | 2 | the sum of colours starts with p's own | `algorithm.rs` | `cone.rs` |
//! | 3 | radius of the kernel: the variance, doubled | `radius.rs` | `radius.rs` |
//! | 4 | neighbour n after neighbour, within that radius | `algorithm.rs` | `cone.rs` |
//! | 5-6 | another material: skipped | `algorithm.rs` | `row.rs` |
//! | 7-8 | too far in depth: skipped | `algorithm.rs` | `row.rs` |
//! | 9-10 | by the angle of the normals: skipped | `algorithm.rs` | `row.rs` |
//! | 11 | weight, by distance | `algorithm.rs` | `row.rs` |
//! | 12 | sum of weights | `algorithm.rs` | `row.rs` |
//! | 13 | sum of weighted colours | `algorithm.rs` | `row.rs` |
//! | 14 | whether there is anything to divide | `algorithm.rs` | `cone.rs` |
//! | 15 | the mean | `algorithm.rs` | `cone.rs` |
//!
//! The slides on mean and variance are in `recurrence.rs`.

use noisefloor_denoiser::StageTimer;
use noisefloor_frame::{FeatureId, Frame, Image};
use rayon::prelude::*;

use crate::cone::{Cone, Thresholds};
use crate::guides::{Guides, Tests};
use crate::{AsWrittenParams, CorrectedParams, radius};

/// The listing by the letter: rows of colours, `None` where the weight sum is zero or the result is not finite, and the radii.
/// None at all if the frame carries no variance.
#[expect(clippy::type_complexity, reason = "rows of pixels")]
pub(crate) fn as_written(
    frame: &Frame,
    params: &AsWrittenParams,
    timer: &mut StageTimer,
) -> Option<(Vec<Vec<Option<[f32; 3]>>>, Vec<f32>)> {
    // Listing, line 3, for all pixels at once.
    let radii = radius::as_written(frame, params.multiplier, params.radius_max_px, params.variance_form)?;
    timer.finish("radius");

    // Listing, line 1.
    let listing = Listing::new(frame, params);
    let rows = (0..frame.height())
        .into_par_iter()
        .map(|y| (0..frame.width()).map(|x| listing.pixel(x, y, radii[y * frame.width() + x])).collect())
        .collect();
    Some((rows, radii))
}

/// What the listing reads, one plane each; `None` where a test is off.
struct Listing<'a> {
    width: usize,
    height: usize,
    params: &'a AsWrittenParams,
    mean: [&'a [f32]; 3],
    id: Option<&'a [f32]>,
    depth: Option<&'a [f32]>,
    normal: Option<[&'a [f32]; 3]>,
}

impl<'a> Listing<'a> {
    fn new(frame: &'a Frame, params: &'a AsWrittenParams) -> Self {
        let feature = |on: bool, id| frame.feature(&id).filter(|_| on).map(|feature| &feature.mean);
        Self {
            width: frame.width(),
            height: frame.height(),
            params,
            mean: [0, 1, 2].map(|c| frame.color.mean.plane(c)),
            id: feature(params.material_ids, FeatureId::Material).map(|image| image.plane(0)),
            depth: feature(params.depth_test, FeatureId::Depth).map(|image| image.plane(0)),
            normal: feature(params.normal_test, FeatureId::Normal)
                .map(|image| [0, 1, 2].map(|c| image.plane(c))),
        }
    }

    fn skipped(&self, p: usize, q: usize) -> bool {
        let dot = |n: [&[f32]; 3]| (0..3).map(|c| n[c][p] * n[c][q]).sum::<f32>();
        // Listing, lines 5-6.
        self.id.is_some_and(|id| id[q] != id[p])
            // Listing, lines 7-8: in scene units.
            || self.depth.is_some_and(|z| f64::from((z[q] - z[p]).abs()) > self.params.depth_threshold)
            // Listing, lines 9-10: above the threshold are the similar normals.
            || self.normal.is_some_and(|n| f64::from(dot(n)) > self.params.normal_threshold)
    }

    /// The listing at one pixel; `None` if the weight sum is zero or the result is not finite.
    fn pixel(&self, x: usize, y: usize, radius: f32) -> Option<[f32; 3]> {
        let p = y * self.width + x;
        let radius = f64::from(radius);
        let reach = radius as usize;
        // Listing, line 2: weight 1, of which the sum of weights does not know.
        let mut total = [0, 1, 2].map(|c| f64::from(self.mean[c][p]));
        let mut sum = 0.0;
        // Listing, line 4: whether p is its own neighbour is not said.
        for qy in y.saturating_sub(reach)..(y + reach + 1).min(self.height) {
            for qx in x.saturating_sub(reach)..(x + reach + 1).min(self.width) {
                let q = qy * self.width + qx;
                let distance = (qx.abs_diff(x).pow(2) as f64 + qy.abs_diff(y).pow(2) as f64).sqrt();
                if distance > radius || (q == p && !self.params.visits_center) || self.skipped(p, q) {
                    continue;
                }
                // Listing, line 11: the parenthesis as printed. A zero radius gives an infinity, which is reported.
                let weight = (1.0 - distance) / radius;
                // Listing, line 12.
                sum += weight;
                // Listing, line 13.
                for (total, plane) in total.iter_mut().zip(self.mean) {
                    *total += weight * f64::from(plane[q]);
                }
            }
        }
        // Listing, line 14: the printed guard compares a vector with zero; read per component. A black pixel stays black.
        // Listing, line 15.
        let value = total.map(|t| if t > 0.0 { (t / sum) as f32 } else { t as f32 });
        (sum != 0.0 && value.iter().all(|v| v.is_finite())).then_some(value)
    }
}

/// The listing with its slips mended: the filtered image and the radii. `None` if the frame carries no variance.
pub(crate) fn corrected(
    frame: &Frame,
    params: &CorrectedParams,
    tests: Tests,
    timer: &mut StageTimer,
) -> Option<(Image, Vec<f32>)> {
    // Listing, line 3: what the variance stands for is a choice; the radius is capped.
    let radii = radius::corrected(frame, params)?;

    // Listing, lines 5-10: what neighbours are told apart by. Depths relative to the depth, as no unit is given; skipped are
    // the normals that differ.
    let guides = Guides::new(frame, tests);
    timer.finish("radius");
    let thresholds = Thresholds {
        depth: params.depth_threshold as f32,
        normal: params.normal_threshold as f32,
        albedo: params.albedo_threshold as f32,
    };

    // Listing, line 1, line 2 and line 4: every pixel, which counts once itself, and its neighbours within the radius. All
    // weights come from the input; nothing is filtered in place.
    let cone = Cone::new(&frame.color.mean, &radii, &guides, thresholds, params.radius_max_px);
    timer.finish("planes");

    // Listing, lines 11-15: a cone of height 1, both sums, and their quotient, whose divisor is at least 1.
    let image = cone.filter();
    timer.finish("filter");
    Some((image, radii))
}
