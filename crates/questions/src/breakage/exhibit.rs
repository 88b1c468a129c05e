//! What a reader sees.

use noisefloor_study::exhibit::{Answer, Exhibit};

use crate::view::View;

pub(super) fn answer(_view: &View<'_>) -> Option<Answer> {
    None
}

pub(super) fn exhibit(_view: &View<'_>) -> Option<Exhibit> {
    None
}
