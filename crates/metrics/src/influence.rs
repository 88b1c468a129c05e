//! Influence of single parts of the reference on the metrics of an image, over all pixels and per class.
//!
//! With parts P_k of half A: L_k = (weighted mean over pixels of (x−B)(P_k−A))/√(n_A(n_A−1)) for the squared error, and
//! n_A − 1 times what deleting the part changes, over the same root, for the relative one, whose denominator it moves too;
//! likewise for half B. Without parts: sums of (x−(A+B)/2)(A−B) over groups of blocks of pixels, which have the spread of
//! what the reference adds.
//!
//! The energy x̄/r̄ moves by −x̄/r̄² with r̄ = pĀ + qB̄: L_k = −(x̄/r̄²)·p·(P̄_k−Ā)/√(n_A(n_A−1)), without parts the sums of
//! −(x̄/r̄²)(A−B)/2. The bias by r̄ in the denominator is of the order of its relative variance, which is that of a mean
//! over the image, and is left.

use std::collections::BTreeMap;

use noisefloor_frame::{Image, SquaredError};

use crate::blocks::blocks;
use crate::contribution::{Contribution, Contributions};
use crate::pixels::Pixels;
use crate::reference_noise::ReferenceNoise;
use crate::truth::{Truth, halves_term};
use crate::weight::weight;

/// Groups of blocks of a reference without parts.
const GROUPS: usize = 16;
/// Fewer blocks say too little about a spread.
const FEWEST_BLOCKS: usize = 4;

/// Sums over the pixels of a class, kept by the trimmed mean or not.
#[derive(Debug, Clone, Default)]
struct Sums {
    pixels: usize,
    bias: f64,
    noise: f64,
    /// Of the image and of the reference.
    light: [f64; 2],
    squared: Vec<f64>,
    relative: Vec<f64>,
    energy: Vec<f64>,
}

impl Sums {
    fn new(length: usize) -> Self {
        let zeros = || vec![0.0; length];
        Self { squared: zeros(), relative: zeros(), energy: zeros(), ..Self::default() }
    }

    fn plus(mut self, other: &Self) -> Self {
        self.pixels += other.pixels;
        self.bias += other.bias;
        self.noise += other.noise;
        self.light = [self.light[0] + other.light[0], self.light[1] + other.light[1]];
        let influences = [
            (&mut self.squared, &other.squared),
            (&mut self.relative, &other.relative),
            (&mut self.energy, &other.energy),
        ];
        for (own, other) in influences {
            own.iter_mut().zip(other).for_each(|(a, b)| *a += b);
        }
        self
    }
}

