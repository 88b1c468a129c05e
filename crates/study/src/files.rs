//! Names of the files in a study's folder, relative to it.

/// The reference of a scene.
#[must_use]
pub fn reference(scene: &str) -> String {
    format!("reference/{scene}.exr")
}

/// Description of a scene.
#[must_use]
pub fn scene(scene: &str) -> String {
    format!("reference/{scene}.json")
}

/// What is kept of a scene's frames to hold them against each other.
#[must_use]
pub fn sketches(scene: &str) -> String {
    format!("reference/{scene}.sketches.json")
}

/// Pixel classes of a scene.
#[must_use]
pub fn classes(scene: &str) -> String {
    format!("reference/{scene}.classes.exr")
}

/// A denoised image; `slug` is the folder of its row.
#[must_use]
pub fn image(scene: &str, slug: &str, spp: u32, replicate: u32) -> String {
    format!("images/{scene}/{slug}/spp{spp:05}-r{replicate}.exr")
}

/// A diagnostic image.
#[must_use]
pub fn diagnostic(scene: &str, slug: &str, spp: u32, replicate: u32, name: &str) -> String {
    format!("diagnostics/{scene}/{slug}/spp{spp:05}-r{replicate}-{name}.exr")
}

/// A picture of something that was measured over all replicates of a level.
#[must_use]
pub fn map(scene: &str, slug: &str, spp: u32, name: &str) -> String {
    format!("maps/{scene}/{slug}/spp{spp:05}-{name}.exr")
}

/// What a program outside said.
#[must_use]
pub fn log(scene: &str, slug: &str, spp: u32, replicate: u32) -> String {
    format!("logs/{scene}/{slug}/spp{spp:05}-r{replicate}.txt")
}
