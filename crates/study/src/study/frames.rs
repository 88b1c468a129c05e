//! Which frames a row gets: the study's, or frames of its own.

use serde::{Deserialize, Serialize};

/// Which noisy frames a row denoises.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RowFrames {
    /// The study's own: the same number of samples in every pixel, shared by all such rows.
    #[default]
    Uniform,
    /// As many samples, placed in rounds where the row's own method asks for them.
    Adaptive(AdaptiveFrames),
    /// The study's own with the variance of their law in place of the samples' own: synthetic scenes know it.
    KnownVariance,
    /// The same number in every pixel, as many as another row's time buys: [`crate::SceneSpec::equal_time_spp`].
    EqualTime {
        /// Label of the other row.
        with: String,
    },
}

/// How adaptive frames are rendered.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct AdaptiveFrames {
    /// Rounds in all. The first is uniform, the others have equal budgets; together they have the level's samples per
    /// pixel on average, exactly.
    pub rounds: u32,
    /// Samples per pixel of the first round, at least 2; a `rounds`-th of the level if absent.
    pub first: Option<u32>,
    /// Most samples that a pixel gets in one round, over the round's average.
    pub most: u32,
}

impl Default for AdaptiveFrames {
    fn default() -> Self {
        Self { rounds: 4, first: None, most: 16 }
    }
}

impl AdaptiveFrames {
    /// Samples per pixel of the first round at level `spp`.
    pub fn first(&self, spp: u32) -> u32 {
        self.first.unwrap_or(spp / self.rounds).max(2).min(spp)
    }

    /// Samples of each round after the first, for `pixels` pixels at level `spp`.
    pub fn budgets(&self, spp: u32, pixels: u64) -> Vec<u64> {
        let rest = u64::from(spp - self.first(spp)) * pixels;
        let rounds = u64::from(self.rounds - 1);
        (0..rounds).map(|i| rest * (i + 1) / rounds - rest * i / rounds).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::AdaptiveFrames;

    #[test]
    fn rounds_of_adaptive_frames_add_up_to_the_level_exactly() {
        for (rounds, first, spp) in
            [(4, None, 16), (4, None, 7), (3, Some(4), 4), (5, Some(2), 33), (2, None, 2)]
        {
            let frames = AdaptiveFrames { rounds, first, most: 16 };
            let budgets = frames.budgets(spp, 101);
            assert_eq!(budgets.len() as u32, rounds - 1);
            assert_eq!(
                budgets.iter().sum::<u64>() + u64::from(frames.first(spp)) * 101,
                u64::from(spp) * 101
            );
            let (least, most) = (budgets.iter().min(), budgets.iter().max());
            assert!(most.unwrap() - least.unwrap() <= 1);
        }
    }
}
