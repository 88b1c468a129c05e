//! What families of intervals cover, against exact and independently simulated values.

use noisefloor_stats::random::Normals;
use noisefloor_stats::{FAMILIES, IntervalNeed, Level, coverage_of, family};
use noisefloor_stats::{TTable, Truth};

#[path = "families/laws.rs"]
mod laws;
#[path = "families/simulation.rs"]
mod simulation;

use laws::Law;
use simulation::{Count, Image, PIXELS};

const LEVELS: [Level; 3] = [Level::TWO_SIDED_95, Level::TWO_SIDED_99, Level::TWO_SIDED_998];

fn count(id: &str, law: Law, n: u32, images: usize, levels: &[Level], seed: u64) -> Vec<Count> {
    let (family, mut random) = (family(id).unwrap(), Normals::new(seed));
    let mut counts = vec![Count::default(); levels.len()];
    for _ in 0..images {
        let image = Image::new(law, n, &mut random);
        for (count, level) in counts.iter_mut().zip(levels) {
            count.add(&image, &image.intervals(family, *level));
        }
    }
    counts
}

/// Whether a measured share is a known one, within 4 standard errors of the measured and what is left of the known.
fn assert_share(got: f64, known: f64, trials: usize, known_error: f64, what: &str) {
    let error = (known * (1.0 - known) / trials as f64).sqrt().hypot(known_error);
    assert!((got - known).abs() <= 4.0 * error, "{what}: {got} instead of {known} ± {error}");
}

#[test]
fn t_covers_exponential_samples_as_simulated_elsewhere() {
    // Covered at 95 %, intervals wholly below and above the mean; covered at 99 and 99.8 %. Standard errors ≤ 0.0004.
    let known = [
        (4, [0.8806, 0.1148, 0.0046], 0.9533, 0.9844),
        (8, [0.8936, 0.1027, 0.0037], 0.9504, 0.9772),
        (16, [0.9134, 0.0815, 0.0051], 0.9619, 0.9818),
        (32, [0.9272, 0.0649, 0.0079], 0.9728, 0.9878),
        (64, [0.9378, 0.0518, 0.0104], 0.9800, 0.9923),
    ];
    for (n, [covered, too_low, too_high], at_99, at_998) in known {
        let images = 40;
        let counts = count("t", Law::Exponential, n, images, &LEVELS, u64::from(n));
        let [got, below, above] = counts[0].shares();
        let trials = images * PIXELS;
        for (got, known) in [
            (got, covered),
            (above, too_low),
            (below, too_high),
            (counts[1].shares()[0], at_99),
            (counts[2].shares()[0], at_998),
        ] {
            assert_share(got, known, trials, 0.0004, &format!("n = {n}"));
        }
    }
}

#[test]
fn t_covers_log_normal_samples_as_simulated_elsewhere() {
    for (n, known) in [(4, [0.8231, 0.9232]), (16, [0.8580, 0.9203]), (64, [0.9055, 0.9558])] {
        let counts = count("t", Law::LogNormal, n, 30, &LEVELS[..2], 100 + u64::from(n));
        for (count, known) in counts.iter().zip(known) {
            assert_share(count.shares()[0], known, 30 * PIXELS, 0.0006, &format!("n = {n}"));
        }
    }
}

/// Coverage of the t-interval by adding up the probabilities of all counts of ones.
fn exact_bernoulli(q: f64, n: u32, level: Level) -> f64 {
    let t = TTable::new(level, n).at(n);
    let (count, mut probability) = (f64::from(n), (1.0 - q).powi(n as i32));
    let mut covered = 0.0;
    for ones in 0..=n {
        let mean = f64::from(ones) / count;
        let spread = (mean * (1.0 - mean) / (count - 1.0)).sqrt();
        if (mean - q).abs() <= t * spread {
            covered += probability;
        }
        probability *= f64::from(n - ones) / f64::from(ones + 1) * (q / (1.0 - q));
    }
    covered
}

#[test]
fn t_covers_rare_events_as_enumerated() {
    let known = [
        (0.02, 4, [0.077_632; 3]),
        (0.02, 16, [0.276_191, 0.276_202, 0.276_202]),
        (0.02, 64, [0.723_767, 0.725_541, 0.725_546]),
        (0.02, 256, [0.881_585, 0.964_443, 0.964_678]),
        (0.1, 4, [0.343_800; 3]),
        (0.1, 16, [0.811_401, 0.814_637, 0.814_698]),
        (0.1, 64, [0.951_172, 0.960_646, 0.990_427]),
    ];
    for (q, n, covered) in known {
        for (level, known) in LEVELS.into_iter().zip(covered) {
            let exact = exact_bernoulli(q, n, level);
            assert!((exact - known).abs() < 1e-6, "q = {q}, n = {n}: {exact} instead of {known}");
        }
        let counts = count("t", Law::Bernoulli(q), n, 10, &LEVELS, 200 + u64::from(n));
        for (count, known) in counts.iter().zip(covered) {
            assert_share(count.shares()[0], known, 10 * PIXELS, 0.0, &format!("q = {q}, n = {n}"));
        }
    }
}

