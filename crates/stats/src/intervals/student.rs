use super::by_t::{ByT, STUDENT};
use super::critical::Tails;

/// x̄ ± t·s/√n (Student 1908): exact for independent normal samples.
pub(super) static STUDENT_T: ByT =
    ByT { id: "t", name: "Student's t", source: STUDENT, tails: Tails::equal, limit: false };
