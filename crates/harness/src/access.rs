use crate::cache::Cache;
use crate::laboratory::Laboratory;
use crate::observer::Observer;

/// What it takes to get a frame or a reference of a scene.
#[derive(Clone, Copy)]
pub(crate) struct Access<'a> {
    pub(crate) cache: &'a Cache,
    pub(crate) laboratory: &'a Laboratory<'a>,
    pub(crate) observer: &'a dyn Observer,
}
