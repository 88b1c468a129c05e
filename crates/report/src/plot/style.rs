//! Colours, markers and dashes: each row of a study keeps its look in every plot.

use std::collections::BTreeMap;

use noisefloor_harness::RowFrames;
use noisefloor_harness::summary::MethodSummary;

use super::figure::{Color, Dash, Figure, Point, Stroke};
use super::svg::{Drawing, hex};
use crate::error::ReportError;
use crate::index::Index;

/// Paper.
pub(crate) const BACKGROUND: Color = Color(0xff, 0xff, 0xff);
/// Text and axes.
pub(crate) const INK: Color = Color(0x1a, 0x1d, 0x21);
/// Secondary text.
pub(crate) const MUTED: Color = Color(0x5b, 0x63, 0x6e);
/// Grid lines.
pub(crate) const GRID: Color = Color(0xe3, 0xe6, 0xea);
/// Shaded regions: reference floor, ceiling of missed events.
pub(crate) const SHADE: Color = Color(0x9a, 0xa3, 0xae);

/// Okabe and Ito (2008), without the yellow that vanishes on white; plain Monte Carlo takes the ink.
pub(crate) const SERIES: [Color; 6] = [
    Color(0x00, 0x72, 0xb2),
    Color(0xd5, 0x5e, 0x00),
    Color(0x00, 0x9e, 0x73),
    Color(0xcc, 0x79, 0xa7),
    Color(0xe6, 0x9f, 0x00),
    Color(0x56, 0xb4, 0xe9),
];

/// Shape of a data point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Marker {
    Circle,
    Square,
    Triangle,
    Diamond,
    Wedge,
    Cross,
}

const MARKERS: [Marker; 5] =
    [Marker::Square, Marker::Triangle, Marker::Diamond, Marker::Wedge, Marker::Cross];
const DASHES: [Dash; 4] = [&[], &[7.0, 1.6], &[4.5, 1.5, 1.2, 1.5], &[1.3, 1.3]];
/// Dash of the guarded variant of a row.
const GUARDED: Dash = &[2.6, 1.6];
/// Dots of a row whose method is also a row on the study's own frames, and whose frames are others.
const OTHER_FRAMES: Dash = &[0.9, 1.4];

/// Look of one row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Look {
    pub color: Color,
    pub marker: Marker,
    /// Outline only.
    pub open: bool,
    pub dash: Dash,
}

impl Look {
    /// The line through the row's points.
    pub(crate) fn stroke(&self) -> Stroke {
        Stroke { color: self.color, width: 1.1, dash: self.dash }
    }
}

/// The look of every row: plain Monte Carlo in ink with discs, the others in their order, a guarded row in the
/// colour of the row that it guards, dashed and with open marks, and a row on frames of its own in the colour of the
/// same method on the study's frames, dotted and with open marks.
#[derive(Debug, Clone)]
pub(crate) struct Looks {
    by_label: BTreeMap<String, Look>,
}

impl Looks {
    pub(crate) fn of(methods: &[MethodSummary]) -> Self {
        let mut by_label = BTreeMap::new();
        let mut next = 0;
        for method in methods.iter().filter(|m| inner(m, methods).is_none()) {
            let look = if method.method == "mc" && method.frames == RowFrames::Uniform {
                Look { color: INK, marker: Marker::Circle, open: false, dash: &[] }
            } else {
                next += 1;
                nth(next - 1)
            };
            by_label.insert(method.label.clone(), look);
        }
        for method in methods {
            if let Some(look) = inner(method, methods).and_then(|i| by_label.get(i).copied()) {
                let dash = if method.frames == RowFrames::Uniform { GUARDED } else { OTHER_FRAMES };
                let mut guarded = Look { open: true, dash, ..look };
                // Two such rows of one method differ in their parameters only: tell them apart by marker.
                for marker in MARKERS {
                    if by_label.values().any(|taken| *taken == guarded) {
                        guarded.marker = marker;
                    }
                }
                by_label.insert(method.label.clone(), guarded);
            }
        }
        Self { by_label }
    }

    /// The row's look; unknown rows look like plain Monte Carlo.
    pub(crate) fn get(&self, label: &str) -> Look {
        let plain = Look { color: INK, marker: Marker::Circle, open: true, dash: &[] };
        self.by_label.get(label).copied().unwrap_or(plain)
    }
}

/// Look number `n`: colours repeat after six, then with another dash and marker.
pub(crate) fn nth(n: usize) -> Look {
    let round = n / SERIES.len();
    Look {
        color: SERIES[n % SERIES.len()],
        marker: MARKERS[(n + round) % MARKERS.len()],
        open: round % 2 == 1,
        dash: DASHES[round % DASHES.len()],
    }
}

/// Rules that give the palette's colours their counterparts in the dark theme, by value: the same SVG then serves
/// as a file on white paper and inside the page.
pub(crate) fn css() -> String {
    let named = [(BACKGROUND, "paper"), (INK, "ink"), (MUTED, "muted"), (GRID, "grid"), (SHADE, "shade")];
    let series = SERIES.iter().enumerate().map(|(i, color)| (*color, format!("series-{i}")));
    let all = named.into_iter().map(|(color, name)| (color, name.to_owned())).chain(series);
    all.map(|(color, name)| {
        let hex = hex(color);
        format!("[fill=\"{hex}\"]{{fill:var(--{name})}}[stroke=\"{hex}\"]{{stroke:var(--{name})}}\n")
    })
    .collect()
}

