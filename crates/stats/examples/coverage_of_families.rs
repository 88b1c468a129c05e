//! How often every family of intervals covers the mean of known laws: 4·10⁵ draws of each, written to
//! `tests/coverage_of_families.csv`.
//!
//! A draw is a pixel with n samples of its own, in one of 400 images of 40×25 pixels. All pixels of an image have the same
//! law, which is the best case for families that look at the neighbours; in `exponential-edge` the right half is eight times
//! as bright. Columns: covered, share of truths below the interval and above it, standard error of the first.

use std::fmt::Write;

use noisefloor_stats::random::Normals;
use noisefloor_stats::{FAMILIES, IntervalNeed, Level};

#[path = "../tests/families/laws.rs"]
mod laws;
#[path = "../tests/families/simulation.rs"]
mod simulation;

use laws::Law;
use simulation::{Count, Image, PIXELS};

const IMAGES: usize = 400;
const COUNTS: [u32; 5] = [4, 8, 16, 32, 64];
const LEVELS: [Level; 3] = [Level::TWO_SIDED_95, Level::TWO_SIDED_99, Level::TWO_SIDED_998];

fn main() -> std::io::Result<()> {
    let mut table = String::from("family,law,n,level,covered,below,above,mcse\n");
    for (of_law, law) in Law::ALL.into_iter().enumerate() {
        for n in COUNTS {
            let mut random = Normals::new(((of_law as u64) << 32) + u64::from(n));
            let mut counts = vec![Vec::new(); FAMILIES.len() * LEVELS.len()];
            for _ in 0..IMAGES {
                let image = Image::new(law, n, &mut random);
                let cells = FAMILIES.iter().flat_map(|family| LEVELS.map(|level| (family, level)));
                for (counts, (family, level)) in counts.iter_mut().zip(cells) {
                    let mut count = Count::default();
                    count.add(&image, &image.intervals(*family, level));
                    counts.push(count.shares());
                }
            }
            for (family, counts) in FAMILIES.iter().zip(counts.chunks(LEVELS.len())) {
                let neighbours = family.needs().contains(&IntervalNeed::Neighbours);
                for (level, shares) in LEVELS.iter().zip(counts) {
                    let [covered, below, above] = [0, 1, 2].map(|k| mean(shares.iter().map(|of| of[k])));
                    let (id, law, level) = (family.id(), law.name(), level.confidence());
                    let error = standard_error(shares, neighbours);
                    let _ = writeln!(
                        table,
                        "{id},{law},{n},{level},{covered:.6},{below:.6},{above:.6},{error:.6}"
                    );
                }
            }
        }
    }
    std::fs::write(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/coverage_of_families.csv"), table)
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    values.sum::<f64>() / IMAGES as f64
}

/// Standard error of the share inside, from the shares of each image. Pixels whose intervals use their neighbours are not
/// independent of each other: then it comes from the spread between images.
fn standard_error(shares: &[[f64; 3]], neighbours: bool) -> f64 {
    let (images, rate) = (IMAGES as f64, mean(shares.iter().map(|of| of[0])));
    if neighbours {
        let squares: f64 = shares.iter().map(|of| (of[0] - rate).powi(2)).sum();
        return (squares / (images * (images - 1.0))).sqrt();
    }
    (rate * (1.0 - rate) / (images * PIXELS as f64)).max(0.0).sqrt()
}
