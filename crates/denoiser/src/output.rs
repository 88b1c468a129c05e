use noisefloor_frame::Image;
use noisefloor_stats::Level;
use serde::{Deserialize, Serialize};

/// Seconds of one named stage of a method.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StageSeconds {
    /// Stage, such as `step 1`.
    pub name: String,
    /// Wall-clock seconds.
    pub seconds: f64,
}

/// A bound that a method states for this very image; where the card's claims say how wide a bound is for every image.
#[derive(Debug, Clone, PartialEq)]
pub struct Bound {
    /// Name shown in reports.
    pub name: String,
    /// 1−α, per pixel and channel.
    pub level: Level,
    /// Half-width per pixel and channel: P(|D−μ| ≤ half_width) ≥ 1−α. Shape of the target, at least 0, infinite where
    /// nothing is claimed.
    pub half_width: Image,
}

/// What the values of a diagnostic image or a figure are in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Those of the colour: brighter frames have larger values.
    Radiance,
    /// Squares of the colour's: variances and squared errors.
    RadianceSquared,
    /// Pixels.
    Pixels,
    /// None: shares, weights, counts, features in their unit range.
    None,
}

/// A named number that a method gives along.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Name for people, stable.
    pub name: String,
    /// Value.
    pub value: f64,
    /// What it is in.
    pub unit: Unit,
}

/// A named image that shows how a method came to its result.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnostic {
    /// Name for people, stable.
    pub name: String,
    /// The image.
    pub image: Image,
    /// What its values are in.
    pub unit: Unit,
}

/// What a method gives back.
#[derive(Debug, Clone, PartialEq)]
pub struct Output {
    /// Denoised radiance, 3 channels, shape of the target.
    pub image: Image,
    /// Own estimate of the squared error per pixel and channel, if the method has one.
    pub error_estimate: Option<Image>,
    /// The image that the estimate is about, with a name for people, where that is not `image`: an intermediate one. Shape
    /// of the target.
    pub estimate_of: Option<(String, Image)>,
    /// Stated bounds.
    pub bounds: Vec<Bound>,
    /// Named images that the source work's figures show: flash image, homogeneous set, kernel radius.
    pub diagnostics: Vec<Diagnostic>,
    /// Numbers worth keeping, such as the flash intensity.
    pub figures: Vec<Figure>,
    /// Seconds per stage in order.
    pub stages: Vec<StageSeconds>,
    /// Seconds that the method itself says it computed for, where what is around it takes time too: a program that starts and
    /// reads files. None: all of the time is the method's.
    pub seconds: Option<f64>,
    /// What a program outside said while it worked; empty for methods of this program.
    pub log: String,
}

impl Output {
    /// An image and nothing else.
    #[must_use]
    pub fn from_image(image: Image) -> Self {
        Self {
            image,
            error_estimate: None,
            estimate_of: None,
            bounds: Vec::new(),
            diagnostics: Vec::new(),
            figures: Vec::new(),
            stages: Vec::new(),
            seconds: None,
            log: String::new(),
        }
    }

    /// Adds a figure.
    pub fn figure(&mut self, name: impl Into<String>, unit: Unit, value: f64) {
        self.figures.push(Figure { name: name.into(), value, unit });
    }

    /// Adds a diagnostic image.
    pub fn diagnose(&mut self, name: impl Into<String>, unit: Unit, image: Image) {
        self.diagnostics.push(Diagnostic { name: name.into(), image, unit });
    }
}
