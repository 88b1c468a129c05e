//! One file per built-in scene, or per large part of one.

pub mod cornell;
