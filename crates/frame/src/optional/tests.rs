use std::sync::Arc;

use super::*;
use crate::{BLOCK_SAMPLES, Counts, FrameError, Image};

/// Samples of one channel with their positions.
struct Known {
    values: Vec<f32>,
    positions: Vec<[f32; 2]>,
}

/// Uniform numbers in 0..1 from SplitMix64.
fn uniforms(seed: u64) -> impl Iterator<Item = f64> {
    let mut state = seed;
    std::iter::repeat_with(move || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    })
}

fn known(n: usize, law: impl Fn(usize, [f64; 2]) -> f64) -> Known {
    let mut u = uniforms(7);
    let mut next = || u.next().unwrap_or_default();
    let (mut values, mut positions) = (Vec::new(), Vec::new());
    for index in 0..n {
        let position = [next() as f32, next() as f32];
        values.push(law(index, [next(), next()]) as f32);
        positions.push(position);
    }
    Known { values, positions }
}

/// exp of a normal number.
fn log_normal(_: usize, [u, v]: [f64; 2]) -> f64 {
    (0.3 + 1.1 * (-2.0 * (1.0 - u).ln()).sqrt() * (std::f64::consts::TAU * v).cos()).exp()
}

fn laws(n: usize) -> Vec<(&'static str, Known)> {
    let mut leaning = known(n, log_normal);
    for (value, position) in leaning.values.iter_mut().zip(&leaning.positions) {
        *value += 4.0 * position[0] - 2.0 * position[1];
    }
    vec![
        ("constant", known(n, |_, _| 0.75)),
        ("black", known(n, |_, _| 0.0)),
        ("two values", known(n, |_, [u, _]| if u < 0.1 { 20.0 } else { 0.0 })),
        ("log-normal", known(n, log_normal)),
        ("far from 0", known(n, |_, [u, _]| 1e4 + u)),
        ("leaning", leaning),
    ]
}

fn transforms() -> Vec<BoxCox> {
    [-1.0, -1e-9, 0.0, 0.25, 1.0, 2.0].map(|lambda| BoxCox::new(lambda, 1e-3).unwrap()).to_vec()
}

fn everything() -> Arc<Gathering> {
    let mut statistics = vec![
        Statistic::ThirdMoment,
        Statistic::Least,
        Statistic::Greatest,
        Statistic::FourParts,
        Statistic::Position,
    ];
    statistics.extend(transforms().into_iter().map(Statistic::BoxCox));
    Arc::new(Gathering::new(statistics, 1))
}

/// What the samples `from..to` come to, added block by block, at most `step` at once.
fn gathered(of: &Arc<Gathering>, known: &Known, range: std::ops::Range<usize>, step: usize) -> Gathered {
    let mut out = Gathered::new(of);
    let mut start = range.start;
    while start < range.end {
        let block = BLOCK_SAMPLES as usize;
        let end = ((start / block + 1) * block).min(range.end).min(start + step);
        let (values, positions) = (&known.values[start..end], &known.positions[start..end]);
        out.extend(&Block { first: start as u32, values, stride: 1, positions });
        start = end;
    }
    out
}

fn finished(gathered: &Gathered, of: &Gathering) -> Vec<f64> {
    let mut out = vec![f64::NAN; of.images()];
    gathered.finish(&mut out);
    out
}

/// The same in two passes, and the scale of rounding errors of each value.
fn two_passes(known: &Known) -> Vec<(f64, f64)> {
    let x: Vec<f64> = known.values.iter().map(|x| f64::from(*x)).collect();
    let n = x.len() as f64;
    let mean_of = |x: &[f64]| x.iter().sum::<f64>() / x.len() as f64;
    let mean = mean_of(&x);
    let moment = |power: i32| x.iter().map(|x| (x - mean).powi(power)).sum::<f64>();
    let absolute = x.iter().map(|x| (x - mean).abs().powi(3)).sum::<f64>();
    let spread = (moment(2) / n).sqrt();
    // Means of large numbers are off by their rounding, and deviations with them.
    let rounding = mean.abs() * 1e-3;
    let third = n / ((n - 1.0) * (n - 2.0));
    let mut out = vec![(third * moment(3), third * (absolute + n * rounding * moment(2) / n) + 1e-9)];
    let least = x.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = x.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    out.extend([(least, 0.0), (greatest, 0.0)]);
    for part in 0..4 {
        let part: Vec<f64> = x.iter().copied().skip(part).step_by(4).collect();
        out.push((mean_of(&part), mean_of(&part).abs()));
    }
    for axis in 0..2 {
        let p: Vec<f64> = known.positions.iter().map(|p| f64::from(p[axis])).collect();
        let center = mean_of(&p);
        let products = x.iter().zip(&p).map(|(x, p)| (x - mean) * (p - center)).sum::<f64>();
        out.push((products / (n - 1.0), spread + rounding));
    }
    for transform in transforms() {
        let lambda = transform.lambda();
        let g: Vec<f64> = x
            .iter()
            .map(|x| x.max(1e-3))
            .map(|x| match lambda {
                0.0 => x.ln(),
                // The first term of the series in λ, which the plain formula loses.
                l if l.abs() < 1e-6 => x.ln() + 0.5 * l * x.ln() * x.ln(),
                l => (x.powf(l) - 1.0) / l,
            })
            .collect();
        let mean = mean_of(&g);
        let s2 = g.iter().map(|g| (g - mean) * (g - mean)).sum::<f64>() / (n - 1.0);
        let largest = g.iter().fold(0.0f64, |m, g| m.max(g.abs()));
        out.push((mean, largest));
        out.push((s2 / n, s2 / n + 1e-3 * largest * largest.min(1e3)));
        out.push((x.iter().filter(|x| **x < 1e-3).count() as f64 / n, 1.0));
    }
    out
}

