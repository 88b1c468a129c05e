//! A panel of a study's pictures for its README.
//!
//! `scenes="a; b"` gives the rows, `spp=16` or one level per scene the frames, `show="plain; rdfc; reference"` the
//! columns: a row's label, `reference`, or `LABEL / DIAGNOSTIC`. `stops` is the exposure, `shrink=2` the factor by which
//! pictures are made smaller.

use std::path::Path;

use noisefloor_frame::Image;
use noisefloor_metrics::tone_map;
use noisefloor_study::exhibit::{Document, GalleryScene};

use crate::readme::Directive;
use crate::sheet;
use crate::write::read_image;

/// The panel as PNG; the error is a clause for people.
pub(crate) fn panel(document: &Document, folder: &Path, asked: &Directive) -> Result<Vec<u8>, String> {
    let known = ["scenes", "spp", "show", "stops", "shrink"];
    if let Some(key) = asked.keys.keys().find(|key| !known.contains(&key.as_str())) {
        return Err(format!("a panel has no key `{key}`; it has {}", known.join(", ")));
    }
    let number = |key: &str, default: f64| match asked.keys.get(key) {
        None => Ok(default),
        Some(text) => text.parse::<f64>().map_err(|_| format!("{key} is `{text}`, not a number")),
    };
    let (stops, shrink) = (number("stops", 0.0)? as f32, number("shrink", 1.0)?.clamp(1.0, 64.0) as usize);
    let scenes: Vec<&GalleryScene> = match asked.list("scenes") {
        ids if ids.is_empty() => document.gallery.iter().collect(),
        ids => {
            let find = |id: &str| {
                let found = document.gallery.iter().find(|scene| scene.id == id);
                found.ok_or_else(|| format!("the study has no scene `{id}`"))
            };
            ids.into_iter().map(find).collect::<Result<_, _>>()?
        }
    };
    let levels = asked.list("spp");
    let shown = asked.list("show");
    if levels.is_empty() || shown.is_empty() || !(levels.len() == 1 || levels.len() == scenes.len()) {
        return Err("a panel needs `show`, and `spp` once or for each scene".into());
    }
    let mut rows = Vec::new();
    for (k, scene) in scenes.into_iter().enumerate() {
        let level = levels[k % levels.len()];
        let spp: u32 = level.parse().map_err(|_| format!("spp is `{level}`, not a level"))?;
        let mut row = Vec::new();
        for (column, name) in shown.iter().enumerate() {
            let picture = picture(scene, folder, spp, name, stops)?;
            let place = if column == 0 { format!("{}, {spp} spp: ", scene.id) } else { String::new() };
            row.push((format!("{place}{name}"), smaller(&picture, shrink)));
        }
        rows.push(row);
    }
    sheet::panel(&rows).map_err(|e| e.to_string())
}

fn picture(scene: &GalleryScene, folder: &Path, spp: u32, name: &str, stops: f32) -> Result<Image, String> {
    let absent = || format!("there is no image `{name}` of {} at {spp} spp", scene.id);
    let read = |path: &str| if path.is_empty() { Err(absent()) } else { read_image(&folder.join(path)) };
    if name == "reference" {
        return Ok(tone_map(&read(&scene.reference)?, stops));
    }
    let rows = scene.levels.iter().filter(|level| level.spp == spp).flat_map(|level| &level.rows);
    if let Some(row) = rows.clone().find(|row| row.label == name) {
        return Ok(tone_map(&read(&row.image)?, stops));
    }
    let (label, diagnostic) = name.split_once(" / ").ok_or_else(absent)?;
    let mut of_row = rows.filter(|row| row.label == label).flat_map(|row| &row.diagnostics);
    let (_, path) = of_row.find(|(name, _)| name == diagnostic).ok_or_else(absent)?;
    let image = read(path)?;
    // Diagnostics have any unit: white is their largest value.
    let largest = image.data().iter().copied().filter(|v| v.is_finite()).fold(0.0, f32::max);
    Ok(if largest > 0.0 { image.map(|v| v / largest) } else { image })
}

/// Means over squares of this side; what is left over at the edges is cut.
fn smaller(image: &Image, side: usize) -> Image {
    if side == 1 {
        return image.clone();
    }
    let (width, height) = ((image.width() / side).max(1), (image.height() / side).max(1));
    Image::from_fn(width, height, image.channels(), |c, x, y| {
        let (mut sum, mut count) = (0.0f64, 0u32);
        for j in y * side..((y + 1) * side).min(image.height()) {
            for i in x * side..((x + 1) * side).min(image.width()) {
                sum += f64::from(image.get(c, i, j));
                count += 1;
            }
        }
        (sum / f64::from(count.max(1))) as f32
    })
}
