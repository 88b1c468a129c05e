//! Photon mapping against path tracing, and what maps promise.

mod common;

use common::*;
use glam::Vec3;
use noisefloor_frame::{FeatureId, Frame, Moments, Sampling};
use noisefloor_render::{
    Integrator, PhotonMaps, PhotonSettings, Prepared, Quantity, Recorded, RenderError, RenderRequest, Silent,
    render,
};
use noisefloor_scenes::{Scattering, Scene};
use noisefloor_stats::{holm_adjusted, t_two_sided_p};

const DEPTH: u32 = 4;
const WIDTH: usize = 16;
const HEIGHT: usize = 12;
const BLOCK: usize = 4;

/// Photon maps are averaged over this many.
const MAPS: u64 = 16;

/// A box of side 2 with a lamp, seen from within so that the image shows the floor away from its edges.
fn room(extra: impl FnOnce(&mut Scene)) -> Scene {
    let mut scene = empty(camera(Vec3::new(0.0, 1.7, 0.9), Vec3::new(0.0, 0.0, 0.1), 26.0));
    let white = add_material(&mut scene, diffuse_rgb(Vec3::new(0.7, 0.6, 0.5)), 0.0);
    let light = add_material(&mut scene, diffuse(0.2), 5.0);
    cuboid(&mut scene, Vec3::new(-1.0, 0.0, -1.0), Vec3::new(1.0, 2.0, 1.0), true, white);
    quad(&mut scene, Vec3::new(-0.4, 1.9, -0.6), Vec3::X * 0.8, Vec3::Z * 0.8, light);
    extra(&mut scene);
    scene
}

fn settings() -> PhotonSettings {
    PhotonSettings {
        paths: 40_000,
        caustic_paths: 60_000,
        radius: 0.16,
        caustic_pixels: 1000.0,
        caustic_radius: 0.16,
    }
}

fn image(prepared: &Prepared, photons: Option<&PhotonMaps>, spp: u32, seed: u64) -> Frame {
    let integrator = if photons.is_some() { Integrator::PhotonMapping } else { Integrator::PathTracing };
    let request = RenderRequest {
        seed,
        integrator,
        photons,
        depth: DEPTH,
        sampling: Sampling::LowDiscrepancy,
        record: Recorded::color_only(),
        ..RenderRequest::new(prepared, WIDTH, HEIGHT, spp)
    };
    render(&request, &Silent).unwrap()
}

/// Means of blocks of 4 × 4 pixels, over the colours.
fn blocks(frame: &Frame) -> [f64; 12] {
    let image = &frame.color.mean;
    std::array::from_fn(|block| {
        let (x, y) = (block % (WIDTH / BLOCK) * BLOCK, block / (WIDTH / BLOCK) * BLOCK);
        let mut sum = 0.0;
        for k in 0..BLOCK * BLOCK {
            let pixel = (y + k / BLOCK) * WIDTH + x + k % BLOCK;
            sum += (0..3).map(|c| f64::from(image.plane(c)[pixel])).sum::<f64>();
        }
        sum / (3 * BLOCK * BLOCK) as f64
    })
}

/// What a light path has to do beside diffuse surfaces.
fn glass(scene: &mut Scene) {
    let glass = add_material(scene, Scattering::Glass { ior: 1.5 }, 0.0);
    sphere(scene, Vec3::new(0.0, 0.75, -0.3), 0.3, glass);
}

fn metal(scene: &mut Scene) {
    let metal = add_material(scene, conductor(0.9, 0.1), 0.0);
    sphere(scene, Vec3::new(0.9, 0.5, 0.0), 0.3, metal);
}

/// Radii as factors, and the weights with which a polynomial of degree 2 through them gives its value at radius 0.
const RADII: [(f32, f64); 3] = [(1.0, 1.0 / 3.0), (0.5, -2.0), (0.25, 8.0 / 3.0)];

