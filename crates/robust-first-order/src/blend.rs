//! Weighted means of what several models say of a pixel (Eq. 13).

use rayon::prelude::*;

use crate::centres::Tile;

/// Sums over a tile and what its windows reach around it.
#[derive(Debug, Clone)]
pub(crate) struct Patch {
    x: usize,
    y: usize,
    width: usize,
    height: usize,
    /// Planes of sums, one after the other.
    sums: Vec<f32>,
    /// The model that weighs most.
    heaviest: Vec<Heaviest>,
}

/// What is kept of the model that weighs most in a pixel.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Heaviest {
    pub weight: f32,
    /// Its window radius.
    pub radius: f32,
    /// Its bandwidth.
    pub k: f32,
    /// How many models cover the pixel.
    pub models: u32,
}

impl Patch {
    /// `planes` planes of zeros for a tile of an image of this size, and the heaviest model if asked for.
    pub fn new(
        tile: &Tile,
        reach: usize,
        (width, height): (usize, usize),
        planes: usize,
        heaviest: bool,
    ) -> Self {
        let (x, y) = (tile.x.saturating_sub(reach), tile.y.saturating_sub(reach));
        let (right, bottom) =
            ((tile.x + tile.width + reach).min(width), (tile.y + tile.height + reach).min(height));
        let (wide, tall) = (right - x, bottom - y);
        let heaviest = if heaviest { vec![Heaviest::default(); wide * tall] } else { Vec::new() };
        Self { x, y, width: wide, height: tall, sums: vec![0.0; planes * wide * tall], heaviest }
    }

    /// Place of a pixel of the image, which must be within.
    #[inline]
    pub fn place(&self, x: usize, y: usize) -> usize {
        (y - self.y) * self.width + x - self.x
    }

    /// Where each of its rows begins: in a plane of its own and in one of an image of this width.
    fn rows(&self, width: usize) -> impl Iterator<Item = (usize, usize)> + use<> {
        let (x, y, own) = (self.x, self.y, self.width);
        (0..self.height).map(move |j| (j * own, (y + j) * width + x))
    }

    /// Adds to the planes from `first` on: the weight, then values times the weight.
    #[inline]
    pub fn add<const N: usize>(&mut self, first: usize, place: usize, weight: f32, values: [f32; N]) {
        let plane = self.width * self.height;
        self.sums[first * plane + place] += weight;
        for (i, value) in values.into_iter().enumerate() {
            self.sums[(first + 1 + i) * plane + place] += weight * value;
        }
    }

    /// Notes a model.
    #[inline]
    pub fn note(&mut self, place: usize, weight: f32, radius: usize, k: f32) {
        let heaviest = &mut self.heaviest[place];
        heaviest.models += 1;
        if weight > heaviest.weight {
            (heaviest.weight, heaviest.radius, heaviest.k) = (weight, radius as f32, k);
        }
    }
}

/// Sums over the image.
#[derive(Debug)]
pub(crate) struct Sums {
    width: usize,
    pub planes: Vec<Vec<f32>>,
    pub heaviest: Vec<Heaviest>,
}

impl Sums {
    pub fn new((width, height): (usize, usize), planes: usize, heaviest: bool) -> Self {
        let heaviest = if heaviest { vec![Heaviest::default(); width * height] } else { Vec::new() };
        Self { width, planes: vec![vec![0.0; width * height]; planes], heaviest }
    }

    /// Adds patches in their order, which no number of threads changes.
    pub fn add(&mut self, patches: &[Patch]) {
        let Self { width, planes, heaviest } = self;
        let width = *width;
        planes.par_iter_mut().enumerate().for_each(|(plane, out)| {
            for patch in patches {
                let from = &patch.sums[plane * patch.width * patch.height..];
                for (here, there) in patch.rows(width) {
                    let row = &from[here..][..patch.width];
                    out[there..][..patch.width].iter_mut().zip(row).for_each(|(sum, v)| *sum += v);
                }
            }
        });
        if heaviest.is_empty() {
            return;
        }
        for patch in patches {
            for (here, there) in patch.rows(width) {
                let row = &patch.heaviest[here..][..patch.width];
                for (out, new) in heaviest[there..][..patch.width].iter_mut().zip(row) {
                    let models = out.models + new.models;
                    if new.weight > out.weight {
                        *out = *new;
                    }
                    out.models = models;
                }
            }
        }
    }

    /// Plane number `plane` over the weights of plane number `weights`; `otherwise` where nothing weighs.
    pub fn mean(&self, plane: usize, weights: usize, otherwise: &[f32]) -> Vec<f32> {
        let sums = self.planes[plane].iter().zip(&self.planes[weights]);
        sums.zip(otherwise).map(|((sum, w), other)| if *w > 0.0 { sum / w } else { *other }).collect()
    }
}
