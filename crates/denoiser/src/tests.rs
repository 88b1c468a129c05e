mod guarded;

use std::sync::Arc;

use noisefloor_frame::{
    Estimate, FeatureId, Flash, Frame, FrameError, Image, Optional, Samples, Sampling, Statistic, Variance,
};
use noisefloor_stats::{Level, t_quantile};
use serde_json::{Map, Value, json};

use crate::*;

const NONE: Citation = Citation::new("none", "no source");

/// Returns a given image and claims things that a guard must take back.
struct Fixed(Image);

impl Denoiser for Fixed {
    fn card(&self) -> MethodCard {
        let mut card = MethodCard::new("fixed", "Fixed", NONE);
        card.claims.estimates_error = true;
        card.claims.error_bound =
            vec![Claim { name: "own".into(), terms: vec![], level: Level::TWO_SIDED_95, proven: false }];
        card
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        input.check(&self.card())?;
        let mut output = Output::from_image(self.0.clone());
        output.error_estimate = Some(self.0.clone());
        output.bounds =
            vec![Bound { name: "own".into(), level: Level::TWO_SIDED_95, half_width: self.0.clone() }];
        Ok(output)
    }
}

fn frame(mean: Image, variance: f32, n: u32) -> Frame {
    let variance = Some(Variance::of_mean(mean.map(|_| variance)));
    Frame::from_color(Estimate { mean, variance, halves: None }, Samples::uniform(n), Sampling::Independent)
}

fn row(values: [f32; 4]) -> Image {
    Image::from_fn(4, 1, 3, |_, x, _| values[x])
}

/// Of a frame of one row: 0.4 everywhere.
fn statistics<const N: usize>(of: [Statistic; N]) -> Optional {
    let recorded = of.map(|statistic| (statistic, vec![row([0.4; 4])]));
    Optional::new(recorded.to_vec(), None, vec![]).unwrap()
}

fn overrides(value: Value) -> Map<String, Value> {
    value.as_object().cloned().unwrap_or_default()
}

#[test]
fn guard_projects_onto_the_interval_and_keeps_what_lies_inside() {
    let f = frame(row([1.0; 4]), 0.01, 16);
    let width = (t_quantile(Level::TWO_SIDED_99, 15) * 0.1) as f32;
    let guarded = Guarded::new(Box::new(Fixed(row([5.0, -5.0, 1.1, 1.0]))), Level::TWO_SIDED_99);
    let output = guarded.denoise(&Input::new(&f)).unwrap();
    for (got, expected) in output.image.plane(1).iter().zip([1.0 + width, 1.0 - width, 1.1, 1.0]) {
        assert!((got - expected).abs() < 1e-6, "{got} instead of {expected}");
    }
    let Figure { name, value, .. } = &output.figures[0];
    assert_eq!((name.as_str(), *value), ("projected values", 6.0), "two of four pixels, three channels");
}

#[test]
fn guard_turns_what_is_no_number_into_the_mean_and_infinities_into_the_ends() {
    let f = frame(row([2.0; 4]), 0.0, 4);
    let wild = row([f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30]);
    let output = Guarded::new(Box::new(Fixed(wild)), Level::TWO_SIDED_99).denoise(&Input::new(&f)).unwrap();
    assert_eq!(output.image, row([2.0; 4]), "zero variance leaves a single point");
}

#[test]
fn guard_replaces_claims_and_drops_what_described_the_unprojected_image() {
    let level = Level::two_sided(0.95).unwrap();
    let guarded = Guarded::new(Box::new(Fixed(row([1.0; 4]))), level);
    let card = guarded.card();
    assert_eq!(card.id, "guarded(fixed)");
    assert_eq!(card.needs, [Need::ColorVariance, Need::Samples(2)]);
    assert_eq!(card.claims.enclosure[0].terms, [(1.0, level)]);
    assert_eq!(card.claims.error_bound.len(), 1);
    assert_eq!(card.claims.error_bound[0].terms, [(2.0, level)]);
    assert!(card.claims.error_bound[0].proven && card.claims.consistent && !card.claims.estimates_error);
    let output = guarded.denoise(&Input::new(&frame(row([1.0; 4]), 0.1, 4))).unwrap();
    assert!(output.bounds.is_empty() && output.error_estimate.is_none());
    assert!(format!("{guarded:?}").contains("guarded(fixed)"));
}

#[test]
fn guard_refuses_an_image_of_another_shape() {
    let guarded = Guarded::new(Box::new(Fixed(Image::new(3, 1, 3))), Level::TWO_SIDED_99);
    let error = guarded.denoise(&Input::new(&frame(row([1.0; 4]), 0.1, 4))).unwrap_err();
    assert!(matches!(error, DenoiseError::Frame(FrameError::Mismatch { got_width: 3, .. })), "{error}");
}

