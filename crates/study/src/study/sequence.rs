//! Scenes that are frames of one sequence.

use crate::study::{SceneSpec, Study};

impl Study {
    /// Sequences in the order of their first scenes: name, and scenes by frame.
    #[must_use]
    pub fn sequences(&self) -> Vec<(&str, Vec<&SceneSpec>)> {
        let mut out: Vec<(&str, Vec<&SceneSpec>)> = Vec::new();
        for scene in &self.scenes {
            let Some(name) = &scene.sequence else { continue };
            match out.iter_mut().find(|(known, _)| known == name) {
                Some((_, frames)) => frames.push(scene),
                None => out.push((name, vec![scene])),
            }
        }
        for (_, frames) in &mut out {
            frames.sort_by_key(|scene| scene.shot.frame);
        }
        out
    }
}
