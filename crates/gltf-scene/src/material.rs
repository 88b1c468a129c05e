//! Materials of a file, made when first used.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use glam::Vec3;
use gltf::image::Source;
use gltf::texture::{Info, WrappingMode};
use noisefloor_scenes::texture::{ImageTexture, Wrap};
use noisefloor_scenes::{Color, Material, Scattering, Scene, Texture};

use crate::GltfError;
use crate::data::{Buffers, fetch};
use crate::image::{Decoded, decode, is_png};

/// Below this α a conductor is narrower than directions resolve.
const LEAST_ALPHA: f32 = 1e-3;

/// Materials and images that were made already.
pub struct Materials<'a> {
    pub buffers: &'a Buffers,
    pub folder: &'a Path,
    pub made: BTreeMap<(Option<usize>, bool), usize>,
    pub images: BTreeMap<usize, Option<Decoded>>,
}

impl Materials<'_> {
    /// Index in `scene` of a material; `uvs`: whether the mesh has texture coordinates.
    pub fn index(
        &mut self,
        scene: &mut Scene,
        material: &gltf::Material<'_>,
        uvs: bool,
        notices: &mut BTreeSet<String>,
    ) -> Result<usize, GltfError> {
        let key = (material.index(), uvs);
        if let Some(&index) = self.made.get(&key) {
            return Ok(index);
        }
        let index = scene.add_material(self.make(material, uvs, notices)?);
        self.made.insert(key, index);
        Ok(index)
    }

    fn make(
        &mut self,
        material: &gltf::Material<'_>,
        uvs: bool,
        notices: &mut BTreeSet<String>,
    ) -> Result<Material, GltfError> {
        let pbr = material.pbr_metallic_roughness();
        let left_out = [
            (material.normal_texture().is_some(), "normal maps"),
            (material.occlusion_texture().is_some(), "occlusion maps"),
            (material.emissive_texture().is_some(), "emissive textures"),
            (pbr.metallic_roughness_texture().is_some(), "metallic-roughness textures"),
            (material.double_sided(), "double-sided materials"),
            (material.alpha_mode() != gltf::material::AlphaMode::Opaque, "alpha modes"),
        ];
        notices.extend(left_out.into_iter().filter(|(is, _)| *is).map(|(_, what)| what.to_owned()));
        let [r, g, b, _] = pbr.base_color_factor();
        let factor = Vec3::new(r, g, b).clamp(Vec3::ZERO, Vec3::ONE);
        let texture = match pbr.base_color_texture() {
            Some(info) => self.texture(&info, factor, uvs, notices)?,
            None => None,
        };
        let color = texture.map_or(Color::Constant(factor), Color::Texture);
        let scattering = if pbr.metallic_factor() >= 0.5 {
            let alpha = pbr.roughness_factor().powi(2).clamp(LEAST_ALPHA, 1.0);
            Scattering::Conductor { f0: color, alpha }
        } else {
            Scattering::Diffuse { albedo: color }
        };
        let strength = material.emissive_strength().unwrap_or(1.0);
        let emission = Vec3::from(material.emissive_factor()) * strength;
        Ok(Material { emission, ..Material::dark(material.name().unwrap_or("unnamed"), scattering) })
    }

    fn texture(
        &mut self,
        info: &Info<'_>,
        factor: Vec3,
        uvs: bool,
        notices: &mut BTreeSet<String>,
    ) -> Result<Option<Texture>, GltfError> {
        if info.tex_coord() != 0 || !uvs {
            notices.insert("textures without the first set of texture coordinates".into());
            return Ok(None);
        }
        let image = info.texture().source();
        let index = image.index();
        if !self.images.contains_key(&index) {
            let what = format!("image {index}");
            let bytes = match image.source() {
                Source::View { view, .. } => self.buffers.view(&view)?.to_vec(),
                Source::Uri { uri, .. } => fetch(uri, self.folder, &what)?,
            };
            let fail = |problem| GltfError::Image { image: index, problem };
            let decoded = match bytes.as_slice() {
                [] => return Err(fail("is empty".into())),
                [0xff, 0xd8, ..] => None,
                png if is_png(png) => Some(decode(png).map_err(fail)?),
                _ => return Err(fail("is not a PNG image".into())),
            };
            self.images.insert(index, decoded);
        }
        let Some(Some(image)) = self.images.get(&index) else {
            notices.insert("JPEG images".into());
            return Ok(None);
        };
        let sampler = info.texture().sampler();
        let wrap = [sampler.wrap_s(), sampler.wrap_t()].map(|mode| match mode {
            WrappingMode::Repeat => Wrap::Repeat,
            WrappingMode::ClampToEdge => Wrap::Clamp,
            WrappingMode::MirroredRepeat => Wrap::Mirror,
        });
        let texture = ImageTexture::new(image.width, image.height, image.pixels.clone(), wrap, factor)
            .map_err(|e| GltfError::Image { image: index, problem: e.to_string() })?;
        Ok(Some(Texture::Image(texture)))
    }
}
