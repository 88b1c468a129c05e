use noisefloor_denoiser::{
    Alternative, DenoiseError, Denoiser, Diagnostics, Entry, Input, MethodCard, Need, Output, StageTimer,
    build_with,
};
use noisefloor_frame::{FeatureId, Image};
use rayon::prelude::*;

use crate::guides::{Guides, Tests};
use crate::{CITATION, CorrectedParams, Spread, radius};

const ID: &str = "geometric-corrected";

/// Registry entry of [`GeometricCorrected`].
pub const CORRECTED_ENTRY: Entry = Entry {
    id: ID,
    summary: "cone filter over neighbours of like material, depth and normal, radius from the noise",
    params: CorrectedParams::DOCS,
    defaults: || serde_json::to_value(CorrectedParams::default()).unwrap_or_default(),
    build: |overrides| build_with(ID, CorrectedParams::DOCS, overrides, GeometricCorrected::new),
};

/// The simple geometric denoiser with its evident slips mended: see the crate documentation.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct GeometricCorrected {
    params: CorrectedParams,
}

impl GeometricCorrected {
    /// Validates the parameters.
    ///
    /// # Errors
    /// The name of the first parameter that is out of range, see [`CorrectedParams::DOCS`].
    pub fn new(params: CorrectedParams) -> Result<Self, &'static str> {
        params.validate()?;
        Ok(Self { params })
    }

    /// The parameters.
    #[must_use]
    pub fn params(&self) -> &CorrectedParams {
        &self.params
    }
}

/// The needs that both variants share.
pub(crate) fn needs(tests: Tests) -> Vec<Need> {
    let features = [
        (tests.material_ids, FeatureId::Material),
        (tests.depth, FeatureId::Depth),
        (tests.normal, FeatureId::Normal),
    ];
    let features = features.into_iter().filter(|(on, _)| *on).map(|(_, id)| Need::Feature(id));
    [Need::ColorVariance, Need::Samples(2)].into_iter().chain(features).collect()
}

/// The switches of the tests, for frames without the feature. Both variants call them alike.
pub(crate) fn alternatives() -> Vec<Alternative> {
    let switches = [
        ("material_ids", FeatureId::Material),
        ("depth_test", FeatureId::Depth),
        ("normal_test", FeatureId::Normal),
    ];
    switches.map(|(name, id)| Alternative::new(name, false, [Need::Feature(id)])).into()
}

/// Rows of RGB triples to a planar image.
pub(crate) fn planar(rows: &[Vec<[f32; 3]>], width: usize) -> Image {
    Image::from_fn(width, rows.len(), 3, |c, x, y| rows[y][x][c])
}

/// Mean and largest kernel radius, and its picture if asked for.
pub(crate) fn describe(output: &mut Output, radii: Vec<f32>, input: &Input<'_>) {
    let (width, height) = (input.target.width(), input.target.height());
    let mean = radii.iter().map(|&r| f64::from(r)).sum::<f64>() / radii.len() as f64; // an image is never empty
    let largest = radii.iter().copied().fold(0.0, f32::max);
    output.figures.push(("mean kernel radius, px".into(), mean));
    output.figures.push(("largest kernel radius, px".into(), f64::from(largest)));
    if input.diagnostics != Diagnostics::Off {
        let image = Image::from_vec(width, height, 1, radii).expect("one radius per pixel");
        output.diagnostics.push(("kernel radius".into(), image));
    }
}

impl Denoiser for GeometricCorrected {
    fn card(&self) -> MethodCard {
        let mut card = MethodCard::new(ID, "Geometric, corrected", CITATION);
        card.needs = needs(self.tests());
        card.alternatives = alternatives();
        card.claims.consistent = self.params.spread != Spread::SampleVariance;
        card.notes.push(match self.params.spread {
            Spread::SampleVariance => {
                "radius from the variance of one sample: depends on exposure, never shrinks, not consistent"
                    .into()
            }
            Spread::StdOfMean => "radius from the standard error: depends on exposure".into(),
            Spread::Relative => "radius from the relative standard error".into(),
        });
        if !self.params.material_ids {
            card.notes.push("material ids are not compared".into());
        }
        card
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        let card = self.card();
        input.check(&card)?;
        let frame = input.target;
        let mut timer = StageTimer::start();

        // Kernel radius from the noise.
        let radii = radius::corrected(frame, &self.params).ok_or_else(|| no_variance(&card))?;
        let guides = Guides::new(frame, self.tests());
        timer.finish("radius");

        // Weighted mean over like neighbours. All weights come from the input; nothing is filtered in place.
        let filter = Filter {
            width: frame.width(),
            height: frame.height(),
            mean: [0, 1, 2].map(|c| frame.color.mean.plane(c)),
            radii: &radii,
            guides: &guides,
            depth_threshold: self.params.depth_threshold as f32,
            normal_threshold: self.params.normal_threshold as f32,
            distances: Distances::new(self.params.radius_max_px),
        };
        let rows: Vec<_> = (0..frame.height()).into_par_iter().map(|y| filter.row(y)).collect();
        let mut output = Output::from_image(planar(&rows, frame.width()));
        timer.finish("filter");

        describe(&mut output, radii, input);
        output.stages = timer.into_stages();
        Ok(output)
    }
}

