//! Families of confidence intervals for the means of pixels.
//!
//! A family is one way to make an interval of what a frame keeps of a pixel's samples. [`FAMILIES`] is the list of all;
//! whoever measures intervals asks every one of them and knows none.

mod asymmetric;
mod by_t;
mod critical;
mod each;
mod family;
mod hall;
mod johnson;
mod normal;
mod one_sided;
mod planes;
mod pooled;
mod rare_event;
mod skewness;
mod student;
#[cfg(test)]
mod tests;
mod window;

pub use family::{IntervalFamily, IntervalNeed};
pub use planes::{IntervalPlanes, SamplePlanes};

/// Every family, Student's t first.
pub static FAMILIES: &[&dyn IntervalFamily] = &[
    &student::STUDENT_T,
    &normal::NormalInterval,
    &johnson::Johnson,
    &hall::Hall,
    &pooled::PooledT,
    &asymmetric::ASYMMETRIC_T,
    &rare_event::RareEventT,
    &one_sided::LOWER_T,
    &one_sided::UPPER_T,
];

/// Student's t: the intervals of moon2013flash.
#[must_use]
pub fn students_t() -> &'static dyn IntervalFamily {
    &student::STUDENT_T
}

/// The family of this id.
#[must_use]
pub fn family(id: &str) -> Option<&'static dyn IntervalFamily> {
    FAMILIES.iter().find(|family| family.id() == id).copied()
}
