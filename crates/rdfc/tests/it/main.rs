//! The method from outside: limiting cases, statistics with known truth, and what must change nothing.

mod citations;
mod common;
mod hard;
mod limits;
mod recipes;
mod same;
mod statistics;
mod time;
