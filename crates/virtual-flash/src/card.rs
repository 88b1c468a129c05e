//! What the method needs and what may be claimed for its settings.

use noisefloor_denoiser::{
    Alternative, Citation, Claim, Claims, Cost, Entry, Invariance, MethodCard, Need, Published,
};

use crate::params::Step;
use crate::{GuideKind, Params, SpreadKind, TestKind};

/// Its id.
pub(crate) const ID: &str = "virtual-flash";

/// The source work.
pub const CITATION: Citation = Citation::with_entry(
    "moon2013flash",
    "B. Moon, J. Y. Jun, J. Lee, K. Kim, T. Hachisuka, S.-E. Yoon, Robust Image Denoising Using a Virtual Flash Image \
           for Monte Carlo Ray Tracing, Computer Graphics Forum 32(1), 2013",
    Entry {
        authors: "Bochang Moon and Jong Yun Jun and JongHyeob Lee and Kunho Kim and Toshiya Hachisuka and Sung-Eui Yoon",
        title: "Robust Image Denoising Using a Virtual Flash Image for Monte Carlo Ray Tracing",
        published: Published::Journal { name: "Computer Graphics Forum", volume: "32", number: "1" },
        year: 2013,
        pages: "139-151",
        doi: "10.1111/cgf.12004",
    },
);

pub(crate) fn card(id: &str, params: &Params, steps: &[Step]) -> MethodCard {
    let mut card = MethodCard::new(id, name(params), CITATION);
    card.needs = needs(params);
    card.alternatives = alternatives(params);
    card.neighbors = params.neighbors;
    card.cost = match params.neighbors {
        0 => Cost::Second,
        1..=2 => Cost::TenSeconds,
        _ => Cost::Minutes,
    };
    card.claims = claims(params, steps);
    card.varies_with =
        by_luminance(params).map(|why| (Invariance::ChannelOrder, why.into())).into_iter().collect();
    card.notes = notes(params);
    card
}

fn name(params: &Params) -> String {
    let mut name = String::from("Virtual flash");
    match params.guide {
        GuideKind::Flash => {}
        GuideKind::Color => name.push_str(", colour guide"),
        GuideKind::None => name.push_str(", no guide"),
    }
    if params.steps == 1 {
        name.push_str(", one step");
    }
    if !params.homogeneous {
        name.push_str(", all pixels");
    }
    name
}

fn needs(params: &Params) -> Vec<Need> {
    let mut needs = Vec::new();
    if params.guide == GuideKind::Flash {
        needs.extend([Need::Flash, Need::FlashVariance]);
    }
    if params.homogeneous || params.guide == GuideKind::Color {
        needs.push(Need::ColorVariance);
        needs.push(Need::Samples(2));
    }
    if params.homogeneous && params.steps == 2 && params.second_spread == SpreadKind::Halves {
        needs.push(Need::ColorHalves);
    }
    needs
}

/// Where channels count by their share in the luminance.
fn by_luminance(params: &Params) -> Option<&'static str> {
    let flash = params.guide == GuideKind::Flash;
    let test = params.homogeneous && params.test == TestKind::Luminance;
    match (flash, test) {
        (true, true) => Some("flash intensity and homogeneous pixels are found by luminance"),
        (true, false) => Some("the flash intensity makes up for missing luminance"),
        (false, true) => Some("homogeneous pixels are found by luminance"),
        (false, false) => None,
    }
}

/// Other guides for frames without a flash image, and another standard error for frames without halves.
fn alternatives(params: &Params) -> Vec<Alternative> {
    let mut alternatives = Vec::new();
    if params.guide == GuideKind::Flash {
        let flash = || vec![Need::Flash, Need::FlashVariance];
        let color = [Need::ColorVariance, Need::Samples(2)];
        alternatives.push(Alternative::new("guide", "color", flash()).asking(color));
        alternatives.push(Alternative::new("guide", "none", flash()));
    }
    if params.second_spread == SpreadKind::Halves {
        alternatives.push(Alternative::new("second_spread", "least", [Need::ColorHalves]));
    }
    alternatives
}

/// One step keeps D inside the interval of its own test (App. A, Eq. 6), as a mean of what lies there does: |D − x̄| ≤ L/2, always.
/// With the truth in it too, at the interval's probability, they are at most L apart (App. A, Eq. 7): |D − μ| ≤ 2·t·s/√n at
/// 1 − α, which is Theorem 3.1 (Sec. 3.4). L is the whole length; the appendix also asks that x̄ + L not be negative, which nothing needs.
///
/// In two steps (Sec. 3.5) with at most the input's standard error the triangle inequality gives |D₂−x̄| ≤ (t₁+t₂)·s/√n, and |D₂−μ| adds
/// t₁·s/√n with probability 1−α₁. The bound as printed, 2·t₂·s/√n, is not covered: step 2 compares filtered values.
///
/// Frames beside the target change none of it (Sec. 4): their pixels are in the set if their means lie in the interval of p.
fn claims(params: &Params, steps: &[Step]) -> Claims {
    let mut claims = Claims::default();
    // The luminance test bounds luminance alone; without the test nothing is bounded.
    let per_channel = params.homogeneous && params.test != TestKind::Luminance;
    claims.consistent = per_channel;
    if !per_channel {
        return claims;
    }
    let claim = |name: &'static str, terms, level, proven| Claim { name: name.into(), terms, level, proven };
    match steps {
        [only] => {
            let level = only.level;
            claims.enclosure.push(claim("interval", vec![(1.0, level)], level, true));
            claims.error_bound.push(claim("Theorem 3.1", vec![(2.0, level)], level, true));
        }
        [first, second] => {
            let (one, two) = (first.level, second.level);
            if matches!(params.second_spread, SpreadKind::Least | SpreadKind::Raw) {
                claims.enclosure.push(claim("composite", vec![(1.0, one), (1.0, two)], one, true));
                claims.error_bound.push(claim("composite", vec![(2.0, one), (1.0, two)], one, true));
            }
            claims.error_bound.push(claim("paper, as printed", vec![(2.0, two)], two, false));
        }
        _ => {}
    }
    claims
}

fn notes(params: &Params) -> Vec<String> {
    let mut notes = Vec::new();
    if params.homogeneous {
        notes.push(
            "bounds are proven for independent normal samples of a fixed number per pixel, per pixel and channel"
                .into(),
        );
    }
    match params.test {
        TestKind::Luminance if params.homogeneous => {
            notes.push("the luminance test bounds luminance only, and no channel".into());
        }
        _ => {}
    }
    if params.homogeneous && params.steps == 2 {
        notes.push(match params.second_spread {
            SpreadKind::Least => {
                "step 2 tests with the smaller of the input's and the propagated standard error".into()
            }
            SpreadKind::Raw => "step 2 tests with the input's standard error".into(),
            SpreadKind::Propagated => "step 2 tests with a propagated standard error: no proven bound".into(),
            SpreadKind::Halves => "step 2 tests with filtered half buffers: no proven bound".into(),
        });
    }
    if params.neighbors > 0 {
        notes.push("frames are compared place by place: nothing follows what moves".into());
    }
    if !params.homogeneous {
        notes.push("without homogeneous pixels nothing is claimed and the bias stays".into());
    }
    notes
}
