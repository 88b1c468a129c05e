//! Skies that are images.

use glam::Vec3;

use crate::MOST_RADIANCE;

/// Radiance from infinitely far away by direction, as an image in latitude and longitude: the columns run once around
/// the vertical axis, the rows from straight up (+Y, first row) to straight down. The middle of the image is looked at
/// along −Z, its right half lies towards +X. Texels are constant patches: no filter is applied, so that a renderer can
/// sample them exactly.
#[derive(Debug, Clone, PartialEq)]
pub struct EnvironmentMap {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Linear RGB radiance, row by row, `width × height` of them.
    pub texels: Vec<Vec3>,
}

impl EnvironmentMap {
    /// What a map may be, in words.
    pub const ALLOWED: &'static str =
        "1 to 2^27 texels, as many as width × height, each finite, not negative and at most 1e15";

    /// What is wrong with it, if something is: its size, or a texel that is negative, not finite or beyond
    /// [`MOST_RADIANCE`], with its column and row.
    #[must_use]
    pub fn problem(&self) -> Option<(String, String)> {
        // 2^27 texels take 2 GiB: more is a typing error.
        let size = self.width.checked_mul(self.height).filter(|n| (1..=1 << 27).contains(n));
        if size != Some(self.texels.len()) {
            let found = format!("{}×{} with {} texels", self.width, self.height, self.texels.len());
            return Some(("the environment map's size".into(), found));
        }
        let bad = |t: &Vec3| !(t.is_finite() && t.min_element() >= 0.0 && t.max_element() <= MOST_RADIANCE);
        let at = self.texels.iter().position(bad)?;
        let place = (at % self.width, at / self.width);
        Some((format!("the environment map's texel {place:?}"), self.texels[at].to_string()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_maps_are_told_apart() {
        let map = |width, texels: Vec<Vec3>| EnvironmentMap { width, height: 2, texels };
        assert_eq!(map(2, vec![Vec3::ONE; 4]).problem(), None);
        assert!(map(3, vec![Vec3::ONE; 4]).problem().unwrap().1.contains("3×2 with 4"));
        assert!(map(0, vec![]).problem().is_some());
        for bad in [
            Vec3::new(0.0, -1.0, 0.0),
            Vec3::splat(f32::NAN),
            Vec3::splat(f32::INFINITY),
            Vec3::new(0.0, 3e38, 0.0),
        ] {
            let mut texels = vec![Vec3::ONE; 4];
            texels[2] = bad;
            assert!(map(2, texels).problem().unwrap().0.contains("texel (0, 1)"));
        }
    }
}
