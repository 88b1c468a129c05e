//! What all paths of an image have in common.

use glam::Vec3A;

use crate::camera::Eye;
use crate::photons::PhotonMaps;

/// The eye, and how far and by what means its paths go.
#[derive(Debug, Clone, Copy)]
pub struct View<'a> {
    /// Centre of the lens, where the eye light sits.
    pub eye: Vec3A,
    /// Most edges of a path.
    pub depth: u32,
    /// Photon maps, for caustics as a feature.
    pub photons: Option<&'a PhotonMaps>,
    /// Whether the photon maps give what comes after the first diffuse vertex.
    pub gather: bool,
    /// Width of a pixel at distance 1.
    pub pixel: f32,
    /// The camera in this frame and in the next, if anything moves.
    pub frames: Option<[Eye; 2]>,
}
