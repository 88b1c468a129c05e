//! The method from outside: limiting cases, statistics with known truth, and what must change nothing.

mod citations;
mod common;
mod cover;
mod hard;
mod limits;
mod same;
mod statistics;
