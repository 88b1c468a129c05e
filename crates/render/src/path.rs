//! The path integrator: unidirectional path tracing with next event estimation (Kajiya 1986), multiple importance
//! sampling (Veach 1997) and Russian roulette (Arvo and Kirk 1990).

use glam::Vec3A;

use crate::bsdf::{Event, Lobe};
use crate::bvh::{Hit, Ray};
use crate::intersect::Traversal;
use crate::medium::Flight;
use crate::prepare::Prepared;
use crate::recorder::{End, Recorder, Turn, Vertex};
use crate::sampler::Sampler;
use crate::view::View;
use steps::{Path, emission};

mod steps;

/// Traces one path and returns the radiance along its first ray; `recorder` sees all of it. What most scenes do not need
/// (a medium, moving bodies, photon mapping) is there only with `EXTRAS`.
pub fn trace<S: Sampler, R: Recorder, const EXTRAS: bool>(
    scene: &Prepared,
    ray: Ray,
    view: &View<'_>,
    sampler: S,
    recorder: &mut R,
    traversal: &mut Traversal,
) -> Vec3A {
    let mut path = Path::new(sampler, ray);
    recorder.started();
    loop {
        let hit = scene.closest::<EXTRAS>(&path.ray, f32::INFINITY, traversal);
        let before = path.throughput;

        // The medium: a free flight ends at the surface ahead, dimmed, or at a collision before it.
        if EXTRAS
            && path.outside
            && let Some(medium) = &scene.medium
        {
            // Finite: an infinite thickness of a colour without extinction would not be a number.
            let limit = hit.map_or(f32::MAX, |hit| hit.t);
            match medium.fly(limit, path.throughput, path.sampler.group(2 * path.edge - 1)[3]) {
                Flight::Passed(weight) => path.throughput *= weight,
                Flight::Scattered(t, weight) => {
                    let seen = hit.filter(|_| recorder.looks());
                    record_in_medium::<S, R, EXTRAS>(&path, scene, view, seen, before, recorder, traversal);
                    if path.edge < view.depth
                        && path.scatter_in_medium::<EXTRAS>(scene, medium, t, weight, traversal)
                    {
                        continue;
                    }
                    break;
                }
            }
        }

        // Light from infinitely far away ends the path.
        let Some(hit) = hit else {
            if path.counts::<EXTRAS>() {
                path.color += path.throughput * scene.lights.background(path.ray.direction, path.previous);
            }
            recorder.hit(&End::Background, path.color);
            break;
        };

        // At the end of the longest path only emission matters, and what the recorder looks at.
        let geometry = &scene.geometry[hit.primitive as usize];
        let surface = &scene.surfaces[geometry.material as usize];
        let last = path.edge >= view.depth;
        let shaded = !last || recorder.looks();
        if !(shaded || surface.emits) {
            break;
        }
        let at = scene.interact::<EXTRAS>(&path.ray, &hit, traversal);

        // Emission: the half of direct light that the choice of this direction found.
        if surface.emits && path.counts::<EXTRAS>() {
            path.color += path.throughput * emission(scene, geometry, &at, &path.ray, hit.t, path.previous);
        }
        if !shaded {
            break;
        }
        let event = surface.scatter.at(at.uv);
        let to_viewer = -path.ray.direction;
        let choice = path.sampler.group(2 * path.edge);
        let (hit, throughput) = (&hit, before);
        let vertex =
            Vertex { scene, view, traversal, hit, at: &at, event: &event, to_viewer, throughput, choice };
        recorder.hit(&End::Surface(vertex), path.color);
        if EXTRAS {
            path.length += hit.t;
        }
        if last {
            break;
        }

        // Perfectly specular surfaces leave no choice of direction, so light sampling has nothing to add.
        let lobe = match event {
            Event::Lobe(lobe) => lobe,
            Event::Specular(specular) => {
                recorder.scattered(&Turn::Specular(specular.tint()));
                if path.follow::<EXTRAS>(&specular, &at, to_viewer, choice) {
                    continue;
                }
                break;
            }
        };

        // Photon maps (Jensen 1996): caustics where the eye looks, everything where the gathering ray arrives.
        if EXTRAS && view.gather && path.gather(view, &at, &lobe) {
            break;
        }

        // Next event estimation: the other half of direct light, by a ray towards a light.
        let mut reached = None;
        if !EXTRAS || path.gathered.is_none() {
            reached = path.sample_light::<EXTRAS>(scene, &at, &lobe, to_viewer, traversal);
        }
        recorder.scattered(&Turn::Lobe { diffuse: matches!(lobe, Lobe::Diffuse { .. }), reached });

        // On in a direction that the surface prefers, if roulette lets the path live.
        if !path.bounce::<EXTRAS>(view, &at, &lobe, to_viewer, choice) {
            break;
        }
    }
    recorder.finished(path.color);
    if EXTRAS { path.color + path.by_photons } else { path.color }
}

/// Tells a recorder of a collision in the medium. Features and the eye light belong to the surface ahead, whatever floats
/// before it.
#[inline(always)]
fn record_in_medium<S: Sampler, R: Recorder, const EXTRAS: bool>(
    path: &Path<S>,
    scene: &Prepared,
    view: &View<'_>,
    ahead: Option<Hit>,
    throughput: Vec3A,
    recorder: &mut R,
    traversal: &Traversal,
) {
    let Some(hit) = &ahead else { return recorder.hit(&End::Medium(None), path.color) };
    let at = &scene.interact::<EXTRAS>(&path.ray, hit, traversal);
    let event = &scene.surfaces[scene.geometry[hit.primitive as usize].material as usize].scatter.at(at.uv);
    let (to_viewer, choice) = (-path.ray.direction, path.sampler.group(2 * path.edge));
    let vertex = Vertex { scene, view, traversal, hit, at, event, to_viewer, throughput, choice };
    recorder.hit(&End::Medium(Some(vertex)), path.color);
}

#[cfg(test)]
mod tests;
