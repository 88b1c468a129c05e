//! Shown, refuted, or not shown: one rule for every verdict of a report.
//!
//! A claim is a region in which an effect should lie; what was measured is an interval. The claim is *shown* if the interval
//! lies in the region, *refuted* if it lies outside, and *not shown* otherwise: lack of evidence is no success. All verdicts of
//! a report are one family, whose refutations are adjusted by Holm's rule ([`Verdicts`]).

mod evidence;
mod judge;
mod needed;
mod region;
mod verdicts;
mod word;

pub use evidence::Evidence;
pub use judge::{Judged, judge};
pub use needed::{Needed, needed_beside};
pub use region::Region;
pub use verdicts::Verdicts;
pub use word::Verdict;
