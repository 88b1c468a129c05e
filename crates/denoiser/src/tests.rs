use noisefloor_frame::{Estimate, FeatureId, Flash, Frame, FrameError, Image, Samples, Sampling, Variance};
use noisefloor_stats::{Level, t_quantile};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use crate::*;

const NONE: Citation = Citation { key: "none", text: "no source" };

/// Returns a given image and claims things that a guard must take back.
struct Fixed(Image);

impl Denoiser for Fixed {
    fn card(&self) -> MethodCard {
        let mut card = MethodCard::new("fixed", "Fixed", NONE);
        card.claims.estimates_error = true;
        card.claims.error_bound =
            vec![Claim { name: "own", terms: vec![], level: Level::TWO_SIDED_95, proven: false }];
        card
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        input.check(&self.card())?;
        let mut output = Output::from_image(self.0.clone());
        output.error_estimate = Some(self.0.clone());
        output.bounds = vec![Bound { claim: "own".into(), half_width: self.0.clone() }];
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
    assert!(output.figures.contains(&("projected values".into(), 6.0)), "two of four pixels, three channels");
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
    ];
    for need in &needs {
        assert!(need.is_met(&full) && !need.is_met(&bare), "{need}");
    }
    full.flash = Some(Flash::Ready(estimate(false)));
    full.features.insert(FeatureId::Albedo, estimate(false));
    assert!(Need::Flash.is_met(&full) && !Need::FlashVariance.is_met(&full));
    assert!(!Need::FeatureVariance(FeatureId::Albedo).is_met(&full));
    full.samples = Samples::per_pixel(vec![9, 9, 1, 9]);
    assert!(!Need::Samples(2).is_met(&full), "every pixel counts");
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Knobs {
    radius: usize,
    strength: f64,
}

impl Default for Knobs {
    fn default() -> Self {
        Self { radius: 3, strength: 0.5 }
    }
}

const DOCS: &[ParamDoc] = &[
    ParamDoc { name: "radius", range: "0 to 9 px", about: "r" },
    ParamDoc { name: "strength", range: "0 to 1", about: "h" },
];

fn knobs(knobs: Knobs) -> Result<MonteCarlo, &'static str> {
    match knobs {
        Knobs { radius, .. } if radius > 9 => Err("radius"),
        Knobs { strength, .. } if !(0.0..=1.0).contains(&strength) => Err("strength"),
        _ => Ok(MonteCarlo),
    }
}

const KNOBS_ENTRY: Entry = Entry {
    id: "knobs",
    summary: "for tests",
    params: DOCS,
    defaults: || json!({ "radius": 3, "strength": 0.5 }),
    build: |overrides| build_with("knobs", DOCS, overrides, knobs),
};

#[test]
fn parameters_come_from_defaults_and_overrides() {
    let params: Knobs = params_from("knobs", DOCS, &overrides(json!({ "radius": 5 }))).unwrap();
    assert_eq!(params, Knobs { radius: 5, strength: 0.5 });
    assert!((KNOBS_ENTRY.build)(&Map::new()).is_ok());
}

#[test]
fn build_errors_blame_the_parameter_and_give_its_range() {
    for (given, parameter, value, range) in [
        (json!({ "radius": "wide" }), "radius", "\"wide\"", "0 to 9 px"),
        (json!({ "strength": 0.7, "radius": -1 }), "radius", "-1", "0 to 9 px"),
        (json!({ "radius": 10 }), "radius", "10", "0 to 9 px"),
        (json!({ "radius": 9, "strength": 1.5 }), "strength", "1.5", "0 to 1"),
    ] {
        let Err(error) = (KNOBS_ENTRY.build)(&overrides(given.clone())) else {
            panic!("{given} was accepted")
        };
        let expected = BuildError::OutOfRange {
            method: "knobs".into(),
            parameter: parameter.into(),
            value: value.into(),
            range: range.into(),
        };
        assert_eq!(error, expected, "{given}");
    }
    let Err(error) = (KNOBS_ENTRY.build)(&overrides(json!({ "radus": 1 }))) else { panic!("accepted") };
    assert!(error.to_string().contains("nearest: radius (0 to 9 px); strength (0 to 1)"), "{error}");
    let Err(error) = (MC_ENTRY.build)(&overrides(json!({ "radius": 1 }))) else { panic!("accepted") };
    assert!(error.to_string().contains("it takes none"), "{error}");
}

#[test]
fn a_later_entry_replaces_an_earlier_one_in_its_place() {
    let mine = Entry { summary: "mine", ..KNOBS_ENTRY };
    let registry = Registry::new(&[KNOBS_ENTRY, MC_ENTRY], &[mine]);
    let listed: Vec<_> = registry.entries().iter().map(|e| (e.id, e.summary)).collect();
    assert_eq!(listed, [("knobs", "mine"), ("mc", MC_ENTRY.summary)]);
}

#[test]
fn registry_records_all_parameters_and_passes_the_guards_own_past_the_inner_method() {
    let registry = Registry::new(&[MC_ENTRY], &[KNOBS_ENTRY]);
    let method =
        registry.build("guarded(knobs)", &overrides(json!({ "radius": 7, "guard_level": 0.998 }))).unwrap();
    assert_eq!(method.params, json!({ "radius": 7, "strength": 0.5, "guard_level": 0.998 }));
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
    let registry = Registry::new(&[MC_ENTRY], &[]);
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
    let registry = Registry::new(&[MC_ENTRY], &[KNOBS_ENTRY]);
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
