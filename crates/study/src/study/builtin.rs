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

const STUDIES: &[BuiltinStudy] = &[
    BuiltinStudy { name: "quick", toml: include_str!("../../../../benchmarks/studies/quick.toml") },
    BuiltinStudy { name: "vfi-table1", toml: include_str!("../../../../benchmarks/studies/vfi-table1.toml") },
    BuiltinStudy { name: "vfi-fig09", toml: include_str!("../../../../benchmarks/studies/vfi-fig09.toml") },
    BuiltinStudy {
        name: "vfi-table1-high",
        toml: include_str!("../../../../benchmarks/studies/vfi-table1-high.toml"),
    },
    BuiltinStudy {
        name: "vfi-fig09-high",
        toml: include_str!("../../../../benchmarks/studies/vfi-fig09-high.toml"),
    },
    BuiltinStudy {
        name: "vfi-ablations",
        toml: include_str!("../../../../benchmarks/studies/vfi-ablations.toml"),
    },
    BuiltinStudy { name: "vfi-guide", toml: include_str!("../../../../benchmarks/studies/vfi-guide.toml") },
    BuiltinStudy { name: "vfi-kappa", toml: include_str!("../../../../benchmarks/studies/vfi-kappa.toml") },
    BuiltinStudy {
        name: "vfi-check-640",
        toml: include_str!("../../../../benchmarks/studies/vfi-check-640.toml"),
    },
    BuiltinStudy { name: "rdfc-fig02", toml: include_str!("../../../../benchmarks/studies/rdfc-fig02.toml") },
    BuiltinStudy { name: "rdfc-fig03", toml: include_str!("../../../../benchmarks/studies/rdfc-fig03.toml") },
    BuiltinStudy { name: "rdfc-fig04", toml: include_str!("../../../../benchmarks/studies/rdfc-fig04.toml") },
    BuiltinStudy { name: "rdfc-fig05", toml: include_str!("../../../../benchmarks/studies/rdfc-fig05.toml") },
    BuiltinStudy { name: "rdfc-fig06", toml: include_str!("../../../../benchmarks/studies/rdfc-fig06.toml") },
    BuiltinStudy { name: "rdfc-fig07", toml: include_str!("../../../../benchmarks/studies/rdfc-fig07.toml") },
    BuiltinStudy { name: "rdfc-fig08", toml: include_str!("../../../../benchmarks/studies/rdfc-fig08.toml") },
    BuiltinStudy { name: "rdfc-fig09", toml: include_str!("../../../../benchmarks/studies/rdfc-fig09.toml") },
    BuiltinStudy {
        name: "rdfc-profiles",
        toml: include_str!("../../../../benchmarks/studies/rdfc-profiles.toml"),
    },
    BuiltinStudy {
        name: "rdfc-spacetime",
        toml: include_str!("../../../../benchmarks/studies/rdfc-spacetime.toml"),
    },
    BuiltinStudy {
        name: "geometric-claim",
        toml: include_str!("../../../../benchmarks/studies/geometric-claim.toml"),
    },
    BuiltinStudy {
        name: "geometric-size",
        toml: include_str!("../../../../benchmarks/studies/geometric-size.toml"),
    },
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
