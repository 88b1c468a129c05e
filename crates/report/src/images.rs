//! Images inside the page: their encoding, and which of them fit.

mod encode;
mod select;

pub(crate) use select::{Gallery, Loader, gallery};
