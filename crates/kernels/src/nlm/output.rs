//! What passes give, filled tile by tile, and what they share.

use super::{Filtered, NlmParams, Pass};
use crate::engine::{Tile, TileRows, for_each_tile};

/// The output of each pass, with `targets` planes each, of which `body` fills the rows of its tile: the planes of the first pass
/// in the order of [`planes_mut`], then those of the next.
pub(super) fn by_tiles<S>(
    params: &NlmParams,
    passes: &[Pass],
    targets: usize,
    tile_size: (usize, usize),
    scratch: impl Fn() -> S + Sync + Send,
    body: impl Fn(&mut S, Tile, Vec<TileRows<'_>>) + Sync + Send,
) -> Vec<Filtered> {
    let size = params.width * params.height;
    let mut out: Vec<Filtered> = passes.iter().map(|pass| empty(size, targets, pass)).collect();
    for_each_tile(params.width, tile_size, out.iter_mut().flat_map(planes_mut), scratch, body);
    out
}

/// The different τ.
pub(super) fn floors(passes: &[Pass]) -> Vec<f32> {
    let mut floors: Vec<f32> = Vec::new();
    for pass in passes {
        if !floors.contains(&pass.floor) {
            floors.push(pass.floor);
        }
    }
    floors
}

/// Planes of zeros for a pass over images of `size` pixels.
fn empty(size: usize, targets: usize, pass: &Pass) -> Filtered {
    let plane = || vec![0.0f32; size];
    Filtered {
        planes: (0..targets).map(|_| plane()).collect(),
        weight_sum: plane(),
        center_share: plane(),
        derivative: (0..if pass.derivative { 3 } else { 0 }).map(|_| plane()).collect(),
    }
}

/// All planes: the targets, Σ w, the centre's share, then the derivatives.
fn planes_mut(filtered: &mut Filtered) -> impl Iterator<Item = &mut [f32]> {
    let sums = [&mut filtered.weight_sum, &mut filtered.center_share];
    filtered.planes.iter_mut().chain(sums).chain(&mut filtered.derivative).map(Vec::as_mut_slice)
}
