use std::path::Path;

use crate::error::StudyError;
use crate::names::nearest;
use crate::study::Study;

/// A study that comes with the program.
#[derive(Debug, Clone, Copy)]
pub struct BuiltinStudy {
    /// Name for the command line.
    pub name: &'static str,
    /// The file.
    pub toml: &'static str,
}

impl BuiltinStudy {
    /// Reads it.
    ///
    /// # Errors
    /// As [`Study::from_toml`]; a test reads them all.
    pub fn study(&self) -> Result<Study, StudyError> {
        Study::from_toml(self.toml, Path::new(&format!("{}.toml", self.name)))
    }
}

/// Studies by the names of their files.
macro_rules! studies {
    ($($name:literal),+ $(,)?) => {
        &[$(BuiltinStudy {
            name: $name,
            toml: include_str!(concat!("../../../../benchmarks/studies/", $name, ".toml")),
        }),+]
    };
}

const STUDIES: &[BuiltinStudy] = studies![
    "quick",
    "vfi-table1",
    "vfi-fig09",
    "vfi-table1-high",
    "vfi-fig09-high",
    "vfi-ablations",
    "vfi-guide",
    "vfi-kappa",
    "vfi-animation",
    "vfi-check-640",
    "rdfc-fig02",
    "rdfc-fig03",
    "rdfc-fig04",
    "rdfc-fig05",
    "rdfc-fig06",
    "rdfc-fig07",
    "rdfc-fig08",
    "rdfc-fig09",
    "rdfc-profiles",
    "rdfc-spacetime",
    "coverage",
    "bounds",
    "calibration",
    "guarantee-cost",
    "membership",
    "instrument",
    "liu-fig01",
    "liu-fig02",
    "liu-fig03",
    "liu-fig04",
    "liu-fig05",
    "liu-fig06",
    "liu-ablation",
    "liu-large",
    "nfor-profiles",
    "geometric-claim",
    "geometric-size",
];

/// The studies that come with the program, in display order.
#[must_use]
pub fn builtin_studies() -> &'static [BuiltinStudy] {
    STUDIES
}

impl Study {
    /// The built-in study of this name.
    ///
    /// # Errors
    /// [`StudyError::UnknownStudy`] with the nearest names.
    pub fn builtin(name: &str) -> Result<Self, StudyError> {
        match STUDIES.iter().find(|study| study.name == name) {
            Some(study) => study.study(),
            None => Err(StudyError::UnknownStudy {
                name: name.into(),
                nearest: nearest(name, STUDIES.iter().map(|s| s.name)),
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_builtin_study_is_valid_and_has_the_name_it_is_found_by() {
        for study in builtin_studies() {
            let read = study.study().unwrap_or_else(|e| panic!("{e}"));
            assert_eq!(read.name, study.name);
            assert!(!read.question.is_empty() && !read.analysis.is_empty());
        }
    }

    #[test]
    fn misspelt_study_is_answered_with_the_nearest() {
        let error = Study::builtin("vfi-fig9").unwrap_err().to_string();
        assert!(error.contains("`vfi-fig9`") && error.contains("vfi-fig09"), "{error}");
    }
}
