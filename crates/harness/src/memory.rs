//! How much memory the largest image of a study takes, before anything is rendered.

use noisefloor_denoiser::Registry;
use noisefloor_render::{Keep, MAX_MEMORY, Quantity};

use crate::error::HarnessError;
use crate::source::recorded;
use noisefloor_study::{SceneSource, Study};

/// Bytes per value: of a frame, and of the file that it is encoded into.
const BYTES_PER_VALUE: u64 = 8;

/// Mean, variance and halves of the colour.
const COLOR_VALUES: u64 = 4 * 3;

/// Values per pixel of a synthetic frame with all its guides.
const SYNTHETIC_VALUES: u64 = COLOR_VALUES + 4 * (3 + 3 + 1 + 6) + 3;

/// The image of a study that takes most memory.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MemoryEstimate {
    /// Id of its scene.
    pub scene: String,
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// About the bytes that a frame and the reference of this scene take together with their files, at most; what
    /// methods take themselves is not known.
    pub bytes: u64,
}

impl MemoryEstimate {
    /// Compares it with what is allowed.
    ///
    /// # Errors
    /// [`HarnessError::Memory`].
    pub fn check(&self, allowed: u64) -> Result<(), HarnessError> {
        if self.bytes <= allowed {
            return Ok(());
        }
        let Self { scene, width, height, bytes } = self.clone();
        Err(HarnessError::Memory { scene, width, height, bytes, allowed })
    }
}

/// Values that are kept of a quantity per pixel.
fn values(quantity: Quantity, keep: Keep) -> u64 {
    let statistics = 1 + u64::from(keep.variance) + 2 * u64::from(keep.halves);
    match quantity.feature() {
        Some(id) => statistics * id.channel_names().map_or(3, |names| names.len() as u64),
        // Two images, and their covariance.
        None => 6 * statistics + 3,
    }
}

/// The image of a study that takes most memory, `None` if all frames come from files, whose readers have limits of
/// their own. Rows that cannot be built count for nothing here; a run tells them.
#[must_use]
pub fn memory_estimate(
    study: &Study,
    registry: &Registry,
    size: Option<(usize, usize)>,
) -> Option<MemoryEstimate> {
    let methods = study.methods.iter().filter_map(|row| registry.build(&row.id, &row.set).ok());
    let cards: Vec<_> = methods.map(|method| method.denoiser.card()).collect();
    let recorded = recorded(cards.iter());
    let features: u64 = recorded.iter().map(|(quantity, keep)| values(*quantity, *keep)).sum();
    let reference = 3 * (1 + u64::from(study.reference.parts));
    let estimates = study.scenes.iter().filter_map(|scene| {
        let ((width, height), values) = match &scene.source {
            SceneSource::Folder(_) => return None,
            SceneSource::Synthetic(synthetic) => {
                // Its own size, or the study's.
                let own = (synthetic.width().max(study.width), synthetic.height().max(study.height));
                (size.unwrap_or(own), SYNTHETIC_VALUES)
            }
            SceneSource::Builtin(_) | SceneSource::Gltf(_) => {
                (size.unwrap_or((study.width, study.height)), COLOR_VALUES + features + reference)
            }
        };
        let pixels = (width as u64).saturating_mul(height as u64);
        let bytes = pixels.saturating_mul(values * BYTES_PER_VALUE);
        Some(MemoryEstimate { scene: scene.id.clone(), width, height, bytes })
    });
    estimates.max_by_key(|estimate| estimate.bytes)
}

/// Refuses a study whose images take more than any is given.
pub(crate) fn check_memory(
    study: &Study,
    registry: &Registry,
    size: Option<(usize, usize)>,
) -> Result<(), HarnessError> {
    memory_estimate(study, registry, size).map_or(Ok(()), |estimate| estimate.check(MAX_MEMORY))
}
