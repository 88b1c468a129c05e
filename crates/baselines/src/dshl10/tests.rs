use noisefloor_conformance::assert_conforms;
use noisefloor_denoiser::{Denoiser, Input};
use noisefloor_frame::{Estimate, FeatureId, Frame, Image, Samples, Sampling};
use noisefloor_stats::random::Normals;

use super::algorithm::plain;
use super::{ATrous, Params};

fn frame(color: Image, normal: Image, depth: Image) -> Frame {
    let mut frame = Frame::from_color(Estimate::from_mean(color), Samples::uniform(4), Sampling::Independent);
    frame.features.insert(FeatureId::Normal, Estimate::from_mean(normal));
    frame.features.insert(FeatureId::Depth, Estimate::from_mean(depth));
    frame
}

/// A wall seen from the front.
fn flat(color: Image) -> Frame {
    let (w, h) = (color.width(), color.height());
    frame(color, Image::from_fn(w, h, 3, |c, _, _| f32::from(c == 2)), Image::filled(w, h, 1, 2.0))
}

fn noise(width: usize, height: usize, seed: u64) -> Image {
    let mut normals = Normals::new(seed);
    Image::from_fn(width, height, 3, |_, _, _| 0.5 + 0.1 * normals.next() as f32)
}

fn run(params: Params, frame: &Frame) -> Image {
    ATrous::new(params).unwrap().denoise(&Input::new(frame)).unwrap().image
}

/// Wide open: nothing but the taps.
fn open() -> Params {
    Params { sigma_color: 1e30, sigma_normal: 1e30, sigma_depth: 1e30, ..Params::default() }
}

fn close(a: &Image, b: &Image, within: f32) {
    let worst = a.data().iter().zip(b.data()).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    assert!(worst <= within, "{worst}");
}

#[test]
fn it_conforms() {
    assert_conforms(&ATrous::default());
    assert_conforms(&ATrous::new(Params { demodulate: true, ..Params::default() }).unwrap());
}

#[test]
fn a_constant_stays_and_values_stay_within_their_range() {
    let constant = Image::filled(40, 30, 3, 0.3);
    close(&run(Params::default(), &flat(constant.clone())), &constant, 1e-6);
    let noisy = noise(40, 30, 1);
    let out = run(Params::default(), &flat(noisy.clone()));
    let (least, most) = noisy.data().iter().fold((f32::MAX, f32::MIN), |(a, b), v| (a.min(*v), b.max(*v)));
    assert!(out.data().iter().all(|v| *v >= least - 1e-5 && *v <= most + 1e-5));
}

#[test]
fn wide_open_it_is_the_plain_transform_whose_impulse_is_the_spline() {
    let (w, h) = (281, 261);
    let impulse = Image::from_fn(w, h, 3, |_, x, y| f32::from((x, y) == (140, 130)));
    let h1 = [1.0 / 16.0, 0.25, 0.375, 0.25, 1.0 / 16.0];
    let one = run(Params { levels: 1, ..open() }, &flat(impulse.clone()));
    let mean = impulse.data().iter().sum::<f32>() / impulse.data().len() as f32;
    assert!(mean > 0.0);
    for j in 0..5 {
        for i in 0..5 {
            assert!((one.get(0, 138 + i, 128 + j) - h1[i] * h1[j]).abs() < 1e-6);
        }
    }
    let mut cascade = impulse.clone();
    for level in 0..5 {
        cascade = plain(&cascade, level);
    }
    let five = run(open(), &flat(impulse));
    close(&five, &cascade, 1e-6);
    // All of the light: no window of 62 pixels to each side that holds the impulse is cut.
    let sum: f64 = five.plane(1).iter().copied().map(f64::from).sum();
    assert!((sum - 1.0).abs() < 1e-4, "{sum}");
}

#[test]
fn with_a_width_of_nothing_distinct_values_stay() {
    let noisy = noise(30, 20, 2);
    close(&run(Params { sigma_color: 1e-20, ..Params::default() }, &flat(noisy.clone())), &noisy, 1e-6);
}

#[test]
fn normals_keep_walls_apart_at_fine_levels_and_not_at_coarse_ones() {
    let (w, h) = (80, 12);
    let step = Image::from_fn(w, h, 3, |_, x, _| if x < 40 { 0.0 } else { 1.0 });
    let normal = Image::from_fn(w, h, 3, |c, x, _| f32::from(c == usize::from(x < 40)));
    let walls = frame(step, normal, Image::filled(w, h, 1, 2.0));
    let leak = |levels: usize, x: usize| run(Params { sigma_color: 1e30, levels, ..Params::default() }, &walls).get(0, x, 6);
    // |Δn|² = 2: exp(−2/0.1) at the first level; at the fifth the divisor is 256 times as large, and the weight 0.92.
    assert!(leak(1, 39) < 1e-8, "{}", leak(1, 39));
    assert!(leak(5, 39) > 0.05, "{}", leak(5, 39));
}

#[test]
fn transposed_images_give_transposed_results() {
    let noisy = noise(40, 30, 3);
    let turned = |image: &Image| Image::from_fn(image.height(), image.width(), 3, |c, x, y| image.get(c, y, x));
    let there = turned(&run(Params::default(), &flat(noisy.clone())));
    close(&run(Params::default(), &flat(turned(&noisy))), &there, 1e-5);
}

#[test]
fn background_mixes_with_nothing_else() {
    let (w, h) = (24, 10);
    let color = Image::from_fn(w, h, 3, |_, x, _| if x < 12 { 0.2 } else { 0.9 });
    let depth = Image::from_fn(w, h, 1, |_, x, _| if x < 12 { 2.0 } else { 0.0 });
    let sky = frame(color.clone(), Image::new(w, h, 3), depth);
    close(&run(Params { sigma_color: 1e30, ..Params::default() }, &sky), &color, 1e-6);
}

#[test]
fn albedo_divided_out_comes_back() {
    let (w, h) = (32, 24);
    let albedo = Image::from_fn(w, h, 3, |_, x, y| 0.2 + 0.6 * ((x + y) % 2) as f32);
    let mut frame = flat(albedo.map(|v| 0.5 * v));
    frame.features.insert(FeatureId::Albedo, Estimate::from_mean(albedo.clone()));
    // The light is even: without the texture there is nothing to blur.
    close(&run(Params { demodulate: true, ..open() }, &frame), &albedo.map(|v| 0.5 * v), 1e-6);
}

#[test]
fn it_removes_noise_whatever_the_exposure() {
    let noisy = noise(64, 48, 4);
    let error = |image: &Image, truth: f32| image.data().iter().map(|v| (v - truth).powi(2)).sum::<f32>();
    let out = run(Params::default(), &flat(noisy.clone()));
    assert!(error(&out, 0.5) < 0.05 * error(&noisy, 0.5));
    let dark = run(Params::default(), &flat(noisy.map(|v| v / 1024.0)));
    assert_eq!(dark.map(|v| v * 1024.0), out);
}
