//! Every built-in scene, all the way through.

use noisefloor::harness::{StudyRun, run};
use noisefloor::questions::violations;
use noisefloor::render::{
    Integrator, PhotonMaps, PhotonSettings, Prepared, Recorded, RenderRequest, Silent as Quiet, render,
};
use noisefloor::scenes::builtin;
use noisefloor::study::{MethodRow, Shot, Study};

#[test]
fn every_scene_can_be_studied_by_its_name() {
    let cache = tempfile::tempdir().unwrap();
    for entry in builtin() {
        let rows = ["mc", "virtual-flash", "guarded(geometric-corrected)"].map(MethodRow::new).into();
        let mapped = entry.photon_mapped;
        let few = PhotonSettings { paths: 3000, caustic_paths: 3000, ..PhotonSettings::default() };
        let shot = Shot {
            integrator: if mapped { Integrator::PhotonMapping } else { Integrator::PathTracing },
            photons: mapped.then_some(few),
            ..Shot::default()
        };
        let mut study = Study::for_scene(entry.id, shot, rows).unwrap();
        study.spp = vec![4];
        study.reference.spp = 64;
        study.timing.warmup = 0;
        study.timing.runs = 1;
        let folder = tempfile::tempdir().unwrap();
        let registry = noisefloor::registry::registry([]);
        let summary = run(&StudyRun {
            size: Some((20, 15)),
            ..StudyRun::new(&study, &registry, folder.path(), cache.path())
        })
        .unwrap_or_else(|e| panic!("{}: {e}", entry.id));
        assert_eq!(summary.cells.len(), 3, "{}", entry.id);
        assert!(summary.skipped.is_empty(), "{}: {:?}", entry.id, summary.skipped);
        assert!(violations(&summary).is_empty(), "{}", entry.id);
        // A constant image has nothing to denoise; everywhere else samples differ.
        assert!(!summary.coverage.is_empty(), "{}", entry.id);
    }
}

#[test]
fn every_scene_gives_the_same_bits_on_any_number_of_threads() {
    for entry in builtin() {
        let scene = (entry.build)().at_frame(1);
        let image = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let prepared = Prepared::new(&scene).unwrap();
                let few = PhotonSettings { paths: 5000, caustic_paths: 9000, ..PhotonSettings::default() };
                let maps = entry.photon_mapped.then(|| PhotonMaps::new(&prepared, &few, 3).unwrap());
                let mut request = RenderRequest::new(&prepared, 16, 12, 4);
                request.record = Recorded::Available;
                if maps.is_some() {
                    request.integrator = Integrator::PhotonMapping;
                    request.photons = maps.as_ref();
                }
                render(&request, &Quiet).unwrap()
            })
        };
        let (one, three) = (image(1), image(3));
        assert!(one.color == three.color && one.features == three.features, "{}", entry.id);
        assert!(one.flash == three.flash, "{}", entry.id);
        assert_eq!(one.color.mean.count_non_finite(), 0, "{}", entry.id);
        assert!(!one.provenance.extra.contains_key("non_finite_samples"), "{}", entry.id);
    }
}
