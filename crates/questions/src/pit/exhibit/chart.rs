use noisefloor_study::exhibit::{Axis, Chart, Form, Guide, Look, Panel, Point, Scale, Series};
use noisefloor_study::format;
use noisefloor_study::summary::SceneSummary;

use super::super::analyse::{Band, Finding};

/// F̂ − u of every level of a scene, with the widest of their bands.
pub(super) fn chart(scene: &SceneSummary, name: &str, here: &[&Finding], bands: &[Band]) -> Option<Chart> {
    let of_level = |f: &&Finding| bands.iter().find(|band| band.values == f.values);
    let band = here.iter().filter_map(of_level).min_by_key(|band| band.values)?;
    let away = |values: &[f64]| -> Vec<(f64, f64)> {
        let count = values.len().max(1) as f64;
        let from_diagonal = |(i, v): (usize, &f64)| ((i + 1) as f64 / count, v - (i + 1) as f64 / count);
        std::iter::once((0.0, 0.0)).chain(values.iter().enumerate().map(from_diagonal)).collect()
    };
    let series: Vec<Series> = here
        .iter()
        .enumerate()
        .map(|(k, f)| Series {
            name: format!("{} spp", f.spp),
            look: Look::own(k),
            points: away(&f.ecdf).into_iter().map(|(x, y)| point(f.spp, x, y)).collect(),
            band: false,
        })
        .collect();
    let (low, high) = (away(&band.low), away(&band.high));
    let drawn = series.iter().flat_map(|series| &series.points).map(|point| point.y);
    let values = drawn.chain(low.iter().chain(&high).map(|(_, y)| *y)).collect();
    let name_of_band = format!("95 % of {} uniform values", band.values);
    let axis = |title: &str, values| Axis { title: title.into(), scale: Scale::Linear, values };
    let panel = Panel {
        title: String::new(),
        x: axis("u", vec![0.0, 1.0]),
        y: axis("share of values up to u, minus u", values),
        form: Form::Lines,
        guides: vec![
            Guide::Line { points: low, name: name_of_band },
            Guide::Line { points: high, name: String::new() },
        ],
        series,
    };
    Some(Chart {
        id: format!("pit-{name}"),
        kind: "pit".into(),
        title: format!("{} · PIT of the input", scene.title),
        panels: vec![panel],
    })
}

fn point(spp: u32, x: f64, y: f64) -> Point {
    let about = format!("{spp} spp: {} at u = {}", format::significant(y, 2), format::significant(x, 2));
    Point { x, y, about, ..Point::default() }
}
