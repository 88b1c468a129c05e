//! What headers say about shared random numbers.

use noisefloor_frame::Provenance;

/// What a header says about where an image came from.
#[derive(Debug, Clone, Copy)]
pub struct Origin<'a> {
    /// Scene, renderer, sampler and seed.
    pub provenance: &'a Provenance,
    /// Samples per pixel, if it says.
    pub spp: Option<f64>,
}

/// Two images whose headers name the same scene, renderer, sampler and random seed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SharedSeed {
    /// The seed.
    pub seed: u64,
    /// Whether that proves that they share samples: both were made by this project's own renderers, where a sample
    /// follows from seed, pixel and index alone. Of other programs it only raises the suspicion.
    pub proven: bool,
}

/// First words of the renderers whose samples follow from seed, pixel and index.
const OURS: &str = "noisefloor";

/// Header attribute of our renderer: index of the first sample, if it is not 0.
const SAMPLE_START: &str = "sample_start";

/// Whether two images that must be independent were made from the same random numbers, as far as both headers say
/// scene, renderer, sampler and seed.
///
/// Versions and settings of the renderer may differ: its random numbers do not depend on them. Ranges of samples of one
/// run that do not overlap are independent.
#[must_use]
pub fn shared_seed(a: Origin<'_>, b: Origin<'_>) -> Option<SharedSeed> {
    let (p, q) = (a.provenance, b.provenance);
    let seed = p.seed.filter(|seed| q.seed == Some(*seed))?;
    let same = |x: &Option<String>, y: &Option<String>| x.is_some() && x == y;
    let renderer = program(p).filter(|name| program(q).as_ref() == Some(name))?;
    if !same(&p.scene, &q.scene) || !same(&p.sampler, &q.sampler) {
        return None;
    }
    let proven = renderer.starts_with(OURS);
    if proven && disjoint(a, b) {
        return None;
    }
    Some(SharedSeed { seed, proven })
}

/// The name of the renderer without its version.
fn program(provenance: &Provenance) -> Option<String> {
    let text = provenance.renderer.as_deref()?;
    text.split_whitespace().next().map(str::to_lowercase)
}

/// Whether the ranges of sample indices are known and do not overlap.
fn disjoint(a: Origin<'_>, b: Origin<'_>) -> bool {
    let range = |origin: Origin<'_>| {
        let start = match origin.provenance.extra.get(SAMPLE_START) {
            Some(text) => text.parse::<f64>().ok()?,
            None => 0.0,
        };
        origin.spp.map(|spp| (start, start + spp))
    };
    match (range(a), range(b)) {
        (Some((a0, a1)), Some((b0, b1))) => a1 <= b0 || b1 <= a0,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn header(renderer: &str, sampler: &str, seed: u64) -> Provenance {
        Provenance {
            scene: Some("cornell".into()),
            renderer: Some(renderer.into()),
            sampler: Some(sampler.into()),
            seed: Some(seed),
            ..Provenance::default()
        }
    }

    fn of(provenance: &Provenance, spp: f64) -> Origin<'_> {
        Origin { provenance, spp: Some(spp) }
    }

    #[test]
    fn equal_scene_sampler_and_seed_of_our_own_renderer_are_proof() {
        let (a, b) = (
            header("noisefloor-render 0.1.0", "independent", 7),
            header("noisefloor-render 0.2.0", "independent", 7),
        );
        assert_eq!(shared_seed(of(&a, 16.0), of(&b, 256.0)), Some(SharedSeed { seed: 7, proven: true }));
        for other in [
            header("noisefloor-render 0.1.0", "independent", 8),
            header("noisefloor-render 0.1.0", "owen-sobol", 7),
            header("other 0.1.0", "independent", 7),
            Provenance { scene: Some("toaster".into()), ..b.clone() },
            Provenance { scene: None, ..b.clone() },
            Provenance { seed: None, ..b.clone() },
        ] {
            assert_eq!(shared_seed(of(&a, 16.0), of(&other, 16.0)), None, "{other:?}");
        }
    }

    #[test]
    fn ranges_of_one_run_that_do_not_overlap_are_independent() {
        let a = header("noisefloor-render 0.1.0", "independent", 7);
        let mut b = a.clone();
        b.extra.insert(SAMPLE_START.into(), "16".into());
        assert_eq!(shared_seed(of(&a, 16.0), of(&b, 16.0)), None);
        assert!(shared_seed(of(&a, 17.0), of(&b, 16.0)).is_some());
        assert!(shared_seed(Origin { provenance: &a, spp: None }, of(&b, 16.0)).is_some(), "unknown range");
    }

    #[test]
    fn of_other_renderers_an_equal_seed_is_a_suspicion() {
        let a = header("Mitsuba 3.5.2", "independent", 0);
        assert_eq!(shared_seed(of(&a, 16.0), of(&a, 64.0)), Some(SharedSeed { seed: 0, proven: false }));
    }
}
