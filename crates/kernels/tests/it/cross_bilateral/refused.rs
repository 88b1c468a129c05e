//! What is out of range.

use super::*;

/// The words of the error after a change of a good case.
fn refused(change: impl FnOnce(&mut Case)) -> String {
    let mut case = Case::random(5, 4, 2, 2);
    case.filter();
    change(&mut case);
    let words = |e: noisefloor_kernels::KernelError| e.to_string();
    let told = filter(&case.params, &case.guides(), &case.planes(), &case.bank).map(|_| ()).map_err(words);
    let by_twin = naive::filter_f64(&case.params, &case.guides(), &case.planes(), &case.bank)
        .map(|_| ())
        .map_err(words);
    assert_eq!(told, by_twin);
    told.unwrap_err()
}

#[test]
fn what_is_out_of_range_is_refused() {
    assert!(refused(|c| c.params.width = 0).starts_with("image of 0x4 pixels"));
    assert!(refused(|c| c.params.height = usize::MAX).starts_with("image of 5x"));
    assert_eq!(refused(|c| c.params.floor = 0.0), "variance floor = 0: allowed 0.000000000001 to 1000000");
    assert!(refused(|c| c.params.floor = f32::NAN).starts_with("variance floor = NaN"));
    assert_eq!(refused(|c| c.bank.clear()), "filters = 0: allowed 1 to 32");
    assert_eq!(refused(|c| c.planes.clear()), "averaged planes = 0: allowed 1 to 1024");
    assert_eq!(refused(|c| c.guides = vec![c.guides[0].clone(); 17]), "guide channels = 17: allowed 0 to 16");
    assert_eq!(refused(|c| c.bank[3].radius = 65), "window radius = 65: allowed 0 to 64");
    for sigma in [-1.0, f32::NAN, f32::INFINITY] {
        let told = refused(|c| c.bank[2] = Spatial::new(sigma));
        assert!(told.starts_with(&format!("spatial sigma = {sigma}: allowed 0 to")), "{told}");
    }
    assert_eq!(refused(|c| c.bank[0] = Spatial::new(32.5)), "window radius = 65: allowed 0 to 64");
    for sigma in [0.0, -0.5, f32::NAN, f32::INFINITY] {
        let told = refused(|c| c.guides[1].2 = sigma);
        assert!(told.starts_with(&format!("sigma of a guide = {sigma}: allowed 0.001 to 100")), "{told}");
    }
}

#[test]
fn values_that_are_refused_are_named_with_their_pixel() {
    for (bad, words) in [(f32::NAN, "NaN"), (f32::INFINITY, "inf"), (-2e7, "-20000000")] {
        let told = refused(|c| c.guides[1].0[7] = bad);
        assert!(told.starts_with(&format!("plane `guide 1` holds {words} at pixel (2, 1)")), "{told}");
    }
    for (bad, words) in [(-1e-9, "-0.000000001"), (f32::NAN, "NaN"), (2e14, "200000000000000")] {
        let told = refused(|c| c.guides[0].1[19] = bad);
        assert!(
            told.starts_with(&format!("plane `variance of guide 0` holds {words} at pixel (4, 3)")),
            "{told}"
        );
    }
    for (bad, words) in [(f32::NAN, "NaN"), (f32::NEG_INFINITY, "-inf"), (2e30, "2")] {
        let told = refused(|c| c.planes[1][0] = bad);
        assert!(told.starts_with(&format!("plane `averaged plane 1` holds {words}")), "{told}");
    }
    for told in [refused(|c| c.planes[1].truncate(3)), refused(|c| c.guides[0].1.truncate(3))] {
        assert!(told.ends_with("holds 3 values, the image has 20 pixels"), "{told}");
    }
}
