//! Random numbers by index: nothing is carried from sample to sample, so any thread can make any of them.

use noisefloor_frame::Sampling;
use sobol_burley::parts;

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

/// The first four Sobol dimensions of any index below 2^16, as the exclusive or of one entry of each table. Bits are
/// reversed, as `sobol_burley` keeps them.
#[derive(Debug, Clone)]
pub struct SobolTables {
    high: Box<[[u32; 4]; 256]>,
    low: Box<[[u32; 4]; 256]>,
}

impl SobolTables {
    /// Fills the tables.
    pub fn new() -> Self {
        let table = |shift: u32| {
            Box::new(std::array::from_fn(|i| parts::sobol_int4_rev((i as u32) << shift, 0).into()))
        };
        Self { high: table(24), low: table(16) }
    }
}

/// Random choices that scramble one group of four dimensions.
#[derive(Debug, Clone, Copy)]
struct Scramble {
    /// Permutes the order of the points, which decorrelates the groups.
    order: u32,
    /// Permutes the digits of each dimension.
    digits: [u32; 4],
}

impl Scramble {
    #[inline]
    fn new(key: u64, group: u32) -> Self {
        let base = key.wrapping_add(u64::from(group).wrapping_mul(GOLDEN.wrapping_mul(4)));
        let [a, b, c] = [1, 2, 3].map(|k: u64| mix(base.wrapping_add(GOLDEN.wrapping_mul(k))));
        let split = |v: u64| (v as u32, (v >> 32) as u32);
        let ((order, x), (y, z)) = (split(a), split(b));
        Self { order, digits: [x, y, z, c as u32] }
    }
}

/// Groups whose scrambles are made once per sequence; later ones, deep in a path, are made when they are used.
const KEPT_GROUPS: usize = 24;

/// One randomisation of the points: what its samples share.
#[derive(Debug, Clone)]
pub struct Sequence {
    key: u64,
    kept: [Scramble; KEPT_GROUPS],
}

impl Sequence {
    /// Randomisation `number` of the pixel with this key.
    pub fn new(pixel_key: u64, number: u32) -> Self {
        let key = mix(pixel_key ^ mix(u64::from(number).wrapping_add(1).wrapping_mul(GOLDEN)));
        Self { key, kept: std::array::from_fn(|group| Scramble::new(key, group as u32)) }
    }
}

/// Owen-scrambled Sobol points (Burley 2020): four dimensions per group, groups decorrelated by shuffling. At most 2^16
/// points per sequence.
#[derive(Debug, Clone, Copy)]
pub struct OwenSobol<'a> {
    tables: &'a SobolTables,
    sequence: &'a Sequence,
    reversed_index: u32,
}

impl<'a> OwenSobol<'a> {
    /// Point `index` of a sequence.
    #[inline]
    pub fn new(tables: &'a SobolTables, sequence: &'a Sequence, index: u32) -> Self {
        Self { tables, sequence, reversed_index: index.reverse_bits() }
    }
}

impl Sampler for OwenSobol<'_> {
    #[inline]
    fn group(&self, group: u32) -> [f32; 4] {
        let scramble = match self.sequence.kept.get(group as usize) {
            Some(kept) => *kept,
            None => Scramble::new(self.sequence.key, group),
        };
        let index = parts::owen_scramble_rev(self.reversed_index, scramble.order);
        let high = self.tables.high[(index >> 24) as usize];
        let low = self.tables.low[(index >> 16) as usize & 255];
        let point = [0, 1, 2, 3].map(|k| high[k] ^ low[k]);
        parts::owen_scramble_int4_rev(point.into(), scramble.digits.into()).reverse_bits().to_f32_norm()
    }
}

/// Name in provenance.
pub fn name(sampling: Sampling) -> &'static str {
    match sampling {
        Sampling::Independent => "independent",
        Sampling::LowDiscrepancy => "owen-sobol",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_power_of_two_of_points_fills_all_strata() {
        let tables = SobolTables::new();
        for number in 0..4 {
            let sequence = Sequence::new(pixel_key(1, 2), number);
            for group in [0, 5, 40] {
                let points: Vec<[f32; 4]> =
                    (0..256).map(|k| OwenSobol::new(&tables, &sequence, k).group(group)).collect();
                for count in [4usize, 64, 256] {
                    for dimension in 0..4 {
                        let mut seen = vec![false; count];
                        for p in &points[..count] {
                            seen[(p[dimension] * count as f32) as usize] = true;
                        }
                        assert!(
                            seen.iter().all(|&s| s),
                            "group {group}, dimension {dimension}, {count} points"
                        );
                    }
                }
                // The first two dimensions are a (0, 2)-sequence: 16 × 16 cells, one point in each.
                let mut cells = vec![false; 256];
                for p in &points {
                    cells[(p[0] * 16.0) as usize * 16 + (p[1] * 16.0) as usize] = true;
                }
                assert!(cells.iter().all(|&c| c));
            }
        }
    }

    #[test]
    fn tables_agree_with_the_direct_computation() {
        let tables = SobolTables::new();
        for index in [0u32, 1, 2, 255, 256, 12_345, 65_535] {
            let reversed = index.reverse_bits();
            let direct: [u32; 4] = parts::sobol_int4_rev(reversed, 0).into();
            let (high, low) =
                (tables.high[(reversed >> 24) as usize], tables.low[(reversed >> 16) as usize & 255]);
            assert_eq!([0, 1, 2, 3].map(|k| high[k] ^ low[k]), direct);
        }
    }

    /// Correlation of two lists of uniform numbers, in units of its standard deviation for independent ones.
    fn correlation(pairs: impl Iterator<Item = (f32, f32)>) -> f64 {
        let (mut sum, mut n) = (0.0, 0.0f64);
        for (a, b) in pairs {
            sum += (f64::from(a) - 0.5) * (f64::from(b) - 0.5) * 12.0;
            n += 1.0;
        }
        sum / n.sqrt()
    }

    #[test]
    fn samples_pixels_groups_and_seeds_are_uncorrelated() {
        let at = |seed, pixel, k, group| Independent::new(pixel_key(seed, pixel), k).group(group);
        let n = 20_000;
        let cases: [f64; 5] = [
            correlation((0..n).map(|k| (at(1, 0, k, 0)[0], at(1, 0, k + 1, 0)[0]))),
            correlation((0..n).map(|k| (at(1, u64::from(k), 0, 0)[1], at(1, u64::from(k) + 1, 0, 0)[1]))),
            correlation((0..n).map(|k| (at(1, 0, k, 0)[2], at(1, 0, k, 1)[2]))),
            correlation((0..n).map(|k| (at(1, 0, k, 0)[3], at(2, 0, k, 0)[3]))),
            correlation((0..n).map(|k| (at(u64::from(k), 0, 0, 0)[0], at(u64::from(k) + 1, 0, 0, 0)[1]))),
        ];
        assert!(cases.iter().all(|z| z.abs() < 4.5), "{cases:?}");
    }

    #[test]
    fn sequences_of_a_pixel_are_uncorrelated() {
        let tables = SobolTables::new();
        // One product per pixel: points within a sequence depend on each other, pixels do not.
        let z = correlation((0..20_000).map(|pixel| {
            let point = |number| {
                let sequence = Sequence::new(pixel_key(3, pixel), number);
                OwenSobol::new(&tables, &sequence, 7).group(1)[0]
            };
            (point(0), point(1))
        }));
        assert!(z.abs() < 4.5, "{z}");
    }
}
