//! The frames have the stated laws, and statistics that mean what their names say.

use noisefloor_frame::{FeatureId, Flash, Frame, Image};
use noisefloor_stats::{Level, t_quantile};
use noisefloor_synthetic::{Guides, ImageKind, MeanImage, SampleLaw, SyntheticScene};

const LAWS: [SampleLaw; 5] = [
    SampleLaw::Gaussian { sd: 0.5, relative: false },
    SampleLaw::Gaussian { sd: 0.5, relative: true },
    SampleLaw::Exponential,
    SampleLaw::LogNormal { sigma: 0.5 },
    SampleLaw::Bernoulli { q: 0.1, bright: 0.75 },
];

fn scene(kind: ImageKind, law: SampleLaw, width: usize, height: usize) -> SyntheticScene {
    SyntheticScene::new(MeanImage::of(kind), law, width, height).unwrap()
}

fn variance(frame: &Frame) -> &Image {
    frame.color.variance.as_ref().unwrap().mean_variance()
}

/// Mean over all values and its standard error from their spread.
fn mean_and_error(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let s2 = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0);
    (mean, (s2 / n).sqrt())
}

fn assert_near(what: &str, values: &[f64], expected: f64) {
    let (mean, error) = mean_and_error(values);
    // Five standard errors: less than one false alarm in a million.
    assert!((mean - expected).abs() < 5.0 * error, "{what}: {mean} ± {error}, expected {expected}");
}

#[test]
fn samples_have_the_stated_mean_and_variance() {
    for law in LAWS {
        let frame = scene(ImageKind::Constant, law, 64, 64).render(16, 5);
        let mu = 0.5;
        let values = |image: &Image| image.data().iter().map(|&v| f64::from(v)).collect::<Vec<_>>();
        let means = values(&frame.color.mean);
        let squares: Vec<f64> = means.iter().map(|m| (m - mu).powi(2)).collect();
        assert_near(law.name(), &means, mu);
        assert_near(law.name(), &squares, law.variance(mu) / 16.0);
        assert_near(law.name(), &values(variance(&frame)), law.variance(mu) / 16.0);
        let two_buffer =
            noisefloor_frame::Variance::from_halves(frame.color.halves.as_ref().unwrap(), &frame.samples);
        assert_near(law.name(), &values(two_buffer.unwrap().mean_variance()), law.variance(mu) / 16.0);
    }
}

#[test]
fn every_pixel_has_its_own_mean() {
    let scene = scene(ImageKind::Mixed, SampleLaw::Gaussian { sd: 0.3, relative: false }, 48, 32);
    let frame = scene.render(64, 2);
    let z: Vec<f64> = frame
        .color
        .mean
        .data()
        .iter()
        .zip(scene.truth().mean().data())
        .map(|(&x, &mu)| f64::from(x - mu) / (0.3 / 8.0))
        .collect();
    assert_near("standardised residual", &z, 0.0);
    let squares: Vec<f64> = z.iter().map(|z| z * z).collect();
    assert_near("its square", &squares, 1.0);
}

/// Share of pixel-channels whose t-interval holds the truth, with its standard error over pixels (independent
/// here).
fn coverage(scene: &SyntheticScene, spp: u32, level: Level) -> (f64, f64) {
    let frame = scene.render(spp, 11);
    let t = t_quantile(level, u64::from(spp) - 1);
    let truth = scene.truth();
    let covered = frame
        .color
        .mean
        .data()
        .iter()
        .zip(variance(&frame).data())
        .zip(truth.mean().data())
        .filter(|&((&x, &v), &mu)| f64::from(x - mu).abs() <= t * f64::from(v).sqrt())
        .count();
    let total = truth.mean().data().len() as f64;
    let rate = covered as f64 / total;
    (rate, (rate * (1.0 - rate) / total).sqrt())
}

#[test]
fn intervals_of_normal_samples_cover_at_the_nominal_rate() {
    let scene = scene(ImageKind::Mixed, SampleLaw::Gaussian { sd: 0.5, relative: false }, 96, 64);
    for spp in [2, 4, 17, 64] {
        for level in [Level::TWO_SIDED_95, Level::TWO_SIDED_99, Level::TWO_SIDED_998] {
            let (rate, error) = coverage(&scene, spp, level);
            assert!((rate - level.confidence()).abs() < 5.0 * error, "{spp} {level:?}: {rate} ± {error}");
        }
    }
}