/// Compares photon mapping at three radii with path tracing: the difference shrinks with the radius, and where it
/// points to for radius 0 is nothing. Returns the p-values of the blocks.
fn compare(scene: &Scene) -> Vec<f64> {
    let prepared = Prepared::new(scene).unwrap();
    let mut truth = Moments::<12>::default();
    for k in 0..16 {
        truth.push(blocks(&image(&prepared, None, 1024, 1000 + k)));
    }
    let mut by_radius = [Moments::<12>::default(); 3];
    let mut at_zero = Moments::<12>::default();
    for map in 0..MAPS {
        let mut sum = [0.0; 12];
        for (moments, (factor, weight)) in by_radius.iter_mut().zip(RADII) {
            // The same light paths for all radii: their errors largely cancel in the extrapolation.
            let maps = PhotonMaps::new(&prepared, &settings().scaled(factor), map).unwrap();
            let values = blocks(&image(&prepared, Some(&maps), 32, map));
            moments.push(values);
            sum.iter_mut().zip(values).for_each(|(s, v)| *s += weight * v);
        }
        at_zero.push(sum);
    }
    let bias = by_radius.map(|m| {
        let apart = m.mean().into_iter().zip(truth.mean()).map(|(a, b)| (a - b) * (a - b));
        (apart.sum::<f64>() / 12.0).sqrt()
    });
    assert!(
        bias[0] > 1.3 * bias[1] && bias[1] > 1.3 * bias[2],
        "the bias does not shrink with the radius: {bias:?}"
    );
    let (maps, reference) = (at_zero.mean_variance().unwrap(), truth.mean_variance().unwrap());
    (0..12)
        .map(|block| {
            let error = (maps[block] + reference[block]).sqrt();
            let truth = truth.mean()[block];
            assert!(error < 0.012 * truth, "block {block}: standard error {error} is no test of {truth}");
            // Both means have at least 15 degrees of freedom.
            t_two_sided_p((at_zero.mean()[block] - truth) / error, MAPS - 1)
        })
        .collect()
}

#[test]
fn photon_mapping_tends_to_path_tracing_as_its_radii_shrink() {
    let p: Vec<f64> = [glass, metal].into_iter().flat_map(|extra| compare(&room(extra))).collect();
    let adjusted = holm_adjusted(&p);
    assert!(adjusted.iter().all(|p| *p > 0.01), "{adjusted:?}");
}

#[test]
fn direct_light_is_that_of_path_tracing_bit_for_bit() {
    let prepared = Prepared::new(&room(glass)).unwrap();
    let maps = PhotonMaps::new(&prepared, &settings(), 1).unwrap();
    let by = |integrator, photons, depth| {
        let record = Recorded::exactly([Quantity::Direct, Quantity::Flash]);
        let request =
            RenderRequest { integrator, photons, depth, record, ..RenderRequest::new(&prepared, 16, 12, 4) };
        render(&request, &Silent).unwrap()
    };
    let [path, photon] = [(Integrator::PathTracing, None), (Integrator::PhotonMapping, Some(&maps))]
        .map(|(integrator, photons)| by(integrator, photons, 2));
    // No room for light that only the maps know: their photons have at least two edges more.
    assert!(path.color.mean == photon.color.mean);
    let deep = by(Integrator::PhotonMapping, Some(&maps), DEPTH);
    assert!(deep.color.mean != photon.color.mean);
    let path = by(Integrator::PathTracing, None, DEPTH);
    assert!(deep.features[&FeatureId::Direct].mean == path.features[&FeatureId::Direct].mean);
    assert_eq!(deep.provenance.extra["photon_map_seed"], "1");
    assert!(deep.provenance.integrator.unwrap().starts_with("photon-mapping"));
}

#[test]
fn maps_depend_on_their_random_seed_and_not_on_the_number_of_threads() {
    let prepared = Prepared::new(&room(glass)).unwrap();
    let render_with = |threads, seed| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let few = PhotonSettings { paths: 9_000, caustic_paths: 20_000, ..settings() };
            let maps = PhotonMaps::new(&prepared, &few, seed).unwrap();
            assert!(maps.len().iter().all(|n| *n > 500), "{:?}", maps.len());
            image(&prepared, Some(&maps), 4, 0).color.mean
        })
    };
    let one = render_with(1, 5);
    assert!(one == render_with(3, 5));
    assert!(one != render_with(1, 6));
}

