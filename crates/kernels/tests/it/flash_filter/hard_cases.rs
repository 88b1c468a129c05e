//! Input at the edge of what is allowed, and beyond.

use super::{Case, RULES, Rule};
use crate::same_bits::levels;
use noisefloor_kernels::InstructionSet;
use noisefloor_kernels::flash_filter::{
    FlashFilterError, FlashParams, Membership, PatchWeights, filter, filter_into, naive,
};

#[test]
fn values_up_to_1e30_give_finite_results() {
    for rule in RULES {
        for guided in [true, false] {
            let mut case = Case::random(70, 20, 5, 2, rule);
            for plane in &mut case.source {
                for (i, v) in plane.iter_mut().enumerate() {
                    *v = [1e30, -1e30, 0.0, 1.0][i % 4];
                }
            }
            case.half_width[0].fill(f32::INFINITY);
            if guided {
                let (planes, sigma_r2) = case.guide.as_mut().unwrap();
                for plane in planes {
                    for (i, v) in plane.iter_mut().enumerate() {
                        *v = [1e30, -f32::MAX, 0.0, f32::MAX][i % 4];
                    }
                }
                for (i, v) in sigma_r2.iter_mut().enumerate() {
                    *v = [f32::INFINITY, 1.0, f32::from_bits(1), f32::MAX][i % 4];
                }
            } else {
                case.guide = None;
            }
            for level in levels() {
                let result = case.filter_at(level);
                assert!(result.iter().flatten().all(|v| v.is_finite()), "{level} {rule:?} guided {guided}");
            }
        }
    }
}

#[test]
fn an_overflowed_distance_has_weight_0() {
    // Two halves whose squared difference overflows: each keeps its own value, whatever the width.
    let (w, h) = (64, 10);
    for sigma_r2 in [f32::from_bits(1), 1e38, f32::INFINITY] {
        let mut case = Case::random(w, h, 3, 0, Rule::Off);
        let half = |low: f32, high: f32| -> Vec<f32> {
            (0..w * h).map(|i| if i % w < 32 { low } else { high }).collect()
        };
        case.source = [half(1.0, 2.0), half(3.0, 4.0), half(5.0, 6.0)];
        case.guide = Some(([half(0.0, 1e25), half(0.0, 1e25), half(0.0, 0.0)], vec![sigma_r2; w * h]));
        for level in levels() {
            assert_eq!(case.filter_at(level), case.source, "{level}, width {sigma_r2}");
        }
        assert_eq!(naive::filter_f32(&case.params, &case.inputs()).unwrap(), case.source);
    }
}

#[test]
fn a_vanishing_spatial_sigma_is_the_identity_and_an_infinite_one_a_box() {
    let mut case = Case::random(20, 20, 2, 1, Rule::Off);
    case.guide = None;
    for sigma in [f32::MIN_POSITIVE, f32::from_bits(1)] {
        case.params.spatial_sigma = sigma;
        assert_eq!(case.filter(), case.source);
    }
    case.params.spatial_sigma = f32::INFINITY;
    let window = (8..=12).flat_map(|y| (8..=12).map(move |x| y * 20 + x));
    let mean = window.map(|i| f64::from(case.source[0][i])).sum::<f64>() / 25.0;
    assert!((f64::from(case.filter()[0][10 * 20 + 10]) - mean).abs() < 1e-6);
}

#[track_caller]
fn refused(case: &Case, wanted: &str) {
    assert_eq!(filter(&case.params, &case.inputs()).unwrap_err().to_string(), wanted);
    // As text: errors about NaN are not equal to themselves.
    assert_eq!(naive::filter_f64(&case.params, &case.inputs()).unwrap_err().to_string(), wanted);
}

