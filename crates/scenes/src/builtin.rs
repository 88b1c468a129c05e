//! One file per built-in scene, or per large part of one.

pub mod bathroom;
mod bathware;
pub mod conference;
pub mod cornell;
mod garden;
mod kitchen;
pub mod outdoor;
pub mod rings;
pub mod shower;
pub mod toaster;
pub mod two_quads;
