//! Optional statistics: what they are of the samples themselves, and that they cost nothing where nobody asks.

mod common;

use common::*;
use glam::Vec3;
use noisefloor_frame::{BoxCox, Counts, Frame, Image, PixelFilter, Sampling, Statistic, Tapped};
use noisefloor_render::{
    OptionalRecord, Prepared, Recorded, RenderError, RenderRequest, Rounds, Silent, render, render_reference,
};

const SIZE: (usize, usize) = (12, 9);

fn statistics() -> Vec<Statistic> {
    let transform = |lambda| Statistic::BoxCox(BoxCox::new(lambda, 1e-3).unwrap());
    vec![
        Statistic::FourParts,
        Statistic::ThirdMoment,
        transform(0.0),
        transform(0.5),
        Statistic::Least,
        Statistic::Greatest,
        Statistic::Position,
    ]
}

/// Everything, and some pixels.
fn all() -> OptionalRecord {
    OptionalRecord { statistics: statistics(), tap: vec![[7, 3], [0, 0], [11, 8], [5, 4]] }
}

fn request(scene: &Prepared, spp: u32) -> RenderRequest<'_> {
    RenderRequest { seed: 7, optional: all(), ..RenderRequest::new(scene, SIZE.0, SIZE.1, spp) }
}

/// Everything but the provenance, which has times in it.
fn bare(frame: Frame) -> Frame {
    Frame { provenance: Default::default(), ..frame }
}

fn values(tapped: &Tapped, channel: usize) -> Vec<f64> {
    tapped.samples.iter().map(|sample| f64::from(sample.color[channel])).collect()
}

fn mean(x: &[f64]) -> f64 {
    x.iter().sum::<f64>() / x.len() as f64
}

/// Σ(x − x̄)(y − ȳ)
fn products(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(a, b)| (a - mean(x)) * (b - mean(y))).sum()
}

/// Holds all statistics of a frame's tapped pixels against its samples.
fn assert_agrees(frame: &Frame) {
    let optional = &frame.optional;
    let [right, down] = optional.position().unwrap();
    let parts = optional.four_parts().unwrap();
    for tapped in optional.tapped() {
        let pixel = tapped.y * frame.width() + tapped.x;
        assert_eq!(tapped.samples.len(), frame.samples.at(pixel) as usize);
        for channel in 0..3 {
            let x = values(tapped, channel);
            let n = x.len() as f64;
            let is = |image: &Image, expected: f64, scale: f64, what: &str| {
                let got = f64::from(image.get(channel, tapped.x, tapped.y));
                assert!((got - expected).abs() <= 2e-7 * scale, "{what}: {got}, expected {expected}");
            };
            let spread = products(&x, &x).sqrt();
            is(&frame.color.mean, mean(&x), mean(&x), "mean");
            let variance = frame.color.variance.as_ref().unwrap().mean_variance();
            is(variance, spread * spread / (n - 1.0) / n, spread * spread, "variance");
            is(optional.least().unwrap(), x.iter().copied().fold(f64::INFINITY, f64::min), 0.0, "least");
            is(optional.greatest().unwrap(), x.iter().copied().fold(0.0, f64::max), 0.0, "greatest");
            let cubes = |power: fn(f64) -> f64| x.iter().map(|v| power(v - mean(&x))).sum::<f64>();
            let third = n / ((n - 1.0) * (n - 2.0));
            let scale = third * cubes(|d| d.abs().powi(3));
            is(optional.third_moment().unwrap(), third * cubes(|d| d.powi(3)), scale, "third moment");
            for (axis, image) in [right, down].into_iter().enumerate() {
                let p: Vec<f64> = tapped.samples.iter().map(|s| f64::from(s.position[axis])).collect();
                is(image, products(&x, &p) / (n - 1.0), spread, "position");
            }
            for moments in optional.box_cox() {
                let g: Vec<f64> = x.iter().map(|v| moments.transform.of(*v)).collect();
                is(moments.mean, mean(&g), 10.0, "mean of g");
                is(moments.mean_variance, products(&g, &g) / (n - 1.0) / n, 10.0, "variance of g");
                is(moments.floored, x.iter().filter(|v| **v < 1e-3).count() as f64 / n, 1.0, "floored");
            }
            for part in 0..4 {
                let of = |index: usize| (tapped.first as usize + index) % 4 == part;
                let x: Vec<f64> =
                    x.iter().enumerate().filter(|(index, _)| of(*index)).map(|(_, x)| *x).collect();
                assert_eq!(parts.samples[part].at(pixel) as usize, x.len());
                is(parts.means[part], mean(&x), mean(&x), "part");
            }
        }
    }
}

