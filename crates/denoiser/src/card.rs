//! Who a method is: source, needs, claims, cost.

use std::borrow::Cow;
use std::fmt;

use noisefloor_frame::{FeatureId, Frame};
use noisefloor_stats::Level;

use crate::{Alternative, Caveat, Citation, Need, param::nearest};

/// What a method promises, each with its conditions in [`MethodCard::notes`].
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Claims {
    /// |D−x̄| ≤ factor · t(level)·s/√n holds always, per pixel and channel.
    pub enclosure: Vec<Claim>,
    /// P(|D−μ| ≤ factor · t(level)·s/√n) ≥ 1−α per pixel and channel.
    pub error_bound: Vec<Claim>,
    /// Claimed to converge to the truth as n → ∞.
    pub consistent: bool,
    /// Gives a per-pixel estimate of its own error.
    pub estimates_error: bool,
}

/// One half-width as a sum of t(level)·s/√n terms.
#[derive(Debug, Clone, PartialEq)]
pub struct Claim {
    /// Name shown in reports, such as `Theorem 3.1`.
    pub name: Cow<'static, str>,
    /// Half-width = Σ factor·t(level)·s/√n.
    pub terms: Vec<(f64, Level)>,
    /// 1−α that the bound is claimed for; meaningless for an enclosure, which is certain.
    pub level: Level,
    /// Whether a proof covers this exact procedure; otherwise it is reported as measured only.
    pub proven: bool,
}

/// What a result should not depend on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Invariance {
    /// All radiances times a power of two give the image times that power.
    Exposure,
    /// Other names for red, green and blue.
    ChannelOrder,
    /// Features in other units: depth in centimetres for metres.
    FeatureUnits,
}

impl Invariance {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Exposure, Self::ChannelOrder, Self::FeatureUnits];
}

impl fmt::Display for Invariance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Exposure => "exposure",
            Self::ChannelOrder => "order of channels",
            Self::FeatureUnits => "units of features",
        })
    }
}

/// How long a method takes for a megapixel on one core at its parameters, roughly: what plans and estimates begin with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cost {
    /// No time worth telling.
    None,
    /// About a second.
    Second,
    /// About ten seconds.
    TenSeconds,
    /// Minutes.
    Minutes,
}

impl Cost {
    /// Seconds for a megapixel on one core, to a factor of three.
    #[must_use]
    pub fn seconds(self) -> f64 {
        match self {
            Self::None => 0.01,
            Self::Second => 1.0,
            Self::TenSeconds => 10.0,
            Self::Minutes => 100.0,
        }
    }
}

/// What a method is there for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// To denoise: it takes part wherever all methods do.
    Method,
    /// A part of another method, run alone where asked for by name.
    Part,
    /// To show a mistake: no baseline, and it sets no axis.
    Fixture,
}

/// Identity, requirements and claims of a configured method.
#[derive(Debug, Clone, PartialEq)]
pub struct MethodCard {
    /// Stable id such as `virtual-flash` or `guarded(virtual-flash)`.
    pub id: String,
    /// Name for people.
    pub name: String,
    /// Source.
    pub citation: Citation,
    /// Inputs it cannot run without.
    pub needs: Vec<Need>,
    /// Inputs it uses if present; a renderer records these too.
    pub uses: Vec<Need>,
    /// Settings under which it does without some of its needs.
    pub alternatives: Vec<Alternative>,
    /// Features that its parameters name. One that has no fixed meaning ([`FeatureId::KNOWN`]) must be in the frame:
    /// otherwise the name is a mistake, see [`crate::Input::check`].
    pub named_features: Vec<String>,
    /// Frames of an animation that it uses on each side of the target, if [`crate::Input`] has them.
    pub neighbors: usize,
    /// Promises.
    pub claims: Claims,
    /// Whether its estimate of its own error is unbiased for a filter that does not follow the noise, normal noise, and a
    /// variance that is known: what SURE promises. Such a method shows whether variance or estimate is wrong.
    pub unbiased_estimate: bool,
    /// What the result depends on although it should not, each with the reason; everything else in [`Invariance`] is a
    /// promise that is tested.
    pub varies_with: Vec<(Invariance, String)>,
    /// What else it does not promise, each with the reason.
    pub caveats: Vec<(Caveat, String)>,
    /// Rough cost.
    pub cost: Cost,
    /// What it is there for.
    pub role: Role,
    /// Conditions, deviations and known failures worth a line in a report.
    pub notes: Vec<String>,
}

impl MethodCard {
    /// A card that needs and claims nothing.
    #[must_use]
    pub fn new(id: impl Into<String>, name: impl Into<String>, citation: Citation) -> Self {
        Self {
            id: id.into(),
            name: name.into(),
            citation,
            needs: Vec::new(),
            uses: Vec::new(),
            alternatives: Vec::new(),
            named_features: Vec::new(),
            neighbors: 0,
            claims: Claims::default(),
            unbiased_estimate: false,
            varies_with: Vec::new(),
            caveats: Vec::new(),
            cost: Cost::Second,
            role: Role::Method,
            notes: Vec::new(),
        }
    }

    /// The first of [`Self::named_features`] that has no fixed meaning and is none of `there`, with the nearest names.
    #[must_use]
    pub fn unknown_feature<'a>(
        &self,
        there: impl Iterator<Item = &'a str> + Clone,
    ) -> Option<(String, Vec<String>)> {
        let known = || FeatureId::KNOWN.iter().map(FeatureId::name).chain(there.clone());
        let unknown = self.named_features.iter().find(|name| !known().any(|known| known == *name))?;
        let mut names: Vec<&str> = known().collect();
        names.sort_unstable();
        names.dedup();
        // Letters of another size are the same name to people.
        let given = unknown.to_lowercase();
        Some((unknown.clone(), nearest(&given, names.into_iter())))
    }

    /// The needs that a frame does not meet.
    #[must_use]
    pub fn missing(&self, frame: &Frame) -> Vec<Need> {
        self.needs.iter().filter(|need| !need.is_met(frame)).cloned().collect()
    }
}
