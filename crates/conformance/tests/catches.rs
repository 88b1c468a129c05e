//! Each recipe catches what it is there for, and nothing that a card declares.

use std::sync::atomic::{AtomicU32, Ordering};

use noisefloor_conformance::{Outcome, assert_conforms, check, recipes};
use noisefloor_denoiser::{
    Adaptive, Caveat, Citation, Claim, DenoiseError, Denoiser, Diagnostics, Guarded, Input, Invariance,
    MethodCard, MonteCarlo, Need, Output,
};
use noisefloor_frame::{FeatureId, Image, luminance};
use noisefloor_stats::{FAMILIES, Level};

type Answer = Result<Output, DenoiseError>;

/// A method made of a closure, which gets the input itself as the output to change.
struct Fake<F> {
    card: MethodCard,
    work: F,
    density: Option<f32>,
}

impl<F: Fn(&Input<'_>, Output) -> Answer + Send + Sync> Denoiser for Fake<F> {
    fn card(&self) -> MethodCard {
        self.card.clone()
    }

    fn denoise(&self, input: &Input<'_>) -> Answer {
        (self.work)(input, Output::from_image(input.target.color.mean.clone()))
    }

    fn adaptive(&self) -> Option<&dyn Adaptive> {
        self.density.is_some().then_some(self)
    }
}

impl<F: Fn(&Input<'_>, Output) -> Answer + Send + Sync> Adaptive for Fake<F> {
    fn density(&self, input: &Input<'_>) -> Result<Image, DenoiseError> {
        Ok(Image::filled(input.target.width(), input.target.height(), 1, self.density.unwrap_or_default()))
    }
}

fn card() -> MethodCard {
    MethodCard::new("fake", "fake", Citation::new("none", "none"))
}

fn with<F: Fn(&Input<'_>, Output) -> Answer + Send + Sync>(card: MethodCard, work: F) -> Fake<F> {
    Fake { card, work, density: None }
}

/// Changes every value of the output by something of the input.
fn plus(of: impl Fn(&Input<'_>) -> f32 + Send + Sync) -> impl Denoiser {
    with(card(), move |input, mut output| {
        let more = of(input);
        output.image = output.image.map(|v| v + more);
        Ok(output)
    })
}

fn depth(input: &Input<'_>) -> f32 {
    input.target.feature(&FeatureId::Depth).map_or(0.0, |depth| depth.mean.data()[0])
}

/// The sentence about the recipe, which must be broken.
#[track_caller]
fn broken(fake: &dyn Denoiser, recipe: &str) -> String {
    match check(fake).of(recipe) {
        Some(Outcome::Broken(violation)) => violation.to_string(),
        other => panic!("{recipe}: {other:?}"),
    }
}

fn claim(factor: f64) -> Claim {
    let level = Level::TWO_SIDED_99;
    Claim { name: "interval".into(), terms: vec![(factor, level)], level, proven: true }
}

#[test]
fn plain_and_guarded_monte_carlo_conform() {
    assert_conforms(&MonteCarlo);
    let guarded = Guarded::new(Box::new(MonteCarlo), Level::TWO_SIDED_99);
    assert_conforms(&guarded);
    let report = check(&guarded);
    assert_eq!(report.outcomes.len(), recipes().len());
    // One sample, one with a variance, one pixel of one, and counts from 1 on have no interval to project into.
    assert!(matches!(report.of("counts"), Some(Outcome::Kept { refused: 4, .. })), "{report:?}");
    assert_eq!(report.of("neighbors"), Some(&Outcome::Idle("it looks at one frame")));
    assert_eq!(report.to_string(), format!("guarded(mc) keeps all {} recipes", recipes().len()));
}

#[test]
fn what_is_guarded_by_any_family_of_intervals_conforms() {
    let black = || {
        with(card(), |_, mut output| {
            output.image = output.image.map(|_| 0.0);
            Ok(output)
        })
    };
    for family in FAMILIES {
        let guarded = |inner| Guarded::new(inner, Level::TWO_SIDED_99).with_interval(*family);
        assert_conforms(&guarded(Box::new(MonteCarlo)));
        // With one end alone nothing keeps it near the input.
        if family.has_both_ends() {
            let method = guarded(Box::new(black()));
            assert_conforms(&method);
            let needs = method.card().needs.len();
            let report = check(&method);
            assert!(
                matches!(report.of("missing"), Some(Outcome::Kept { frames, .. }) if *frames == needs),
                "{report:?}"
            );
        }
    }
}

#[test]
fn images_that_cannot_be_are_told_with_their_frame() {
    let nan = plus(|_| f32::NAN);
    assert!(
        broken(&nan, "runs").contains("1173 values of the output that are not finite (a complete frame)")
    );
    let crop = with(card(), |input, _| Ok(Output::from_image(input.target.color.mean.crop(0, 0, 1, 1))));
    assert!(broken(&crop, "raw").contains("another shape: output is 1×1×3"));
    let panics = with(card(), |input: &Input<'_>, output| {
        assert!(input.target.width() > 1, "out of cheese");
        Ok(output)
    });
    let report = check(&panics);
    assert!(report.of("runs").is_some_and(|outcome| outcome.violation().is_none()));
    assert!(broken(&panics, "sizes").contains("panics: out of cheese (1×1)"));
    assert!(report.to_string().contains("fake, recipe `sizes`: panics"), "{report}");
}

