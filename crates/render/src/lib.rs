//! A deterministic, multi-threaded path tracer and photon mapper that records frames with their statistics.
//!
//! [`Prepared::new`] checks a scene and builds its acceleration structure once; [`render`] and [`render_reference`] make
//! frames and references from it. Only what a [`Recorded`] asks for is gathered, and only what the scene can give.

mod allocate;
mod assemble;
mod bsdf;
mod bvh;
mod camera;
mod classes;
mod columns;
mod environment;
mod error;
mod film;
mod geometry;
mod interaction;
mod intersect;
mod lights;
mod limits;
mod math;
mod medium;
mod memory;
mod moving;
mod optional;
mod path;
mod photons;
mod plan;
mod planes;
mod prepare;
mod progress;
mod provenance;
mod record;
mod recorder;
mod recording;
mod render;
mod request;
mod rounds;
mod sampler;
mod shot;
mod stream;
mod surface;
mod table;
mod tally;
mod view;
mod worker;

pub use allocate::allocate;
pub use classes::{ClassMap, OUT_OF_FOCUS, PixelClass, pixel_classes};
pub use error::RenderError;
pub use limits::{DEEPEST, LONGEST_SEQUENCE, MAX_MEMORY};
pub use noisefloor_frame::{FeatureHit, Integrator, PhotonSettings};
pub use optional::OptionalRecord;
pub use photons::PhotonMaps;
pub use prepare::Prepared;
pub use progress::{Progress, Silent};
pub use record::{Keep, Quantity, Recorded, available};
pub use render::{render, render_reference};
pub use request::{Purpose, REVISION, RenderRequest, sequence_seed, usual_seed};
pub use rounds::Rounds;
