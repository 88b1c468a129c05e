//! One file per built-in scene, or per large part of one.

pub mod conference;
pub mod cornell;
pub mod fog;
mod garden;
mod kitchen;
pub mod outdoor;
pub mod rings;
pub mod spin;
pub mod toaster;
pub mod two_quads;