fn assert_close(got: &[f64], expected: &[(f64, f64)], what: &str) {
    assert_eq!(got.len(), expected.len());
    for (at, (got, (expected, scale))) in got.iter().zip(expected).enumerate() {
        assert!((got - expected).abs() <= 1e-11 * scale, "{what}, value {at}: {got}, expected {expected}");
    }
}

#[test]
fn every_row_agrees_with_two_passes() {
    let of = everything();
    for n in [4, 16, 17, 100, 1000] {
        for (law, known) in laws(n) {
            let got = finished(&gathered(&of, &known, 0..n, 16), &of);
            assert_close(&got, &two_passes(&known), &format!("{n} samples, {law}"));
        }
    }
}

#[test]
fn constant_samples_have_no_moments_and_two_values_those_of_a_coin() {
    let of = Arc::new(Gathering::new(vec![Statistic::ThirdMoment, Statistic::Position], 1));
    let constant = known(50, |_, _| 0.1);
    assert_eq!(finished(&gathered(&of, &constant, 0..50, 16), &of), [0.0; 3]);
    // 3 of 4 are 0, one is 4: Σ(x − 1)³ = 27 − 3 for every four, and 40 of them.
    let coin = known(160, |index, _| if index % 4 == 0 { 4.0 } else { 0.0 });
    let third = finished(&gathered(&of, &coin, 0..160, 16), &of)[0];
    let expected = 160.0 * (40.0 * 24.0) / (159.0 * 158.0);
    assert!((third - expected).abs() < 1e-12 * expected, "{third}, expected {expected}");
}

#[test]
fn any_split_comes_to_the_whole_and_aligned_ones_to_its_bits() {
    let of = everything();
    for (law, known) in laws(192) {
        let whole = finished(&gathered(&of, &known, 0..192, 16), &of);
        let scales: Vec<(f64, f64)> =
            whole.iter().zip(two_passes(&known)).map(|(whole, (_, scale))| (*whole, scale)).collect();
        assert_eq!(finished(&gathered(&of, &known, 0..192, 5), &of), whole, "rounds have the same bits");
        for cuts in [vec![64, 128], vec![128], vec![1, 2, 3], vec![7, 40, 41, 100], vec![48, 49], vec![191]] {
            let mut ends = cuts.clone();
            ends.push(192);
            let mut joined = gathered(&of, &known, 0..ends[0], 16);
            for range in ends.windows(2) {
                joined.append(&gathered(&of, &known, range[0]..range[1], 16));
            }
            let joined = finished(&joined, &of);
            if cuts.iter().all(|cut| cut % 64 == 0) {
                assert_eq!(joined, whole, "{law}, {cuts:?}");
            }
            assert_close(&joined, &scales, &format!("{law}, {cuts:?}"));
        }
    }
}

#[test]
fn channels_do_not_mix_and_cleared_state_is_new() {
    let of = Arc::new(Gathering::new(vec![Statistic::Greatest, Statistic::FourParts], 3));
    let mut gathered = Gathered::new(&of);
    let values: Vec<f32> = (0..8).flat_map(|s| [s as f32, 10.0 * s as f32, -1.0, 99.0, 99.0]).collect();
    let block = Block { first: 4, values: &values, stride: 5, positions: &[[0.5; 2]; 8] };
    let out = |gathered: &Gathered| {
        let mut out = vec![0.0; 15];
        gathered.finish(&mut out);
        out
    };
    gathered.extend(&block);
    let once = out(&gathered);
    assert_eq!(once[..6], [7.0, 70.0, -1.0, 2.0, 20.0, -1.0]);
    assert_eq!(once[12..], [5.0, 50.0, -1.0]);
    gathered.clear();
    gathered.extend(&block);
    assert_eq!(out(&gathered), once);
}

#[test]
fn transforms_are_checked_and_smooth_in_their_exponent() {
    for (lambda, floor) in [(2.5, 1.0), (f64::NAN, 1.0), (0.0, 0.0), (0.0, -1.0), (1.0, f64::INFINITY)] {
        let error = BoxCox::new(lambda, floor).unwrap_err();
        assert!(matches!(error, FrameError::Parameter { .. }), "{error}");
    }
    let g = |lambda, x| BoxCox::new(lambda, 1e-2).unwrap().of(x);
    assert_eq!(g(1.0, 3.0), 2.0);
    assert_eq!(g(0.0, 0.0), 1e-2f64.ln());
    assert_eq!(g(-1.0, -5.0), g(-1.0, 1e-2));
    assert!((g(1e-12, 7.0) - 7f64.ln()).abs() < 1e-10);
}