fn assert_near(a: &Image, b: &Image) {
    for (a, b) in a.data().iter().zip(b.data()) {
        assert!((a - b).abs() <= 2e-6 * a.abs().max(b.abs()).max(1e-3), "{a} and {b}");
    }
}

#[test]
fn every_statistic_is_that_of_the_samples() {
    let scene = Prepared::new(&cornell()).unwrap();
    for (spp, sample_start) in [(4, 0), (16, 3), (48, 16), (101, 5)] {
        let frame = render(&RenderRequest { sample_start, ..request(&scene, spp) }, &Silent).unwrap();
        let places: Vec<[usize; 2]> = frame.optional.tapped().iter().map(|t| [t.x, t.y]).collect();
        assert_eq!(places, [[0, 0], [7, 3], [5, 4], [11, 8]], "row by row");
        assert_agrees(&frame);
        let parts = frame.optional.four_parts().unwrap();
        for (halves, expected) in parts.halves().iter().zip(frame.color.halves.as_ref().unwrap()) {
            assert_near(halves, expected);
        }
        let inside = frame.crop(5, 3, 4, 4);
        assert_eq!(inside.optional.tapped().len(), 2);
        inside.check().unwrap();
        assert_agrees(&inside);
    }
}

#[test]
fn asking_changes_no_bit_of_the_rest_and_not_asking_gives_nothing() {
    let scene = Prepared::new(&cornell()).unwrap();
    for record in [Recorded::Available, Recorded::color_only()] {
        let asked = RenderRequest { record, ..request(&scene, 19) };
        let plain = RenderRequest { optional: OptionalRecord::default(), ..asked.clone() };
        let with = bare(render(&asked, &Silent).unwrap());
        let without = bare(render(&plain, &Silent).unwrap());
        assert!(without.optional.is_empty() && !with.optional.is_empty());
        assert_eq!(Frame { optional: Default::default(), ..with }, without);
        assert!(plain.memory(None).unwrap() < asked.memory(None).unwrap());
        let reference = RenderRequest { spp: 16, ..asked.clone() };
        assert!(render_reference(&reference, 8, &Silent).unwrap().frame.optional.is_empty());
        assert_eq!(plain.memory(Some(8)).unwrap(), asked.memory(Some(8)).unwrap());
    }
}

