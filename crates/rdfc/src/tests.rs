//! Parts that no output shows by themselves.

use noisefloor_frame::{Far, Image};
use noisefloor_kernels::nlm::{
    Border, Center, Denominator, GuideDenominator, Pairs, Rule, Smoothing, Taps, WeightRules,
};

use crate::candidates::{plausible, steps};
use crate::features::squared_slope;
use crate::settings::Settings;
use crate::{Density, Gradient, Params, Profile, SecondPass, Ties};

#[test]
fn profiles_decide_what_is_left_open() {
    let paper = Settings::new(&Params { profile: Profile::Paper, ..Params::default() });
    assert_eq!(
        (paper.denominator, paper.center, paper.rule),
        (Denominator::Center, Center::One, Rule::Exact)
    );
    assert_eq!((paper.ties, paper.second_pass, paper.map_patch), (Ties::Earlier, SecondPass::Text, 1));
    assert_eq!((paper.gradient, paper.far, paper.density), (Gradient::Central, Far::Largest, Density::Text));
    assert_eq!(paper.second_denominator, GuideDenominator::Pair);
    let program = Settings::new(&Params { profile: Profile::Authors, ..Params::default() });
    let center = Center::LargestNeighbor { least: 1e-3 };
    assert_eq!((program.denominator, program.center, program.rule), (Denominator::Pair, center, Rule::Joint));
    assert_eq!((program.ties, program.second_pass, program.map_patch), (Ties::Program, SecondPass::Code, 3));
    assert_eq!(
        (program.gradient, program.far, program.density),
        (Gradient::MinHalf, Far::Common, Density::Code)
    );
    assert_eq!(program.second_denominator, GuideDenominator::TwiceCenter);
    let rules = WeightRules {
        smoothing: Smoothing::BelowPatch,
        pairs: Pairs::Near,
        border: Border::Mirrored,
        taps: Taps::Clipped,
    };
    assert_eq!((program.rules, paper.rules), (rules, WeightRules::default()));
    assert_eq!(program.candidate_rules(), WeightRules { smoothing: Smoothing::None, ..rules });
    let best = Settings::new(&Params::default());
    assert_eq!((best.ties, best.rules), (Ties::Later, WeightRules::default()));
    assert_eq!((best.density, best.second_pass), (Density::Effective, SecondPass::Off));
    assert_eq!(
        (best.rule, best.gradient, best.second_denominator),
        (Rule::Exact, Gradient::Central, GuideDenominator::TwiceCenter)
    );
    let told = Params { ties: Some(Ties::Later), ..Params::default() };
    assert_eq!(Settings::new(&told).ties, Ties::Later);
}

#[test]
fn steps_are_a_hundredth_or_none_for_all_channels_whatever_the_exposure() {
    // Pixels: fine; above 1, which is as fine; one zero; one negative; one next to nothing; a firefly.
    let values = [
        [0.5, 0.2, 1.0],
        [0.5, 1.5, 0.5],
        [0.0, 0.5, 0.5],
        [-0.1, 0.5, 0.5],
        [1e-8, 0.5, 0.5],
        [1e9, 1.0, 1.0],
    ];
    for exposure in [1.0, 2.0f32.powi(-40), 2.0f32.powi(20)] {
        let color = Image::from_fn(6, 1, 3, |c, x, _| values[x][c] * exposure);
        let steps = steps(&color);
        for x in [0, 1, 5] {
            assert_eq!([0, 1, 2].map(|c| steps.get(c, x, 0)), values[x].map(|v| 0.01 * (v * exposure)));
        }
        assert!((0..3).all(|c| (2..5).all(|x| steps.get(c, x, 0) == 0.0)));
    }
}

#[test]
fn derivatives_outside_their_range_give_way_to_that_for_fixed_weights() {
    let values = [[0.1, 0.5, 1.0], [0.1, -0.01, 0.2], [1.01, 0.5, 0.5], [0.2, 0.2, f32::NAN]];
    let derivative = Image::from_fn(4, 1, 3, |c, x, _| values[x][c]);
    let got = plausible(derivative, &[0.25; 4]);
    assert_eq!([0, 1, 2].map(|c| got.get(c, 0, 0)), values[0]);
    assert!((0..3).all(|c| (1..4).all(|x| got.get(c, x, 0) == 0.25)));
}

#[test]
fn slopes_follow_their_rule() {
    // Columns 0, 1, 3, 7, 7: differences 1, 2, 4, 0.
    let row = [0.0, 1.0, 3.0, 7.0, 7.0];
    let image = Image::from_fn(5, 3, 1, |_, x, _| row[x]);
    let middle = |rule| -> Vec<f32> { (0..5).map(|x| squared_slope(&image, rule).get(0, x, 1)).collect() };
    assert_eq!(middle(Gradient::MinHalf), [0.0, 0.25, 1.0, 0.0, 0.0]);
    assert_eq!(middle(Gradient::Central), [1.0, 2.25, 9.0, 4.0, 0.0]);
    assert_eq!(middle(Gradient::Off), [0.0; 5]);
    // Both axes add up.
    let both = Image::from_fn(3, 3, 1, |_, x, y| x as f32 + 2.0 * y as f32);
    assert_eq!(squared_slope(&both, Gradient::MinHalf).get(0, 1, 1), 0.25 + 1.0);
}
