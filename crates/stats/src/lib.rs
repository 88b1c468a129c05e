//! Intervals, coverage, bounds, slopes and comparisons: numbers in, numbers out.
//!
//! No images, no files, no randomness. A confidence [`Level`] says whether it is two-sided or upper, and an
//! [`Interval`]'s level travels with it.
//!
//! | question | file |
//! | --- | --- |
//! | How sure is a mean over replicates? | [`replicate_interval`], [`proportion_interval`], [`Interval::below`] |
//! | Do t-intervals of pixels cover the truth? | [`coverage`] |
//! | Does an error bound hold? | [`half_widths`], [`bound_violations`], [`bound_verdict`], [`enclosure`] |
//! | Which method is better? | [`compare`], [`holm_adjusted`], [`paired_ratio`] |
//! | How fast does the error fall, and to what? | [`slope`], [`convergence`], [`monte_carlo_constant`], [`equal_error_multiplier`] |
//! | What does a common reference add to ratios and slopes? | [`ReferenceShare`] |
//! | Which methods are worth their time? | [`pareto_front`] |

mod bounds;
mod compare;
mod convergence;
mod coverage;
mod enclosure;
mod equal_error;
mod holm;
mod interval;
mod level;
mod levels;
mod monte_carlo;
mod observed;
mod paired;
mod pareto;
mod plateau;
mod proportion;
mod share;
mod slope;
mod student;

pub mod random;

pub use bounds::{BoundTally, BoundVerdict, bound_verdict, bound_violations, half_widths};
pub use compare::{Comparison, Direction, Family, Pair, Row, compare};
pub use convergence::{Convergence, Verdict, convergence};
pub use coverage::{CoverageTally, coverage};
pub use enclosure::{Enclosure, enclosure};
pub use equal_error::{Multiplier, equal_error_multiplier};
pub use holm::holm_adjusted;
pub use interval::{Interval, replicate_interval};
pub use level::{Level, LevelError, Sides};
pub use levels::Levels;
pub use monte_carlo::{MonteCarloFit, monte_carlo_constant};
pub use observed::{Counts, Groups, Observed, ShapeError, Truth};
pub use paired::{Effect, paired_difference, paired_effect, paired_ratio};
pub use pareto::pareto_front;
pub use plateau::{Plateau, plateau};
pub use proportion::{Rate, clustered_rate, proportion_interval, rate_standard_error};
pub use share::ReferenceShare;
pub use slope::{Slope, slope};
pub use student::{TTable, normal_quantile, t_quantile, t_two_sided_p};
