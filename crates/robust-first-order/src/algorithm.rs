//! Liu, Zheng, Yuan 2018, Sec. 3, in its order.
//!
//! | equation | what | file |
//! |---|---|---|
//! | Eq. 1, Eq. 2 | the first-order model of a window | `noisefloor-kernels`, `regression/models` |
//! | Eq. 3, Eq. 4, Eq. 5 | joint non-local means of features | `features.rs`, for `noisefloor-kernels`, `joint_nlm` |
//! | Eq. 6 | guided filter | `noisefloor-kernels`, `guided` |
//! | Eq. 7 | prefiltered features | `features.rs` |
//! | Eq. 8 | prefiltered colour | `guided.rs` |
//! | Eq. 9, Eq. 10, Eq. 12 | the bandwidth of a model | `tile.rs` |
//! | Eq. 11 | bias and variance step by step | `models.rs`, for `noisefloor-kernels`, `regression/models` |
//! | Eq. 13 | the blend | `tile.rs`, sums in `blend.rs` |
//! | Eq. 14 | detail, and with it the windows | `centres.rs` |

use noisefloor_denoiser::{DenoiseError, StageTimer};
use noisefloor_frame::{Frame, Variance};
use noisefloor_kernels::regression::models::{Field, Planes};

use crate::card::ID;
use crate::centres::{self, Tile};
use crate::features::{self, Channel};
use crate::guided::{self, Guide, MAX_VARIANCE};
use crate::models::{Modelled, model};
use crate::settings::Settings;
use crate::tile::Assembly;
use crate::{ErrorKind, Params};

/// ε of relative errors over the squared mean of M: the 0.01 of Sec. 4 for an image of mean 1.
const RELATIVE: f64 = 0.01;

/// Everything that came of a frame.
#[derive(Debug)]
pub(crate) struct Done {
    /// Prefiltered features.
    pub channels: Vec<Channel>,
    /// M and its variance.
    pub guide: Guide,
    pub tiles: Vec<Tile>,
    pub modelled: Modelled,
    /// Variance of the noisy colour, mean of the channels.
    pub variance: Vec<f32>,
}

/// Sec. 3 on a frame with finite values.
pub(crate) fn denoise(
    frame: &Frame,
    params: &Params,
    settings: &Settings,
    timer: &mut StageTimer,
) -> Result<Done, DenoiseError> {
    let size = (frame.width(), frame.height());
    let color = &frame.color.mean;
    let planes = [0, 1, 2].map(|c| color.plane(c));
    // Variances of the mean; those of sound frames are there.
    let sampled = frame.color.variance.as_ref().map(Variance::mean_variance);
    let sampled = sampled.map_or_else(|| color.map(|_| 0.0), |v| v.map(|v| v.clamp(0.0, MAX_VARIANCE)));
    let sampled = [0, 1, 2].map(|c| sampled.plane(c));

    // Sec. 3.2, Eq. 3 to Eq. 7: features without their noise.
    let mut channels = features::raw(frame, params)?;
    features::prefilter(&mut channels, size, params)?;
    timer.finish("features");

    // Sec. 3.3, Eq. 8: colour with less noise and the edges of the features; weights are made from nothing else.
    let guide = guided::prefilter(frame, sampled, &channels, params)?;
    timer.finish("colour");

    // Sec. 3.5, Eq. 14: tiles with detail get small windows, all others large ones.
    let detail = centres::detail(&channels, size, params.edge);
    let tiles = centres::tiles(size, settings.tile, &detail, params.edge_share);

    // Sec. 3.1, Eq. 1 and Eq. 2: what models are made of.
    let variance = mean([0, 1, 2].map(|c| sampled[c]));
    let importance = importance(&guide, params.error);
    let of_model: &[Channel] = if params.features_in_model { &channels } else { &[] };
    let field = Field::new(
        size.0,
        size.1,
        &Planes {
            guide: guide.value.each_ref().map(Vec::as_slice),
            guide_variance: guide.variance.each_ref().map(Vec::as_slice),
            target: planes,
            variance: &variance,
            importance: &importance,
            features: of_model.iter().map(|c| c.value.as_slice()).collect(),
        },
        settings.rules.clone(),
    )
    .map_err(|e| DenoiseError::of_kernel(ID, &e))?;
    timer.finish("tiles");

    // Sec. 3.4, Eq. 9 to Eq. 12: the bandwidth with the least error, whose bias and variance are found step by step; and Eq. 13: all
    // models that cover a pixel, weighed.
    let none = Assembly { value: guide.value.clone(), variance: variance.clone() };
    let modelled = model(size, &tiles, &field, settings, params, &none, |stage| timer.finish(stage));
    Ok(Done { channels, guide, tiles, modelled, variance })
}

/// What squared errors are multiplied by before they are added up (Eq. 10).
fn importance(guide: &Guide, error: ErrorKind) -> Vec<f32> {
    let m = mean(guide.value.each_ref().map(Vec::as_slice));
    if error == ErrorKind::Absolute {
        return vec![1.0; m.len()];
    }
    // An image has at least one pixel.
    let level = m.iter().copied().map(f64::from).sum::<f64>() / m.len() as f64;
    let floor = RELATIVE * level * level;
    let over = |m: &f32| {
        let square = f64::from(*m).powi(2) + floor;
        // All is black where this is 0, and no error differs.
        if square > 1e-30 { (1.0 / square) as f32 } else { 1.0 }
    };
    m.iter().map(over).collect()
}

fn mean([r, g, b]: [&[f32]; 3]) -> Vec<f32> {
    let third =
        |((r, g), b): ((&f32, &f32), &f32)| ((f64::from(*r) + f64::from(*g) + f64::from(*b)) / 3.0) as f32;
    r.iter().zip(g).zip(b).map(third).collect()
}
