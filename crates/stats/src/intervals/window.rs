//! Windows around a pixel, cut at the borders of the image.

use super::planes::SamplePlanes;

/// Pixels on each side of the centre: 7×7.
pub(super) const RADIUS: usize = 3;

/// Planar indices of the window around a planar index, itself among them; pixels that take no part are left out, except the
/// centre.
pub(super) fn window<'a>(planes: &SamplePlanes<'a>, index: usize) -> impl Iterator<Item = usize> + use<'a> {
    let (observed, width) = (planes.observed, planes.width);
    // An index exists, so there are pixels, and whole rows of them.
    let (plane, centre) = (index / observed.pixels * observed.pixels, index % observed.pixels);
    let height = observed.pixels / width;
    let (x, y) = (centre % width, centre / width);
    let columns = x.saturating_sub(RADIUS)..(x + RADIUS + 1).min(width);
    let rows = y.saturating_sub(RADIUS)..(y + RADIUS + 1).min(height);
    rows.flat_map(move |row| columns.clone().map(move |column| row * width + column))
        .filter(move |&pixel| pixel == centre || observed.takes_part(pixel))
        .map(move |pixel| plane + pixel)
}
