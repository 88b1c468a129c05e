/// Anchor in the page, and name of the answers on disk.
pub(super) const ID: &str = "instrument";
