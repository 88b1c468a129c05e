use super::*;
#[test]
fn quick() {
    let (width, height) = (67, 35);
    let mut s = 1u32;
    let mut rnd = || {
        s = s.wrapping_mul(1664525).wrapping_add(1013904223);
        (s >> 8) as f32 / 16777216.0
    };
    let n = width * height;
    let mut pl = || -> Vec<f32> { (0..n).map(|_| rnd()).collect() };
    let src = [pl(), pl(), pl()];
    let tol = [pl(), pl(), pl()];
    let g = [pl(), pl(), pl()];
    let k: Vec<f32> = pl().iter().map(|v| v * 20.0).collect();
    let params = FlashParams {
        width,
        height,
        window_radius: 5,
        spatial_sigma: 3.0,
        patch: PatchWeights::gaussian(2, 1.25).unwrap(),
    };
    for membership in [
        Membership::Joint([&tol[0], &tol[1], &tol[2]]),
        Membership::PerChannel([&tol[0], &tol[1], &tol[2]]),
        Membership::Luminance(&tol[0]),
        Membership::Off,
    ] {
        let inputs = FlashInputs {
            source: [&src[0], &src[1], &src[2]],
            membership,
            guide: Some(Guide { planes: [&g[0], &g[1], &g[2]], inv_two_sigma_r2: &k }),
        };
        let oracle = naive::filter_f64(&params, &inputs).unwrap();
        for level in Level::ALL {
            let mut out = [vec![0.0f32; n], vec![0.0; n], vec![0.0; n]];
            let [a, b, c] = &mut out;
            filter_into(&params, &inputs, level, [a, b, c]).unwrap();
            let mut worst = 0f64;
            for c in 0..3 {
                for i in 0..n {
                    worst = worst.max((oracle[c][i] - out[c][i] as f64).abs());
                }
            }
            println!("{level} {worst:e}");
            assert!(worst < 1e-5);
        }
    }
}
