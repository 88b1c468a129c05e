//! Charts: what is drawn, not how.

use serde::Serialize;

/// One figure, of one panel or of several side by side.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Chart {
    /// Name of its exported files: letters, digits, `-`, `_` and `.`. Begins with [`Chart::kind`].
    pub id: String,
    /// Kind, such as `convergence`: one of [`crate::FIGURES`].
    pub kind: String,
    /// What stands above it.
    pub title: String,
    /// Panels of equal size with axes of their own.
    pub panels: Vec<Panel>,
}

/// Axes with what is drawn between them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Panel {
    /// What stands above it, where there are several; may be empty.
    pub title: String,
    /// From left to right.
    pub x: Axis,
    /// From bottom to top.
    pub y: Axis,
    /// How values are drawn.
    pub form: Form,
    /// Under everything else, in order.
    pub guides: Vec<Guide>,
    /// Rows of the study, or other families of points, in the order of the legend.
    pub series: Vec<Series>,
}

/// How values are drawn.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Form {
    /// Points with error bars, joined by lines.
    #[default]
    Lines,
    /// One bar for each series, with its name beside it: for a single value of x, which is not drawn.
    Bars,
}

/// An axis.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Axis {
    /// With the unit.
    pub title: String,
    /// How values are placed.
    pub scale: Scale,
    /// Values that must lie on it; it is as long as these ask for.
    pub values: Vec<f64>,
}

/// How values map to positions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Scale {
    /// The value itself.
    Linear,
    /// Logarithm of the value.
    Log,
    /// Logarithm with a strip at the low end that stands for 0.
    LogWithZero,
    /// Logarithm of what is missing to 1, for fractions near it.
    Miss,
    /// Samples per pixel: logarithm, with ticks at the values themselves.
    Levels,
    /// Seconds: logarithm, with ticks named by their units.
    Seconds,
}

/// A family of points.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Series {
    /// In the legend.
    pub name: String,
    /// How it looks.
    pub look: Look,
    /// In the order of the line.
    pub points: Vec<Point>,
    /// Whether a translucent band joins the intervals instead of bars.
    pub band: bool,
}

/// How a family looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Look {
    /// Place of the study's row whose colour it has; or, if absent, number of a colour of its own.
    pub row: Option<usize>,
    /// Number of a colour of its own.
    pub own: usize,
    /// Marks in outline, instead of what the row has.
    pub open: Option<bool>,
    /// Mark, instead of the row's.
    pub shape: Option<Shape>,
}

impl Look {
    /// That of a row of the study.
    #[must_use]
    pub fn of_row(row: usize) -> Self {
        Self { row: Some(row), own: 0, open: None, shape: None }
    }

    /// One of its own.
    #[must_use]
    pub fn own(own: usize) -> Self {
        Self { row: None, own, open: None, shape: None }
    }
}

/// A mark.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Shape {
    /// Disc.
    Circle,
    /// Square.
    Square,
    /// Triangle that points up.
    Triangle,
    /// Square on its corner.
    Diamond,
}

/// A point in the units of the axes.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Point {
    /// Place along x.
    pub x: f64,
    /// Value.
    pub y: f64,
    /// Lower end of its interval, where known.
    pub low: Option<f64>,
    /// Upper end.
    pub high: Option<f64>,
    /// `y` is only an upper limit: drawn as an arrow towards smaller values.
    pub limit: bool,
    /// Over other frames or fewer pixels than the others: ringed, and not on the line.
    pub doubtful: bool,
    /// Shown under the pointer.
    pub about: String,
    /// A short text beside it; may be empty.
    pub label: String,
}

/// What is drawn under the series.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Guide {
    /// Everything below a value is shaded.
    Below {
        /// The value.
        y: f64,
        /// In the legend.
        name: String,
    },
    /// Everything above a line is shaded.
    Above {
        /// Corners of the line, from left to right.
        line: Vec<(f64, f64)>,
        /// In the legend.
        name: String,
    },
    /// A horizontal line with its name at the right end.
    Level {
        /// The value.
        y: f64,
        /// At its end; may be empty.
        label: String,
        /// In the legend, said once for guides of the same name; may be empty.
        name: String,
        /// The family whose colour it has, instead of ink.
        own: Option<usize>,
    },
    /// A dotted line.
    Line {
        /// Corners.
        points: Vec<(f64, f64)>,
        /// In the legend.
        name: String,
    },
    /// The border of what is reachable: a broad line.
    Front {
        /// Corners.
        points: Vec<(f64, f64)>,
        /// In the legend.
        name: String,
    },
}
