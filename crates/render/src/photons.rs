//! Photon maps (Jensen 1996): light that was followed from its sources, kept where it meets diffuse surfaces.
//!
//! Two maps are kept. The *caustic* map has photons that only specular and glossy surfaces turned on their way; it is
//! looked at directly, with a radius that follows the size of a pixel. The *global* map has all photons and is looked at
//! from where a gathering ray arrives.

use glam::Vec3A;
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use noisefloor_frame::PhotonSettings;
use rayon::iter::{IntoParallelIterator, ParallelIterator};

use crate::RenderError;
use crate::bsdf::Event;
use crate::bvh::Ray;
use crate::interaction::Interaction;
use crate::intersect::Traversal;
use crate::lights::Ball;
use crate::limits::DEEPEST;
use crate::prepare::Prepared;
use crate::sampler::{Independent, Sampler, mix, pixel_key};

/// Refuses numbers of paths and radii that no map can have.
fn check(settings: &PhotonSettings) -> Result<(), RenderError> {
    let paths = [("paths", settings.paths), ("caustic-paths", settings.caustic_paths)];
    if let Some((parameter, value)) = paths.into_iter().find(|(_, v)| !(1..=1 << 26).contains(v)) {
        return Err(wrong(parameter, value.to_string(), "1 to 67108864 light paths"));
    }
    let radii = [("radius", settings.radius, 1.0), ("caustic-radius", settings.caustic_radius, 1.0)];
    let radii = radii.into_iter().chain([("caustic-pixels", settings.caustic_pixels, 1000.0)]);
    for (parameter, value, most) in radii {
        if !(1e-6..=most).contains(&value) {
            return Err(wrong(parameter, value.to_string(), &format!("in 1e-6..={most}")));
        }
    }
    Ok(())
}

fn wrong(parameter: &'static str, value: String, expected: &str) -> RenderError {
    RenderError::InvalidRequest { parameter, value, expected: expected.to_owned() }
}

/// Light that met a diffuse surface.
#[derive(Debug, Clone, Copy)]
struct Photon {
    position: [f32; 3],
    /// Geometric normal on the side that was lit.
    normal: [f32; 3],
    /// Flux, so that its density is the irradiance about the shading normal.
    flux: [f32; 3],
    /// Edges from the light to here.
    edges: u32,
}

/// Photons with a tree over their positions.
#[derive(Debug)]
struct Map {
    photons: Vec<Photon>,
    /// None without photons.
    tree: Option<ImmutableKdTree<f32, 3>>,
}

impl Map {
    fn new(photons: Vec<Photon>) -> Result<Self, RenderError> {
        if photons.is_empty() {
            return Ok(Self { photons, tree: None });
        }
        let positions: Vec<[f32; 3]> = photons.iter().map(|p| p.position).collect();
        let tree = ImmutableKdTree::new_from_slice(&positions).map_err(|e| {
            wrong("paths", photons.len().to_string(), &format!("photons that fit a tree ({e})"))
        })?;
        Ok(Self { photons, tree: Some(tree) })
    }

    /// Flux and number of photons per area about a point, of those with at most `edges` edges: a kernel that falls from
    /// twice the mean at the middle to 0 at `radius` (Epanechnikov's), over photons whose surface faces the same way.
    fn density(&self, at: &Interaction, radius: f32, edges: u32) -> (Vec3A, f32) {
        let Some(tree) = &self.tree else { return (Vec3A::ZERO, 0.0) };
        let squared = radius * radius;
        // Scenes so small that areas underflow have no densities.
        if squared < f32::MIN_POSITIVE {
            return (Vec3A::ZERO, 0.0);
        }
        let (mut flux, mut count) = ([0.0f64; 3], 0.0f64);
        tree.query(&at.point.to_array()).within::<SquaredEuclidean<f32>>(squared).unsorted().visit(|found| {
            let photon = &self.photons[found.item as usize];
            let apart = (Vec3A::from_array(photon.position) - at.point).length_squared();
            let weight = f64::from(1.0 - apart / squared);
            if weight > 0.0
                && photon.edges <= edges
                && Vec3A::from_array(photon.normal).dot(at.geometric) > SAME_SIDE
            {
                for (sum, f) in flux.iter_mut().zip(photon.flux) {
                    *sum += weight * f64::from(f);
                }
                count += weight;
            }
        });
        let scale = 2.0 / (std::f64::consts::PI * f64::from(squared)); // positive: see above
        (Vec3A::from_array(flux.map(|f| (f * scale) as f32)), (count * scale) as f32)
    }
}

