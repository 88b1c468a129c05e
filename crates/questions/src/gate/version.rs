use noisefloor_study::context::Context;
use noisefloor_study::record::Record;

/// What one version of the program left: a study's description and its finished cells.
#[derive(Debug, Clone, Copy)]
pub struct Version<'a> {
    /// Scenes with their references, and rows.
    pub context: &'a Context,
    /// Finished cells.
    pub records: &'a [Record],
}
