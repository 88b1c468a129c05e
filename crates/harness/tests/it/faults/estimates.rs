//! A method whose estimate of its own error lacks a term.

use noisefloor_denoiser::{Registry, mc};
use noisefloor_harness::Laboratory;
use noisefloor_study::check::CheckKind;

use super::boxed::{Sure, boxed};
use super::planted::{TINY, measured_with, named, silent};

#[test]
fn g_an_estimate_without_its_derivative_term_is_named_where_the_variance_is_known() {
    let registry = Registry::new([mc(), boxed(Sure::WithoutDerivative)]);
    let summary = measured_with(TINY, Laboratory::default(), &registry);
    for spp in [4, 16] {
        let found = named(&summary, CheckKind::KnownVariance, "normal (instrument)", spp, 10.0);
        assert!(found.record.what.contains("boxed") && found.record.found.unwrap().value < 0.0, "{found:?}");
    }
    let others = CheckKind::ALL.into_iter().filter(|kind| *kind != CheckKind::KnownVariance);
    silent(&summary, &others.collect::<Vec<_>>());
}
