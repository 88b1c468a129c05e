//! The harness from outside, with fake methods and tiny studies. One binary, so that it is linked once.

mod asked_for;
mod cache;
mod common;
mod estimates;
mod faults;
mod findings;
mod flicker;
mod frames;
mod gate;
mod import;
mod inputs;
mod kept;
mod known_variance;
mod limits;
mod looks;
mod outcomes;
mod over_replicates;
mod paper;
mod progress;
mod recorded;
mod resume;
mod shots;
mod sizes;
mod statistics;
mod superseded;
mod told;
