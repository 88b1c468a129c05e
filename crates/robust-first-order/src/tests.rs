//! Parts that no output shows by themselves.

use crate::Params;
use crate::centres::{first, tiles};
use crate::settings::Settings;
use crate::tile::least;
use crate::{KSum, Tiling};

#[test]
fn the_least_error_wins_and_the_smallest_k_of_several_in_any_order() {
    assert_eq!(least(&[1.0, 1.5, 2.0], &[3.0, 1.0, 2.0]), 1);
    assert_eq!(least(&[1.0, 1.5, 2.0], &[2.0, 1.0, 1.0]), 1);
    let pairs = [(1.0f32, 2.0f64), (1.5, 1.0), (2.0, 1.0), (3.5, 4.0)];
    for shift in 0..4 {
        let turned: Vec<_> = (0..4).map(|i| pairs[(i + shift) % 4]).collect();
        let (bandwidths, errors): (Vec<f32>, Vec<f64>) = turned.into_iter().unzip();
        assert_eq!(bandwidths[least(&bandwidths, &errors)], 1.5);
    }
}

#[test]
fn steps_weigh_what_the_text_says() {
    for (t, g) in [(1, 0.75), (2, 8.0 / 9.0), (3, 0.9375)] {
        assert!((Settings::step_weight(t) - g).abs() < 1e-15);
    }
}

#[test]
fn settings_follow_the_parameters() {
    let settings = Settings::new(&Params::default());
    assert_eq!(settings.bandwidths, [1.0, 1.5, 2.0, 3.5, 4.0]);
    assert_eq!((settings.tile, settings.reach, settings.growth, settings.divided), (31, 15, 10, false));
    let other = Params {
        k_scale: 0.5,
        k_sum: KSum::Divided,
        small_radius_px: 20,
        fixed_k: None,
        ..Params::default()
    };
    let settings = Settings::new(&other);
    assert_eq!(settings.bandwidths, [0.5, 0.75, 1.0, 1.75, 2.0]);
    assert_eq!((settings.reach, settings.divided), (20, true));
    assert_eq!(Settings::new(&Params { fixed_k: Some(3.0), ..other }).bandwidths, [3.0]);
}

#[test]
fn tiles_begin_with_the_windows_that_the_tiling_says() {
    let (width, height) = (70, 40);
    let mut detail = vec![false; width * height];
    // 40 % of the first tile, and one pixel more in the second.
    let mut put = |x: usize, count: usize| {
        (0..count).for_each(|i| detail[(i / 31) * width + x + i % 31] = true);
    };
    put(0, 384);
    put(31, 385);
    let tiles = tiles((width, height), 31, &detail, 0.4);
    let shape: Vec<_> = tiles.iter().map(|t| (t.x, t.y, t.width, t.height, t.detailed)).collect();
    let expected = [
        (0, 0, 31, 31, false),
        (31, 0, 31, 31, true),
        (62, 0, 8, 31, false),
        (0, 31, 31, 9, false),
        (31, 31, 31, 9, false),
        (62, 31, 8, 9, false),
    ];
    assert_eq!(shape, expected);
    let of = |tile: usize, tiling| -> Vec<(usize, usize, usize)> {
        let params = Params { tiling, ..Params::default() };
        first(&tiles[tile], &params).iter().map(|c| (c.x, c.y, c.radius)).collect()
    };
    let three = [5, 15, 25];
    let nine = |x: usize| three.into_iter().flat_map(|j| three.map(|i| (x + i, j, 5))).collect::<Vec<_>>();
    assert_eq!(of(0, Tiling::ThreeByThree), [(15, 15, 15)]);
    assert_eq!(of(1, Tiling::ThreeByThree), nine(31));
    assert_eq!(of(1, Tiling::Literal), [(46, 15, 5)]);
    assert_eq!(of(0, Tiling::Literal), [(15, 15, 15)]);
    assert_eq!(of(0, Tiling::AllDetail), nine(0));
    assert_eq!(of(5, Tiling::AllDetail), [(66, 35, 5)]);
    assert_eq!(of(0, Tiling::Dense).len(), 16);
    assert!(of(0, Tiling::Dense).iter().all(|c| c.2 == 10));
}
