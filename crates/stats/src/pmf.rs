//! Binomial and Poisson probabilities by saddle points (Loader 2000, "Fast and accurate computation of binomial
//! probabilities"): no difference of large logarithms, so that they are accurate at any number of trials.

use std::f64::consts::TAU;

/// ln n! − ln(√(2πn)(n/e)ⁿ), for n ≥ 1.
fn stirling_error(n: f64) -> f64 {
    if n <= 15.0 {
        let log_factorial: f64 = (2..=n as u32).map(|k| f64::from(k).ln()).sum();
        return log_factorial - ((n + 0.5) * n.ln() - n + 0.5 * TAU.ln());
    }
    let square = n * n;
    // The next term is below 1e-15 at n = 16.
    (1.0 / 12.0
        - (1.0 / 360.0 - (1.0 / 1260.0 - (1.0 / 1680.0 - 1.0 / 1188.0 / square) / square) / square) / square)
        / n
}

/// x·ln(x/m) + m − x for x, m > 0, without cancellation where x is near m (Loader 2000, section 4).
fn deviance(x: f64, m: f64) -> f64 {
    let difference = x - m;
    if difference.abs() >= 0.1 * (x + m) {
        return x * (x / m).ln() - difference;
    }
    let v = difference / (x + m); // x + m > 0
    let mut sum = difference * v;
    let mut power = 2.0 * x * v;
    for j in 1..1000 {
        power *= v * v;
        let next = sum + power / f64::from(2 * j + 1);
        if next == sum {
            break;
        }
        sum = next;
    }
    sum
}

/// P(X = k) for X binomial with `n` trials of probability `p` in [0, 1] and `q` = 1 − p, which the caller may know more
/// exactly; 0 for k > n.
pub(crate) fn binomial(k: u64, n: u64, p: f64, q: f64) -> f64 {
    if k > n {
        return 0.0;
    }
    if p <= 0.0 || q <= 0.0 {
        return f64::from(u8::from(k == if p <= 0.0 { 0 } else { n }));
    }
    let (hits, trials) = (k as f64, n as f64);
    let misses = trials - hits;
    // Of p and q the smaller one is the exact one.
    let log = |own: f64, other: f64| if own > other { (-other).ln_1p() } else { own.ln() };
    if k == 0 || k == n {
        return (trials * if k == 0 { log(q, p) } else { log(p, q) }).exp();
    }
    let log = stirling_error(trials)
        - stirling_error(hits)
        - stirling_error(misses)
        - deviance(hits, trials * p)
        - deviance(misses, trials * q);
    log.exp() * (trials / (TAU * hits * misses)).sqrt() // 0 < k < n
}

/// P(X = k) for X Poisson with mean `m` > 0.
pub(crate) fn poisson(k: u64, m: f64) -> f64 {
    if k == 0 {
        return (-m).exp();
    }
    let x = k as f64;
    (-stirling_error(x) - deviance(x, m)).exp() / (TAU * x).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn probabilities_agree_with_products() {
        for (n, p) in [(1u64, 0.3), (7, 0.02), (24, 0.5), (40, 0.97)] {
            let q: f64 = 1.0 - p;
            let mut choose = 1.0;
            for k in 0..=n {
                let product = choose * f64::powi(p, k as i32) * q.powi((n - k) as i32);
                let ratio = binomial(k, n, p, q) / product;
                assert!((ratio - 1.0).abs() < 1e-13, "{k} of {n} at {p}: {ratio}");
                choose *= (n - k) as f64 / (k + 1) as f64;
            }
        }
        let mut product = (-3.5f64).exp();
        for k in 0..40u64 {
            assert!((poisson(k, 3.5) / product - 1.0).abs() < 1e-13, "{k}");
            product *= 3.5 / (k + 1) as f64;
        }
        assert_eq!(
            (binomial(0, 5, 0.0, 1.0), binomial(1, 5, 0.0, 1.0), binomial(5, 5, 1.0, 0.0)),
            (1.0, 0.0, 1.0)
        );
        assert_eq!(binomial(6, 5, 0.5, 0.5), 0.0);
    }

    #[test]
    fn the_middle_of_a_hundred_million_trials_is_that_of_stirlings_series() {
        // C(2m, m)/4^m = (1 − 1/(8m) + 1/(128m²) + …)/√(πm).
        let m = 5e7;
        let series = (1.0 - 1.0 / (8.0 * m)) / (std::f64::consts::PI * m).sqrt();
        assert!((binomial(50_000_000, 100_000_000, 0.5, 0.5) / series - 1.0).abs() < 1e-13);
    }
}
