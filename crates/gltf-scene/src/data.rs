//! Bytes of buffers, and numbers of accessors with every bound checked before anything is read or allocated.

use gltf::accessor::{Accessor, DataType, Dimensions};
use gltf::buffer::{Source, View};

use crate::GltfError;
use crate::uri::Fetcher;

/// All buffers of a file.
pub struct Buffers(Vec<Vec<u8>>);

impl Buffers {
    pub fn read(gltf: &mut gltf::Gltf, files: &mut Fetcher<'_>) -> Result<Self, GltfError> {
        let mut blob = gltf.blob.take();
        let mut all = Vec::new();
        for buffer in gltf.document.buffers() {
            let what = format!("buffer {}", buffer.index());
            let bytes = match buffer.source() {
                Source::Bin => blob.take().ok_or_else(|| GltfError::data(&what, "has no data"))?,
                Source::Uri(uri) => files.fetch(uri, &what)?,
            };
            if bytes.len() < buffer.length() {
                let problem = format!("is truncated: {} of {} bytes are there", bytes.len(), buffer.length());
                return Err(GltfError::data(what, problem));
            }
            all.push(bytes);
        }
        Ok(Self(all))
    }

    pub fn view(&self, view: &View<'_>) -> Result<&[u8], GltfError> {
        let end = view.offset().checked_add(view.length());
        let bytes = self.0.get(view.buffer().index());
        bytes.zip(end).and_then(|(bytes, end)| bytes.get(view.offset()..end)).ok_or_else(|| {
            GltfError::data(format!("buffer view {}", view.index()), "reaches beyond its buffer")
        })
    }

    /// Elements with `N` floating-point components; integers are taken as normalised.
    pub fn floats<const N: usize>(&self, accessor: &Accessor<'_>) -> Result<Vec<[f32; N]>, GltfError> {
        let width = accessor.data_type().size();
        let convert: fn(&[u8]) -> f32 = match accessor.data_type() {
            DataType::F32 => |b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]),
            DataType::U8 => |b| f32::from(b[0]) / 255.0,
            DataType::U16 => |b| f32::from(u16::from_le_bytes([b[0], b[1]])) / 65535.0,
            _ => return Err(wrong(accessor, "is not of floating-point or unsigned normalised numbers")),
        };
        let elements = self.elements(accessor, N)?;
        Ok(elements.map(|e| std::array::from_fn(|i| convert(&e[i * width..]))).collect())
    }

    /// Unsigned indices.
    pub fn indices(&self, accessor: &Accessor<'_>) -> Result<Vec<u32>, GltfError> {
        let convert: fn(&[u8]) -> u32 = match accessor.data_type() {
            DataType::U8 => |b| u32::from(b[0]),
            DataType::U16 => |b| u32::from(u16::from_le_bytes([b[0], b[1]])),
            DataType::U32 => |b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]),
            _ => return Err(wrong(accessor, "is not of unsigned integers")),
        };
        Ok(self.elements(accessor, 1)?.map(convert).collect())
    }

    /// The bytes of each element, every one inside its view.
    pub fn elements(
        &self,
        accessor: &Accessor<'_>,
        components: usize,
    ) -> Result<impl Iterator<Item = &[u8]>, GltfError> {
        let dimensions = match accessor.dimensions() {
            Dimensions::Scalar => 1,
            Dimensions::Vec2 => 2,
            Dimensions::Vec3 => 3,
            Dimensions::Vec4 => 4,
            _ => 0,
        };
        if dimensions != components {
            return Err(wrong(accessor, &format!("does not have {components} components")));
        }
        if accessor.sparse().is_some() {
            return Err(wrong(accessor, "is sparse, which is not supported"));
        }
        let view = accessor.view().ok_or_else(|| wrong(accessor, "has no buffer view"))?;
        let size = accessor.data_type().size() * components;
        let stride = view.stride().unwrap_or(size);
        if stride < size {
            return Err(wrong(accessor, "has elements that overlap"));
        }
        let bytes = self.view(&view)?;
        if accessor.count() == 0 {
            return Err(wrong(accessor, "has no elements"));
        }
        let last = accessor.count().checked_sub(1).and_then(|n| n.checked_mul(stride));
        let end = last.and_then(|l| l.checked_add(accessor.offset())).and_then(|l| l.checked_add(size));
        if end.is_none_or(|end| end > bytes.len()) {
            return Err(wrong(accessor, "reaches beyond its buffer view"));
        }
        let start = accessor.offset();
        Ok((0..accessor.count()).map(move |i| &bytes[start + i * stride..][..size]))
    }
}

fn wrong(accessor: &Accessor<'_>, problem: &str) -> GltfError {
    GltfError::data(format!("accessor {}", accessor.index()), problem)
}