/// Least cosine between the normals of a photon and of where it is looked for.
const SAME_SIDE: f32 = 0.7;

/// Most that interpolated normals may change a photon's flux at one vertex: the ratio of cosines has no bound at grazing
/// angles.
const MOST_CORRECTION: f32 = 8.0;

/// The photon maps of a scene. Another random seed gives other maps, whose estimates are independent.
#[derive(Debug)]
pub struct PhotonMaps {
    scene: String,
    stamp: u64,
    settings: PhotonSettings,
    seed: u64,
    caustic: Map,
    global: Map,
    /// Of the scene, in its units.
    radius: f32,
    seconds: f64,
}

/// Keeps the random numbers of light paths apart from those of camera paths with the same random seed.
const LIGHT_PATHS: u64 = 0x70_68_6F_74_6F_6E;

/// Light paths of one piece of work.
const PIECE: u32 = 4096;

impl PhotonMaps {
    /// Follows light through a scene, on the threads of the current rayon pool. The maps are the same for any number of
    /// them.
    ///
    /// # Errors
    /// [`RenderError::InvalidRequest`] for settings out of range, and for a scene with a medium or with moving bodies,
    /// whose photons this mapper does not follow.
    pub fn new(scene: &Prepared, settings: &PhotonSettings, seed: u64) -> Result<Self, RenderError> {
        check(settings)?;
        let models = scene.models();
        if models.medium || !scene.bodies.is_empty() {
            let what = if models.medium { "a medium" } else { "moving bodies" };
            let value = format!("a scene with {what}");
            return Err(wrong("photon maps of", value, "a scene without a medium and without moving bodies"));
        }
        let start = std::time::Instant::now();
        let everything = Ball { center: scene.center, radius: scene.radius };
        let caustic = match scene.turning {
            Some(ball) => shoot(scene, settings.caustic_paths, ball, true, seed),
            None => Vec::new(),
        };
        let global = shoot(scene, settings.paths, everything, false, seed);
        let [caustic, global] = [caustic, global].map(Map::new);
        Ok(Self {
            scene: scene.id().to_owned(),
            stamp: scene.stamp,
            settings: *settings,
            seed,
            caustic: caustic?,
            global: global?,
            radius: scene.radius,
            seconds: start.elapsed().as_secs_f64(),
        })
    }

    /// What they were made with.
    #[must_use]
    pub fn settings(&self) -> &PhotonSettings {
        &self.settings
    }

    /// The random seed they were made with.
    #[must_use]
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// Photons in the caustic and in the global map.
    #[must_use]
    pub fn len(&self) -> [usize; 2] {
        [self.caustic.photons.len(), self.global.photons.len()]
    }

    /// Whether no light met a diffuse surface.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == [0, 0]
    }

    /// Seconds that it took to make them.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.seconds
    }

    /// Id of the scene.
    pub(crate) fn scene(&self) -> &str {
        &self.scene
    }

    /// Whether they were made of this preparation of the scene.
    pub(crate) fn are_of(&self, scene: &Prepared) -> bool {
        self.stamp == scene.stamp
    }

    /// Irradiance by caustics at a point where a pixel is `footprint` wide, from light with at most `edges` edges, and
    /// the density of caustic photons there per photon path.
    pub(crate) fn caustic(&self, at: &Interaction, footprint: f32, edges: u32) -> (Vec3A, f32) {
        let most = self.settings.caustic_radius * self.radius;
        // Positive: a hit has a positive distance, and so a footprint, unless it underflows.
        let radius = (self.settings.caustic_pixels * footprint).clamp(1e-6 * most, most);
        let (flux, count) = self.caustic.density(at, radius, edges);
        (flux, count / self.settings.caustic_paths as f32)
    }

    /// Irradiance by all light with at most `edges` edges.
    pub(crate) fn global(&self, at: &Interaction, edges: u32) -> Vec3A {
        self.global.density(at, self.settings.radius * self.radius, edges).0
    }
}