#[test]
fn missing_inputs_are_refused_by_name_before_any_work() {
    /// Fails the test if it is ever run.
    struct Untouchable;
    impl Denoiser for Untouchable {
        fn card(&self) -> MethodCard {
            let mut card = MethodCard::new("untouchable", "Untouchable", NONE);
            card.needs = vec![Need::FeatureVariance(FeatureId::Albedo), Need::Flash, Need::FlashVariance];
            card
        }
        fn denoise(&self, _: &Input<'_>) -> Result<Output, DenoiseError> {
            panic!("work began without the inputs");
        }
    }
    let bare =
        Frame::from_color(Estimate::from_mean(row([1.0; 4])), Samples::uniform(1), Sampling::LowDiscrepancy);
    let guarded = Guarded::new(Box::new(Untouchable), Level::TWO_SIDED_99);
    let error = guarded.denoise(&Input::new(&bare)).unwrap_err();
    let text = error.to_string();
    for part in [
        "guarded(untouchable)",
        "feature `albedo` with its variance",
        "virtual flash image",
        "variance of the virtual flash image",
        "variance of the colour mean",
        "at least 2 samples",
    ] {
        assert!(text.contains(part), "`{part}` not in: {text}");
    }
}

#[test]
fn buffers_of_another_shape_are_refused() {
    let mut f = frame(row([1.0; 4]), 0.1, 4);
    f.features.insert(FeatureId::Depth, Estimate::from_mean(Image::new(4, 2, 1)));
    let error = MonteCarlo.denoise(&Input::new(&f)).unwrap_err();
    assert!(matches!(error, DenoiseError::Frame(FrameError::Mismatch { ref what, .. }) if what == "depth"));
}

#[test]
fn each_need_is_met_by_what_it_names_and_by_nothing_less() {
    let bare =
        Frame::from_color(Estimate::from_mean(row([1.0; 4])), Samples::uniform(1), Sampling::LowDiscrepancy);
    let estimate = |full: bool| Estimate {
        mean: row([1.0; 4]),
        variance: full.then(|| Variance::of_mean(row([1.0; 4]))),
        halves: full.then(|| [row([1.0; 4]), row([1.0; 4])]),
    };
    let mut full = Frame::from_color(estimate(true), Samples::uniform(2), Sampling::Independent);
    full.features.insert(FeatureId::Albedo, estimate(true));
    full.flash = Some(Flash::Parts { base: estimate(true), light: estimate(true), covariance: None });
    let needs = [
        Need::ColorVariance,
        Need::ColorHalves,
        Need::Samples(2),
        Need::IndependentSamples,
        Need::Feature(FeatureId::Albedo),
        Need::FeatureVariance(FeatureId::Albedo),
        Need::Flash,
        Need::FlashVariance,
        Need::ThirdMoment,
        Need::Extremes,
    ];
    full.optional = statistics([Statistic::ThirdMoment, Statistic::Least, Statistic::Greatest]);
    for need in &needs {
        assert!(need.is_met(&full) && !need.is_met(&bare), "{need}");
    }
    full.flash = Some(Flash::Ready(estimate(false)));
    full.features.insert(FeatureId::Albedo, estimate(false));
    assert!(Need::Flash.is_met(&full) && !Need::FlashVariance.is_met(&full));
    assert!(!Need::FeatureVariance(FeatureId::Albedo).is_met(&full));
    full.samples = Samples::per_pixel(vec![9, 9, 1, 9]);
    assert!(!Need::Samples(2).is_met(&full), "every pixel counts");
    full.optional = statistics([Statistic::Least]);
    assert!(!Need::ThirdMoment.is_met(&full) && !Need::Extremes.is_met(&full));
}

choices! {
    /// Words.
    enum Mode {
        /// The one.
        Fast = "fast",
        /// The other.
        VerySlow = "very-slow",
    }
}

parameters! {
    /// For tests.
    struct Knobs {
        /// How far
        /// it looks.
        radius: usize = 3, integer(0..=9).unit("px").symbol("r").section("Sec. 4");
        /// How much it does.
        strength: f64 = 0.5, number(0.0..=1.0);
        /// How it does it, where said.
        mode: Option<Mode> = None, choice::<Mode>().or_null();
        /// What it does it with.
        with: Vec<String> = vec!["a".into()], names(2);
        /// Whether it does it.
        on: bool = true, flag();
    }
}

fn knobs() -> Arc<dyn Factory> {
    method("knobs", "for tests", Some("page"), |knobs: Knobs| knobs.check().map(|()| MonteCarlo))
}