#[test]
fn caustic_density_is_there_where_something_bends_light() {
    let density = |scene: &Scene| {
        let prepared = Prepared::new(scene).unwrap();
        let maps = PhotonMaps::new(&prepared, &settings(), 2).unwrap();
        let record = Recorded::exactly([Quantity::Caustics, Quantity::Albedo]);
        let request =
            RenderRequest { photons: Some(&maps), record, ..RenderRequest::new(&prepared, WIDTH, HEIGHT, 8) };
        render(&request, &Silent).unwrap().features[&FeatureId::Caustics].mean.clone()
    };
    assert!(density(&room(|_| {})).data().iter().all(|v| *v == 0.0));
    let bright = density(&room(glass));
    let most = bright.data().iter().fold(0.0f32, |a, b| a.max(*b));
    // 60 000 paths from a lamp above: the ball turns a few hundredths of them onto about a tenth of a unit of area.
    assert!(most > 0.05 && most < 5.0, "{most}");
}

#[test]
fn what_photon_maps_cannot_do_is_said() {
    let prepared = Prepared::new(&room(glass)).unwrap();
    let request =
        RenderRequest { integrator: Integrator::PhotonMapping, ..RenderRequest::new(&prepared, 2, 2, 2) };
    let message = |error: RenderError| error.to_string();
    assert!(message(render(&request, &Silent).unwrap_err()).contains("photons is absent"));
    let few = PhotonSettings { paths: 100, caustic_paths: 100, ..settings() };
    let other = Scene { id: "other".into(), ..room(metal) };
    let maps = PhotonMaps::new(&Prepared::new(&other).unwrap(), &few, 0).unwrap();
    let request = RenderRequest { photons: Some(&maps), ..request };
    assert!(message(render(&request, &Silent).unwrap_err()).contains("of scene `other`"));
    // Equal in name only.
    let again = Prepared::new(&other).unwrap();
    let request = RenderRequest { scene: &again, ..request };
    assert!(message(render(&request, &Silent).unwrap_err()).contains("another preparation"));
    for (bad, word) in [
        (PhotonSettings { paths: 0, ..few }, "paths"),
        (PhotonSettings { caustic_paths: 1 << 30, ..few }, "caustic-paths"),
        (PhotonSettings { radius: f32::NAN, ..few }, "radius"),
        (PhotonSettings { caustic_radius: 2.0, ..few }, "caustic-radius"),
        (PhotonSettings { caustic_pixels: 0.0, ..few }, "caustic-pixels"),
        (few.scaled(1e-22), "radius"),
    ] {
        assert!(message(PhotonMaps::new(&prepared, &bad, 0).unwrap_err()).starts_with(word), "{word}");
    }
    let mut foggy = room(glass);
    foggy.medium =
        Some(noisefloor_scenes::Medium { absorption: Vec3::ONE, scattering: Vec3::ONE, mean_cosine: 0.0 });
    let error = PhotonMaps::new(&Prepared::new(&foggy).unwrap(), &few, 0).unwrap_err();
    assert!(message(error).contains("a medium"));
    let mut moving = room(metal);
    moving.add_body(1.0, noisefloor_scenes::Body { meshes: vec![0], ..Default::default() });
    let error = PhotonMaps::new(&Prepared::new(&moving).unwrap(), &few, 0).unwrap_err();
    assert!(message(error).contains("moving bodies"));
    // A scene without light has empty maps, and is black.
    let mut dark = room(|_| {});
    dark.materials[1].emission = Vec3::ZERO;
    let dark = Prepared::new(&dark).unwrap();
    let maps = PhotonMaps::new(&dark, &few, 0).unwrap();
    assert!(maps.is_empty());
    assert!(image(&dark, Some(&maps), 2, 0).color.mean.data().iter().all(|v| *v == 0.0));
}