#[test]
fn needs_are_asked_for_before_anything_else_and_what_is_there_is_not_refused() {
    let mut needy = card();
    needy.needs = vec![Need::Flash, Need::Samples(4)];
    let careless = with(needy.clone(), |_, output| Ok(output));
    assert!(broken(&careless, "missing").contains("runs although fake needs virtual flash image"));
    let late = with(needy.clone(), |input, output| {
        DenoiseError::refuse("fake", "a value is not finite", &input.target.color.mean, f32::is_finite)?;
        input.check(&card_that_needs(&[Need::Flash, Need::Samples(4)]))?;
        Ok(output)
    });
    assert!(broken(&late, "missing").contains("where the reason is"));
    let picky = with(card(), |input, output| {
        input.check(&card_that_needs(&[Need::ColorHalves]))?;
        Ok(output)
    });
    assert!(broken(&picky, "features").contains("refuses a frame that has all it needs"));
    let never = with(card_that_needs(&[Need::Samples(u32::MAX)]), |_, output| Ok(output));
    assert!(broken(&never, "runs").contains("needs what a complete frame lacks"));
}

fn card_that_needs(needs: &[Need]) -> MethodCard {
    MethodCard { needs: needs.to_vec(), ..card() }
}

#[test]
fn what_only_a_card_asks_for_is_added_to_the_frames() {
    let extra = FeatureId::Extra("curvature".into());
    let mut odd = card_that_needs(&[
        Need::FeatureHalves(extra.clone()),
        Need::Feature(FeatureId::Direct),
        Need::Samples(500),
    ]);
    odd.named_features = vec!["curvature".into()];
    let own = odd.clone();
    let fake = with(odd, move |input, output| {
        input.check(&own)?;
        assert!(input.target.feature(&extra).is_some());
        Ok(output)
    });
    assert_conforms(&fake);
    assert!(matches!(check(&fake).of("scales"), Some(Outcome::Kept { refused: 0, .. })));
}

#[test]
fn state_threads_diagnostics_and_neighbours_must_change_nothing() {
    let count = AtomicU32::new(0);
    let moody = plus(move |_| count.fetch_add(1, Ordering::Relaxed) as f32);
    assert!(broken(&moody, "repeats").contains("other bits when it is asked again"));
    let threaded = plus(|_| rayon::current_num_threads() as f32);
    assert!(broken(&threaded, "threads").contains("on four threads"));
    let curious = plus(|input| if input.diagnostics == Diagnostics::Off { 0.0 } else { 1.0 });
    assert!(broken(&curious, "diagnostics").contains("with diagnostics (1×1)"));
    let mut looks = card();
    looks.neighbors = 2;
    let greedy = with(looks, |input, output| {
        assert!(input.before.len() == input.after.len(), "asked for more");
        Ok(output)
    });
    assert!(broken(&greedy, "neighbors").contains("asked for more (the first frame of a sequence)"));
}