#[test]
fn one_table_says_everything_about_parameters() {
    let knobs = knobs();
    let [radius, strength, mode, with, on] = knobs.params() else { panic!("five") };
    assert_eq!(radius.described(), "r: How far it looks (Sec. 4)");
    let ranges = [radius, strength, mode, with, on].map(Param::range);
    assert_eq!(ranges, ["0 to 9 px", "0 to 1", "null | fast | very-slow", "up to 2 names", "true | false"]);
    let defaults = json!({ "radius": 3, "strength": 0.5, "mode": null, "with": ["a"], "on": true });
    assert_eq!(Value::Object(knobs.defaults()), defaults);
    assert_eq!((knobs.readme(), knobs.version(&Map::new())), (Some("page"), None));
    assert!(knobs.build(&Map::new()).is_ok());
    // All that the table allows, the struct takes.
    for given in [json!({ "mode": "very-slow" }), json!({ "with": [] }), json!({ "strength": 1 })] {
        assert!(knobs.build(&overrides(given)).is_ok());
    }
}

#[test]
fn ranges_read_as_people_say_them() {
    use std::ops::Bound::{Excluded, Included};

    use crate::param::kinds::{above, between, integer, number};
    for (param, range) in [
        (number(-1.0..=1.0), "-1 to 1"),
        (number(0.0..), "0 or more"),
        (number(..), "any number"),
        (above(0.0), "above 0"),
        (between(0.0, 1.0).unit("two-sided"), "above 0 and below 1, two-sided"),
        (number((Excluded(0.0), Included(100.0))).unit("%"), "above 0, at most 100 %"),
        (integer(1..=2), "1 | 2"),
        (integer(0..=usize::MAX), "0 or more"),
    ] {
        assert_eq!(param.range(), range);
    }
    assert!(!above(0.0).allows(&json!(0.0)) && above(0.0).allows(&json!(1e-300)));
    assert!(!number(..).allows(&json!(null)), "what JSON makes of a NaN");
}

#[test]
fn build_errors_blame_the_parameter_and_give_its_range() {
    for (given, parameter, value, range) in [
        (json!({ "radius": "wide" }), "radius", "\"wide\"", "0 to 9 px"),
        (json!({ "strength": 0.7, "radius": -1 }), "radius", "-1", "0 to 9 px"),
        (json!({ "radius": 10 }), "radius", "10", "0 to 9 px"),
        (json!({ "radius": 2.5 }), "radius", "2.5", "0 to 9 px"),
        (json!({ "radius": 9, "strength": 1.5 }), "strength", "1.5", "0 to 1"),
        (json!({ "mode": "slow" }), "mode", "\"slow\"", "null | fast | very-slow"),
        (json!({ "with": ["a", "b", "c"] }), "with", "[\"a\",\"b\",\"c\"]", "up to 2 names"),
    ] {
        let Err(error) = knobs().build(&overrides(given.clone())) else { panic!("{given} was accepted") };
        let expected = BuildError::OutOfRange {
            method: "knobs".into(),
            parameter: parameter.into(),
            value: value.into(),
            range: range.into(),
        };
        assert_eq!(error, expected, "{given}");
    }
    let Err(error) = knobs().build(&overrides(json!({ "radus": 1 }))) else { panic!("accepted") };
    assert!(error.to_string().contains("nearest: radius (0 to 9 px)"), "{error}");
    let Err(error) = mc().build(&overrides(json!({ "radius": 1 }))) else { panic!("accepted") };
    assert!(error.to_string().contains("it takes none"), "{error}");
    let wild = Knobs { strength: f64::NAN, ..Knobs::default() };
    assert_eq!(wild.check().unwrap_err().to_string(), "parameter `strength` is null; allowed: 0 to 1");
}

#[test]
fn a_later_method_replaces_an_earlier_one_in_its_place() {
    let mine = method("knobs", "mine", None, |_: NoParams| Ok(MonteCarlo));
    let registry = Registry::new([knobs(), mc(), mine]);
    let listed: Vec<_> = registry.factories().iter().map(|f| (f.id(), f.summary())).collect();
    assert_eq!(listed, [("knobs", "mine"), ("mc", mc().summary())]);
}

/// A method that the program learns of while it runs.
struct Learned {
    id: String,
    params: Vec<Param>,
}

impl Factory for Learned {
    fn id(&self) -> &str {
        &self.id
    }

    fn summary(&self) -> &str {
        "learned"
    }

    fn params(&self) -> &[Param] {
        &self.params
    }

    fn build(&self, overrides: &Map<String, Value>) -> Result<Box<dyn Denoiser>, BuildError> {
        check_overrides(&self.id, &self.params, overrides)?;
        Ok(Box::new(MonteCarlo))
    }