#[test]
fn rounds_ranges_and_threads_make_the_statistics_of_one_run() {
    let scene = Prepared::new(&cornell()).unwrap();
    let whole = render(&request(&scene, 64), &Silent).unwrap().optional;
    let mut rounds = Rounds::start(&request(&scene, 5), &Silent).unwrap();
    rounds.add(&[59; SIZE.0 * SIZE.1], &Silent).unwrap();
    assert_eq!(rounds.frame().unwrap().optional, whole);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
    assert_eq!(pool.install(|| render(&request(&scene, 64), &Silent)).unwrap().optional, whole);
    for (cuts, aligned) in [([16, 32], true), ([7, 40], false)] {
        let range = |start: u32, end: u32| {
            let part = RenderRequest { sample_start: start, ..request(&scene, end - start) };
            Rounds::start(&part, &Silent).unwrap()
        };
        let mut joined = range(0, cuts[0]);
        joined.append(&range(cuts[0], cuts[1])).unwrap();
        joined.append(&range(cuts[1], 64)).unwrap();
        let joined = joined.frame().unwrap();
        assert_eq!(joined.optional.tapped(), whole.tapped());
        assert_eq!((joined.optional.least(), joined.optional.greatest()), (whole.least(), whole.greatest()));
        assert_agrees(&joined);
        if aligned {
            assert_eq!(joined.optional, whole);
        }
        for ((_, a), (_, b)) in joined.optional.recorded().iter().zip(whole.recorded()) {
            a.iter().zip(b).for_each(|(a, b)| assert_near(a, b));
        }
    }
    let mut uneven =
        Rounds::start(&RenderRequest { sample_start: 2, ..request(&scene, 4) }, &Silent).unwrap();
    let extra: Vec<u32> = (0..SIZE.0 * SIZE.1).map(|pixel| [0, 3, 20][pixel % 3]).collect();
    uneven.add(&extra, &Silent).unwrap();
    let uneven = uneven.frame().unwrap();
    assert_agrees(&uneven);
    assert!(matches!(uneven.optional.four_parts().unwrap().samples[1], Counts::PerPixel(_)));
}

/// Black floor beside a lamp of radiance 3; a pixel sees the edge between them.
#[test]
fn statistics_of_a_known_law_are_those_of_its_formula() {
    let mut scene = with_sky(empty(camera(Vec3::new(0.0, 5.0, 0.0), Vec3::ZERO, 30.0)), 1.0);
    let floor = add_material(&mut scene, diffuse(0.0), 0.0);
    let lamp = add_material(&mut scene, diffuse(0.0), 3.0);
    quad(&mut scene, Vec3::new(-9.0, 0.0, -9.0), Vec3::Z * 18.0, Vec3::X * 9.25, floor);
    quad(&mut scene, Vec3::new(0.25, 0.0, -9.0), Vec3::Z * 18.0, Vec3::X * 9.0, lamp);
    let prepared = Prepared::new(&scene).unwrap();
    let optional = OptionalRecord { statistics: statistics(), tap: vec![[0, 0]] };
    let request = RenderRequest {
        depth: 1,
        record: Recorded::color_only(),
        optional,
        ..RenderRequest::new(&prepared, 1, 1, 1 << 14)
    };
    let frame = render(&request, &Silent).unwrap();
    let of = |image: &Image| f64::from(image.get(0, 0, 0));
    let (optional, n) = (&frame.optional, f64::from(1 << 14));
    // A sample is 3 with probability q, else 0; it is 3 on one side of the pixel.
    let half = 5.0 * 15f64.to_radians().tan();
    let q = 0.5 - 0.125 / half;
    let x = values(&optional.tapped()[0], 0);
    assert!(x.iter().all(|x| *x == 0.0 || *x == 3.0));
    let error = (q * (1.0 - q) / n).sqrt();
    assert!((of(&frame.color.mean) / 3.0 - q).abs() < 4.5 * error, "{} and {q}", of(&frame.color.mean) / 3.0);
    assert_eq!([of(optional.least().unwrap()), of(optional.greatest().unwrap())], [0.0, 3.0]);
    let third = |q: f64| 27.0 * q * (1.0 - q) * (1.0 - 2.0 * q);
    // The derivative of q(1 − q)(1 − 2q) is below 1.
    assert!((of(optional.third_moment().unwrap()) - third(q)).abs() < 27.0 * 4.5 * error);
    let [right, down] = optional.position().unwrap();
    let covariance = 3.0 * 0.5 * q * (1.0 - q);
    assert!((of(right).abs() - covariance).abs() < 3.0 * 4.5 * 0.3 / n.sqrt(), "{} {covariance}", of(right));
    assert!(of(down).abs() < 3.0 * 4.5 * 0.15 / n.sqrt());
    for moments in optional.box_cox() {
        let (low, high) = (moments.transform.of(0.0), moments.transform.of(3.0));
        let scale = (high - low) * error;
        assert!((of(moments.mean) - (low + q * (high - low))).abs() < 4.5 * scale);
        assert!((of(moments.mean_variance) / (scale * scale) - 1.0).abs() < 0.1);
        assert!((of(moments.floored) - (1.0 - q)).abs() < 4.5 * error);
    }
    let centers = RenderRequest { filter: PixelFilter::Point, ..request };
    let frame = render(&centers, &Silent).unwrap();
    assert_eq!(frame.optional.position().unwrap().map(of), [0.0; 2]);
    assert!(frame.optional.tapped()[0].samples.iter().all(|sample| sample.position == [0.5; 2]));
}

