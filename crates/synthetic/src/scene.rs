use noisefloor_frame::Reference;
use serde::{Deserialize, Serialize};

use crate::{Classes, ImageKind, MeanImage, SampleLaw, SyntheticError};

/// Which guide images a synthetic frame carries beside the colour.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Guides {
    /// Albedo, normal, depth, material id and the virtual flash in its two parts.
    #[default]
    FlashParts,
    /// The same with a ready-made flash image.
    FlashReady,
    /// Albedo, normal, depth and material id, no flash image.
    NoFlash,
    /// Colour only.
    None,
}

/// A scene that needs no renderer: its mean image and the law of its samples are known exactly.
///
/// In a study file (every parameter but `image` and `law` has a default; one that the chosen law does not
/// have is an error):
///
/// ```toml
/// image = "edges"      # constant, flats, ramps, edges, texture, mixed
/// level = 0.5          # radiance where the pattern is dark
/// contrast = 0.5       # added where it is bright
/// period = 8           # of the texture, pixels
/// law = "gaussian"     # sd, relative | exponential | log-normal: sigma | bernoulli: q, bright
/// sd = 0.5             # of one sample
/// width = 160
/// height = 120
/// guides = "flash-parts"   # flash-ready, no-flash, none
/// ```
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
#[serde(try_from = "Description", into = "Description")]
pub struct SyntheticScene {
    pub(crate) image: MeanImage,
    pub(crate) law: SampleLaw,
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) common_channels: bool,
    pub(crate) guides: Guides,
    pub(crate) feature_sd: f64,
    pub(crate) flash_sd: f64,
}

impl SyntheticScene {
    /// Default columns and rows.
    pub const SIZE: (usize, usize) = (160, 120);
    /// Default standard deviation of one sample of albedo and normal components, and of depth relative to
    /// depth.
    pub const FEATURE_SD: f64 = 0.02;
    /// Default standard deviation of one flash sample, relative to its mean.
    pub const FLASH_SD: f64 = 0.1;

    /// A scene with all guides and independent channels.
    ///
    /// # Errors
    /// [`SyntheticError`] naming the parameter that is out of range.
    pub fn new(
        image: MeanImage,
        law: SampleLaw,
        width: usize,
        height: usize,
    ) -> Result<Self, SyntheticError> {
        let scene = Self {
            image,
            law,
            width,
            height,
            common_channels: false,
            guides: Guides::default(),
            feature_sd: Self::FEATURE_SD,
            flash_sd: Self::FLASH_SD,
        };
        scene.check()?;
        Ok(scene)
    }

    /// Another choice of guide images.
    #[must_use]
    pub fn with_guides(self, guides: Guides) -> Self {
        Self { guides, ..self }
    }

    /// Whether one random number drives all three channels of a sample, instead of one each.
    #[must_use]
    pub fn with_common_channels(self, common_channels: bool) -> Self {
        Self { common_channels, ..self }
    }

    /// The same scene at another size.
    ///
    /// # Errors
    /// [`SyntheticError::OutOfRange`] if a side is 0 or above 65536.
    pub fn resized(&self, width: usize, height: usize) -> Result<Self, SyntheticError> {
        let scene = Self { width, height, ..self.clone() };
        scene.check()?;
        Ok(scene)
    }

    /// Mean image.
    #[must_use]
    pub fn image(&self) -> MeanImage {
        self.image
    }

    /// Law of the samples.
    #[must_use]
    pub fn law(&self) -> SampleLaw {
        self.law
    }

    /// Columns.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// Guide images that frames carry.
    #[must_use]
    pub fn guides(&self) -> Guides {
        self.guides
    }

    /// The exact truth: the mean image without variance.
    #[must_use]
    pub fn truth(&self) -> Reference {
        Reference::exact(self.image.image(self.width, self.height))
    }

    /// Class of each pixel.
    #[must_use]
    pub fn classes(&self) -> Classes {
        self.image.classes(self.width, self.height)
    }

