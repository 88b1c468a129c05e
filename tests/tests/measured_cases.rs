//! Hard cases in figures, for every registered method: how far one bright sample spreads, what becomes of the energy, and
//! what the exposure does. `cargo test -p noisefloor-tests --test measured_cases -- --nocapture` prints the table.

use noisefloor_conformance::change::{exposed, set_variance};
use noisefloor_denoiser::{Caveat, DenoiseError, Denoiser, Input, Invariance};
use noisefloor_frame::{Estimate, Frame, Image};
use noisefloor_synthetic::{ImageKind, MeanImage, SampleLaw, SyntheticScene};
use serde_json::{Map, Value, json};

const SIZE: (usize, usize) = (40, 30);
const SPP: u32 = 16;
/// Where the bright sample falls.
const AT: (usize, usize) = (20, 15);
/// Its value, where the image is about 0.5.
const BRIGHT: [f32; 5] = [1e2, 1e4, 1e6, 1e8, 1e10];
/// Powers of two by which the exposure is changed.
const STOPS: [i32; 4] = [-20, -10, 10, 20];

/// Most energy over the larger of the input's and the truth's that a frame with a bright sample may leave a method with.
const MOST_ENERGY: f64 = 1.02;
/// Most that a power of two of exposure may change a method's output, relative to it.
const MOST_CHANGE: f64 = 1e-6;

/// Settings that make a method depend on the exposure, by its own card.
const SETTINGS: &[(&str, &str, &str)] = &[("geometric-corrected", "floor_unit", "radiance")];

/// Gamma-like noise of half the mean around a mixed image, with all buffers; and the image.
fn sound() -> (Frame, Image) {
    // σ² = ln(1 + 0.5²): a standard deviation of half the mean.
    let law = SampleLaw::LogNormal { sigma: 1.25f64.ln().sqrt() };
    let scene = SyntheticScene::new(MeanImage::of(ImageKind::Mixed), law, SIZE.0, SIZE.1).unwrap();
    (scene.render(SPP, 5), scene.truth().mean().clone())
}

/// The frame with one of the samples of the first half at `AT` replaced by one that is brighter by `value` in all channels:
/// the mean rises by e = value/n, the variance of the mean by e², up to the old sample's share.
fn with_bright_sample(frame: &Frame, value: f32) -> Frame {
    let mut out = frame.clone();
    let e = value / SPP as f32;
    let (x, y) = AT;
    let add = |image: &mut Image, more: f32| {
        (0..3).for_each(|c| image.set(c, x, y, image.get(c, x, y) + more));
    };
    let color = |color: &mut Estimate| {
        add(&mut color.mean, e);
        color.halves.iter_mut().flatten().take(1).for_each(|half| add(half, 2.0 * e));
    };
    color(&mut out.color);
    let (index, n) = (y * SIZE.0 + x, out.pixels());
    let mut i = 0;
    set_variance(&mut out.color, |v| {
        i += 1;
        if (i - 1) % n == index { v + e * e } else { v }
    });
    out
}

/// Mean over pixels and channels.
fn mean(image: &Image) -> f64 {
    image.data().iter().map(|&v| f64::from(v)).sum::<f64>() / image.data().len() as f64
}

/// Pixels of which a channel differs by more than half of what it was.
fn changed(from: &Image, to: &Image) -> usize {
    let far = |c: usize, p: usize| {
        let (a, b) = (f64::from(from.plane(c)[p]), f64::from(to.plane(c)[p]));
        (b - a).abs() > 0.5 * a.abs()
    };
    (0..from.pixels()).filter(|&p| (0..3).any(|c| far(c, p))).count()
}

/// Largest change of a value relative to it, dark values counting as a hundredth of the mean.
fn largest_change(from: &Image, to: &Image, factor: f64) -> f64 {
    let least = 0.01 * mean(from).abs();
    let pairs = from.data().iter().zip(to.data()).map(|(&a, &b)| (f64::from(a), f64::from(b) / factor));
    pairs.map(|(a, b)| (b - a).abs() / a.abs().max(least)).fold(0.0, f64::max)
}

/// The figures of a method.
struct Figures {
    label: String,
    /// Whether it depends on the exposure by its own card.
    declared: bool,
    /// Whether it may make light of outliers, by its own card.
    makes_light: bool,
    /// Of each bright sample: pixels changed by more than half; energy of the output over the input's, over the larger of
    /// the input's and the truth's.
    bright: Vec<(usize, f64, f64)>,
    /// Energy of the output over the input's on the sound frame.
    energy: f64,
    /// Of each change of exposure.
    change: Vec<f64>,
}

