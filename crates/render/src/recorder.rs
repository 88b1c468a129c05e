//! What may watch a path while it is traced.

use glam::Vec3A;

use crate::Prepared;
use crate::bsdf::Event;
use crate::bvh::Hit;
use crate::interaction::Interaction;
use crate::intersect::Traversal;
use crate::view::View;

/// A point on a surface that a path has come to.
#[derive(Debug, Clone, Copy)]
pub struct Vertex<'a> {
    /// The scene.
    pub scene: &'a Prepared,
    /// What all paths have in common.
    pub view: &'a View<'a>,
    /// Where the bodies are.
    pub traversal: &'a Traversal,
    /// What was hit, and how far ahead.
    pub hit: &'a Hit,
    /// Point and normals.
    pub at: &'a Interaction,
    /// How the surface scatters there.
    pub event: &'a Event,
    /// Unit direction back along the path.
    pub to_viewer: Vec3A,
    /// Factor on light from here to the eye, without what a medium before this surface takes.
    pub throughput: Vec3A,
    /// The random numbers that choose where the path goes from here.
    pub choice: [f32; 4],
}

/// What ends an edge of a path.
#[derive(Debug, Clone, Copy)]
pub enum End<'a> {
    /// A surface.
    Surface(Vertex<'a>),
    /// The path was scattered in the medium; the surface ahead, if there is one and the recorder looks.
    Medium(Option<Vertex<'a>>),
    /// The path left the scene.
    Background,
}

/// How a path turns at a surface.
#[derive(Debug, Clone, Copy)]
pub enum Turn {
    /// At a perfectly specular one with this reflectance (1 for glass).
    Specular(Vec3A),
    /// At one that scatters into a solid angle.
    Lobe {
        /// Whether it is diffuse.
        diffuse: bool,
        /// Whether the shadow ray from there reached its light; `None` if none was traced.
        reached: Option<bool>,
    },
}

/// Watches paths and keeps of each what is wanted beside its colour. It changes nothing about a path.
pub trait Recorder {
    /// A path starts; what was kept of the last one is forgotten.
    fn started(&mut self);

    /// Whether the end of the present edge matters even if the path goes no further.
    fn looks(&self) -> bool;

    /// An edge has ended. `color`: what the path has gathered, what the end itself emits included.
    fn hit(&mut self, end: &End<'_>, color: Vec3A);

    /// The path turns at the surface that was hit last.
    fn scattered(&mut self, turn: &Turn);

    /// The path is over. `color`: what it has gathered.
    fn finished(&mut self, color: Vec3A);

    /// What was kept of the path, in the order of the values behind the colour in a tally.
    fn values(&self) -> &[f32];
}

/// Keeps the colour alone, at no cost.
impl Recorder for () {
    #[inline(always)]
    fn started(&mut self) {}

    #[inline(always)]
    fn looks(&self) -> bool {
        false
    }

    #[inline(always)]
    fn hit(&mut self, _: &End<'_>, _: Vec3A) {}

    #[inline(always)]
    fn scattered(&mut self, _: &Turn) {}

    #[inline(always)]
    fn finished(&mut self, _: Vec3A) {}

    #[inline(always)]
    fn values(&self) -> &[f32] {
        &[]
    }
}
