//! Whether a medium has a meaning in its scene.

use crate::{Medium, Scene};

impl Medium {
    /// The first number that has no meaning, or the first light that cannot reach `scene` through a medium: what, its
    /// value, what is allowed.
    #[must_use]
    pub fn problem(&self, scene: &Scene) -> Option<(String, String, &'static str)> {
        for (what, v) in [("absorption", self.absorption), ("scattering", self.scattering)] {
            if !(v.is_finite() && v.min_element() >= 0.0 && v.max_element() <= 1e6) {
                return Some((format!("{what} of the medium"), v.to_string(), "in [0, 1e6] per scene unit"));
            }
        }
        if self.extinction().max_element() <= 0.0 {
            let what = "extinction of the medium".to_owned();
            return Some((what, self.extinction().to_string(), "above 0; a scene without a medium has none"));
        }
        if !(-0.95..=0.95).contains(&self.mean_cosine) {
            return Some((
                "mean cosine of the medium".into(),
                self.mean_cosine.to_string(),
                "in [−0.95, 0.95]",
            ));
        }
        let allowed = "none in a scene with a medium, which nothing from infinitely far away gets through";
        if scene.sun.is_some() {
            return Some(("sun".into(), "present".into(), allowed));
        }
        scene.sky.as_ref().map(|_| ("sky".into(), "present".into(), allowed))
    }
}