/// For a frame whose variance vanished between check and use, which cannot be; kept as an error all the same.
pub(crate) fn no_variance(card: &MethodCard) -> DenoiseError {
    DenoiseError::MissingInputs {
        method: card.id.clone(),
        missing: vec![Need::ColorVariance],
        ways_out: Vec::new(),
    }
}

impl GeometricCorrected {
    fn tests(&self) -> Tests {
        let p = &self.params;
        Tests { material_ids: p.material_ids, depth: p.depth_test, normal: p.normal_test }
    }
}

/// Euclidean lengths of the offsets (dx, dy) with both at most `reach` pixels.
struct Distances {
    reach: usize,
    /// Rows by |dy|, columns by dx + reach.
    lengths: Vec<f32>,
}

impl Distances {
    fn new(radius: f64) -> Self {
        let reach = radius.ceil() as usize;
        let side = 2 * reach + 1;
        let length = |i: usize| ((i / side).pow(2) as f32 + (i % side).abs_diff(reach).pow(2) as f32).sqrt();
        Self { reach, lengths: (0..(reach + 1) * side).map(length).collect() }
    }

    /// Lengths for |dy| fixed and dx from −`left` on, `count` of them.
    fn row(&self, dy: usize, left: usize, count: usize) -> &[f32] {
        &self.lengths[dy * (2 * self.reach + 1) + self.reach - left..][..count]
    }
}

struct Filter<'a> {
    width: usize,
    height: usize,
    mean: [&'a [f32]; 3],
    radii: &'a [f32],
    guides: &'a Guides,
    depth_threshold: f32,
    normal_threshold: f32,
    distances: Distances,
}

impl Filter<'_> {
    fn row(&self, y: usize) -> Vec<[f32; 3]> {
        let mut weights = vec![0.0; 2 * self.distances.reach + 1];
        (0..self.width).map(|x| self.pixel(x, y, &mut weights)).collect()
    }

    /// Σ w·u / Σ w over the neighbours closer than R, weight 1 − distance/R, the pixel itself with weight 1.
    fn pixel(&self, x: usize, y: usize, weights: &mut [f32]) -> [f32; 3] {
        let p = y * self.width + x;
        let radius = self.radii[p];
        if radius <= 1.0 {
            return self.mean.map(|plane| plane[p]); // no whole pixel lies closer than R
        }
        let reach = radius.ceil() as usize - 1; // largest whole offset below R
        let (mut total, mut sum) = ([0.0; 3], 0.0);
        for qy in y.saturating_sub(reach)..(y + reach + 1).min(self.height) {
            // Columns that can lie in the disc; dy ≤ reach < R keeps the root real.
            let dy = qy.abs_diff(y);
            let across = (radius * radius - (dy * dy) as f32).sqrt().ceil() as usize;
            let across = across.min(reach);
            let columns = x.saturating_sub(across)..(x + across + 1).min(self.width);
            let weights = &mut weights[..columns.len()];
            let lengths = self.distances.row(dy, x - columns.start, columns.len());
            let start = qy * self.width + columns.start;
            self.weigh(p, start, 1.0 / radius, lengths, weights); // radius > 1
            if qy == y {
                weights[x - columns.start] = 1.0; // whatever its features say
            }
            let [r, g, b] = self.mean.map(|plane| &plane[start..][..weights.len()]);
            for (((&weight, &r), &g), &b) in weights.iter().zip(r).zip(g).zip(b) {
                let weight = f64::from(weight);
                sum += weight;
                total[0] += weight * f64::from(r);
                total[1] += weight * f64::from(g);
                total[2] += weight * f64::from(b);
            }
        }
        total.map(|t| (t / sum) as f32) // sum ≥ 1, the pixel's own weight
    }

    /// Weights of the pixels from index `start` on for pixel `p`, without a branch so that it vectorises.
    fn weigh(&self, p: usize, start: usize, inverse: f32, lengths: &[f32], weights: &mut [f32]) {
        let g = self.guides;
        let n = weights.len();
        let part = |plane| -> &[f32] { &Vec::as_slice(plane)[start..][..n] };
        let (id, depth, no_normal) = (part(&g.id), part(&g.depth), part(&g.no_normal));
        let [nx, ny, nz] = [part(&g.normal[0]), part(&g.normal[1]), part(&g.normal[2])];
        let (p_id, p_depth, p_none) = (g.id[p], g.depth[p], g.no_normal[p]);
        let [px, py, pz] = [g.normal[0][p], g.normal[1][p], g.normal[2][p]];
        let lengths = &lengths[..n];
        for i in 0..n {
            let cosine = px * nx[i] + py * ny[i] + pz * nz[i];
            let far = if p_depth > depth[i] { p_depth } else { depth[i] };
            // A NaN makes a comparison false and so keeps the neighbour out.
            let alike = (id[i] == p_id)
                & ((depth[i] - p_depth).abs() <= self.depth_threshold * far)
                & (cosine + p_none + no_normal[i] >= self.normal_threshold);
            let cone = 1.0 - lengths[i] * inverse;
            weights[i] = if alike & (cone > 0.0) { cone } else { 0.0 };
        }
    }
}