#[test]
fn low_discrepancy_samples_have_all_but_four_parts() {
    let scene = Prepared::new(&cornell()).unwrap();
    let statistics = vec![Statistic::Position, Statistic::Greatest];
    let tap = vec![[3, 3]];
    let optional = OptionalRecord { statistics, tap };
    let sampling = Sampling::LowDiscrepancy;
    let frame = render(&RenderRequest { sampling, optional, ..request(&scene, 32) }, &Silent).unwrap();
    let tapped = &frame.optional.tapped()[0];
    let right: Vec<f64> = tapped.samples.iter().map(|sample| f64::from(sample.position[0])).collect();
    // Every sixteenth of the pixel's width has one sample of each half.
    for half in 0..2 {
        let mut cells: Vec<u32> = right.iter().skip(half).step_by(2).map(|x| (x * 16.0) as u32).collect();
        cells.sort_unstable();
        assert_eq!(cells, (0..16).collect::<Vec<_>>());
    }
    let greatest = values(tapped, 1).into_iter().fold(0.0, f64::max) as f32;
    assert_eq!(frame.optional.greatest().unwrap().get(1, 3, 3), greatest);
}

#[test]
fn what_has_no_meaning_is_refused() {
    let scene = Prepared::new(&cornell()).unwrap();
    let told = |request: RenderRequest<'_>| match render(&request, &Silent) {
        Err(error @ RenderError::InvalidRequest { .. }) => error.to_string(),
        other => panic!("{other:?}"),
    };
    let of = |statistics, tap| OptionalRecord { statistics, tap };
    let with = |optional, spp| RenderRequest { optional, ..request(&scene, spp) };
    assert!(
        told(with(of(vec![Statistic::ThirdMoment], vec![]), 2)).contains("at least 3 for `third-moment`")
    );
    assert!(told(with(of(vec![Statistic::FourParts], vec![]), 3)).contains("at least 4 for `four-parts`"));
    assert!(told(with(of(vec![Statistic::Least; 2], vec![]), 8)).contains("each once"));
    assert!(told(with(of(vec![], vec![[12, 0]]), 8)).contains("inside 12×9 pixels"));
    assert!(told(with(of(vec![], vec![[1, 1], [2, 1], [1, 1]]), 8)).contains("each once"));
    let sampling = Sampling::LowDiscrepancy;
    assert!(told(RenderRequest { sampling, ..request(&scene, 8) }).contains("four parts"));
    let mut rounds = Rounds::start(&request(&scene, 8), &Silent).unwrap();
    let other = OptionalRecord { tap: vec![], ..all() };
    let other = RenderRequest { sample_start: 8, optional: other, ..request(&scene, 8) };
    let error = rounds.append(&Rounds::start(&other, &Silent).unwrap()).unwrap_err();
    assert!(error.to_string().contains("optional statistics"), "{error}");
    let one = RenderRequest {
        optional: of(vec![Statistic::Least, Statistic::Greatest], vec![]),
        ..request(&scene, 1)
    };
    let frame = render(&one, &Silent).unwrap();
    assert_eq!(frame.optional.least(), Some(&frame.color.mean));
}
