//! Maps of the relative error as pictures.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use noisefloor_frame::{Image, Reference};
use noisefloor_io::Destination;
use noisefloor_metrics::{ErrorKind, error_map};
use noisefloor_report::error_picture;

use super::Compared;
use crate::args::Compare;
use crate::output::spare;

/// Share of the pixels of all images that lie within the range of the scale.
const SHOWN: f64 = 0.99;

/// A map that was written.
pub struct Map {
    pub path: PathBuf,
    /// Relative error at the bright end of the scale; the dark end is 0.
    pub top: f32,
    /// Pixels above that.
    pub above: usize,
    pub non_finite: usize,
}

impl Map {
    /// What it shows, in words.
    pub fn note(&self) -> String {
        let mut note = format!("|x − r|/√(r² + 0.01), viridis from 0 to {}", self.top);
        for (count, what) in [(self.above, "above"), (self.non_finite, "not finite (magenta)")] {
            if count > 0 {
                note.push_str(&format!(", {count} {} {what}", if count == 1 { "pixel" } else { "pixels" }));
            }
        }
        note
    }
}

/// Where the maps go, one for each image; refused before any work if one would write over an input.
pub fn plan(args: &Compare) -> anyhow::Result<Option<Vec<PathBuf>>> {
    let Some(folder) = &args.maps else { return Ok(None) };
    fs::create_dir_all(folder).with_context(|| format!("making the folder {}", folder.display()))?;
    let mut taken = BTreeSet::new();
    let mut paths = Vec::new();
    for image in &args.images {
        let stem = image.file_stem().unwrap_or(image.as_os_str()).to_string_lossy().into_owned();
        let mut name = format!("{stem}.error.png");
        let mut count = 1;
        while !taken.insert(name.clone()) {
            count += 1;
            name = format!("{stem}-{count}.error.png");
        }
        let to = Destination::from(folder.join(&name));
        spare(&to, args.images.iter().chain([&args.reference]).map(PathBuf::as_path))?;
        to.check()?;
        paths.push(folder.join(name));
    }
    Ok(Some(paths))
}

/// Draws all maps in one range, so that they can be compared by eye.
pub fn write(
    paths: &[PathBuf],
    reference: &Reference,
    range: Option<f32>,
    all: &mut [Compared<'_>],
) -> anyhow::Result<()> {
    let maps: Vec<Image> = all
        .iter()
        .map(|one| error_map(&one.image, reference, ErrorKind::Relative))
        .collect::<Result<_, _>>()?;
    let top = range.unwrap_or_else(|| usual_range(&maps));
    for ((path, map), one) in paths.iter().zip(&maps).zip(all) {
        one.map = Some(draw(path, map, top)?);
    }
    Ok(())
}

fn draw(path: &Path, map: &Image, top: f32) -> anyhow::Result<Map> {
    let shown = error_picture(map, top)?;
    Destination::from(path).write(|out| out.write_all(&shown.png))?;
    let (above, non_finite) = (shown.clipped_pixels, shown.non_finite_pixels);
    Ok(Map { path: path.to_owned(), top, above, non_finite })
}

/// The 99th percentile over all maps, rounded up to two digits.
fn usual_range(maps: &[Image]) -> f32 {
    let mut values: Vec<f32> =
        maps.iter().flat_map(|map| map.data()).copied().filter(|v| v.is_finite()).collect();
    if values.is_empty() {
        return 1.0;
    }
    values.sort_unstable_by(f32::total_cmp);
    let value = values[((values.len() - 1) as f64 * SHOWN) as usize];
    if value <= 0.0 {
        return 1.0; // equal images: any range shows that
    }
    let step = 10f64.powf(f64::from(value).log10().floor() - 1.0);
    ((f64::from(value) / step).ceil() * step) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_range_covers_the_99th_percentile_of_all_maps_and_is_never_zero() {
        let map = |values: Vec<f32>| Image::from_vec(values.len(), 1, 1, values).unwrap();
        let low = map((0..100).map(|i| i as f32 / 1000.0).collect());
        assert_eq!(usual_range(std::slice::from_ref(&low)), 0.098);
        // Half of the 200 values are high, so the percentile is.
        let high = map(vec![4.321; 100]);
        assert_eq!(usual_range(&[low, high]), 4.4);
        assert_eq!(usual_range(&[map(vec![0.0, f32::NAN])]), 1.0);
        assert_eq!(usual_range(&[map(vec![f32::INFINITY])]), 1.0);
    }
}