#[test]
fn a_shifted_centre_gains_as_little_as_published() {
    let (t, johnson) = (family("t").unwrap(), family("johnson").unwrap());
    for (law, n, gain) in [
        (Law::Exponential, 4, 0.0008),
        (Law::Exponential, 8, 0.0025),
        (Law::Exponential, 16, 0.0027),
        (Law::Exponential, 32, 0.0020),
        (Law::LogNormal, 16, 0.005),
    ] {
        let (images, mut random) = (40, Normals::new(300 + u64::from(n)));
        let (mut gained, mut lost) = (0u32, 0u32);
        for _ in 0..images {
            let image = Image::new(law, n, &mut random);
            let [old, new] = [t, johnson].map(|family| image.intervals(family, Level::TWO_SIDED_95));
            for (i, truth) in image.truth.iter().enumerate() {
                let [old, new] = [&old, &new].map(|ends| ends.low[i] <= *truth && *truth <= ends.high[i]);
                gained += u32::from(new && !old);
                lost += u32::from(old && !new);
            }
        }
        let trials = f64::from(images) * PIXELS as f64;
        let got = (f64::from(gained) - f64::from(lost)) / trials;
        let error = f64::from(gained + lost).sqrt() / trials;
        // Published to a hundredth of a percent, the last to a tenth; simulated with 4·10⁵ draws.
        let known_error = if gain == 0.005 { 0.0005 } else { 0.0002 };
        assert!((got - gain).abs() <= 4.0 * error.hypot(known_error), "{law:?}, {n}: {got} ± {error}");
        assert!(got < 0.01, "{got} is no gain to speak of");
    }
}

/// One line of the table of the example `coverage_of_families`.
struct Line {
    family: String,
    law: Law,
    n: u32,
    level: Level,
    shares: [f64; 3],
    error: f64,
}

fn table() -> Vec<Line> {
    let number = |text: &str| text.parse::<f64>().unwrap();
    let line = |text: &str| {
        let [family, law, n, level, covered, below, above, error] =
            <[&str; 8]>::try_from(text.split(',').collect::<Vec<_>>()).unwrap();
        Line {
            family: family.into(),
            law: Law::ALL.into_iter().find(|known| known.name() == law).unwrap(),
            n: n.parse().unwrap(),
            level: Level::two_sided(number(level)).unwrap(),
            shares: [covered, below, above].map(number),
            error: number(error),
        }
    };
    include_str!("coverage_of_families.csv").lines().skip(1).map(line).collect()
}

#[test]
fn the_table_has_every_family_and_a_thinned_selection_of_it_is_found_again() {
    let table = table();
    assert_eq!(table.len(), FAMILIES.len() * Law::ALL.len() * 5 * LEVELS.len());
    let images = 8;
    // 17 shares no factor with the numbers of levels, families, counts and laws: each of them occurs.
    for (at, line) in table.iter().enumerate().step_by(17) {
        let neighbours = family(&line.family).unwrap().needs().contains(&IntervalNeed::Neighbours);
        let counts = count(&line.family, line.law, line.n, images, &[line.level], 9000 + at as u64);
        let [covered, below, above] = counts[0].shares();
        let trials = (images * PIXELS) as f64;
        // Of images that were not seen the spread is that of the table: 400 images of the same size.
        let error = line.error * (400.0 / images as f64).sqrt();
        let tolerance = 4.0 * error.hypot(line.error);
        let what = format!("{} {} {} {:?}", line.family, line.law.name(), line.n, line.level);
        // A rate of 0 or 1 shows no spread: then what as many trials may miss with a probability of 10⁻⁴.
        let rare = 9.3 / trials;
        assert!((covered - line.shares[0]).abs() <= tolerance + rare, "{what}: {covered} {tolerance}");
        for (got, known) in
            [(below, line.shares[1]), (above, line.shares[2])].into_iter().filter(|_| !neighbours)
        {
            let error = (known * (1.0 - known) / trials).sqrt();
            assert!((got - known).abs() <= 4.0 * 1.01 * error + rare, "{what}: {got} instead of {known}");
        }
    }
}

#[test]
fn the_side_of_misses_is_counted_as_by_hand() {
    let mut random = Normals::new(5);
    let image = Image::new(Law::Exponential, 4, &mut random);
    let planes = image.planes();
    let truth: Vec<f32> = image.truth.iter().map(|truth| *truth as f32).collect();
    let truth = Truth { mean: &truth, variance: None };
    for family in FAMILIES {
        let intervals = image.intervals(*family, Level::TWO_SIDED_95);
        let tally = coverage_of(&intervals, &planes.observed, &truth, Level::TWO_SIDED_95, None).unwrap()[0];
        let mut count = Count::default();
        count.add(&image, &intervals);
        let [covered, below, above] = count.shares().map(|share| (share * PIXELS as f64).round() as u64);
        assert_eq!((tally.covered, tally.truth_below, tally.truth_above), (covered, below, above));
    }
}
