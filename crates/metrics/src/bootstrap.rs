use std::collections::BTreeMap;

use noisefloor_frame::Image;

use crate::MetricError;
use crate::blocks::blocks;
use crate::measurer::Measurer;

/// Standard error of each metric within one image: the spread of the metric over `replicates` images that are
/// put together from blocks of about 32×32 pixels, drawn with replacement (block bootstrap, Künsch 1989).
///
/// It says how much the number depends on which parts of this image were looked at, and nothing about other
/// random seeds. Metrics without a spread (fewer than two blocks, undefined values) are absent.
///
/// # Errors
/// [`MetricError::Shape`] if the image has not the shape of the reference.
pub fn block_bootstrap(
    measurer: &Measurer<'_>,
    test: &Image,
    replicates: usize,
    seed: u64,
) -> Result<BTreeMap<String, f64>, MetricError> {
    let asked = measurer.asked(test)?;
    let blocks = blocks(test.width(), test.height(), |p| asked.pixels.valid[p]);
    if blocks.len() < 2 {
        return Ok(BTreeMap::new());
    }
    let mut samples: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    let mut state = seed;
    for _ in 0..replicates {
        let chosen: Vec<usize> = (0..blocks.len()).map(|_| below(&mut state, blocks.len())).collect();
        let members: Vec<usize> = chosen.iter().flat_map(|&b| blocks[b].iter().copied()).collect();
        for (metric, value) in asked.over(&members) {
            samples.entry(metric.id).or_default().extend(value);
        }
    }
    let mut out = BTreeMap::new();
    for (id, samples) in samples {
        if samples.len() >= 2 {
            let n = samples.len() as f64;
            let mean = samples.iter().sum::<f64>() / n;
            let m2: f64 = samples.iter().map(|v| (v - mean).powi(2)).sum();
            out.insert(id.to_owned(), (m2 / (n - 1.0)).sqrt()); // n ≥ 2
        }
    }
    Ok(out)
}

/// A number below `limit` from the SplitMix64 sequence (Steele, Lea, Flood 2014); `limit` is far below 2³²,
/// so the bias of the multiplication is negligible.
fn below(state: &mut u64, limit: usize) -> usize {
    *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^= z >> 31;
    ((u128::from(z) * limit as u128) >> 64) as usize
}