    fn check(&self) -> Result<(), SyntheticError> {
        let range = |parameter, value: f64, ok: bool, allowed| {
            if ok { Ok(()) } else { Err(SyntheticError::OutOfRange { parameter, value, allowed }) }
        };
        for (parameter, side) in [("width", self.width), ("height", self.height)] {
            range(parameter, side as f64, (1..=65536).contains(&side), "1 to 65536")?;
        }
        let MeanImage { level, contrast, period, .. } = self.image;
        let radiance = "finite, absolute value at most 1e30";
        for (parameter, value) in [("level", level), ("contrast", contrast)] {
            range(parameter, value, value.abs() <= 1e30, radiance)?;
        }
        range("period", period as f64, period >= 2, "at least 2 pixels")?;
        for (parameter, value) in [("feature_sd", self.feature_sd), ("flash_sd", self.flash_sd)] {
            range(parameter, value, (0.0..=10.0).contains(&value), "0 to 10")?;
        }
        self.law.check()?;
        if self.law.needs_positive_mean() && (level < 0.0 || level + contrast < 0.0) {
            return Err(SyntheticError::NegativeMean { law: self.law.name(), level, contrast });
        }
        Ok(())
    }
}

/// A scene as a study file describes it, whose size may be left to the study.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(try_from = "Description")]
pub struct SyntheticSpec {
    scene: SyntheticScene,
    width: Option<usize>,
    height: Option<usize>,
}

impl SyntheticSpec {
    /// The scene; a side that the description does not state is that of `size`, or the default.
    ///
    /// # Errors
    /// [`SyntheticError::OutOfRange`] if a side is 0 or above 65536.
    pub fn scene(&self, size: Option<(usize, usize)>) -> Result<SyntheticScene, SyntheticError> {
        let (width, height) = size.unwrap_or(SyntheticScene::SIZE);
        self.scene.resized(self.width.unwrap_or(width), self.height.unwrap_or(height))
    }
}

impl TryFrom<Description> for SyntheticSpec {
    type Error = SyntheticError;

    fn try_from(description: Description) -> Result<Self, SyntheticError> {
        let (width, height) = (description.width, description.height);
        Ok(Self { scene: description.try_into()?, width, height })
    }
}

#[derive(Clone, Copy, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum LawName {
    Gaussian,
    Exponential,
    LogNormal,
    Bernoulli,
}

/// The flat table of a study file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Description {
    image: ImageKind,
    level: Option<f64>,
    contrast: Option<f64>,
    period: Option<usize>,
    law: LawName,
    sd: Option<f64>,
    relative: Option<bool>,
    sigma: Option<f64>,
    q: Option<f64>,
    bright: Option<f64>,
    #[serde(default)]
    common_channels: bool,
    width: Option<usize>,
    height: Option<usize>,
    #[serde(default)]
    guides: Guides,
    feature_sd: Option<f64>,
    flash_sd: Option<f64>,
}

impl TryFrom<Description> for SyntheticScene {
    type Error = SyntheticError;

    fn try_from(d: Description) -> Result<Self, SyntheticError> {
        let law = match d.law {
            LawName::Gaussian => {
                SampleLaw::Gaussian { sd: d.sd.unwrap_or(0.5), relative: d.relative.unwrap_or(false) }
            }
            LawName::Exponential => SampleLaw::Exponential,
            LawName::LogNormal => SampleLaw::LogNormal { sigma: d.sigma.unwrap_or(1.0) },
            LawName::Bernoulli => {
                SampleLaw::Bernoulli { q: d.q.unwrap_or(0.01), bright: d.bright.unwrap_or(1.0) }
            }
        };
        let own: &[&str] = match law {
            SampleLaw::Gaussian { .. } => &["sd", "relative"],
            SampleLaw::Exponential => &[],
            SampleLaw::LogNormal { .. } => &["sigma"],
            SampleLaw::Bernoulli { .. } => &["q", "bright"],
        };
        for (parameter, given) in [
            ("sd", d.sd.is_some()),
            ("relative", d.relative.is_some()),
            ("sigma", d.sigma.is_some()),
            ("q", d.q.is_some()),
            ("bright", d.bright.is_some()),
        ] {
            if given && !own.contains(&parameter) {
                let choice = format!("law {}", law.name());
                return Err(SyntheticError::NotApplicable { parameter, choice });
            }
        }
        let default = MeanImage::of(d.image);
        let scene = Self {
            image: MeanImage {
                kind: d.image,
                level: d.level.unwrap_or(default.level),
                contrast: d.contrast.unwrap_or(default.contrast),
                period: d.period.unwrap_or(default.period),
            },
            law,
            width: d.width.unwrap_or(Self::SIZE.0),
            height: d.height.unwrap_or(Self::SIZE.1),
            common_channels: d.common_channels,
            guides: d.guides,
            feature_sd: d.feature_sd.unwrap_or(Self::FEATURE_SD),
            flash_sd: d.flash_sd.unwrap_or(Self::FLASH_SD),
        };
        scene.check()?;
        Ok(scene)
    }
}

