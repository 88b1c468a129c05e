use thiserror::Error;

use crate::Scene;
use crate::analytic;
use crate::builtin::{
    bathroom, conference, cornell, fog, nave, outdoor, rings, shower, spin, teapot, toaster, two_quads,
};

/// A scene that can be built by name.
#[derive(Debug, Clone, Copy)]
pub struct SceneEntry {
    /// Stable name.
    pub id: &'static str,
    /// What it shows and which figure it stands in for.
    pub about: &'static str,
    /// Whether the figures that it stands in for were photon mapped.
    pub photon_mapped: bool,
    /// Builds it; deterministic.
    pub build: fn() -> Scene,
}

const SCENES: &[SceneEntry] = &[
    SceneEntry {
        id: cornell::ID,
        about: "Cornell box with a mirror ball and a glass ball: the usual test of interreflection, with a caustic",
        photon_mapped: false,
        build: cornell::cornell,
    },
    SceneEntry {
        id: cornell::DIFFUSE_ID,
        about: "Cornell box with its two diffuse blocks, measured geometry: the yardstick for rendering speed",
        photon_mapped: false,
        build: cornell::cornell_diffuse,
    },
    SceneEntry {
        id: toaster::ID,
        about: "steel toaster on a kitchen counter, thin lens: stands in for the toaster of moon2013flash",
        photon_mapped: false,
        build: toaster::toaster,
    },
    SceneEntry {
        id: outdoor::ID,
        about: "shaded brick courtyard with two potted shrubs: stands in for the outdoor scene of moon2013flash",
        photon_mapped: false,
        build: outdoor::outdoor,
    },
    SceneEntry {
        id: bathroom::ID,
        about: "bathroom with mirrors, lit by way of its ceiling: stands in for the bathroom of moon2013flash",
        photon_mapped: true,
        build: bathroom::bathroom,
    },
    SceneEntry {
        id: shower::ID,
        about: "tiled booth with a glass pane, a glossy can and strong caustics: stands in for the shower booth of moon2013flash",
        photon_mapped: true,
        build: shower::shower,
    },
    SceneEntry {
        id: rings::ID,
        about: "metal rings on wood with sharp caustics: stands in for the wedding band of moon2013flash and the rings of rousselle2013rdfc",
        photon_mapped: true,
        build: rings::rings,
    },
    SceneEntry {
        id: conference::ID,
        about: "meeting room with many lamps and thin furniture: stands in for the conference room of rousselle2013rdfc",
        photon_mapped: false,
        build: conference::conference,
    },
    SceneEntry {
        id: nave::ID,
        about: "church nave under a thin lens, lit through its windows: stands in for the Sibenik cathedral of rousselle2013rdfc",
        photon_mapped: false,
        build: nave::nave,
    },
    SceneEntry {
        id: teapot::ID,
        about: "glossy metal teapot on stone as irregular as noise: stands in for the teapot-metal scene of rousselle2013rdfc",
        photon_mapped: false,
        build: teapot::teapot,
    },
    SceneEntry {
        id: fog::ID,
        about: "winged serpent in a dark hall, lit through slits: stands in for the dragon in fog of rousselle2013rdfc",
        photon_mapped: false,
        build: fog::fog,
    },
    SceneEntry {
        id: spin::ID,
        about: "fan, wheel, top, ball and letter block on a table: stands in for the motion blur of liu2018robust",
        photon_mapped: false,
        build: spin::spin,
    },
    SceneEntry {
        id: two_quads::ID,
        about: "a textured quad in focus beside one far out of focus: stands in for rousselle2013rdfc Fig. 3",
        photon_mapped: false,
        build: two_quads::two_quads,
    },
    SceneEntry {
        id: "furnace",
        about: "inside of a glowing box: every pixel is 1/(1−albedo), or the geometric sum that the path depth allows",
        photon_mapped: false,
        build: || analytic::furnace(analytic::FURNACE_ALBEDO),
    },
    SceneEntry {
        id: "direct",
        about: "diffuse plane under a square lamp: the closed form of a configuration factor",
        photon_mapped: false,
        build: analytic::direct,
    },
    SceneEntry {
        id: "gradient",
        about: "diffuse plane under a ball lamp: light falls off smoothly, in closed form everywhere",
        photon_mapped: false,
        build: analytic::gradient,
    },
];

/// All built-in scenes in display order.
#[must_use]
pub fn builtin() -> &'static [SceneEntry] {
    SCENES
}

/// No built-in scene has this id.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("there is no scene `{id}`; the nearest names are {}", nearest.join(", "))]
#[non_exhaustive]
pub struct UnknownScene {
    /// What was asked for.
    pub id: String,
    /// Up to three existing ids, most similar first.
    pub nearest: Vec<&'static str>,
}

/// The built-in scene called `id`.
///
/// # Errors
///
/// [`UnknownScene`] with the nearest names if there is none.
pub fn find(id: &str) -> Result<&'static SceneEntry, UnknownScene> {
    SCENES.iter().find(|entry| entry.id == id).ok_or_else(|| {
        // The time that a comparison takes grows with the product of both lengths.
        let id = id.char_indices().nth(100).map_or(id, |(end, _)| &id[..end]);
        let mut nearest: Vec<_> = SCENES.iter().map(|entry| entry.id).collect();
        nearest.sort_by(|a, b| strsim::jaro_winkler(b, id).total_cmp(&strsim::jaro_winkler(a, id)));
        nearest.truncate(3);
        UnknownScene { id: id.to_owned(), nearest }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_entry_builds_the_scene_of_its_id() {
        for entry in builtin() {
            assert_eq!((entry.build)().id, entry.id);
            assert_eq!(find(entry.id).map(|found| found.id), Ok(entry.id));
        }
    }

    #[test]
    fn misspelt_name_is_answered_with_the_nearest() {
        let error = find("cornel-difuse").expect_err("no such scene");
        assert_eq!(error.nearest[0], "cornell-diffuse");
        assert!(error.to_string().contains("`cornel-difuse`"), "{error}");
        assert!(!find("").expect_err("no such scene").nearest.is_empty());
    }
}
