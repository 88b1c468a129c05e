//! Random numbers by index: nothing is carried from sample to sample, so any thread can make any of them.

use noisefloor_frame::Sampling;

/// Four uniform numbers in [0, 1) per *group*; a path uses fixed groups for fixed decisions.
pub trait Sampler: Copy {
    /// The numbers of one group.
    fn group(&self, group: u32) -> [f32; 4];
}

/// Finaliser of SplitMix64 (variant 13 of Stafford's mixers): a bijection that spreads every bit.
#[inline]
pub fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;

/// Key of a pixel: every random seed gives another set.
#[inline]
pub fn pixel_key(seed: u64, pixel: u64) -> u64 {
    mix(mix(seed.wrapping_add(GOLDEN)).wrapping_add(pixel.wrapping_mul(GOLDEN)))
}

/// Independent samples: SplitMix64 streams, one per pixel and sample.
#[derive(Debug, Clone, Copy)]
pub struct Independent {
    key: u64,
}

impl Independent {
    /// Sample `index` of the pixel with this key.
    #[inline]
    pub fn new(pixel_key: u64, index: u32) -> Self {
        Self { key: mix(pixel_key ^ mix(u64::from(index).wrapping_add(1).wrapping_mul(GOLDEN))) }
    }
}

impl Sampler for Independent {
    #[inline]
    fn group(&self, group: u32) -> [f32; 4] {
        let base = self.key.wrapping_add(u64::from(group).wrapping_mul(GOLDEN.wrapping_mul(2)));
        let (a, b) = (mix(base.wrapping_add(GOLDEN)), mix(base.wrapping_add(GOLDEN.wrapping_mul(2))));
        // 24 bits fill a float in [0, 1) without rounding up to 1.
        let unit = |bits: u32| (bits >> 8) as i32 as f32 * (1.0 / 16_777_216.0);
        [unit(a as u32), unit((a >> 32) as u32), unit(b as u32), unit((b >> 32) as u32)]
    }
}

/// Owen-scrambled Sobol points (Burley 2020): four dimensions per group, groups decorrelated by their seeds. At most
/// 2^16 points per sequence.
#[derive(Debug, Clone, Copy)]
pub struct OwenSobol {
    key: u64,
    index: u32,
}

impl OwenSobol {
    /// Point `index` of randomisation `sequence` of the pixel with this key.
    #[inline]
    pub fn new(pixel_key: u64, sequence: u32, index: u32) -> Self {
        Self { key: mix(pixel_key ^ mix(u64::from(sequence).wrapping_add(1).wrapping_mul(GOLDEN))), index }
    }
}

impl Sampler for OwenSobol {
    #[inline]
    fn group(&self, group: u32) -> [f32; 4] {
        let seed = mix(self.key.wrapping_add(u64::from(group).wrapping_mul(GOLDEN)));
        sobol_burley::sample_4d(self.index, 0, (seed >> 32) as u32)
    }
}

/// Name in provenance.
pub fn name(sampling: Sampling) -> &'static str {
    match sampling {
        Sampling::Independent => "independent",
        Sampling::LowDiscrepancy => "owen-sobol",
    }
}