impl From<SyntheticScene> for Description {
    fn from(s: SyntheticScene) -> Self {
        let (mut sd, mut relative, mut sigma, mut q, mut bright) = (None, None, None, None, None);
        let law = match s.law {
            SampleLaw::Gaussian { sd: value, relative: of_mean } => {
                (sd, relative) = (Some(value), Some(of_mean));
                LawName::Gaussian
            }
            SampleLaw::Exponential => LawName::Exponential,
            SampleLaw::LogNormal { sigma: value } => {
                sigma = Some(value);
                LawName::LogNormal
            }
            SampleLaw::Bernoulli { q: probability, bright: share } => {
                (q, bright) = (Some(probability), Some(share));
                LawName::Bernoulli
            }
        };
        Self {
            image: s.image.kind,
            level: Some(s.image.level),
            contrast: Some(s.image.contrast),
            period: Some(s.image.period),
            law,
            sd,
            relative,
            sigma,
            q,
            bright,
            common_channels: s.common_channels,
            width: Some(s.width),
            height: Some(s.height),
            guides: s.guides,
            feature_sd: Some(s.feature_sd),
            flash_sd: Some(s.flash_sd),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<SyntheticScene, String> {
        toml::from_str(text).map_err(|e| e.message().to_owned())
    }

    #[test]
    fn a_study_table_round_trips() {
        for text in [
            "image = \"edges\"\nlaw = \"gaussian\"\nsd = 0.25\nrelative = true",
            "image = \"mixed\"\nlaw = \"exponential\"\nguides = \"none\"\nwidth = 8\nheight = 9",
            "image = \"texture\"\nperiod = 5\nlaw = \"log-normal\"\nsigma = 0.5",
            "image = \"flats\"\nlaw = \"bernoulli\"\nq = 0.02\ncommon_channels = true",
        ] {
            let scene = parse(text).unwrap();
            let again: SyntheticScene = toml::from_str(&toml::to_string(&scene).unwrap()).unwrap();
            assert_eq!(scene, again);
        }
        let scene = parse("image = \"edges\"\nlaw = \"gaussian\"\nsd = 0.25").unwrap();
        assert_eq!(scene.law(), SampleLaw::Gaussian { sd: 0.25, relative: false });
        assert_eq!((scene.width(), scene.height()), SyntheticScene::SIZE);
    }

    #[test]
    fn a_side_that_is_not_stated_is_that_of_the_study() {
        let size = |sides: &str, of_study| {
            let text = format!("image = \"edges\"\nlaw = \"gaussian\"\n{sides}");
            let spec: SyntheticSpec = toml::from_str(&text).unwrap();
            let scene = spec.scene(of_study).unwrap();
            (scene.width(), scene.height())
        };
        assert_eq!(size("", Some((5, 3))), (5, 3));
        assert_eq!(size("width = 7", Some((5, 3))), (7, 3));
        assert_eq!(size("width = 7\nheight = 8", Some((5, 3))), (7, 8));
        assert_eq!(size("height = 8", None), (SyntheticScene::SIZE.0, 8));
    }

    #[test]
    fn errors_name_the_parameter() {
        let table = [
            ("image = \"edges\"\nlaw = \"gaussian\"\nsd = -1", "parameter `sd` is -1"),
            ("image = \"edges\"\nlaw = \"exponential\"\nsd = 1", "`sd` has no meaning for law exponential"),
            ("image = \"edges\"\nlaw = \"bernoulli\"\nq = 0", "parameter `q` is 0"),
            ("image = \"edges\"\nlaw = \"exponential\"\nlevel = -1", "needs means ≥ 0"),
            ("image = \"edges\"\nlaw = \"gaussian\"\nwidth = 0", "parameter `width` is 0"),
            ("image = \"edges\"\nlaw = \"gaussian\"\nsdd = 0", "unknown field `sdd`"),
            ("image = \"edge\"\nlaw = \"gaussian\"", "unknown variant `edge`"),
            ("image = \"edges\"\nlaw = \"gaussian\"\nlevel = nan", "parameter `level`"),
        ];
        for (text, part) in table {
            let message = parse(text).unwrap_err();
            assert!(message.contains(part), "{message}");
        }
    }
}
