//! Tests of the bank of cross-bilateral filters.

mod bits;
mod oracle;
mod properties;
mod refused;

use std::f32::consts::{FRAC_1_SQRT_2, SQRT_2};

use noisefloor_kernels::cross_bilateral::*;

use crate::random::Random;

/// Inputs that own their values: a step in the middle of the image with noise in every guide, planes of either sign.
#[derive(Clone, Debug)]
struct Case {
    params: BilateralParams,
    /// Values, variances, σ.
    guides: Vec<(Vec<f32>, Vec<f32>, f32)>,
    planes: Vec<Vec<f32>>,
    bank: Vec<Spatial>,
}

/// The spatial σ of li2012sbf.
const SIGMAS: [f32; 9] = [0.0, FRAC_1_SQRT_2, 1.0, SQRT_2, 2.0, 2.0 * SQRT_2, 4.0, 4.0 * SQRT_2, 8.0];

impl Case {
    fn random(width: usize, height: usize, guides: usize, planes: usize) -> Self {
        let mut u = Random((width * 1000 + height * 10 + guides) as u64);
        let n = width * height;
        let guides = (0..guides)
            .map(|k| {
                let step = |p: usize| if 2 * (p % width) < width { 0.0 } else { 0.3 };
                let value = (0..n).map(|p| step(p) + 0.3 * u.uniform()).collect();
                // Below the floor and above it.
                let variance =
                    u.plane(n, |u| if u.uniform() < 0.3 { 0.004 * u.uniform() } else { 0.1 * u.uniform() });
                (value, variance, [0.8, 0.25, 0.6][k % 3])
            })
            .collect();
        Self {
            params: BilateralParams { width, height, floor: 0.01 },
            guides,
            planes: (0..planes).map(|_| u.plane(n, |u| 2.0 * u.uniform() - 1.0)).collect(),
            bank: SIGMAS.map(Spatial::new).to_vec(),
        }
    }

    /// One row without noise: guides of these values, all with this variance.
    fn row(guide: &[f32], variance: f32, sigma: f32, spatial: Spatial) -> Self {
        let n = guide.len();
        Self {
            params: BilateralParams { width: n, height: 1, floor: 0.01 },
            guides: vec![(guide.to_vec(), vec![variance; n], sigma)],
            planes: vec![guide.to_vec()],
            bank: vec![spatial],
        }
    }

    fn guides(&self) -> Vec<BilateralGuide<'_>> {
        self.guides
            .iter()
            .map(|(value, variance, sigma)| BilateralGuide { value, variance, sigma: *sigma })
            .collect()
    }

    fn planes(&self) -> Vec<&[f32]> {
        self.planes.iter().map(Vec::as_slice).collect()
    }

    fn filter(&self) -> Vec<Filtered> {
        filter(&self.params, &self.guides(), &self.planes(), &self.bank).unwrap_or_else(|e| panic!("{e}"))
    }

    fn oracle(&self) -> Vec<Filtered<f64>> {
        naive::filter_f64(&self.params, &self.guides(), &self.planes(), &self.bank)
            .unwrap_or_else(|e| panic!("{e}"))
    }

    /// w(p,q) of the first filter from every p to these q: planes that are 1 at one q each come out as w/W.
    fn weights_to(&self, to: &[usize]) -> Vec<Vec<f64>> {
        let n = self.params.width * self.params.height;
        let planes = to.iter().map(|q| (0..n).map(|p| f32::from(p == *q)).collect()).collect();
        let out = &Self { planes, ..self.clone() }.oracle()[0];
        out.planes
            .iter()
            .map(|of| of.iter().zip(&out.weights).map(|(mean, sum)| mean * sum).collect())
            .collect()
    }
}