fn figures(label: &str, id: &str, method: &dyn Denoiser) -> Option<Figures> {
    let (frame, truth) = sound();
    let run = |frame: &Frame| match method.denoise(&Input::new(frame)) {
        Ok(output) => Some(output.image),
        // A fixture of its source's slips.
        Err(DenoiseError::Undefined { .. }) if id.contains("as-written") => None,
        Err(error) => panic!("{label}: {error}"),
    };
    let plain = run(&frame)?;
    let bright = |value: &f32| {
        let spoilt = with_bright_sample(&frame, *value);
        let out = run(&spoilt)?;
        let input = mean(&spoilt.color.mean);
        Some((changed(&plain, &out), mean(&out) / input, mean(&out) / input.max(mean(&truth))))
    };
    let change = |stops: &i32| {
        let factor = 2f32.powi(*stops);
        Some(largest_change(&plain, &run(&exposed(&frame, factor))?, f64::from(factor)))
    };
    let card = method.card();
    Some(Figures {
        label: label.to_owned(),
        declared: label != id || card.varies_with.iter().any(|(what, _)| *what == Invariance::Exposure),
        makes_light: card.caveats.iter().any(|(caveat, _)| *caveat == Caveat::Light),
        bright: BRIGHT.iter().map(bright).collect::<Option<_>>()?,
        energy: mean(&plain) / mean(&frame.color.mean),
        change: STOPS.iter().map(change).collect::<Option<_>>()?,
    })
}

/// All registered methods with their defaults, and the settings told apart.
fn all() -> Vec<Figures> {
    let registry = noisefloor_registry::registry([]);
    let mut out = Vec::new();
    for factory in registry.factories().iter().filter(|factory| factory.ready()) {
        let of_entry = SETTINGS.iter().filter(|(id, ..)| *id == factory.id());
        let settings = of_entry
            .map(|(_, name, value)| (format!("{} {name}={value}", factory.id()), json!({ *name: value })));
        for (label, settings) in [(factory.id().to_owned(), json!({}))].into_iter().chain(settings) {
            let settings: Map<String, Value> = settings.as_object().cloned().unwrap_or_default();
            let method = registry.build(factory.id(), &settings).unwrap();
            out.extend(figures(&label, factory.id(), method.denoiser.as_ref()));
        }
    }
    out
}

fn print(all: &[Figures]) {
    let heads = BRIGHT.map(|v| format!("{v:.0e}")).join(" | ");
    println!(
        "One bright sample: pixels of {} changed by more than half (energy out over in)",
        SIZE.0 * SIZE.1
    );
    println!("| method | {heads} | energy, sound frame |");
    for row in all {
        let cells: Vec<String> =
            row.bright.iter().map(|(n, energy, _)| format!("{n} ({energy:.3})")).collect();
        println!("| {} | {} | {:.4} |", row.label, cells.join(" | "), row.energy);
    }
    println!("Exposure: largest relative change of the output");
    println!("| method | {} |", STOPS.map(|k| format!("2^{k}")).join(" | "));
    for row in all {
        let cells: Vec<String> = row.change.iter().map(|change| format!("{change:.1e}")).collect();
        println!("| {} | {} |", row.label, cells.join(" | "));
    }
}

#[test]
fn bright_samples_make_no_light_and_exposure_changes_nothing_but_where_declared() {
    let all = all();
    print(&all);
    let plain = &all[0];
    assert_eq!(plain.label, "mc");
    assert!(plain.bright.iter().all(|(changed, energy, _)| (*changed, *energy) == (1, 1.0)));
    for row in &all {
        let most_energy = row.bright.iter().map(|(_, _, energy)| *energy).fold(0.0, f64::max);
        let most_change = row.change.iter().copied().fold(0.0, f64::max);
        // What a card declares and is gone is no longer to be declared.
        assert_eq!(most_energy > MOST_ENERGY, row.makes_light, "{}: energy {most_energy}", row.label);
        if row.declared {
            // A declared dependence that is gone is no longer to be declared.
            assert!(most_change > MOST_CHANGE, "{}: exposure changes nothing", row.label);
        } else {
            assert!(most_change <= MOST_CHANGE, "{}: exposure changes {most_change}", row.label);
        }
    }
}
