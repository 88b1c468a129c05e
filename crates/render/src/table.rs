//! How every quantity is taken from a path, and how the samples of a pixel make it up.

use glam::Vec3A;

use crate::Quantity;
use crate::bsdf::Event;
use crate::limits::DEEPEST;
use crate::recorder::Vertex;

/// One quantity.
#[derive(Debug)]
pub struct Row {
    /// Its id, which gives it a name and channels.
    pub quantity: Quantity,
    /// How a path gives it.
    pub taken: Taken,
    /// How samples give the pixel's.
    pub joined: Joined,
}

/// How a path gives a quantity.
#[derive(Debug, Clone, Copy)]
pub enum Taken {
    /// From the surface that features belong to: a value for each channel. The other number is what background has.
    Surface(fn(&Seen<'_>) -> Vec3A, f32),
    /// Whether a shadow ray from that surface reached its light, and whether one was traced: 1 or 0.
    ShadowRays,
    /// What the path has gathered by the end of the edge behind that surface.
    DirectLight,
    /// F0, S and their sum.
    Flash,
}

/// How the samples of a pixel give its value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Joined {
    /// By their mean, with variance and halves.
    Mean,
    /// The mean of their first value over that of their second, with variance and halves.
    Ratio,
    /// Two quantities of three channels by their means, with variances, halves and covariance; third comes their sum.
    Pair,
    /// By the first sample alone.
    First,
}

/// The surface that features belong to, with the way to it.
#[derive(Debug)]
pub struct Seen<'a> {
    /// The surface.
    pub vertex: &'a Vertex<'a>,
    /// Product of the tints of the specular surfaces on the way.
    pub tint: Vec3A,
    /// Length of the way.
    pub way: f32,
}

/// Every quantity.
pub static TABLE: [Row; Quantity::ALL.len()] = [
    mean(Quantity::Albedo, |seen| seen.tint * seen.vertex.event.albedo()),
    mean(Quantity::Normal, |seen| seen.vertex.at.normal),
    mean(Quantity::Depth, |seen| Vec3A::splat(seen.way)),
    Row { quantity: Quantity::Visibility, taken: Taken::ShadowRays, joined: Joined::Ratio },
    Row { quantity: Quantity::Direct, taken: Taken::DirectLight, joined: Joined::Mean },
    Row { quantity: Quantity::Material, taken: Taken::Surface(material, -1.0), joined: Joined::First },
    Row { quantity: Quantity::Flash, taken: Taken::Flash, joined: Joined::Pair },
    mean(Quantity::Brdf, brdf),
    mean(Quantity::Motion, motion),
    mean(Quantity::Caustics, caustics),
];

/// Most features: the mean of what the surface has, 0 for background.
const fn mean(quantity: Quantity, take: fn(&Seen<'_>) -> Vec3A) -> Row {
    Row { quantity, taken: Taken::Surface(take, 0.0), joined: Joined::Mean }
}

fn material(seen: &Seen<'_>) -> Vec3A {
    let Vertex { scene, hit, .. } = seen.vertex;
    // Exact: scenes have far fewer than 2^24 materials.
    Vec3A::splat(scene.geometry[hit.primitive as usize].material as f32)
}

/// Of the direction that the path takes, or would take if it went on.
fn brdf(seen: &Seen<'_>) -> Vec3A {
    let Vertex { event, at, to_viewer, choice, .. } = seen.vertex;
    let weight = match event {
        Event::Specular(specular) => specular.tint(),
        Event::Lobe(lobe) => {
            lobe.sample(at, *to_viewer, choice[0], choice[1]).map_or(Vec3A::ZERO, |s| s.weight)
        }
    };
    weight * seen.tint
}

fn motion(seen: &Seen<'_>) -> Vec3A {
    let Vertex { scene, view, hit, at, traversal, .. } = seen.vertex;
    let Some([now, next]) = &view.frames else { return Vec3A::ZERO };
    let [start, end] = scene.over_a_frame(hit, at.point, traversal);
    match (now.project(start), next.project(end)) {
        (Some(from), Some(to)) => Vec3A::new(to[0] - from[0], to[1] - from[1], 0.0),
        _ => Vec3A::ZERO,
    }
}

fn caustics(seen: &Seen<'_>) -> Vec3A {
    let Vertex { view, at, .. } = seen.vertex;
    Vec3A::splat(view.photons.map_or(0.0, |maps| maps.caustic(at, view.pixel * seen.way, DEEPEST).1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_quantity_has_its_row_and_every_one_but_the_flash_is_a_feature() {
        for (row, quantity) in TABLE.iter().zip(Quantity::ALL) {
            assert_eq!(row.quantity, quantity);
            assert_eq!(quantity.feature().is_none(), quantity == Quantity::Flash);
        }
    }
}
