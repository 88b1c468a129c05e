//! Images of a file, decoded when first looked at.

use std::collections::BTreeMap;

use gltf::image::Source;

use crate::GltfError;
use crate::data::Buffers;
use crate::image::{Decoded, decode, is_png};
use crate::uri::Fetcher;

/// The most texels of all images and vertex colours together: 1.5 GiB.
const MOST_TEXELS: usize = 1 << 27;

/// Where the images of a file come from, and those that were decoded already.
pub struct Images<'a> {
    pub buffers: &'a Buffers,
    pub files: Fetcher<'a>,
    decoded: BTreeMap<usize, Option<Decoded>>,
    left: usize,
}

impl<'a> Images<'a> {
    pub fn new(buffers: &'a Buffers, files: Fetcher<'a>) -> Self {
        Self { buffers, files, decoded: BTreeMap::new(), left: MOST_TEXELS }
    }

    /// Takes room for so many texels, if it is there.
    pub fn take(&mut self, texels: usize) -> bool {
        let left = self.left.checked_sub(texels);
        self.left = left.unwrap_or(self.left);
        left.is_some()
    }

    /// An image's colours, or nothing if its format is not read.
    pub fn get(&mut self, image: &gltf::Image<'_>) -> Result<Option<Decoded>, GltfError> {
        let index = image.index();
        if let Some(known) = self.decoded.get(&index) {
            return Ok(known.clone());
        }
        let bytes = match image.source() {
            Source::View { view, .. } => self.buffers.view(&view)?.to_vec(),
            Source::Uri { uri, .. } => self.files.fetch(uri, &format!("image {index}"))?,
        };
        let decoded = match bytes.as_slice() {
            [] => return Err(GltfError::image(index, "is empty")),
            [0xff, 0xd8, ..] => None,
            png if is_png(png) => Some(decode(png).map_err(|problem| GltfError::image(index, problem))?),
            _ => return Err(GltfError::image(index, "is not a PNG image")),
        };
        let texels = decoded.as_ref().map_or(0, |d| d.pixels.len());
        if !self.take(texels) {
            let problem = format!("with it, the images have more than {MOST_TEXELS} pixels");
            return Err(GltfError::image(index, problem));
        }
        self.decoded.insert(index, decoded.clone());
        Ok(decoded)
    }
}
