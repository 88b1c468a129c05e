//! Material ids, depths and normals as planes that the loops read without a branch.

use noisefloor_frame::{FeatureId, Frame};

/// Id that all background pixels share.
const BACKGROUND: f32 = -1.0;

/// One entry per pixel in each plane.
#[derive(Debug, Clone)]
pub(crate) struct Guides {
    /// Equal for pixels that may be the same material; all zero if ids are not compared.
    pub id: Vec<f32>,
    /// Depth, 0 where it is not compared: background, or everywhere.
    pub depth: Vec<f32>,
    /// Unit normals, 0 where there is none.
    pub normal: [Vec<f32>; 3],
    /// 2 where the normal is absent, else 0: added to a cosine it passes every test "at least T_n".
    pub no_normal: Vec<f32>,
}

/// Which features are compared.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tests {
    pub material_ids: bool,
    pub depth: bool,
    pub normal: bool,
}

impl Guides {
    /// Reads the features that `tests` asks for; the frame has been checked to have them.
    ///
    /// Background is one id, and depth is not compared inside it: a negative material id, or without ids a depth that is
    /// 0 or not finite.
    pub fn new(frame: &Frame, tests: Tests) -> Self {
        let pixels = frame.pixels();
        let plane = |on: bool, id: FeatureId, channel: usize| match frame.feature(&id) {
            Some(feature) if on => feature.mean.plane(channel).to_vec(),
            _ => vec![0.0; pixels],
        };
        let mut id = plane(tests.material_ids, FeatureId::Material, 0);
        let mut depth = plane(tests.depth, FeatureId::Depth, 0);
        for (id, depth) in id.iter_mut().zip(&mut depth) {
            let far = tests.depth && !(depth.is_finite() && *depth > 0.0);
            if *id < 0.0 || (!tests.material_ids && far) {
                (*id, *depth) = (BACKGROUND, 0.0);
            }
        }
        let mut normal = [0, 1, 2].map(|c| plane(tests.normal, FeatureId::Normal, c));
        let mut no_normal = vec![0.0; pixels];
        for (pixel, none) in no_normal.iter_mut().enumerate() {
            let n = [0, 1, 2].map(|c| f64::from(normal[c][pixel]));
            let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
            let usable = length.is_finite() && length > 0.0;
            *none = if usable { 0.0 } else { 2.0 };
            for c in 0..3 {
                normal[c][pixel] = if usable { (n[c] / length) as f32 } else { 0.0 };
            }
        }
        Self { id, depth, normal, no_normal }
    }
}
