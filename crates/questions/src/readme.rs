//! Tables of a study inside a README.
//!
//! | kind | shows | keys |
//! | --- | --- | --- |
//! | `answers` | the first screen's sentences | |
//! | `levels` | a table per scene: levels down, rows of the study across | `metric`, `show`, `scenes`, `spp`, `rows` |
//! | `methods` | rows of the study down, scenes and levels across | the same |
//! | `coverage` | coverage of the input's intervals, per scene | `scenes`, `spp` |
//! | `bounds` | violations of error bounds, per scene | `scenes`, `spp`, `rows` |
//! | `slopes` | slopes and verdicts | `metric`, `scenes`, `rows` |
//! | `paper` | ratios beside the source work's | |
//! | `equal-time` | samples for equal time | |
//! | `estimates` | methods' estimates of their own error | `scenes`, `spp`, `rows` |
//! | `flicker` | errors that change from frame to frame | |
//! | `absent` | rows that did not run or are not ranked, with the reason | |
//! | `machine` | cells, processor, build, load and date | |
//!
//! `show` is `value`, `ratio` (to plain Monte Carlo) or `multiplier` (samples for an equal error); lists are split at `;`.
//! Every kind but `answers` and `machine` belongs to a question.

mod asked;
mod chosen;
mod common;
mod kind;

use noisefloor_study::format;
use noisefloor_study::summary::Summary;

pub use asked::{Asked, Block};
pub(crate) use chosen::{Chosen, Show};
pub use kind::Kind;
pub(crate) use kind::{code, headed, headed_by, lines, plain, push};

use crate::list::QUESTIONS;
use crate::view::View;

/// Makes what a README asks for, in order.
///
/// # Errors
/// A clause for people, if the study has nothing of this name.
pub fn readme_table(summary: &Summary, asked: &Asked) -> Result<Vec<Block>, String> {
    let view = View::new(summary);
    let kinds = || QUESTIONS.iter().flat_map(|question| question.readme).chain(common::KINDS);
    let kind = kinds()
        .find(|kind| kind.name == asked.kind)
        .ok_or_else(|| format!("there is no table `{}`", asked.kind))?;
    if let Some(key) = asked.keys.keys().find(|key| !kind.keys.contains(&key.as_str())) {
        let has = if kind.keys.is_empty() { "none".into() } else { format::list(kind.keys) };
        return Err(format!("`{}` has no key `{key}`; it has {has}", asked.kind));
    }
    Ok((kind.make)(&Chosen::new(&view, asked)?))
}
