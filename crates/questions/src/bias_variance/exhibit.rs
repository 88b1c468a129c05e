//! What a reader sees.

mod chart;
mod table;

use noisefloor_study::exhibit::{Exhibit, Part};

use super::ID;
use super::analyse::Finding;
use crate::answers;
use crate::section::section;
use crate::view::View;

const NOTE: &str = "The squared error of a row, split into the square of its bias, which no number of replicates takes away, and the \
    variance of one replicate. Relative: each pixel's error over the square of its brightness, as in relMSE. Bias squared is unbiased \
    and may come out negative; where it is below its uncertainty only an upper limit is told.";

pub(super) fn exhibits(view: &View<'_>) -> Vec<Exhibit> {
    let found: Vec<Finding> = answers::read(&view.summary.answers, ID).unwrap_or_default();
    let (mut tables, mut charts) = (Vec::new(), Vec::new());
    for (scene, name) in view.named_scenes() {
        let here: Vec<&Finding> = found.iter().filter(|f| f.scene == scene.id).collect();
        if !here.is_empty() {
            tables.push(Part::Heading(scene.title.clone()));
            tables.extend(table::parts(view, &name, &here));
            charts.extend(chart::chart(view, scene, &name, &here).filter(|_| view.draws("bias")));
        }
    }
    section([ID, "Bias and variance", "Bias and variance of the errors"], NOTE, charts, tables)
}
