//! Cutting planes into tiles, and checking them.

use noisefloor_kernels::inside::{first_bad, for_each_tile};

#[test]
fn the_first_bad_value_is_found() {
    let mut values = vec![1.0; 100_000];
    assert_eq!(first_bad(&values, |v| v > 0.0), None);
    for bad in [99_999, 70_000, 16_384, 16_383, 0] {
        values[bad] = -1.0;
        assert_eq!(first_bad(&values, |v| v > 0.0), Some(bad));
    }
}

#[test]
fn tiles_cover_every_pixel_of_every_plane_once() {
    for (width, height) in [(1, 1), (64, 16), (65, 17), (130, 5), (3, 40)] {
        let (mut a, mut b) = (vec![0.0f32; width * height], vec![0.0f32; width * height]);
        for_each_tile(
            width,
            (64, 16),
            [a.as_mut_slice(), b.as_mut_slice()],
            || (),
            |(), tile, planes| {
                assert!(tile.x + tile.width <= width && tile.y + tile.height <= height);
                for (offset, rows) in [1.0, 2.0].into_iter().zip(planes) {
                    assert_eq!(rows.len(), tile.height);
                    for (j, row) in rows.into_iter().enumerate() {
                        assert_eq!(row.len(), tile.width);
                        for (i, value) in row.iter_mut().enumerate() {
                            *value += offset + ((tile.y + j) * width + tile.x + i) as f32;
                        }
                    }
                }
            },
        );
        for i in 0..width * height {
            assert_eq!((a[i], b[i]), (1.0 + i as f32, 2.0 + i as f32));
        }
    }
}
