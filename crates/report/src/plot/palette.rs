//! Colours.

use super::figure::Color;

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

/// `#rrggbb`.
pub(crate) fn hex(Color(r, g, b): Color) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
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