/// Follows `paths` light paths towards a sphere. `caustic`: keeps only what specular and glossy surfaces alone have
/// turned, which must all be in the sphere; else keeps everything.
fn shoot(scene: &Prepared, paths: u32, target: Ball, caustic: bool, seed: u64) -> Vec<Photon> {
    let key = pixel_key(mix(seed ^ LIGHT_PATHS), u64::from(caustic));
    let chances = scene.lights.towards(target);
    let share = 1.0 / paths as f32; // at least one: checked
    let pieces: Vec<Vec<Photon>> = (0..paths.div_ceil(PIECE))
        .into_par_iter()
        .map_init(
            || scene.traversal(),
            |traversal, piece| {
                let mut found = Vec::new();
                for path in piece * PIECE..((piece + 1) * PIECE).min(paths) {
                    let sampler = Independent::new(key, path);
                    let (u, v) = (sampler.group(0), sampler.group(1));
                    if let Some((origin, direction, flux)) = scene.lights.emit(u, v, target, &chances) {
                        let ray = Ray { origin, direction };
                        follow(scene, sampler, (ray, flux * share), caustic, traversal, &mut found);
                    }
                }
                found
            },
        )
        .collect();
    pieces.concat()
}

/// Follows one light path and keeps its photons.
fn follow(
    scene: &Prepared,
    sampler: Independent,
    (mut ray, mut flux): (Ray, Vec3A),
    caustic: bool,
    traversal: &mut Traversal,
    found: &mut Vec<Photon>,
) {
    for edge in 1..DEEPEST {
        let Some(hit) = scene.closest::<false>(&ray, f32::INFINITY, traversal) else { return };
        let at = scene.interact::<false>(&ray, &hit, traversal);
        let surface = &scene.surfaces[scene.geometry[hit.primitive as usize].material as usize];
        let arriving = -ray.direction;
        let (shading, facing) = (arriving.dot(at.normal), arriving.dot(at.geometric));
        let event = surface.scatter.at(at.uv);
        let diffuse = matches!(event, Event::Lobe(crate::bsdf::Lobe::Diffuse { .. }));
        if diffuse && !(caustic && edge == 1) {
            let bent = (shading / facing.max(1e-6)).min(MOST_CORRECTION);
            found.push(Photon {
                position: at.point.to_array(),
                normal: at.geometric.to_array(),
                flux: (flux * bent).to_array(),
                edges: edge,
            });
        }
        if diffuse && caustic {
            return;
        }
        let u = sampler.group(edge + 1);
        let (direction, weight, normal) = match event {
            Event::Specular(specular) => {
                // Flux, unlike radiance, is not squeezed by refraction.
                let (direction, _, normal) = specular.follow(&at, arriving, u[2]);
                (direction, specular.tint(), normal)
            }
            Event::Lobe(lobe) => match lobe.sample(&at, arriving, u[0], u[1]) {
                Some(scattered) => (scattered.direction, scattered.weight, at.normal),
                None => return,
            },
        };
        // Light and importance bend differently at interpolated normals (Veach 1997, Sec. 5.3); 1 where they are flat.
        let leaving = direction.dot(normal).abs().max(1e-6);
        let bent = arriving.dot(normal) * direction.dot(at.geometric).abs() / (facing.max(1e-6) * leaving);
        let weight = weight * bent.min(MOST_CORRECTION);
        // Roulette by the loss at this surface keeps the photons' flux alike.
        let chance = weight.max_element().min(1.0);
        // Also ends light of which nothing is left.
        if u[3] >= chance {
            return;
        }
        flux *= weight * (1.0 / chance);
        ray = Ray { origin: at.leave(direction), direction };
    }
}
