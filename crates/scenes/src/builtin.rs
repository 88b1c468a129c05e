//! One file per built-in scene, or per large part of one.

pub mod cornell;
mod garden;
mod kitchen;
pub mod outdoor;
pub mod toaster;
