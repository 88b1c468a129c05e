//! Which images fit into the page, and the viewer's table of contents.

use std::collections::BTreeMap;
use std::path::Path;

use noisefloor_frame::Image;
use noisefloor_study::exhibit::{self, Document};
use noisefloor_study::format::plural;
use serde::Serialize;

use super::encode::{Encoded, encode};

/// Reads an image of the study; the error is a sentence for the page.
pub(crate) type Loader<'a> = dyn Fn(&Path) -> Result<Image, String> + 'a;

/// A rectangle of an image: x, y, width, height.
pub(crate) type Crop = [usize; 4];

/// What the viewer can show.
#[derive(Debug, Default, Serialize)]
pub(crate) struct Gallery {
    pub scenes: Vec<GalleryScene>,
    pub images: Vec<Encoded>,
    /// The level whose diagnostics the page carries.
    #[serde(skip)]
    pub diagnostics_spp: Option<u32>,
    /// Levels that the page leaves out to stay small, as sentences.
    #[serde(skip)]
    pub omitted: Vec<String>,
    /// Files that could not be read, as sentences.
    #[serde(skip)]
    pub unreadable: Vec<String>,
}

/// The images of one scene, as positions in [`Gallery::images`].
#[derive(Debug, Default, Serialize)]
pub(crate) struct GalleryScene {
    pub id: String,
    pub title: String,
    /// The part of the frame that is shown, if not all.
    pub crop: Option<Crop>,
    pub reference: Option<usize>,
    pub levels: Vec<GalleryLevel>,
}

/// The images of one scene at one level.
#[derive(Debug, Default, Serialize)]
pub(crate) struct GalleryLevel {
    pub spp: u32,
    /// Row label to image.
    pub images: BTreeMap<String, usize>,
    /// Row label to diagnostic name to image.
    pub diagnostics: BTreeMap<String, BTreeMap<String, usize>>,
    /// Row label to the primary metric as text.
    pub values: BTreeMap<String, String>,
}

impl Gallery {
    /// Size of all images as text.
    pub(crate) fn bytes(&self) -> usize {
        self.images.iter().map(|i| i.text.len()).sum()
    }
}

/// Chooses and encodes images until the budget (bytes of text in the page) is used up.
///
/// First the references and the level that the page opens with, for every scene, cropped around the centre if
/// even these are too large; then that level's diagnostics (other levels' stay outside); then further levels, each
/// as a whole or not at all.
pub(crate) fn gallery(document: &Document, load: &Loader<'_>, budget: usize) -> Gallery {
    let levels = document.gallery.iter().flat_map(|scene| &scene.levels).map(|level| level.spp);
    let mut wanted: Vec<u32> = levels.collect();
    wanted.sort_unstable();
    wanted.dedup();
    let chosen = document.chosen.filter(|n| wanted.contains(n));
    let first = chosen.or_else(|| wanted.get(wanted.len() / 2).copied());
    let mut builder = Builder {
        scenes: &document.gallery,
        load,
        gallery: Gallery::default(),
        stored: BTreeMap::new(),
        left_out: 0,
    };
    let share = budget / document.gallery.len().max(1);
    for scene in &document.gallery {
        builder.open(scene, first, share);
    }
    if let Some(spp) = first {
        builder.each(|b, i, scene| b.add_diagnostics(i, scene, spp, budget));
    }
    for &spp in wanted.iter().filter(|n| Some(**n) != first) {
        builder.each(|b, i, scene| b.add_level(i, scene, spp, budget));
    }
    let left_out = builder.left_out;
    let mut gallery = builder.gallery;
    if left_out > 0 {
        gallery.omitted.push(plural(left_out, "diagnostic image"));
    }
    gallery.diagnostics_spp = first;
    gallery.scenes.iter_mut().for_each(|s| s.levels.sort_by_key(|l| l.spp));
    gallery
}

struct Builder<'a> {
    scenes: &'a [exhibit::GalleryScene],
    load: &'a Loader<'a>,
    gallery: Gallery,
    /// Images in the gallery by scene and path, so that shared files are carried once.
    stored: BTreeMap<(usize, String), usize>,
    /// Diagnostics that did not fit.
    left_out: usize,
}

