//! One file per built-in scene, or per large part of one.

pub mod bathroom;
mod bathware;
mod church;
mod column;
pub mod conference;
pub mod cornell;
pub mod fog;
mod garden;
mod kitchen;
pub mod nave;
pub mod outdoor;
pub mod rings;
pub mod shower;
pub mod spin;
pub mod teapot;
pub mod toaster;
pub mod two_quads;
