//! What is kept of a frame to hold it against the other frames of its scene: a few kilobytes.

use noisefloor_frame::{Frame, Image, Variance};
use noisefloor_stats::instrument::ResidualSums;
use serde::{Deserialize, Serialize};

use crate::Planes;
use crate::against::{Against, grey};
use crate::brightness::{self, Brightness};
use crate::chance::ALPHA;

/// Hashes of a frame's planes, sums of its brightness, and some of its pixels.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Sketch {
    /// Hashes of the colour planes.
    pub(crate) planes: Planes,
    /// Whether its mean is expected to be the reference's and shows the same picture.
    pub(crate) sound: bool,
    /// Samples per pixel.
    pub(crate) spp: f64,
    /// S, its variance without the reference's part, that part, third moment; absent if not testable.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) brightness: Option<[f64; 4]>,
    /// Whether the frame's own brightness was found to differ.
    pub(crate) differs: bool,
    /// Difference of the half buffers at some pixels, in units of the noise there.
    #[serde(default, skip_serializing_if = "Vec::is_empty", with = "hex")]
    pub(crate) halves: Vec<f32>,
    /// Distance to the reference at the same pixels, in units of the noise around; NaN where it is not known.
    #[serde(default, skip_serializing_if = "Vec::is_empty", with = "hex")]
    pub(crate) distance: Vec<f32>,
}

/// Most pixels that are kept.
const PIXELS: usize = 1024;

impl Sketch {
    pub(crate) fn of(
        against: &Against<'_>,
        frame: &Frame,
        invalid: &[bool],
        blocks: &[ResidualSums],
        whole: Brightness,
        planes: Planes,
    ) -> Self {
        let variance = frame.color.variance.as_ref().map(Variance::mean_variance);
        let typical = ResidualSums::total(blocks);
        let typical = (typical.e2 / typical.pixels.max(1.0)).sqrt();
        // The typical residual for the brightness around: known without the pixel's own samples, so that distances in this
        // unit have no mean.
        let around = |p: usize| typical / against.weights[against.blocks.of(p)];
        // Differences of halves are symmetric whatever their unit, and even better in that of the pixel's own noise.
        let own = |p: usize| {
            let stated = variance.map_or(0.0, |v| f64::from(grey(v, p)).max(0.0).sqrt());
            if variance.is_some() { stated.max(0.1 * around(p)) } else { around(p) }
        };
        let kept = positions(frame.pixels());
        let at = |value: &dyn Fn(usize) -> f64, unit: &dyn Fn(usize) -> f64| -> Vec<f32> {
            let one = |p: usize| match against.usable(p, invalid) {
                true => (value(p) / unit(p)) as f32,
                false => f32::NAN,
            };
            kept.iter().map(|&p| one(p)).collect()
        };
        let difference = |a: &Image, b: &Image, p: usize| f64::from(grey(a, p)) - f64::from(grey(b, p));
        let halves = frame.color.halves.as_ref();
        let differs = matches!(whole, Brightness::Tested { p, .. } if p <= ALPHA);
        Self {
            planes,
            sound: true,
            spp: frame.samples.total().mean(),
            brightness: brightness::pooled(frame, blocks),
            differs,
            halves: halves.map(|[a, b]| at(&|p| difference(a, b, p), &own)).unwrap_or_default(),
            distance: at(&|p| difference(&frame.color.mean, against.reference.mean(), p), &around),
        }
    }
}

/// Pixels spread over the image without a pattern: steps of the golden ratio.
fn positions(pixels: usize) -> Vec<usize> {
    if pixels <= PIXELS {
        return (0..pixels).collect();
    }
    let golden = 0.618_033_988_749_894_9;
    let mut out: Vec<usize> =
        (0..PIXELS).map(|k| ((k as f64 * golden).fract() * pixels as f64) as usize).collect();
    out.sort_unstable();
    out.dedup();
    out
}

/// Single-precision numbers as eight hexadecimal digits each.
mod hex {
    use serde::{Deserialize, Deserializer, Serializer};

    pub(super) fn serialize<S: Serializer>(values: &[f32], to: S) -> Result<S::Ok, S::Error> {
        let text: String = values.iter().map(|v| format!("{:08x}", v.to_bits())).collect();
        to.serialize_str(&text)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f32>, D::Error> {
        let text = String::deserialize(from)?;
        let one = |digits: &[u8]| {
            let digits = std::str::from_utf8(digits).ok()?;
            u32::from_str_radix(digits, 16).ok().map(f32::from_bits)
        };
        let values: Option<Vec<f32>> = text.as_bytes().chunks(8).map(one).collect();
        values.ok_or_else(|| serde::de::Error::custom("not a list of hexadecimal numbers"))
    }
}
