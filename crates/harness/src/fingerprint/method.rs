//! What a method gives on a few small frames: a method whose fingerprint is the same gives the same numbers.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::OnceLock;

use noisefloor_denoiser::{DenoiseError, Figure, Input, Method, MethodCard, Output};
use noisefloor_frame::{Frame, Statistic};
use noisefloor_synthetic::{ImageKind, MeanImage, SampleLaw, SyntheticScene, hard_case};

use noisefloor_study::Bits;
use noisefloor_study::Key;

/// Hard cases that between them meet the branches of methods: with and without features, flash, variance and halves, few
/// samples, fireflies, no variance, values that had to be mended, counts that differ, images smaller than any window.
const CASES: [&str; 18] = [
    "three samples",
    "one sample",
    "NaN in colour, variance, features and flash",
    "zero variance everywhere",
    "zero variance in one channel",
    "fireflies a million times brighter",
    "rare bright samples",
    "scale 1e-8",
    "scale 1e8",
    "collinear features",
    "background at infinite depth",
    "ready-made flash",
    "no flash",
    "colour only",
    "colour without variance and halves",
    "sample counts from 2 on",
    "1×1",
    "smaller than any window",
];

/// Optional statistics that methods can need.
const STATISTICS: [Statistic; 3] = [Statistic::ThirdMoment, Statistic::Least, Statistic::Greatest];

/// Neighbouring frames on each side that are tried at most.
const NEIGHBORS: usize = 2;

/// The frames, and the moments of a short sequence.
struct Frames {
    cases: Vec<Frame>,
    moments: Vec<Frame>,
}

fn frames() -> &'static Frames {
    static FRAMES: OnceLock<Frames> = OnceLock::new();
    FRAMES.get_or_init(|| {
        let law = SampleLaw::Gaussian { sd: 0.3, relative: false };
        let scene = SyntheticScene::new(MeanImage::of(ImageKind::Mixed), law, 24, 16);
        let moments = 0..2 * NEIGHBORS as u64 + 1;
        Frames {
            cases: CASES.iter().filter_map(|name| hard_case(name)).map(|case| case.frame().0).collect(),
            moments: scene
                .iter()
                .flat_map(|scene| moments.clone().map(|k| scene.render_with(8, 100 + k, &STATISTICS)))
                .collect(),
        }
    })
}

/// Runs something of a method; a panic is told as its message.
pub(crate) fn attempt<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    // The method's state is not touched again after a panic unless by another call, which fails on its own.
    catch_unwind(AssertUnwindSafe(work)).map_err(|panic| {
        let text = panic
            .downcast_ref::<String>()
            .cloned()
            .or_else(|| panic.downcast_ref::<&str>().map(|s| (*s).to_owned()));
        text.unwrap_or_default()
    })
}

/// Fingerprints of methods, each made once.
#[derive(Debug, Default)]
pub(crate) struct Fingerprints(BTreeMap<String, Key>);

impl Fingerprints {
    /// That of a method with its parameters.
    pub(crate) fn of(&mut self, method: &Method) -> Key {
        let made = self.0.entry(format!("{} {}", method.id, method.params));
        made.or_insert_with(|| fingerprint(method)).clone()
    }
}

/// Hash of the bits of a method's output on the frames of this file, of what it asks for and of what it claims. Methods
/// give equal bits on any number of threads and with any instruction set, and so does this.
fn fingerprint(method: &Method) -> Key {
    let mut bits = Bits::of("method");
    let card = method.denoiser.card();
    bits.text(&contract(&card));
    if let Some(version) = &method.version {
        // Something else computes, and says what it is.
        bits.text(version);
        return bits.finish();
    }
    for case in &frames().cases {
        add(&mut bits, method, &Input::new(case));
    }
    let moments = &frames().moments;
    if let Some(middle) = moments.get(NEIGHBORS) {
        // What a study hands over: never more than the card says, and fewer at the ends of a sequence.
        let reach = card.neighbors.min(NEIGHBORS);
        let (before, after) = (&moments[NEIGHBORS - reach..NEIGHBORS], &moments[NEIGHBORS + 1..][..reach]);
        add(&mut bits, method, &Input::new(middle));
        if reach > 0 {
            add(&mut bits, method, &Input::new(middle).with_neighbors(before, after));
            add(&mut bits, method, &Input::new(middle).with_neighbors(&[], after));
        }
        if let Some(adaptive) = method.denoiser.adaptive() {
            match attempt(|| adaptive.density(&Input::new(middle))) {
                Ok(Ok(density)) => bits.image(&density),
                Ok(Err(error)) => bits.text(error.kind()),
                Err(_) => bits.text("panic"),
            }
        }
    }
    bits.finish()
}

/// What a card says that decides numbers or whether there are any, without names and notes.
fn contract(card: &MethodCard) -> String {
    let MethodCard { needs, uses, neighbors, claims, .. } = card;
    format!("{needs:?} {uses:?} {neighbors} {claims:?}")
}

fn add(bits: &mut Bits, method: &Method, input: &Input<'_>) {
    match attempt(|| method.denoiser.denoise(input)) {
        Ok(Ok(output)) => add_output(bits, &output),
        // Not the wording, which may be mended at any time.
        Ok(Err(error)) => add_refusal(bits, &error),
        Err(_) => bits.text("panic"),
    }
}