/// SVG symbols `swatch-0`, `swatch-1`, … with the look of each row.
pub(crate) fn swatches(index: &Index<'_>) -> Result<String, ReportError> {
    let mut out = String::new();
    for (i, method) in index.summary.methods.iter().enumerate() {
        let look = index.looks.get(&method.label);
        let mut figure = Figure::new(20.0, 8.0, String::new());
        figure.line(vec![(0.0, 4.0), (20.0, 4.0)], Stroke { width: 1.4, ..look.stroke() });
        mark(&mut figure, look, (10.0, 4.0));
        out += &Drawing::of(&figure, "swatch")?.symbol(&format!("swatch-{i}"));
    }
    Ok(out)
}

/// Label of the row that this one is a variant of, if both are rows of the study: `guarded(x) more` guards `x more`, else
/// a row of the method `x`; a row on frames of its own belongs to the same method and parameters on the study's.
fn inner<'a>(method: &MethodSummary, methods: &'a [MethodSummary]) -> Option<&'a str> {
    if method.frames != RowFrames::Uniform {
        let same = |m: &&MethodSummary| {
            m.frames == RowFrames::Uniform && (&m.method, &m.params) == (&method.method, &method.params)
        };
        return methods.iter().find(same).map(|m| m.label.as_str());
    }
    let (name, suffix) =
        method.label.strip_prefix("guarded(").and_then(|l| l.rsplit_once(')')).unwrap_or_default();
    let label = format!("{name}{suffix}");
    let id = method.method.strip_prefix("guarded(").and_then(|m| m.strip_suffix(')'));
    let by_label = methods.iter().find(|m| !name.is_empty() && m.label == label);
    by_label.or_else(|| methods.iter().find(|m| Some(m.method.as_str()) == id)).map(|m| m.label.as_str())
}

/// Draws a data point of about 4.4 points across.
pub(crate) fn mark(figure: &mut Figure, look: Look, (x, y): Point) {
    let r = 2.2;
    let stroke = Stroke::solid(look.color, 0.9);
    let polygon = |corners: &[(f64, f64)]| -> Vec<Point> {
        corners.iter().map(|&(dx, dy)| (x + r * dx, y + r * dy)).collect()
    };
    let corners = match look.marker {
        Marker::Circle => {
            figure.disc((x, y), r, look.color);
            if look.open {
                figure.disc((x, y), r - 0.8, BACKGROUND);
            }
            return;
        }
        Marker::Cross => {
            let wide = Stroke::solid(look.color, if look.open { 0.9 } else { 1.4 });
            figure.line(polygon(&[(-0.9, -0.9), (0.9, 0.9)]), wide);
            figure.line(polygon(&[(-0.9, 0.9), (0.9, -0.9)]), wide);
            return;
        }
        Marker::Square => polygon(&[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)]),
        Marker::Triangle => polygon(&[(0.0, -1.15), (1.1, 0.85), (-1.1, 0.85)]),
        Marker::Wedge => polygon(&[(0.0, 1.15), (1.1, -0.85), (-1.1, -0.85)]),
        Marker::Diamond => polygon(&[(0.0, -1.25), (1.25, 0.0), (0.0, 1.25), (-1.25, 0.0)]),
    };
    figure.area(corners.clone(), if look.open { BACKGROUND } else { look.color }, 1.0);
    if look.open {
        let mut outline = corners.clone();
        outline.extend([corners[0], corners[1]]);
        figure.line(outline, stroke);
    }
}

#[cfg(test)]
mod tests {
    use noisefloor_harness::AdaptiveFrames;

    use super::*;

    fn row(label: &str, method: &str) -> MethodSummary {
        MethodSummary {
            label: label.into(),
            method: method.into(),
            name: String::new(),
            citation: String::new(),
            reference: String::new(),
            params: serde_json::Value::Null,
            notes: vec![],
            frames: RowFrames::Uniform,
            estimates_error: false,
        }
    }

    #[test]
    fn a_guarded_row_has_the_colour_of_its_inner_row() {
        let rows = [
            row("guarded(geometric)", "guarded(geometric)"),
            row("mc", "mc"),
            row("virtual-flash", "virtual-flash"),
            row("geometric", "geometric"),
            row("projected", "guarded(virtual-flash)"),
            row("projected twice", "guarded(virtual-flash)"),
            row("virtual-flash steps=1", "virtual-flash"),
            row("guarded(virtual-flash) steps=1", "guarded(virtual-flash)"),
            MethodSummary {
                frames: RowFrames::Adaptive(AdaptiveFrames::default()),
                ..row("rounds", "geometric")
            },
            MethodSummary { frames: RowFrames::EqualTime { with: "geometric".into() }, ..row("more", "mc") },
        ];
        let looks = Looks::of(&rows);
        assert_eq!(looks.get("mc").color, INK);
        assert_eq!(looks.get("projected").color, looks.get("virtual-flash").color);
        assert!(looks.get("projected").open && !looks.get("virtual-flash").open);
        assert_eq!(looks.get("guarded(geometric)").color, looks.get("geometric").color);
        assert_ne!(looks.get("geometric").color, looks.get("virtual-flash").color);
        assert_eq!(looks.get("rounds").color, looks.get("geometric").color);
        assert_eq!((looks.get("more").color, looks.get("more").dash), (INK, OTHER_FRAMES));
        let (one, guarded_one) =
            (looks.get("virtual-flash steps=1"), looks.get("guarded(virtual-flash) steps=1"));
        assert_eq!(one.color, guarded_one.color);
        for (i, a) in rows.iter().enumerate() {
            assert!(rows[..i].iter().all(|b| looks.get(&a.label) != looks.get(&b.label)), "{}", a.label);
        }
    }

    #[test]
    fn two_dozen_rows_all_look_different() {
        let looks: Vec<Look> = (0..24).map(nth).collect();
        for (i, a) in looks.iter().enumerate() {
            assert!(looks[..i].iter().all(|b| a != b), "look {i} repeats");
        }
    }
}
