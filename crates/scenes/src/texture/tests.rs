use super::*;
use crate::hash::Placement;

const DARK: Vec3 = Vec3::new(0.1, 0.0, 0.2);
const BRIGHT: Vec3 = Vec3::new(1.0, 0.9, 0.8);

fn all() -> Vec<Texture> {
    let (a, b, colors, size) = (DARK, BRIGHT, [DARK, BRIGHT], Vec2::new(0.25, 0.08));
    vec![
        Texture::Checker { frequency: Vec2::new(3.0, 5.0), a, b },
        Texture::Stripes { period: 0.3, share: 0.4, base: a, stripe: b },
        Texture::Bricks(Bricks { size, joint: 0.01, colors, mortar: BRIGHT, seed: 1 }),
        Texture::Tiles(Tiles { size, joint: 0.01, colors, clouding: 0.3, grout: DARK, seed: 2 }),
        Texture::Tiles(Tiles { size, joint: 0.0, colors, clouding: 0.0, grout: DARK, seed: 2 }),
        Texture::Wood(Wood { plank: 0.2, length: 1.5, ring: 0.02, dark: DARK, light: BRIGHT, seed: 3 }),
        Texture::Clouds(Clouds { frequency: Vec2::splat(4.0), octaves: 3, a, b, seed: 4 }),
        Texture::Streaks(Streaks { width: 0.01, length: 1.0, dark: DARK, bright: BRIGHT, seed: 5 }),
        Texture::Leaf(Leaf { colors, vein: BRIGHT, seed: 6 }),
        Texture::Granite(Granite { grain: 0.1, colors: [a, b, DARK, BRIGHT], seed: 8 }),
        Texture::Bread(Bread { crumb: BRIGHT, toasted: DARK, crust: DARK, seed: 7 }),
    ]
}

#[test]
fn colours_stay_in_the_unit_cube_far_from_the_origin_too() {
    let mut placement = Placement::new(1);
    for texture in all() {
        for scale in [1.0, 100.0, 1e9, 1e30] {
            for _ in 0..2000 {
                let uv = Vec2::new(placement.range(-scale, scale), placement.range(-scale, scale));
                let c = texture.eval(uv);
                assert!(c.min_element() >= 0.0 && c.max_element() <= 1.0, "{texture:?} at {uv} is {c}");
            }
        }
    }
}

#[test]
fn textures_are_not_flat() {
    for texture in all() {
        let mut placement = Placement::new(2);
        let values: Vec<f32> = (0..500)
            .map(|_| texture.eval(Vec2::new(placement.range(-2.0, 2.0), placement.range(-1.0, 1.0))).y)
            .collect();
        let mean = values.iter().sum::<f32>() / 500.0;
        let variance = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f32>() / 499.0;
        assert!(variance.sqrt() > 0.05, "{texture:?} deviates by {}", variance.sqrt());
    }
}

#[test]
fn split_rounds_down_on_both_sides_of_zero() {
    for (x, floor, rest) in [(2.25, 2, 0.25), (-0.25, -1, 0.75), (-3.0, -3, 0.0), (0.0, 0, 0.0)] {
        assert_eq!(noise::split(x), (floor, rest));
    }
    let (_, rest) = noise::split(-1e-9);
    assert!((0.0..=1.0).contains(&rest));
}

#[test]
fn noise_is_continuous_across_lattice_lines() {
    for i in -3..3 {
        let p = Vec2::new(i as f32, 0.4 + i as f32);
        let step = Vec2::new(1e-4, 0.0);
        let jump = (value_noise(p - step, 3) - value_noise(p + step, 3)).abs();
        // The slope of the blend is at most 3/2 of the difference of two values in [0, 1).
        assert!(jump <= 1.5 * 2e-4 + 1e-6, "jump {jump} at {p}");
    }
}

#[test]
fn brick_wall_shows_mortar_in_its_share_of_the_area() {
    let wall =
        Bricks { size: Vec2::new(0.25, 0.08), joint: 0.01, colors: [Vec3::X; 2], mortar: Vec3::Y, seed: 1 };
    let mut placement = Placement::new(3);
    let n = 20_000;
    let hits = (0..n)
        .filter(|_| wall.eval(Vec2::new(placement.range(0.0, 40.0), placement.range(0.0, 40.0))).y > 0.0)
        .count();
    let expected = 1.0 - (1.0 - 0.01 / 0.25) * (1.0 - 0.01 / 0.08);
    let share = hits as f64 / f64::from(n);
    // Four standard errors of a proportion, and 2 % of area for the wobble of the joints.
    assert!(
        (share - expected).abs() < 4.0 * (expected / f64::from(n)).sqrt() + 0.02,
        "{share} for {expected}"
    );
}

#[test]
fn granite_shows_its_minerals_in_their_shares() {
    let colors = [Vec3::X, Vec3::Y, Vec3::Z, Vec3::ONE];
    let stone = Granite { grain: 0.1, colors, seed: 3 };
    let mut placement = Placement::new(4);
    let n = 20_000;
    let mut counts = [0.0; 4];
    for _ in 0..n {
        let c = stone.eval(Vec2::new(placement.range(0.0, 90.0), placement.range(0.0, 90.0)));
        let index = if c.min_element() > 0.0 { 3 } else { c.max_position() };
        counts[index] += 1.0 / f64::from(n);
    }
    for (share, expected) in counts.into_iter().zip([0.5, 0.25, 0.125, 0.125]) {
        // Four standard errors; points are so far apart that hardly two share a grain.
        let error: f64 = (expected * (1.0 - expected) / f64::from(n)).sqrt();
        assert!((share - expected).abs() < 4.0 * error, "{share} for {expected}");
    }
}
