#![doc = include_str!("../README.md")]

mod bounds;
mod compare;
mod convergence;
mod coverage;
mod enclosure;
mod equal_error;
mod holm;
mod interval;
mod intervals;
mod level;
mod levels;
mod membership;
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
pub use coverage::{CoverageTally, coverage, coverage_of};
pub use enclosure::{Enclosure, enclosure};
pub use equal_error::{Multiplier, equal_error_multiplier};
pub use holm::holm_adjusted;
pub use interval::{Interval, replicate_interval};
pub use intervals::{FAMILIES, IntervalFamily, IntervalNeed, IntervalPlanes, SamplePlanes, family};
pub use level::{Level, LevelError, Sides};
pub use levels::Levels;
pub use membership::{MembershipTest, RejectionTally, SampleMean, interval_rejection, rejections};
pub use monte_carlo::{MonteCarloFit, monte_carlo_constant};
pub use observed::{Groups, Observed, SampleCounts, ShapeError, Truth};
pub use paired::{Effect, paired_difference, paired_effect, paired_ratio};
pub use pareto::pareto_front;
pub use plateau::{Plateau, plateau};
pub use proportion::{Rate, clustered_rate, proportion_interval, rate_standard_error};
pub use share::ReferenceShare;
pub use slope::{Slope, slope};
pub use student::{TTable, normal_quantile, t_quantile, t_two_sided_p};