#[test]
fn intervals_of_rare_events_do_not_cover() {
    let scene = scene(ImageKind::Constant, SampleLaw::Bernoulli { q: 0.01, bright: 1.0 }, 64, 64);
    let (rate, error) = coverage(&scene, 16, Level::TWO_SIDED_99);
    // At most the pixels that saw an event at all can cover: 1 − 0.99^16 = 14.9 %.
    assert!(rate < 0.1486 + 5.0 * error, "{rate} ± {error}");
}

#[test]
fn same_bits_for_any_thread_count() {
    let scene = scene(ImageKind::Mixed, SampleLaw::Exponential, 37, 23);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| scene.render(33, 9))
    };
    assert_eq!(with(1), with(5));
    assert_ne!(scene.render(33, 9).color, scene.render(33, 10).color);
}

#[test]
fn a_shorter_frame_has_the_first_samples_of_a_longer_one() {
    for law in LAWS {
        let scene = scene(ImageKind::Flats, law, 9, 7);
        let (one, two) = (scene.render(1, 3), scene.render(2, 3));
        assert_eq!(one.color.mean, two.color.halves.as_ref().unwrap()[0], "{}", law.name());
        assert!(one.color.variance.is_none() && one.color.halves.is_none());
    }
}

#[test]
fn common_channels_share_their_random_number() {
    let scene = scene(ImageKind::Constant, SampleLaw::Exponential, 8, 8);
    let channels_agree = |frame: Frame| frame.color.mean.plane(0) == frame.color.mean.plane(1);
    assert!(channels_agree(scene.clone().with_common_channels(true).render(4, 1)));
    assert!(!channels_agree(scene.render(4, 1)));
}

#[test]
fn features_and_flash_have_consistent_statistics() {
    for spp in [2u32, 3, 16] {
        let scene = scene(ImageKind::Constant, SampleLaw::Exponential, 64, 48);
        let frame = scene.render(spp, 4);
        frame.check().unwrap();
        let Some(Flash::Parts { base, light, .. }) = &frame.flash else { panic!("parts were asked for") };
        let n = f64::from(spp);
        let table = [
            (&frame.features[&FeatureId::Albedo], 1.0, 0.02),
            (&frame.features[&FeatureId::Depth], 5.0, 0.1),
            (base, 0.2, 0.02),
            (light, 0.3, 0.03),
        ];
        for (estimate, mean, sd) in table {
            let values = |image: &Image| image.data().iter().map(|&v| f64::from(v)).collect::<Vec<_>>();
            let v = estimate.variance.as_ref().unwrap().mean_variance();
            let squares: Vec<f64> = values(&estimate.mean).iter().map(|x| (x - mean).powi(2)).collect();
            assert_near("mean", &values(&estimate.mean), mean);
            assert_near("squared deviation", &squares, sd * sd / n);
            assert_near("variance of the mean", &values(v), sd * sd / n);
            // s² of normal samples has variance 2σ⁴/(n−1).
            let spread: Vec<f64> = values(v).iter().map(|v| (v * n / (sd * sd) - 1.0).powi(2)).collect();
            assert_near("spread of s²", &spread, 2.0 / (n - 1.0));
        }
    }
}

#[test]
fn guides_are_there_as_asked() {
    let law = SampleLaw::Gaussian { sd: 0.5, relative: false };
    for (guides, features, flash) in [
        (Guides::FlashParts, 4, true),
        (Guides::FlashReady, 4, true),
        (Guides::NoFlash, 4, false),
        (Guides::None, 0, false),
    ] {
        for spp in [1, 4] {
            let frame = scene(ImageKind::Mixed, law, 20, 10).with_guides(guides).render(spp, 0);
            frame.check().unwrap();
            assert_eq!((frame.features.len(), frame.flash.is_some()), (features, flash));
        }
    }
}

#[test]
fn extreme_scales_stay_finite() {
    for level in [1e-8, 1e8, 1e30] {
        let image = MeanImage { kind: ImageKind::Edges, level, contrast: level, period: 8 };
        let frame = SyntheticScene::new(image, SampleLaw::Gaussian { sd: 0.1, relative: true }, 8, 4);
        let frame = frame.unwrap().render(4, 1);
        assert_eq!(frame.color.mean.count_non_finite(), 0);
        // At 1e30 the variance exceeds the range of f32; below it must not.
        assert!(level > 1e18 || variance(&frame).count_non_finite() == 0);
    }
}
