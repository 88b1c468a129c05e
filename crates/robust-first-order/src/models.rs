//! Passes over the image: errors of every bandwidth step by step, growth of the set of centres, the blend.

use noisefloor_kernels::regression::models::Field;
use rayon::prelude::*;

use crate::Params;
use crate::blend::Sums;
use crate::centres::{self, Center, Tile};
use crate::params::Assembled;
use crate::settings::Settings;
use crate::tile::{ASSEMBLED, Assembly, Pass, Work};

/// Tiles whose sums are held at a time: 91 MiB at 800×800.
const TILES: usize = 256;

/// All models of a frame, blended.
#[derive(Debug)]
pub(crate) struct Modelled {
    pub sums: Sums,
    pub centers: Vec<Center>,
}

/// Eq. 9 to Eq. 13 for all centres, with the steps of Eq. 11 one after the other over the whole image. `none` is y_t and Var_t where no model says anything.
pub(crate) fn model(
    size: (usize, usize),
    tiles: &[Tile],
    field: &Field,
    settings: &Settings,
    params: &Params,
    none: &Assembly,
    mut finished: impl FnMut(&'static str),
) -> Modelled {
    let mut centers: Vec<Vec<Center>> = tiles.iter().map(|tile| centres::first(tile, params)).collect();
    let mut images: Vec<Vec<Assembly>> = Vec::new();
    // A model that starts from what it made itself needs no image of all.
    let first = if settings.assembled == Assembled::Local { settings.steps } else { 1 };
    for step in first..=settings.steps {
        let last = step == settings.steps;
        // Sec. 3.4 and 3.5: centres are added with the bandwidths of the first step, and once more with the last.
        let pass = Pass { size, settings, field, images: &images, step, grows: last || step == 1, last };
        let sums = all(&pass, tiles, &mut centers);
        finished(["models, step 1", "models, step 2", "models, step 3"][step.clamp(1, 3) - 1]);
        if last {
            return Modelled { sums, centers: centers.concat() };
        }
        let count = pass.planes() / ASSEMBLED;
        images.push((0..count).map(|k| assembly(&sums, ASSEMBLED * k, none)).collect());
    }
    // There is a last step, as there is at least one.
    Modelled { sums: Sums::new(size, 0, false), centers: Vec::new() }
}

fn all(pass: &Pass<'_>, tiles: &[Tile], centers: &mut [Vec<Center>]) -> Sums {
    let mut sums = Sums::new(pass.size, pass.planes(), pass.last);
    for (tiles, centers) in tiles.chunks(TILES).zip(centers.chunks_mut(TILES)) {
        let work = tiles.par_iter().zip(centers.par_iter_mut()).with_max_len(1);
        let patches: Vec<_> = work
            .map_init(
                || Work::new(pass),
                |work, (tile, centers)| {
                    let patch;
                    (*centers, patch) = pass.run(tile, std::mem::take(centers), work);
                    patch
                },
            )
            .collect();
        sums.add(&patches);
    }
    sums
}

fn assembly(sums: &Sums, first: usize, none: &Assembly) -> Assembly {
    Assembly {
        value: [0, 1, 2].map(|c| sums.mean(first + 1 + c, first, &none.value[c])),
        variance: sums.mean(first + 4, first, &none.variance),
    }
}