impl<'a> Builder<'a> {
    fn each(&mut self, mut f: impl FnMut(&mut Self, usize, &'a exhibit::GalleryScene)) {
        for (i, scene) in self.scenes.iter().enumerate() {
            f(self, i, scene);
        }
    }

    /// Starts a scene with its reference and its first level, within `share` bytes.
    fn open(&mut self, scene: &'a exhibit::GalleryScene, spp: Option<u32>, share: usize) {
        let position = self.gallery.scenes.len();
        self.gallery.scenes.push(GalleryScene {
            id: scene.id.clone(),
            title: scene.title.clone(),
            ..GalleryScene::default()
        });
        // A reference that is not what was written has no path.
        let reference = Some(scene.reference.as_str()).filter(|path| !path.is_empty());
        let mut paths: Vec<&str> = reference.into_iter().collect();
        paths.extend(spp.iter().flat_map(|&n| level_paths(scene, n)));
        let Some((first, _)) = self.read(&paths, None).into_iter().next() else { return };
        let full = [0, 0, first.width, first.height];
        let mut crop = full;
        // Cropping changes the compression, so the size is found by shrinking until it fits.
        loop {
            let encoded = self.read(&paths, (crop != full).then_some(crop));
            let bytes: usize = encoded.iter().map(|(e, _)| e.text.len()).sum();
            if bytes <= share || crop[2].min(crop[3]) <= 16 {
                self.gallery.scenes[position].crop = (crop != full).then_some(crop);
                for (image, path) in encoded {
                    self.store(position, path, image);
                }
                break;
            }
            // `bytes > share ≥ 0`, so the quotient is defined and below 1.
            let shrink = (share as f64 / bytes as f64).sqrt().clamp(0.3, 0.97);
            let side = |n: usize| ((n as f64 * shrink) as usize).max(16).min(n);
            let (w, h) = (side(crop[2]), side(crop[3]));
            crop = [(full[2] - w) / 2, (full[3] - h) / 2, w, h];
        }
        let reference = self.stored.get(&(position, scene.reference.clone())).copied();
        self.gallery.scenes[position].reference = reference;
        if let Some(spp) = spp {
            self.enter_level(position, scene, spp);
        }
    }

    /// Reads and encodes files; unreadable ones are noted once and left out.
    fn read<'p>(&mut self, paths: &[&'p str], crop: Option<Crop>) -> Vec<(Encoded, &'p str)> {
        let mut encoded = Vec::new();
        for &path in paths.iter().filter(|p| !p.is_empty()) {
            match (self.load)(Path::new(path)) {
                Ok(image) => {
                    let cut = match crop {
                        Some([x, y, w, h]) if x + w <= image.width() && y + h <= image.height() => {
                            image.crop(x, y, w, h)
                        }
                        _ => image,
                    };
                    encoded.push((encode(&cut), path));
                }
                Err(reason) => {
                    let sentence = format!("{path}: {reason}");
                    if !self.gallery.unreadable.contains(&sentence) {
                        self.gallery.unreadable.push(sentence);
                    }
                }
            }
        }
        encoded
    }

    fn store(&mut self, scene: usize, path: &str, image: Encoded) {
        let key = (scene, path.to_owned());
        if self.stored.contains_key(&key) {
            return;
        }
        // Rows often share a diagnostic: the same pixels are carried once.
        let same = self.gallery.images.iter().position(|known| *known == image);
        self.stored.insert(key, same.unwrap_or(self.gallery.images.len()));
        if same.is_none() {
            self.gallery.images.push(image);
        }
    }

    /// Files not yet stored that fit into what is left of the budget, all or none.
    fn fit(&mut self, position: usize, paths: &[&str], budget: usize) -> bool {
        let missing: Vec<&str> = paths
            .iter()
            .copied()
            .filter(|p| !self.stored.contains_key(&(position, (*p).to_owned())))
            .collect();
        let encoded = self.read(&missing, self.gallery.scenes[position].crop);
        let new = encoded.iter().filter(|(image, _)| !self.gallery.images.contains(image));
        let bytes: usize = new.map(|(image, _)| image.text.len()).sum();
        let fits = self.gallery.bytes() + bytes <= budget;
        if fits {
            for (image, path) in encoded {
                self.store(position, path, image);
            }
        }
        fits
    }

    fn add_level(&mut self, position: usize, scene: &'a exhibit::GalleryScene, spp: u32, budget: usize) {
        let paths: Vec<&str> = level_paths(scene, spp).collect();
        if paths.is_empty() {
            return;
        }
        if self.fit(position, &paths, budget) {
            self.enter_level(position, scene, spp);
        } else {
            self.gallery.omitted.push(format!("{} at {spp} spp", scene.title));
        }
    }

    fn add_diagnostics(
        &mut self,
        position: usize,
        scene: &'a exhibit::GalleryScene,
        spp: u32,
        budget: usize,
    ) {
        let Some(level) = self.gallery.scenes[position].levels.iter().position(|l| l.spp == spp) else {
            return;
        };
        for row in rows(scene, spp) {
            for (name, path) in &row.diagnostics {
                if !self.fit(position, &[path], budget) {
                    self.left_out += 1;
                    continue;
                }
                if let Some(&image) = self.stored.get(&(position, path.clone())) {
                    let level = &mut self.gallery.scenes[position].levels[level];
                    let of_row = level.diagnostics.entry(row.label.clone()).or_default();
                    of_row.insert(name.clone(), image);
                }
            }
        }
    }

    fn enter_level(&mut self, position: usize, scene: &'a exhibit::GalleryScene, spp: u32) {
        let mut level = GalleryLevel { spp, ..GalleryLevel::default() };
        for row in rows(scene, spp) {
            if let Some(&image) = self.stored.get(&(position, row.image.clone())) {
                level.images.insert(row.label.clone(), image);
            }
            if !row.value.is_empty() {
                level.values.insert(row.label.clone(), row.value.clone());
            }
        }
        if !level.images.is_empty() {
            self.gallery.scenes[position].levels.push(level);
        }
    }
}

/// The rows with images of a scene at a level.
fn rows(scene: &exhibit::GalleryScene, spp: u32) -> impl Iterator<Item = &exhibit::GalleryRow> {
    scene.levels.iter().filter(move |level| level.spp == spp).flat_map(|level| &level.rows)
}

/// Files of a level.
fn level_paths(scene: &exhibit::GalleryScene, spp: u32) -> impl Iterator<Item = &str> {
    rows(scene, spp).map(|row| row.image.as_str()).filter(|path| !path.is_empty())
}
