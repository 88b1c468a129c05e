//! What a reader sees.

use noisefloor_study::exhibit::Exhibit;

use crate::view::View;

pub(super) fn exhibit(_view: &View<'_>) -> Option<Exhibit> {
    None
}
