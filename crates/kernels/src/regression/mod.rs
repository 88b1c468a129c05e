//! Local linear regression.

pub mod models;
