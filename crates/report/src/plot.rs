//! Charts as pictures: drawn once as a list of shapes, written as SVG, PNG and PDF.

mod axis;
mod bars;
mod draw;
mod figure;
pub(crate) mod font;
mod frame;
mod guides;
mod labels;
mod legend;
mod lines;
pub(crate) mod palette;
mod raster;
mod scales;
pub(crate) mod style;
pub(crate) mod svg;

#[cfg(test)]
mod tests;

pub(crate) use draw::{Drawn, draw};
pub(crate) use raster::{pdf, png};