#[test]
fn parameters_out_of_range_are_refused_by_name() {
    let good = Case::random(8, 8, 2, 1, Rule::Joint);
    let with = |change: &dyn Fn(&mut FlashParams)| {
        let mut case = good.clone();
        change(&mut case.params);
        case
    };
    refused(&with(&|p| p.window_radius = 33), "window radius 33: allowed 0 to 32 pixels");
    refused(
        &with(&|p| p.spatial_sigma = 0.0),
        "spatial sigma = 0: must be greater than 0 (infinity is allowed)",
    );
    refused(
        &with(&|p| p.spatial_sigma = f32::NAN),
        "spatial sigma = NaN: must be greater than 0 (infinity is allowed)",
    );
    refused(&with(&|p| p.width = 9), "plane `source 0` holds 64 values, the image has 72 pixels");
    let max = 1u32 << 31;
    refused(
        &with(&|p| p.height = 0),
        &format!("image of 8x0 pixels: both sides must be at least 1 and the area at most {max}"),
    );
    refused(
        &with(&|p| (p.width, p.height) = (usize::MAX, 2)),
        &format!(
            "image of {}x2 pixels: both sides must be at least 1 and the area at most {max}",
            usize::MAX
        ),
    );
    assert_eq!(PatchWeights::uniform(4), Err(FlashFilterError::PatchRadius { value: 4, max: 3 }));
    assert!(matches!(PatchWeights::gaussian(1, -1.0), Err(FlashFilterError::Sigma { .. })));
}

#[test]
fn values_out_of_range_are_refused_with_their_place() {
    let good = Case::random(8, 8, 2, 1, Rule::Joint);
    for bad in [f32::NAN, f32::INFINITY, -2e30] {
        let mut case = good.clone();
        case.source[1][19] = bad;
        refused(
            &case,
            &format!("plane `source 1` holds {bad} at pixel (3, 2): allowed is a magnitude of at most 1e30"),
        );
    }
    for bad in [f32::NAN, -1e-30] {
        let mut case = good.clone();
        case.half_width[2][8] = bad;
        refused(
            &case,
            &format!("plane `half-width 2` holds {bad} at pixel (0, 1): allowed is 0 to infinity"),
        );
    }
    let mut case = good.clone();
    case.guide.as_mut().unwrap().0[0][63] = f32::NEG_INFINITY;
    refused(&case, "plane `guide 0` holds -inf at pixel (7, 7): allowed is any finite value");
    for bad in [f32::NAN, 0.0, -1.0] {
        let mut case = good.clone();
        case.guide.as_mut().unwrap().1[0] = bad;
        refused(&case, &format!("plane `sigma_r2` holds {bad} at pixel (0, 0): allowed is greater than 0"));
    }
}

#[test]
fn planes_of_the_wrong_length_are_refused() {
    let case = Case::random(8, 8, 2, 1, Rule::Luminance);
    let short = vec![1.0; 63];
    let inputs = noisefloor_kernels::flash_filter::FlashInputs {
        membership: Membership::Luminance(&short),
        ..case.inputs()
    };
    let plane = "half-width of luminance";
    let expected = FlashFilterError::PlaneLength { plane, expected: 64, actual: 63 };
    assert_eq!(filter(&case.params, &inputs), Err(expected));

    let (mut a, mut b, mut c) = (vec![0.0; 64], vec![0.0; 65], vec![0.0; 64]);
    let result = filter_into(&case.params, &case.inputs(), InstructionSet::best(), [&mut a, &mut b, &mut c]);
    let expected = FlashFilterError::PlaneLength { plane: "output 1", expected: 64, actual: 65 };
    assert_eq!(result, Err(expected));
}

#[test]
fn an_instruction_set_that_is_missing_is_refused() {
    let case = Case::random(8, 8, 2, 1, Rule::Joint);
    for level in InstructionSet::ALL {
        let mut out = [(); 3].map(|()| vec![0.0; 64]);
        let [r, g, b] = &mut out;
        let result = filter_into(&case.params, &case.inputs(), level, [r, g, b]);
        let missing = Err(FlashFilterError::LevelUnavailable { level });
        assert_eq!(result, if level.is_available() { Ok(()) } else { missing });
    }
}
