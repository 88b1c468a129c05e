//! The regression: tile by tile the weights of all windows, then row by row models and what they predict.

use super::distances::Group;
use super::guide::GROUP;
use super::job::{Job, TILE, View};
use super::model::Model;
use super::params::{Fit, Planes, Solver};
use super::prediction::Prediction;
use super::solve::Normal;
use super::units;
use super::weigh::Weigh;
use crate::engine::{Copies, InstructionSet, Plane, Scratch, Tile, Window, for_each_tile, map_tiles};

/// A worker's memory.
struct Memory {
    single: Scratch,
    double: Scratch<f64>,
}

/// Runs a checked call.
pub(super) fn regress(fit: &Fit, planes: &Planes<'_>, level: InstructionSet) -> [Vec<f32>; 3] {
    let weighting = fit.weighting;
    let job = Job::new(fit, planes, level);
    let size = (weighting.width, weighting.height);
    let predictions = map_tiles(size, TILE, || job.memory(), |memory, tile| job.run(memory, tile));
    let mut out = [0, 1, 2].map(|_| vec![0.0; weighting.width * weighting.height]);
    let across = weighting.width.div_ceil(TILE.0);
    for_each_tile(
        weighting.width,
        TILE,
        out.iter_mut().map(Vec::as_mut_slice),
        || vec![0.0f64; 4 * TILE.0],
        |sums, tile, mut rows| {
            for j in 0..tile.height {
                sums.fill(0.0);
                // All tiles whose windows reach here, in one order.
                for ty in (tile.y / TILE.1).saturating_sub(1)..=tile.y / TILE.1 + 1 {
                    for tx in (tile.x / TILE.0).saturating_sub(1)..=tile.x / TILE.0 + 1 {
                        if tx < across
                            && let Some(prediction) = predictions.get(ty * across + tx)
                        {
                            prediction.add(tile, j, sums, TILE.0);
                        }
                    }
                }
                for (c, rows) in rows.iter_mut().enumerate() {
                    for (i, to) in rows[j].iter_mut().enumerate() {
                        // The pixel's own model has a weight of at least 1e-4.
                        *to = (sums[c * TILE.0 + i] / sums[3 * TILE.0 + i]) as f32;
                    }
                }
            }
        },
    );
    out
}

impl Job<'_> {
    fn memory(&self) -> Memory {
        Memory {
            single: Scratch::new(self.single_sizes().iter().sum()),
            double: Scratch::new(self.double_sizes().iter().sum()),
        }
    }

    fn run(&self, memory: &mut Memory, tile: Tile) -> Prediction {
        let [guide, vertical, border, weights] = memory.single.parts(self.single_sizes());
        let [area, sums, work, moments, coefficients, base, units] = memory.double.parts(self.double_sizes());
        let weighting = &self.layout.weighting;
        let copies = Copies { width: weighting.width, height: weighting.height, tile };
        let channels: Vec<_> =
            self.planes.guide.iter().zip(&self.variances).map(|(c, v)| (c, v.as_slice())).collect();
        self.layout.fill_guide(&copies, &channels, guide);
        self.layout.fill_border(tile, border);
        self.fill_area(tile, area);
        if self.fit.solver == Solver::MinimalNorm {
            for (j, plane) in self.planes.features.iter().enumerate() {
                let size = (weighting.width, weighting.height);
                let to = (&mut units[j * self.units()..], self.layout.wide);
                units::fill(plane, size, (tile, weighting.window), self.ranges[j], to);
            }
        }
        // Neighbours beyond the image are not visited.
        weights.fill(0.0);
        sums.fill(0.0);
        // SAFETY: the parts have the sizes of the layout, whose copies reach as far around the tile as the window and the patch
        // do, and a group of offsets and a vector more; the walk keeps offsets within the reach and rows within the tile.
        let mut view = unsafe {
            View {
                guide: Plane::vouched(guide),
                border: Plane::vouched(border),
                area: Plane::vouched(area),
                vertical: Plane::vouched_mut(vertical),
                weights: Plane::vouched_mut(weights),
                sums: Plane::vouched_mut(sums),
                work: Plane::vouched_mut(work),
                moments: Plane::vouched_mut(moments),
                coefficients: Plane::vouched_mut(coefficients),
                base: Plane::vouched_mut(base),
            }
        };
        let window = Window { width: weighting.width, height: weighting.height, reach: weighting.window };
        for block in window.blocks(tile, GROUP) {
            let group = Group { rows: block.rows, dy: block.dy, dx: block.dx, count: block.count };
            self.level.launch(Weigh { job: self, tile, group: &group, view: &mut view });
        }
        let mut normal = Normal::new();
        self.level.launch(Model { job: self, tile, view: &mut view, normal: &mut normal, units });
        self.prediction(tile, sums)
    }
}
