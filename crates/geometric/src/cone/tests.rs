use noisefloor_frame::{Estimate, FeatureId, Frame, Image, Samples, Sampling};
use noisefloor_kernels::InstructionSet;

use super::*;
use crate::Material;
use crate::guides::Tests;

const THRESHOLDS: Thresholds = Thresholds { depth: 0.02, normal: 0.9, albedo: 0.1 };
const RADIUS_MAX: f64 = 9.5;

/// Uniforms in [0, 1) by SplitMix64.
fn uniforms(seed: u64) -> impl FnMut() -> f32 {
    let mut state = seed;
    move || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 40) as f32 / (1u64 << 24) as f32
    }
}

/// Patches of ids, depths, tints and normals, some of them absent, and radii from 0 to the largest.
fn case(width: usize, height: usize, seed: u64) -> (Frame, Vec<f32>) {
    let mut u = uniforms(seed);
    let mut color = Image::from_fn(width, height, 3, |_, _, _| u());
    color.set(1, width / 2, height / 2, 1e6);
    let mut frame = Frame::from_color(Estimate::from_mean(color), Samples::uniform(4), Sampling::Independent);
    let mut patches = |channels, choices: &[f32], side: usize| {
        let (columns, rows) = (width.div_ceil(side), height.div_ceil(side));
        let all: Vec<f32> =
            (0..columns * rows * channels).map(|_| choices[(u() * choices.len() as f32) as usize]).collect();
        Image::from_fn(width, height, channels, |c, x, y| {
            all[(c * rows + y / side) * columns + x / side] * (1.0 + 1e-3 * (x + y) as f32)
        })
    };
    for (id, channels, choices) in [
        (FeatureId::Depth, 1, &[1.0, 1.01, 1.5, 0.0, f32::INFINITY][..]),
        (FeatureId::Normal, 3, &[0.0, 1.0, 0.9]),
        (FeatureId::Albedo, 3, &[0.0, 0.5, 0.52]),
    ] {
        frame.features.insert(id, Estimate::from_mean(patches(channels, choices, 5)));
    }
    let ids = patches(1, &[0.0, 1.0, 2.0, -1.0], 7).map(f32::round);
    frame.features.insert(FeatureId::Material, Estimate::from_mean(ids));
    let radii = (0..width * height).map(|_| (1.3 * u()).min(1.0) * RADIUS_MAX as f32).collect();
    (frame, radii)
}

fn guides(frame: &Frame, material: Material, on: bool) -> Guides {
    Guides::new(frame, Tests { material, depth: on, normal: on })
}

/// The formula in `f64`, every pixel of the image as a neighbour of every other: each value with how far rounding may move
/// it. A weight 1 − d/R has an absolute error of 2ε however small it is, so a bright neighbour's share of the sum is that
/// uncertain; 8ε of the value are for the sums.
fn oracle(frame: &Frame, radii: &[f32], guides: &Guides) -> Vec<[(f64, f64); 3]> {
    let (w, h) = (frame.width(), frame.height());
    let value = |plane: &[f32], i: usize| f64::from(plane[i]);
    let color = |c: usize, i: usize| value(frame.color.mean.plane(c), i);
    let like = |p: usize, q: usize| {
        let (zp, zq) = (value(&guides.depth, p), value(&guides.depth, q));
        let n = |i: usize| guides.normal.each_ref().map(|plane| value(plane, i));
        let (np, nq) = (n(p), n(q));
        let cosine = np[0] * nq[0] + np[1] * nq[1] + np[2] * nq[2];
        let absent = np[0].is_nan() || nq[0].is_nan();
        let tint = guides.albedo.as_ref().is_none_or(|planes| {
            let pairs = planes.each_ref().map(|plane| (value(plane, p), value(plane, q)));
            let most = pairs.iter().map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            most <= f64::from(THRESHOLDS.albedo) * pairs.iter().map(|(a, b)| a.max(*b)).fold(0.0, f64::max)
        });
        guides.id[p] == guides.id[q]
            && (zp - zq).abs() <= f64::from(THRESHOLDS.depth) * zp.max(zq)
            && (absent || cosine >= f64::from(THRESHOLDS.normal))
            && tint
    };
    let pixel = |p: usize| {
        let radius = f64::from(radii[p]);
        let (mut sum, mut total) = (1.0, [0, 1, 2].map(|c| color(c, p)));
        let (mut count, mut plain) = (0.0, [0.0; 3]);
        for q in (0..w * h).filter(|&q| q != p && like(p, q)) {
            let (dx, dy) = ((q % w).abs_diff(p % w) as f64, (q / w).abs_diff(p / w) as f64);
            let distance = dx.hypot(dy);
            if distance < radius {
                let weight = 1.0 - distance / radius;
                sum += weight;
                count += 1.0;
                plain.iter_mut().enumerate().for_each(|(c, plain)| *plain += color(c, q));
                total.iter_mut().enumerate().for_each(|(c, total)| *total += weight * color(c, q));
            }
        }
        let epsilon = f64::from(f32::EPSILON);
        [0, 1, 2].map(|c| {
            let value = total[c] / sum;
            (value, epsilon * (8.0 * value + 2.0 * (plain[c] + count * value) / sum))
        })
    };
    (0..w * h).map(pixel).collect()
}

#[test]
fn every_value_is_that_of_the_formula() {
    let mut moved = 0;
    for (w, h, seed) in [(1, 1, 1), (2, 9, 2), (9, 1, 3), (33, 20, 4), (40, 17, 5)] {
        let (frame, radii) = case(w, h, seed);
        for (material, on) in [
            (Material::Ids, true),
            (Material::Albedo, true),
            (Material::Albedo, false),
            (Material::Off, true),
            (Material::Off, false),
        ] {
            let guides = guides(&frame, material, on);
            let got = Cone::new(&frame.color.mean, &radii, &guides, THRESHOLDS, RADIUS_MAX).filter();
            for (p, expected) in oracle(&frame, &radii, &guides).into_iter().enumerate() {
                for (c, (expected, allowed)) in expected.into_iter().enumerate() {
                    let value = f64::from(got.get(c, p % w, p / w));
                    assert!(
                        (value - expected).abs() <= allowed,
                        "{w}×{h} {material:?} {on}, pixel {p}: {value}, formula {expected}"
                    );
                    moved += usize::from(value != f64::from(frame.color.mean.get(c, p % w, p / w)));
                }
            }
        }
    }
    assert!(moved > 5000, "{moved} values are filtered at all");
}

#[test]
fn every_instruction_set_gives_the_same_bits() {
    let (frame, radii) = case(61, 29, 6);
    for material in [Material::Ids, Material::Albedo] {
        let guides = guides(&frame, material, true);
        let cone = Cone::new(&frame.color.mean, &radii, &guides, THRESHOLDS, RADIUS_MAX);
        let bits = |image: &Image| image.data().iter().map(|v| v.to_bits()).collect::<Vec<_>>();
        let portable = bits(&cone.filter_at(InstructionSet::Portable));
        for level in InstructionSet::ALL {
            assert_eq!(bits(&cone.filter_at(level)), portable, "{level}");
        }
    }
}