/// Contributions over all pixels, and per class that has pixels. `kept` says which pixels the trimmed mean keeps.
pub(crate) fn contributions(
    (truth, noise): (&Truth<'_>, &ReferenceNoise),
    test: &Image,
    errors: &Pixels<'_>,
    kept: &[bool],
) -> (Contributions, BTreeMap<String, Contributions>) {
    if matches!(truth.squared_error(), SquaredError::Exact | SquaredError::Uncorrected) {
        return Default::default();
    }
    let source = Source::new((truth, noise), errors);
    let classes = truth.classes.map_or(&[][..], |classes| classes.names);
    let mut buckets = vec![[Sums::new(source.length()), Sums::new(source.length())]; classes.len().max(1)];
    for p in (0..test.pixels()).filter(|&p| errors.valid[p]) {
        let class = truth.classes.map_or(0, |classes| usize::from(classes.of_pixel[p]));
        let sums = &mut buckets[class][usize::from(kept[p])];
        sums.pixels += 1;
        sums.bias += errors.bias[p];
        sums.noise += errors.relative_plain[p] - (errors.relative[p] + errors.bias[p]);
        sums.light = [sums.light[0] + errors.value[p], sums.light[1] + errors.truth[p]];
        source.add(test, p, sums);
    }
    let whole = |[cut, kept]: &[Sums; 2]| cut.clone().plus(kept);
    let total = |of: &dyn Fn(&[Sums; 2]) -> Sums| {
        buckets.iter().map(of).fold(Sums::new(source.length()), |sum, part| sum.plus(&part))
    };
    let mut all = source.named(&total(&whole), noise.product);
    if let Some(relative) = source.named(&total(&|[_, kept]| kept.clone()), noise.product).remove("relmse") {
        all.insert("relmse_trimmed".to_owned(), relative);
    }
    let named = classes.iter().zip(&buckets).enumerate().filter_map(|(class, (name, sums))| {
        let sums = whole(sums);
        let product = noise.class_products.get(class).copied().unwrap_or_default();
        (sums.pixels > 0).then(|| (name.clone(), source.named(&sums, product)))
    });
    (all, named.collect())
}

/// What the influences are taken of.
enum Source<'m> {
    /// The reference's parts.
    Parts { truth: &'m Truth<'m>, noise: &'m ReferenceNoise, halves: &'m [Image; 2] },
    /// The difference of its halves, by the group of each pixel's block.
    Halves { truth: &'m Truth<'m>, halves: &'m [Image; 2], group: Vec<usize>, groups: usize },
    /// Nothing: only the bias is known.
    Nothing,
}

impl<'m> Source<'m> {
    fn new((truth, noise): (&'m Truth<'m>, &'m ReferenceNoise), errors: &Pixels<'_>) -> Self {
        let Some(halves) = &truth.reference.frame.color.halves else { return Self::Nothing };
        if truth.parts_in_a().is_some() {
            return Self::Parts { truth, noise, halves };
        }
        let blocks = blocks(truth.mean.width(), truth.mean.height(), |p| errors.valid[p]);
        if blocks.len() < FEWEST_BLOCKS {
            return Self::Nothing;
        }
        let groups = blocks.len().min(GROUPS);
        let mut group = vec![0; errors.valid.len()];
        for (index, block) in blocks.iter().enumerate() {
            block.iter().for_each(|&p| group[p] = index % groups);
        }
        Self::Halves { truth, halves, group, groups }
    }

    fn length(&self) -> usize {
        match self {
            Self::Parts { noise, .. } => noise.centred.iter().map(Vec::len).sum(),
            Self::Halves { groups, .. } => *groups,
            Self::Nothing => 0,
        }
    }

    /// Adds the three channels of a pixel.
    fn add(&self, test: &Image, p: usize, sums: &mut Sums) {
        let n = test.pixels();
        let value = |image: &Image, i: usize| f64::from(image.data()[i]);
        match self {
            Self::Nothing => {}
            Self::Halves { truth, halves: [a, b], group, .. } => {
                for i in [p, n + p, 2 * n + p] {
                    let (x, a, b) = (value(test, i), value(a, i), value(b, i));
                    let linear = (x - 0.5 * (a + b)) * (a - b);
                    sums.squared[group[p]] += linear;
                    sums.relative[group[p]] += halves_term(truth, i, x, a, b);
                    sums.energy[group[p]] += 0.5 * (a - b);
                }
            }
            Self::Parts { truth, noise, halves } => {
                let centred = &noise.centred;
                let in_a = centred[0].len();
                let share = in_a as f64 / (in_a + centred[1].len()) as f64; // both have at least 2
                for i in [p, n + p, 2 * n + p] {
                    let (x, r, w) = (value(test, i), value(truth.mean, i), truth.weight[i]);
                    let residuals = [x - value(&halves[0], i), x - value(&halves[1], i)];
                    let whole = residuals[0] * residuals[1] * w;
                    for (half, (parts, share)) in centred.iter().zip([share, 1.0 - share]).enumerate() {
                        let (own, other) = (residuals[half], residuals[1 - half]);
                        let (degrees, first) = ((parts.len() - 1) as f64, half * in_a);
                        for (k, part) in parts.iter().enumerate() {
                            let off = f64::from(part[i]);
                            let step = off / degrees; // at least 1
                            let without = (own + step) * other * weight(r - share * step);
                            sums.squared[first + k] += other * off;
                            sums.relative[first + k] += degrees * (without - whole);
                            sums.energy[first + k] += share * off;
                        }
                    }
                }
            }
        }
    }

    fn named(&self, sums: &Sums, [product, relative_product]: [f64; 2]) -> Contributions {
        let count = (3 * sums.pixels).max(1) as f64;
        let scaled = |sums: &[f64]| -> Vec<f64> {
            match self {
                Self::Parts { noise, .. } => {
                    let (a, b) = sums.split_at(noise.centred[0].len());
                    [a, b].into_iter().flat_map(|half| influences(half, count)).collect()
                }
                _ => sums.iter().map(|sum| sum / count).collect(),
            }
        };
        let per_pixel = |sum: f64| sum / sums.pixels.max(1) as f64;
        let of = |bias, noise, sums: &[f64], product: f64| Contribution {
            bias,
            noise,
            parts: scaled(sums),
            product: if matches!(self, Self::Parts { .. }) { product.sqrt() } else { 0.0 },
        };
        let mut out = Contributions::new();
        out.insert(
            "relmse".to_owned(),
            of(per_pixel(sums.bias), per_pixel(sums.noise), &sums.relative, relative_product),
        );
        if !matches!(self, Self::Nothing) {
            out.insert("mse".to_owned(), of(0.0, 0.0, &sums.squared, product));
            let [value, truth] = sums.light.map(per_pixel);
            if truth > 0.0 {
                let moved: Vec<f64> = sums.energy.iter().map(|sum| -value / (truth * truth) * sum).collect();
                out.insert("energy".to_owned(), of(0.0, 0.0, &moved, 0.0));
            }
        }
        out
    }
}

/// Sums of one half, centred and scaled to influences.
fn influences(sums: &[f64], count: f64) -> impl Iterator<Item = f64> {
    let n = sums.len() as f64; // at least 2
    let mean = sums.iter().sum::<f64>() / n;
    let scale = count * (n * (n - 1.0)).sqrt();
    sums.iter().map(move |sum| (sum - mean) / scale)
}
