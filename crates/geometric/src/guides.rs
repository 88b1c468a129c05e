//! Materials, depths and normals (Listing, lines 5-10) as planes that the loop reads without a branch.

use noisefloor_frame::{FeatureId, Frame};
use rayon::prelude::*;

use crate::Material;

/// Id that all background pixels share; ours, any number that is none of a material.
const BACKGROUND: f32 = -1.0;
/// Id outside the image: none equals it; ours.
pub(crate) const OUTSIDE: f32 = f32::NAN;

/// One entry per pixel in each plane.
#[derive(Debug, Clone)]
pub(crate) struct Guides {
    /// Equal for pixels that may be the same material; all zero where ids are not compared.
    pub id: Vec<f32>,
    /// Albedo, all zero where it is not compared.
    pub albedo: Option<[Vec<f32>; 3]>,
    /// Depth, 0 where it is not compared: background, or everywhere.
    pub depth: Vec<f32>,
    /// Unit normals, NaN where there is none or none is compared.
    pub normal: [Vec<f32>; 3],
}

/// Which features are compared.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tests {
    pub material: Material,
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
        let ids = tests.material == Material::Ids;
        let mut id = plane(ids, FeatureId::Material, 0);
        let mut depth = plane(tests.depth, FeatureId::Depth, 0);
        id.par_iter_mut().zip(&mut depth).for_each(|(id, depth)| {
            let far = tests.depth && !(depth.is_finite() && *depth > 0.0);
            if *id < 0.0 || (!ids && far) {
                (*id, *depth) = (BACKGROUND, 0.0);
            }
        });
        let albedo = (tests.material == Material::Albedo)
            .then(|| [0, 1, 2].map(|channel| plane(true, FeatureId::Albedo, channel)));
        let mut normal = [0, 1, 2].map(|channel| plane(tests.normal, FeatureId::Normal, channel));
        let [x, y, z] = &mut normal;
        x.par_iter_mut().zip(y).zip(z).for_each(|((x, y), z)| {
            let n = [&*x, &*y, &*z].map(|v| f64::from(*v));
            let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
            let usable = length.is_finite() && length > 0.0;
            [*x, *y, *z] = n.map(|v| if usable { (v / length) as f32 } else { f32::NAN });
        });
        Self { id, albedo, depth, normal }
    }
}
