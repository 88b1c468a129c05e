use std::path::Path;

use noisefloor_denoiser::Registry;
use noisefloor_study::Study;

use crate::laboratory::Laboratory;
use crate::observer::{Observer, Silent};

/// A study to run, with everything it needs from outside.
pub struct StudyRun<'a> {
    /// The study.
    pub study: &'a Study,
    /// The methods that rows may name.
    pub registry: &'a Registry,
    /// Folder for records, images and summary; made if need be.
    pub out_dir: &'a Path,
    /// Folder for rendered frames, shared by all studies; made if need be.
    pub cache_dir: &'a Path,
    /// Columns and rows of rendered and synthetic scenes, instead of the study's.
    pub size: Option<(usize, usize)>,
    /// Labels of rows, or ids of methods, whose cells run again although they are finished.
    pub again: &'a [String],
    /// Command line, for the report.
    pub command: String,
    /// Instruction set that the kernels chose, for the report.
    pub simd: String,
    /// What measures it.
    pub laboratory: Laboratory<'a>,
    /// Is told how it goes, and may stop it.
    pub observer: &'a dyn Observer,
}

impl<'a> StudyRun<'a> {
    /// A run of the study as it is, of which nobody is told.
    #[must_use]
    pub fn new(study: &'a Study, registry: &'a Registry, out_dir: &'a Path, cache_dir: &'a Path) -> Self {
        Self {
            study,
            registry,
            out_dir,
            cache_dir,
            size: None,
            again: &[],
            command: String::new(),
            simd: String::new(),
            laboratory: Laboratory::default(),
            observer: &Silent,
        }
    }
}

impl std::fmt::Debug for StudyRun<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("StudyRun")
            .field("study", &self.study.name)
            .field("out_dir", &self.out_dir)
            .field("cache_dir", &self.cache_dir)
            .field("size", &self.size)
            .finish_non_exhaustive()
    }
}
