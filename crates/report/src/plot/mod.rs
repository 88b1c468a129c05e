//! Plots of a summary: built once as a list of shapes, written as SVG and PNG.

mod axis;
mod bitmap;
mod bounds;
mod chart;
mod convergence;
mod coverage;
mod estimates;
mod figure;
pub(crate) mod font;
mod speed;
pub(crate) mod style;
pub(crate) mod svg;

pub(crate) use bitmap::png;
pub(crate) use bounds::bounds;
pub(crate) use convergence::convergence;
pub(crate) use coverage::coverage;
pub(crate) use estimates::estimates;
pub(crate) use figure::Figure;
pub(crate) use speed::{Time, speed};
