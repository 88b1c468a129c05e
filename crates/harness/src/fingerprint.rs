//! Hashes of what methods and the renderer compute: they change whenever other numbers come out, and only then, so that
//! nobody has to remember to raise a version and a rebuilt program goes on where another one stopped.

mod method;

pub(crate) use method::{Fingerprints, attempt};
