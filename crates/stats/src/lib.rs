#![doc = include_str!("../README.md")]

mod band;
mod bias_variance;
mod binomial;
mod bounds;
mod compare;
mod convergence;
mod coverage;
mod enclosure;
mod equal_error;
mod gate;
mod holm;
mod interval;
mod intervals;
mod leave_one_out;
mod level;
mod levels;
mod membership;
mod monte_carlo;
mod observed;
mod paired;
mod pareto;
mod pit;
mod plateau;
mod pmf;
mod power;
mod proportion;
mod share;
mod slope;
mod student;
mod verdict;

pub mod instrument;
pub mod random;

pub use band::{BandError, EcdfBand, ecdf};
pub use bias_variance::{
    BiasReference, BiasVariance, BiasVarianceError, BiasVarianceMaps, BiasVarianceTotal, Estimated,
    ReferenceNoise, Replicates, bias_variance,
};
pub use binomial::{BinomialError, MOST_TRIALS, binomial_p_against, binomial_two_sided_p, clopper_pearson};
pub use bounds::{BoundTally, bound_violations, half_widths};
pub use compare::{Comparison, Direction, Family, Pair, Row, compare};
pub use convergence::{Convergence, Trend, convergence};
pub use coverage::{CoverageTally, coverage, coverage_of, coverage_of_pixels};
pub use enclosure::{Enclosure, enclosure};
pub use equal_error::{Multiplier, equal_error_multiplier};
pub use gate::{Answer, Change, Gate, Judgement, Terms, gate};
pub use holm::holm_adjusted;
pub use interval::{Interval, replicate_interval};
pub use intervals::{
    FAMILIES, IntervalFamily, IntervalNeed, IntervalPlanes, SamplePlanes, family, students_t,
};
pub use leave_one_out::{
    LeaveOneOut, LeaveOneOutError, LeaveOneOutTally, PixelSpread, leave_one_out, leave_one_out_interval,
};
pub use level::{Level, LevelError, Sides};
pub use levels::Levels;
pub use membership::{MembershipTest, RejectionTally, SampleMean, interval_rejection, rejections};
pub use monte_carlo::{MonteCarloFit, monte_carlo_constant};
pub use observed::{Groups, Observed, SampleCounts, ShapeError, Truth};
pub use paired::{Effect, paired_difference, paired_effect, paired_ratio};
pub use pareto::pareto_front;
pub use pit::{Pit, PitError, pit};
pub use plateau::{Plateau, plateau};
pub use power::{Design, log_ratio_spread};
pub use proportion::{Rate, clustered_rate, proportion_interval, rate_standard_error};
pub use share::ReferenceShare;
pub use slope::{Slope, slope};
pub use student::{TTable, normal_quantile, normal_two_sided_p, t_quantile, t_two_sided_p};
pub use verdict::{Evidence, Judged, Needed, Region, Verdict, Verdicts, judge, needed_beside};
