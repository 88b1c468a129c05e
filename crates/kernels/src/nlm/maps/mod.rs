//! The second fast form, for rules that look at the weights of whole offsets ([`WeightRules`]): map by map instead of vector by
//! vector.
//!
//! For each tile and each pair of opposite offsets: maps of Δ² over the tile and what patches and smoothing reach around it
//! (`squares`), patch means by box sums (`boxes`), weights (`exponential`), what opposite neighbours share (`pairs`), smoothing,
//! then what the weights add to the sums of each pass (`sums`). All loops run over rows of slices, in plain arithmetic, for
//! the compiler to vectorise; each pixel's sums are taken in one order whatever the tile.

mod boxes;
mod counts;
pub(crate) mod exponential;
mod features;
mod frames;
mod guided;
mod layout;
mod moved;
mod offset;
mod pairs;
mod squares;
mod sums;
mod sweep;

use self::boxes::Region;
use self::counts::Counts;
use self::features::FeatureSquare;
use self::frames::Around;
use self::layout::{Layout, Place};
use self::squares::Square;
use self::sums::Finish;
use self::sweep::{Step, Sweep, Work};
use super::output::{by_tiles, floors};
use super::{Filtered, NlmInputs, NlmParams, Pass, Rule, Taps};
use crate::engine::{Copies, InstructionSet, Tile, TileRows};

/// Tile, (width, height) in pixels: large, because what is around it is computed for every tile that it is around.
pub(super) const TILE: (usize, usize) = (96, 32);

/// One call's constants, shared by all workers.
struct Job<'a> {
    params: &'a NlmParams,
    passes: &'a [Pass],
    inputs: &'a NlmInputs<'a>,
    level: InstructionSet,
    layout: Layout,
    /// The different τ.
    floors: Vec<f32>,
    /// Channels of each feature.
    features: Vec<usize>,
    rule: Rule,
}

/// A worker's memory.
struct Scratch {
    here: Around,
    there: Option<Around>,
    work: Work,
}

/// Runs checked passes.
pub(super) fn filter(
    params: &NlmParams,
    passes: &[Pass],
    inputs: &NlmInputs<'_>,
    level: InstructionSet,
    tile_size: (usize, usize),
) -> Vec<Filtered> {
    let job = Job {
        params,
        passes,
        inputs,
        level,
        layout: Layout::new(params, passes, inputs, tile_size),
        floors: floors(passes),
        features: inputs.frame.features.iter().map(Vec::len).collect(),
        rule: inputs.perturbation.map_or(Rule::Exact, |p| p.rule),
    };
    by_tiles(
        params,
        passes,
        job.layout.targets,
        tile_size,
        || job.scratch(),
        |scratch, tile, rows| job.run(scratch, tile, rows),
    )
}

impl Job<'_> {
    fn scratch(&self) -> Scratch {
        let beside = !self.inputs.neighbors.is_empty();
        Scratch {
            here: Around::new(&self.layout),
            there: beside.then(|| Around::new(&self.layout)),
            work: Work::new(&self.layout, self.passes, self.floors.len()),
        }
    }

    fn run(&self, scratch: &mut Scratch, tile: Tile, out: Vec<TileRows<'_>>) {
        let (width, height) = (self.params.width, self.params.height);
        let copies = Copies { width, height, tile };
        let place = Place { tile, width, height };
        let steps: Vec<Step> = self.passes.iter().map(|pass| self.step(&place, pass)).collect();
        let Scratch { here, there, work } = scratch;
        here.fill(&self.layout, &copies, &self.inputs.frame);
        work.sums.iter_mut().for_each(sums::Sums::clear);
        if let (Some(bends), Some(perturbation)) = (&mut work.bends, &self.inputs.perturbation) {
            for (to, step) in bends.steps.iter_mut().zip(perturbation.step) {
                copies.own(&self.layout.pixel, step, to, |v| v);
            }
        }
        let mut sweep = |here: &Around, beside: Option<&Around>| {
            self.level.run(Sweep {
                layout: &self.layout,
                place,
                square: Square::new(self.params),
                feature: FeatureSquare::new(self.params),
                rules: self.params.rules,
                floors: &self.floors,
                features: &self.features,
                steps: &steps,
                rule: self.rule,
                here,
                beside,
                work: &mut *work,
            });
        };
        sweep(here, None);
        if let Some(there) = there {
            for frame in &self.inputs.neighbors {
                there.fill(&self.layout, &copies, frame);
                sweep(here, Some(there));
            }
        }
        let finish = Finish {
            layout: &self.layout,
            place,
            center: self.params.center,
            inputs: self.inputs,
            joint: self.rule == Rule::Joint,
        };
        let mut out = out.into_iter();
        for (pass, sums) in self.passes.iter().zip(&work.sums) {
            finish.pass(pass, sums, &mut out);
        }
    }

    fn step(&self, place: &Place, pass: &Pass) -> Step {
        let patch = pass.patch.unwrap_or(0);
        let radius = self.params.rules.smoothing.radius(patch);
        let region = |around| Region { width: place.tile.width, height: place.tile.height, around };
        Step {
            pass: *pass,
            floor: self.floors.iter().position(|&floor| floor == pass.floor).unwrap_or(0),
            taps: Counts::new(place, region(radius), patch, self.params.rules.taps),
            boxes: Counts::new(place, region(0), radius, Taps::Clipped),
        }
    }
}
