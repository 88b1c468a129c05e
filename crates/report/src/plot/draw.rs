//! A chart as figures: its panels, its legend, and all of it on one sheet.

use noisefloor_study::exhibit::{Chart, Form};

use super::axis::Axis;
use super::figure::Figure;
use super::frame::{COLUMN, heading, left_of};
use super::legend::Legend;
use super::style::Looks;
use super::{bars, lines};

/// Height of the plotting area of a chart of one panel, points.
const HEIGHT: f64 = 152.0;
/// The same where there are several.
const SMALL_HEIGHT: f64 = 118.0;
/// Panels side by side.
const ACROSS: usize = 2;
/// Room for the title above several panels.
const TITLE: f64 = 15.0;

/// A drawn chart.
#[derive(Debug)]
pub(crate) struct Drawn {
    pub title: String,
    /// Each as wide as a column of a paper. A single one has the chart's title inside.
    pub panels: Vec<Figure>,
    legend: Legend,
}

impl Drawn {
    /// The legend in the width of a column.
    pub(crate) fn legend(&self) -> Option<Figure> {
        self.legend.figure(COLUMN)
    }

    /// Everything on one sheet: a column wide, or two where there are several panels.
    pub(crate) fn sheet(&self) -> Figure {
        let several = self.panels.len() > 1;
        let across = if several { ACROSS } else { 1 };
        let wide = COLUMN * across as f64;
        let mut sheet = Figure::new(wide, 0.0, self.title.clone());
        let mut top = 0.0;
        if several || self.panels.is_empty() {
            sheet.label(heading(&self.title));
            top += TITLE;
        }
        for row in self.panels.chunks(across) {
            for (column, panel) in row.iter().enumerate() {
                sheet.place(panel, (COLUMN * column as f64, top));
            }
            top += row.iter().map(|panel| panel.height).fold(0.0, f64::max);
        }
        if let Some(legend) = self.legend.figure(wide) {
            sheet.place(&legend, (0.0, top));
            top += legend.height;
        }
        sheet.height = top;
        sheet
    }
}

/// Draws a chart with the looks of the study's rows.
pub(crate) fn draw(chart: &Chart, looks: &Looks) -> Drawn {
    let several = chart.panels.len() > 1;
    let height = if several { SMALL_HEIGHT } else { HEIGHT };
    // Panels side by side begin at the same place, whatever their numbers and names need.
    let of = |form: Form| chart.panels.iter().filter(move |p| p.form == form);
    let axis = of(Form::Lines).map(|p| left_of(&Axis::of(&p.y))).fold(0.0, f64::max);
    let names = of(Form::Bars).map(bars::left_of).fold(0.0, f64::max);
    let mut legend = Legend::default();
    let mut panels = Vec::new();
    for panel in &chart.panels {
        let title = if several { &panel.title } else { &chart.title };
        panels.push(match panel.form {
            Form::Lines => lines::panel(panel, title, looks, &mut legend, (axis, height)),
            Form::Bars => bars::panel(panel, title, looks, &mut legend, names),
        });
    }
    Drawn { title: chart.title.clone(), panels, legend }
}