#[test]
fn what_a_frame_has_is_checked() {
    let image = || Image::filled(2, 1, 3, 1.0);
    let too_few = Optional::new(vec![(Statistic::Position, vec![image()])], None, vec![]).unwrap_err();
    assert_eq!(too_few.to_string(), "optional statistic `position`: 1 images, expected 2");
    let parts = || vec![(Statistic::FourParts, vec![image(); 4])];
    assert!(Optional::new(parts(), None, vec![]).is_err());
    let counts = [3, 3, 2, 2].map(Counts::Uniform);
    let optional = Optional::new(parts(), Some(counts), vec![]).unwrap();
    assert!(optional.check(2, 1).is_ok() && optional.check(1, 2).is_err());
    assert_eq!(optional.four_parts().unwrap().halves(), [image(), image()]);
    assert!(optional.third_moment().is_none() && !optional.is_empty() && Optional::default().is_empty());
    let tapped = |x| Tapped { x, y: 0, first: 0, samples: vec![] };
    let optional = Optional::new(vec![], None, vec![tapped(1)]).unwrap();
    assert_eq!(optional.crop([1, 0], [1, 1], Counts::clone).tapped(), [tapped(0)]);
    assert!(optional.crop([0, 0], [1, 1], Counts::clone).is_empty() && optional.check(1, 1).is_err());
}

#[test]
fn every_row_is_that_of_its_statistic() {
    let of = everything();
    let mut ids: Vec<&str> = of.statistics().iter().map(|statistic| statistic.row().id).collect();
    ids.dedup();
    assert_eq!(ids, ["third-moment", "least", "greatest", "four-parts", "position", "box-cox"]);
    let mut unique: Vec<&str> = TABLE.iter().map(|row| row.id).collect();
    unique.sort_unstable();
    unique.dedup();
    assert_eq!(unique.len(), TABLE.len());
    assert!(TABLE.iter().all(|row| row.images.len() <= 8 && !row.start.is_empty()));
}

#[test]
fn names_round_trip_and_a_wrong_one_is_told_what_there_is() {
    let transforms =
        [(0.0, 1e-3), (-0.0, 1e-3), (0.5, 1e6), (-2.0, 0.125)].map(|(l, f)| BoxCox::new(l, f).unwrap());
    let others = [
        Statistic::ThirdMoment,
        Statistic::Least,
        Statistic::Greatest,
        Statistic::FourParts,
        Statistic::Position,
    ];
    for statistic in others.into_iter().chain(transforms.map(Statistic::BoxCox)) {
        assert_eq!(statistic.to_string().parse::<Statistic>().unwrap(), statistic);
    }
    assert_eq!(Statistic::BoxCox(transforms[1]).to_string(), "box-cox:0:0.001");
    for wrong in
        ["", "fourth-moment", "box-cox", "box-cox:", "box-cox:1", "box-cox:1:x", "box-cox:1:1:1", "least:1"]
    {
        let error = wrong.parse::<Statistic>().unwrap_err();
        assert!(matches!(error, FrameError::UnknownStatistic { .. }), "{wrong}: {error}");
        assert!(error.to_string().contains("third-moment"), "{error}");
    }
    let beyond = "box-cox:3:1".parse::<Statistic>().unwrap_err();
    assert!(matches!(beyond, FrameError::Parameter { .. }), "{beyond}");
}

#[test]
fn parts_are_dealt_in_turn_from_any_sample_on() {
    for first in 0..9u32 {
        let totals: Vec<u32> = (1..40).collect();
        let parts = FourParts::dealt(first, &Counts::PerPixel(totals.clone()));
        for (pixel, total) in totals.into_iter().enumerate() {
            for (part, counts) in parts.iter().enumerate() {
                let dealt = (first..first + total).filter(|index| *index as usize % 4 == part).count();
                assert_eq!(counts.at(pixel) as usize, dealt, "part {part} of {total} from {first}");
            }
        }
    }
    assert_eq!(FourParts::dealt(0, &Counts::PerPixel(vec![7; 3])), [2, 2, 2, 1].map(Counts::Uniform));
}

#[test]
fn a_frame_has_them_in_the_order_of_the_table() {
    let image = || Image::filled(1, 1, 3, 1.0);
    let transform = |lambda| Statistic::BoxCox(BoxCox::new(lambda, 1e-2).unwrap());
    let asked = [transform(0.5), Statistic::Least, transform(-0.5), Statistic::ThirdMoment];
    let recorded = asked.map(|statistic| (statistic, vec![image(); statistic.row().images.len()]));
    let optional = Optional::new(recorded.to_vec(), None, vec![]).unwrap();
    let order: Vec<Statistic> = optional.recorded().iter().map(|(statistic, _)| *statistic).collect();
    assert_eq!(order, [Statistic::ThirdMoment, Statistic::Least, transform(-0.5), transform(0.5)]);
}
