//! Tests of the flash filter: made-up images, and what must hold for any image.

mod bits;
mod carried;
mod hard_cases;
mod neighbors;
mod oracle;
mod properties;
mod sets;

use noisefloor_kernels::InstructionSet;
use noisefloor_kernels::flash_filter::{
    Carried, Filtered, FlashInputs, FlashParams, Guide, Membership, PatchWeights, filter_carrying_into,
    filter_into,
};

use crate::random::Random;

/// How a [`Case`] decides who is homogeneous with whom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rule {
    Joint,
    PerChannel,
    Luminance,
    Off,
}

pub(super) const RULES: [Rule; 4] = [Rule::Joint, Rule::PerChannel, Rule::Luminance, Rule::Off];

/// Parameters and planes that live together.
#[derive(Clone, Debug)]
pub struct Case {
    pub params: FlashParams,
    pub rule: Rule,
    pub source: [Vec<f32>; 3],
    pub half_width: [Vec<f32>; 3],
    pub guide: Option<([Vec<f32>; 3], Vec<f32>)>,
    /// Variances, or values if the test wants them so.
    pub carried: [Vec<f32>; 3],
}

impl Case {
    /// Random planes: source and guide in [0, 1), half-widths in [0, 0.6), 1/(2σ_r²) from 1 to 30, variances in
    /// [0, 1), one pixel in eight without any tolerance.
    pub fn random(
        width: usize,
        height: usize,
        window_radius: usize,
        patch_radius: usize,
        rule: Rule,
    ) -> Self {
        let mut random =
            Random((width * 1000 + height) as u64 * 100 + (window_radius * 10 + patch_radius) as u64);
        let n = width * height;
        Self {
            params: FlashParams {
                width,
                height,
                window_radius,
                spatial_sigma: (2 * window_radius + 1) as f32 / 3.0,
                patch: PatchWeights::gaussian(patch_radius, 1.25).unwrap(),
            },
            rule,
            source: random.planes(n, Random::uniform),
            half_width: random
                .planes(n, |random| if random.uniform() < 0.125 { 0.0 } else { 0.6 * random.uniform() }),
            guide: Some((
                random.planes(n, Random::uniform),
                (0..n).map(|_| 0.5 / (1.0 + 29.0 * random.uniform())).collect(),
            )),
            carried: random.planes(n, Random::uniform),
        }
    }

    pub fn inputs(&self) -> FlashInputs<'_> {
        let half_width = self.half_width.each_ref().map(Vec::as_slice);
        FlashInputs {
            source: self.source.each_ref().map(Vec::as_slice),
            membership: match self.rule {
                Rule::Joint => Membership::Joint(half_width),
                Rule::PerChannel => Membership::PerChannel(half_width),
                Rule::Luminance => Membership::Luminance(half_width[0]),
                Rule::Off => Membership::Off,
            },
            guide: self.guide.as_ref().map(|(planes, noise)| Guide {
                planes: planes.each_ref().map(Vec::as_slice),
                sigma_r2: noise,
            }),
            before: &[],
            after: &[],
        }
    }

    pub fn filter_at(&self, level: InstructionSet) -> [Vec<f32>; 3] {
        let mut out = [(); 3].map(|()| vec![f32::NAN; self.params.width * self.params.height]);
        let [r, g, b] = &mut out;
        filter_into(&self.params, &self.inputs(), level, [r, g, b]).unwrap();
        out
    }

    /// The planes that are carried along, with squared weights or plain ones.
    pub fn carried(&self, variances: bool) -> Carried<'_> {
        let planes = self.carried.each_ref().map(Vec::as_slice);
        if variances { Carried::Variances(planes) } else { Carried::Values(planes) }
    }

    pub fn carrying_at(&self, level: InstructionSet, variances: bool) -> Filtered {
        let planes = || [(); 3].map(|()| vec![f32::NAN; self.params.width * self.params.height]);
        let mut out = Filtered { image: planes(), carried: planes() };
        let into = [&mut out.image, &mut out.carried].map(|planes| planes.each_mut().map(Vec::as_mut_slice));
        filter_carrying_into(&self.params, &self.inputs(), &self.carried(variances), level, into).unwrap();
        out
    }

    pub fn filter(&self) -> [Vec<f32>; 3] {
        noisefloor_kernels::flash_filter::filter(&self.params, &self.inputs()).unwrap()
    }

    pub fn oracle(&self) -> [Vec<f64>; 3] {
        noisefloor_kernels::flash_filter::naive::filter_f64(&self.params, &self.inputs()).unwrap()
    }
}
