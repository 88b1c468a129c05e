//! Everything that is common to the pixels of one rendering.

use std::sync::atomic::{AtomicU64, Ordering};

use crate::camera::Eye;
use crate::plan::Plan;
use crate::sampler::SobolTables;
use crate::view::View;
use crate::{Integrator, RenderError, RenderRequest};

/// What the threads of a rendering share.
#[derive(Debug)]
pub struct Shot<'a> {
    /// What is rendered.
    pub request: &'a RenderRequest<'a>,
    /// What is kept of it.
    pub plan: &'a Plan,
    /// The camera.
    pub eye: Eye,
    /// For all paths.
    pub view: View<'a>,
    /// For low-discrepancy samples.
    pub sobol: SobolTables,
    /// What is counted.
    pub counts: &'a Totals,
}

impl<'a> Shot<'a> {
    /// Of a request.
    pub fn new(request: &'a RenderRequest<'a>, plan: &'a Plan, counts: &'a Totals) -> Self {
        let camera = &request.scene.camera;
        let eye = Eye::new(camera, request.width, request.height, request.filter);
        let next = request
            .scene
            .camera_move
            .map(|step| Eye::new(&step.apply(camera, 1.0), request.width, request.height, request.filter));
        let view = View {
            eye: eye.position(),
            depth: request.depth,
            photons: request.photons,
            gather: request.integrator == Integrator::PhotonMapping,
            pixel: eye.pixel(),
            frames: next.map(|next| [eye, next]),
        };
        Self { request, plan, eye, view, sobol: SobolTables::new(), counts }
    }
}

/// What is counted over a rendering, on all threads.
#[derive(Debug, Default)]
pub struct Totals {
    /// Samples that were not finite and count as black.
    non_finite: AtomicU64,
    /// Rays that were followed.
    rays: AtomicU64,
}

impl Totals {
    /// Samples that were not finite, and rays.
    pub fn read(&self) -> [u64; 2] {
        [&self.non_finite, &self.rays].map(|count| count.load(Ordering::Relaxed))
    }

    /// Refuses an image of which more than half is made up: samples that are not finite count as black.
    pub fn check(&self, request: &RenderRequest<'_>) -> Result<(), RenderError> {
        let [non_finite, _] = self.read();
        let samples = (request.width * request.height) as u64 * u64::from(request.spp);
        if non_finite <= samples / 2 {
            return Ok(());
        }
        Err(RenderError::NonFinite { scene: request.scene.id().into(), non_finite, samples })
    }

    /// Counts samples that were not finite, and rays.
    pub fn count(&self, non_finite: u64, rays: u64) {
        if non_finite > 0 {
            self.non_finite.fetch_add(non_finite, Ordering::Relaxed);
        }
        self.rays.fetch_add(rays, Ordering::Relaxed);
    }

    /// Adds what another rendering counted.
    pub fn add(&self, other: &Self) {
        let [non_finite, rays] = other.read();
        self.count(non_finite, rays);
    }
}