fn add_refusal(bits: &mut Bits, error: &DenoiseError) {
    bits.text(error.kind());
}

fn add_output(bits: &mut Bits, output: &Output) {
    // Seconds differ from run to run; diagnostic images are looked at, not counted.
    let Output {
        image,
        error_estimate,
        estimate_of,
        bounds,
        diagnostics: _,
        figures,
        stages: _,
        seconds: _,
        log: _,
    } = output;
    bits.text("output");
    bits.image(image);
    bits.images(error_estimate);
    if let Some((name, image)) = estimate_of {
        bits.text(name);
        bits.image(image);
    }
    bits.number(bounds.len() as u64);
    for bound in bounds {
        bits.text(&bound.name);
        bits.number(bound.level.confidence().to_bits());
        bits.image(&bound.half_width);
    }
    bits.number(figures.len() as u64);
    for Figure { name, value, unit: _ } in figures {
        bits.text(name);
        bits.number(if value.is_nan() { f64::NAN.to_bits() } else { value.to_bits() });
    }
}

#[cfg(test)]
mod tests {
    use noisefloor_denoiser::{Citation, Denoiser, Guarded, MonteCarlo, Registry, Unit, mc};
    use noisefloor_stats::{Level, family};
    use serde_json::{Map, json};

    use super::*;

    /// The input, changed by a closure where it says so.
    struct Fake<F>(F);

    impl<F: Fn(&Frame, Output) -> Result<Output, DenoiseError> + Send + Sync> Denoiser for Fake<F> {
        fn card(&self) -> MethodCard {
            MethodCard::new("fake", "fake", Citation::new("none", "none"))
        }

        fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
            (self.0)(input.target, Output::from_image(input.target.color.mean.clone()))
        }
    }

    fn fake<F>(edit: F) -> Key
    where
        F: Fn(&Frame, Output) -> Result<Output, DenoiseError> + Send + Sync + 'static,
    {
        fingerprint(&Method {
            id: "fake".into(),
            params: json!({}),
            version: None,
            denoiser: Box::new(Fake(edit)),
        })
    }

    fn refusal(wording: &'static str) -> DenoiseError {
        DenoiseError::Undefined { method: "fake".into(), what: wording.into(), pixels: 1, x: 0, y: 0 }
    }

    #[test]
    fn every_frame_exists() {
        assert_eq!((frames().cases.len(), frames().moments.len()), (CASES.len(), 2 * NEIGHBORS + 1));
    }

    #[test]
    fn any_bit_of_an_output_changes_the_fingerprint_and_wording_does_not() {
        let plain = fake(|_, output| Ok(output));
        assert_eq!(fake(|_, output| Ok(output)), plain);
        // Only where a branch is met: an image smaller than any window.
        let small = fake(|frame, mut output| {
            if frame.pixels() < 25 {
                output.image.data_mut()[0] += 1.0;
            }
            Ok(output)
        });
        let estimate = fake(|_, mut output| {
            output.error_estimate = Some(output.image.clone());
            Ok(output)
        });
        let figure = fake(|_, mut output| {
            output.figure("a", Unit::None, 1.0);
            Ok(output)
        });
        let diagnostics = fake(|_, mut output| {
            output.diagnose("a", Unit::None, output.image.clone());
            Ok(output)
        });
        assert!(plain != small && plain != estimate && plain != figure && estimate != figure);
        assert_eq!(diagnostics, plain);
        let refuses = |wording| {
            fake(
                move |frame, output| {
                    if frame.features.is_empty() { Err(refusal(wording)) } else { Ok(output) }
                },
            )
        };
        assert_eq!(refuses("weight"), refuses("sum of weights"));
        assert_ne!(refuses("weight"), plain);
        assert_ne!(fake(|_, _| panic!("no reason")), plain);
    }

    #[test]
    fn claims_and_needs_are_part_of_it() {
        let built = |denoiser: Box<dyn Denoiser>| Method {
            id: "m".into(),
            params: json!({}),
            version: None,
            denoiser,
        };
        let guarded = |level| built(Box::new(Guarded::new(Box::new(MonteCarlo), level)));
        // The guarded input is the input: the bits are the same, the claims are not.
        let levels = [Level::TWO_SIDED_95, Level::TWO_SIDED_99].map(|level| fingerprint(&guarded(level)));
        assert_ne!(levels[0], levels[1]);
        assert_ne!(levels[0], fingerprint(&built(Box::new(MonteCarlo))));
        // Frames that have every statistic tell apart what needs the same of them.
        let by = |id| {
            let guarded = Guarded::new(Box::new(MonteCarlo), Level::TWO_SIDED_95);
            built(Box::new(guarded.with_interval(family(id).unwrap())))
        };
        assert_ne!(fingerprint(&by("hall")), fingerprint(&by("johnson")));
    }

    #[test]
    fn a_fingerprint_is_made_once_and_is_the_same_on_any_number_of_threads() {
        let registry = Registry::new([mc()]);
        let method = registry.build("guarded(mc)", &Map::new()).unwrap();
        let mut kept = Fingerprints::default();
        let first = kept.of(&method);
        for threads in [1, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            assert_eq!(pool.install(|| fingerprint(&method)), first);
        }
        assert_eq!((kept.of(&method), kept.0.len()), (first, 1));
    }
}