#[test]
fn claims_are_held_against_their_card() {
    let mut bold = card();
    bold.claims.enclosure.push(claim(1.0));
    let leaves = with(bold, |_, mut output| {
        output.image = output.image.map(|v| v + 1e3);
        Ok(output)
    });
    assert!(broken(&leaves, "enclosure").contains("leaves the enclosure \"interval\""));
    let mut proud = card();
    proud.claims.error_bound.push(claim(0.5));
    assert!(broken(&with(proud, |_, output| Ok(output)), "bounds").contains("\"interval\" too often"));
    let mut wary = card();
    wary.claims.error_bound.push(Claim { proven: false, ..claim(0.5) });
    assert_conforms(&with(wary, |_, output| Ok(output)));
    let steers = |density| Fake { density: Some(density), ..with(card(), |_, output| Ok(output)) };
    assert!(broken(&steers(-1.0), "density").contains("of the density that are not finite or negative"));
    assert!(matches!(check(&steers(1.0)).of("density"), Some(Outcome::Kept { frames: 7, refused: 0 })));
}

#[test]
fn a_result_depends_on_nothing_that_its_card_does_not_declare() {
    let lit = plus(|_| 0.01);
    assert!(broken(&lit, "exposure").contains("depends on the exposure"));
    let eye = plus(|input| {
        let mean = &input.target.color.mean;
        luminance([0, 1, 2].map(|c| mean.plane(c)[0]))
    });
    assert!(broken(&eye, "channels").contains("depends on the order of channels"));
    let near = plus(|input| if depth(input) > 1.0 { input.target.color.mean.data()[0] } else { 0.0 });
    assert!(broken(&near, "units").contains("depends on the units of features"));

    let mut honest = card();
    honest.varies_with.push((Invariance::Exposure, "a constant is added".into()));
    let declared = with(honest.clone(), |_, mut output| {
        output.image = output.image.map(|v| v + 0.01);
        Ok(output)
    });
    assert_conforms(&declared);
    let expected = Outcome::Declared { reason: "a constant is added".into(), seen: true };
    assert_eq!(check(&declared).of("exposure"), Some(&expected));
    // Nothing is added any more.
    let stale = with(honest, |_, output| Ok(output));
    assert!(matches!(check(&stale).of("exposure"), Some(Outcome::Declared { seen: false, .. })));
}

#[test]
fn caveats_excuse_what_they_name_and_need_a_reason() {
    let undefined = |input: &Input<'_>, output| match input.target.color.mean.data()[0] {
        v if v > 100.0 => {
            let (method, what) = ("fake".into(), "too bright".into());
            Err(DenoiseError::Undefined { method, what, pixels: 1, x: 0, y: 0 })
        }
        _ => Ok(output),
    };
    assert!(broken(&with(card(), undefined), "scales").contains("too bright"));
    let mut cautious = card();
    cautious.caveats.push((Caveat::Undefined, "no answer for bright pixels".into()));
    cautious.varies_with.push((Invariance::Exposure, "no answer for bright pixels".into()));
    assert_conforms(&with(cautious, undefined));

    let wild = |input: &Input<'_>, mut output: Output| {
        output.image = output.image.map(|v| if input.target.features.is_empty() { v } else { 2.0 * v });
        Ok(output)
    };
    assert!(broken(&with(card(), wild), "level").contains("an even image of a million"));
    let mut mute = card();
    mute.caveats.push((Caveat::Level, String::new()));
    assert!(broken(&with(mute, wild), "card").contains("without a reason"));
}