    fn version(&self, _: &Map<String, Value>) -> Option<String> {
        Some("7".into())
    }
}

#[test]
fn a_method_known_only_at_run_time_joins() {
    let id = format!("learned-{}", 7);
    let params = vec![param::kinds::number(0.0..=2.0).named("gain", "a gain", json!(1.0))];
    let registry = Registry::new([mc(), Arc::new(Learned { id: id.clone(), params })]);
    let built = registry.build(&format!("guarded({id})"), &overrides(json!({ "gain": 2.0 }))).unwrap();
    assert_eq!(built.params, json!({ "gain": 2.0, "guard_level": 0.99 }));
    assert_eq!(built.version.as_deref(), Some("7"));
    let error = registry.build(&id, &overrides(json!({ "gain": 3 }))).unwrap_err().to_string();
    assert_eq!(error, "method `learned-7`: parameter `gain` is 3; allowed: 0 to 2");
}

#[test]
fn registry_records_all_parameters_and_passes_the_guards_own_past_the_inner_method() {
    let registry = Registry::new([mc(), knobs()]);
    let method =
        registry.build("guarded(knobs)", &overrides(json!({ "radius": 7, "guard_level": 0.998 }))).unwrap();
    assert_eq!((&method.params["radius"], &method.params["guard_level"]), (&json!(7), &json!(0.998)));
    assert_eq!(method.params["strength"], 0.5);
    assert_eq!(method.id, "guarded(knobs)");
    let default = registry.build("guarded(mc)", &Map::new()).unwrap();
    assert_eq!(default.params, json!({ "guard_level": 0.99 }));
    for bad in [json!(1.0), json!(0), json!("high"), json!(null)] {
        let error = registry.build("guarded(mc)", &overrides(json!({ "guard_level": bad }))).unwrap_err();
        assert!(
            matches!(error, BuildError::OutOfRange { ref parameter, .. } if parameter == "guard_level"),
            "{error}"
        );
    }
    let error = registry.build("guarded(mc)", &overrides(json!({ "gard_level": 0.9 }))).unwrap_err();
    assert!(error.to_string().contains("guard_level"), "{error}");
    assert!(matches!(registry.build("guarded(mc", &Map::new()), Err(BuildError::UnknownMethod { .. })));
}

#[test]
fn monte_carlo_returns_its_input() {
    let f = frame(row([0.0, 1.0, -2.0, 1e8]), 0.1, 1);
    assert_eq!(MonteCarlo.denoise(&Input::new(&f)).unwrap().image, f.color.mean);
}

#[test]
fn stages_are_kept_in_order() {
    let mut timer = StageTimer::start();
    timer.finish("first");
    timer.finish("second");
    let stages = timer.into_stages();
    assert_eq!(stages.iter().map(|s| s.name.as_str()).collect::<Vec<_>>(), ["first", "second"]);
    assert!(stages.iter().all(|s| s.seconds >= 0.0));
}

#[test]
fn nesting_beyond_the_limit_is_an_error_at_once() {
    let registry = Registry::new([mc()]);
    let nested = |levels: usize| format!("{}mc{}", "guarded(".repeat(levels), ")".repeat(levels));
    assert!(registry.build(&nested(Guarded::MOST_LEVELS), &Map::new()).is_ok());
    for levels in [Guarded::MOST_LEVELS + 1, 2000, 100_000] {
        for id in [nested(levels), "guarded(".repeat(levels)] {
            let error = registry.build(&id, &Map::new()).unwrap_err();
            let BuildError::Nesting { levels: told, most: Guarded::MOST_LEVELS, .. } = error else {
                panic!("{error}");
            };
            assert_eq!(told, levels);
            assert!(error.to_string().len() < 300, "{error}");
        }
    }
}

#[test]
fn names_of_any_length_are_answered_shortly() {
    let registry = Registry::new([mc(), knobs()]);
    let long = "x".repeat(1 << 20);
    let error = registry.build(&long, &Map::new()).unwrap_err().to_string();
    assert!(error.len() < 400, "{} characters", error.len());
    let error = registry.build("knobs", &overrides(json!({ long: 1 }))).unwrap_err().to_string();
    assert!(error.len() < 800, "{} characters", error.len());
    for (method, name) in [("knobs", "radius"), ("guarded(mc)", "guard_level")] {
        let error = registry.build(method, &overrides(json!({ name: "y".repeat(1 << 20) }))).unwrap_err();
        assert!(matches!(error, BuildError::OutOfRange { .. }) && error.to_string().len() < 400, "{method}");
    }
}
