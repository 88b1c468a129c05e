//! The test of homogeneous pixels is the one that `noisefloor-stats` measures.

use noisefloor_denoiser::half_widths;
use noisefloor_frame::{Image, Samples};
use noisefloor_kernels::flash_filter::half_width;
use noisefloor_stats::random::Normals;
use noisefloor_stats::{Level, MembershipTest, SampleMean};

#[test]
fn neighbours_that_the_kernel_takes_are_those_that_the_test_does_not_tell_apart() {
    let (pixels, mut random) = (4000, Normals::new(17));
    let counts: Vec<u32> = (0..pixels).map(|pixel| [2, 4, 16, 300][pixel % 4]).collect();
    let mean: Vec<f32> = (0..pixels).map(|_| (2.0 + random.next()) as f32).collect();
    let other: Vec<f32> = mean.iter().map(|m| m + (0.3 * random.next()) as f32).collect();
    // Some without any spread.
    let variance: Vec<f32> =
        (0..pixels).map(|p| if p % 7 == 0 { 0.0 } else { (0.01 * random.uniform()) as f32 }).collect();
    for level in [Level::TWO_SIDED_99, Level::TWO_SIDED_998] {
        let image = Image::from_vec(pixels, 1, 1, variance.clone()).unwrap();
        let widths = half_widths(&image, &Samples::per_pixel(counts.clone()), level);
        let mut taken = 0;
        for p in 0..pixels {
            let difference = (other[p] - mean[p]).abs();
            let width = half_width(widths.data()[p], mean[p]);
            // The kernel's thresholds are in single precision.
            if (difference - width).abs() < 4e-6 * width {
                continue;
            }
            let centre = SampleMean { mean: mean[p].into(), variance: variance[p].into(), n: counts[p] };
            let neighbour = SampleMean { mean: other[p].into(), ..centre };
            let apart = MembershipTest::InInterval.rejects(&centre, &neighbour, level).unwrap();
            assert_eq!(difference <= width, !apart, "pixel {p} at {level:?}");
            taken += usize::from(!apart);
        }
        assert!(taken > pixels / 10 && taken < pixels * 9 / 10, "{taken}");
    }
}
