//! What several test files need.
#![allow(dead_code)] // each test file uses some of it

use std::collections::BTreeMap;

use noisefloor_frame::{
    Camera, Counts, Estimate, FeatureId, Flash, Frame, Image, Integrator, Maps, PixelFilter, Provenance,
    RoundsTaken, Samples, Sampling, Variance,
};

/// Every kind of bit pattern: quiet and signalling NaN with payload, infinities, both zeros, subnormals, ordinary.
pub const HARD: [u32; 10] = [
    0x7FC1_2345,
    0xFF81_2345,
    0x7F80_0000,
    0xFF80_0000,
    0x8000_0000,
    0x0000_0001,
    0x807F_FFFF,
    0x7F7F_FFFF,
    0x3DCC_CCCD,
    0x0000_0000,
];

/// Deterministic noise with hard values strewn in.
pub fn image(width: usize, height: usize, channels: usize, seed: u32) -> Image {
    Image::from_fn(width, height, channels, |c, x, y| {
        let mut z = seed ^ (c as u32) << 28 ^ (y as u32) << 14 ^ x as u32;
        z = (z ^ z >> 16).wrapping_mul(0x21F0_AAAD);
        z = (z ^ z >> 15).wrapping_mul(0x735A_2D97);
        z ^= z >> 15;
        if z.is_multiple_of(7) {
            f32::from_bits(HARD[(z / 7 % 10) as usize])
        } else {
            f32::from_bits(z & 0xBFFF_FFFF)
        }
    })
}

pub fn estimate(width: usize, height: usize, channels: usize, seed: u32) -> Estimate {
    let make = |k: u32| image(width, height, channels, seed.wrapping_mul(31).wrapping_add(k));
    Estimate { mean: make(0), variance: Some(Variance::of_mean(make(1))), halves: Some([make(2), make(3)]) }
}

/// A frame that has everything.
pub fn full_frame(width: usize, height: usize) -> Frame {
    let counts: Vec<u32> = (0..width * height).map(|p| 4 + (p % 5) as u32 * 100_000_007).collect();
    let half = counts.iter().map(|n| n / 3).collect();
    let samples = Samples::per_pixel(counts).with_half_a(Counts::PerPixel(half));
    let mut frame = Frame::from_color(estimate(width, height, 3, 1), samples, Sampling::LowDiscrepancy);
    for (k, id) in FeatureId::KNOWN.into_iter().enumerate() {
        let channels = id.channel_names().expect("known features have fixed channels").len();
        frame.features.insert(id, estimate(width, height, channels, 10 + k as u32));
    }
    for channels in [1, 2, 3, 4, 12] {
        let id = FeatureId::Extra(format!("some.other thing with {channels} channels"));
        frame.features.insert(id, estimate(width, height, channels, 50 + channels as u32));
    }
    frame.flash = Some(Flash::Parts {
        base: estimate(width, height, 3, 90),
        light: estimate(width, height, 3, 91),
        covariance: Some(image(width, height, 3, 92)),
    });
    frame.provenance = provenance();
    frame
}

pub fn provenance() -> Provenance {
    let names = ["note", "owner", "spp", "extra.spp", "samplesPerPixel", "ünïcödé 名前", "filter2"];
    Provenance {
        scene: Some("Küche, 厨房".into()),
        renderer: Some("noisefloor 0.1".into()),
        integrator: Some("path depth=6".into()),
        light: Some(Integrator::PathTracing),
        photon_maps: Some(Maps::Fixed),
        rounds: Some(RoundsTaken { count: 4, density_seconds: None }),
        sampler: Some("owen-sobol".into()),
        seed: Some(u64::MAX),
        filter: Some(PixelFilter::Point),
        camera: Some(Camera {
            camera_to_world: [
                [1.0, 0.5, -0.0, 3.0],
                [0.1, 1.0, 0.2, 4.0],
                [0.0, 0.3, 1.0, 1e-40],
                [0.0, 0.0, 0.0, 1.0],
            ],
            vertical_fov_degrees: 37.3,
        }),
        render_seconds: None,
        render_threads: None,
        extra: names.map(|name| (name.to_owned(), format!("value of {name}"))).into(),
    }
}

pub fn no_attributes() -> BTreeMap<String, String> {
    BTreeMap::new()
}

fn bits(image: &Image) -> (usize, usize, usize, Vec<u32>) {
    let values = image.data().iter().map(|v| v.to_bits()).collect();
    (image.width(), image.height(), image.channels(), values)
}

pub fn assert_same_image(name: &str, a: &Image, b: &Image) {
    assert!(bits(a) == bits(b), "{name} differs");
}

fn assert_same_estimate(name: &str, a: &Estimate, b: &Estimate) {
    let all = |e: &Estimate| {
        let variance = e.variance.as_ref().map(|v| bits(v.mean_variance()));
        (bits(&e.mean), variance, e.halves.as_ref().map(|[a, b]| (bits(a), bits(b))))
    };
    assert!(all(a) == all(b), "{name} differs");
}

/// Equality to the bit, where `==` would trip over NaN and let −0 pass for 0.
pub fn assert_same_frame(a: &Frame, b: &Frame) {
    assert_same_estimate("color", &a.color, &b.color);
    assert!(a.features.keys().eq(b.features.keys()), "{:?} {:?}", a.features.keys(), b.features.keys());
    for (id, estimate) in &a.features {
        assert_same_estimate(id.name(), estimate, &b.features[id]);
    }
    match (&a.flash, &b.flash) {
        (None, None) => {}
        (Some(Flash::Ready(a)), Some(Flash::Ready(b))) => assert_same_estimate("flash", a, b),
        (
            Some(Flash::Parts { base, light, covariance }),
            Some(Flash::Parts { base: base2, light: light2, covariance: covariance2 }),
        ) => {
            assert_same_estimate("flashBase", base, base2);
            assert_same_estimate("flashLight", light, light2);
            assert!(covariance.as_ref().map(bits) == covariance2.as_ref().map(bits), "flashCov differs");
        }
        _ => panic!("flash differs in kind"),
    }
    assert_eq!((&a.samples, a.sampling, &a.provenance), (&b.samples, b.sampling, &b.provenance));
}
