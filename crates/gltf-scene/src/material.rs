//! Materials of a file, made when first used.

use std::collections::{BTreeMap, BTreeSet};

use glam::Vec3;
use gltf::texture::{Info, WrappingMode};
use noisefloor_scenes::texture::{ImageTexture, Wrap};
use noisefloor_scenes::{Color, MOST_RADIANCE, Material, Mesh, Scattering, Scene, Texture};

use crate::GltfError;
use crate::images::Images;
use crate::tint::{self, VertexColors};

/// Below this α a conductor is narrower than directions resolve.
const LEAST_ALPHA: f32 = 1e-3;

/// Materials that were made already, and what they are made from.
pub struct Materials<'a> {
    pub images: Images<'a>,
    made: BTreeMap<(Option<usize>, bool), usize>,
}

/// What the colour of a surface is multiplied from.
struct Base {
    factor: Vec3,
    texture: Option<ImageTexture>,
}

impl<'a> Materials<'a> {
    pub fn new(images: Images<'a>) -> Self {
        Self { images, made: BTreeMap::new() }
    }

    /// Gives the mesh its material, made in `scene` if it is new, and its vertex colours.
    pub fn dress(
        &mut self,
        scene: &mut Scene,
        mut mesh: Mesh,
        colors: Option<VertexColors>,
        material: &gltf::Material<'_>,
        notices: &mut BTreeSet<String>,
    ) -> Result<Mesh, GltfError> {
        let uvs = !mesh.uvs.is_empty();
        let key = (material.index(), uvs);
        if let (None, Some(&index)) = (&colors, self.made.get(&key)) {
            mesh.material = index;
            return Ok(mesh);
        }
        let mut base = self.base(material, uvs, notices)?;
        let shared = colors.is_none();
        match colors {
            None => {}
            Some(VertexColors::Constant(color)) => {
                base.factor *= color;
                base.texture = base.texture.map(|texture| texture.times(color));
            }
            Some(VertexColors::Each(_)) if base.texture.is_some() => {
                notices.insert("vertex colours on surfaces with a texture".into());
            }
            Some(VertexColors::Each(_)) if !self.images.take(tint::texels(mesh.triangles.len())) => {
                notices.insert("vertex colours of the largest meshes".into());
            }
            Some(VertexColors::Each(colors)) => {
                let (baked, texture) = tint::bake(&mesh, &colors, base.factor);
                (mesh, base.texture) = (baked, Some(texture));
            }
        }
        let material = self.make(material, base, notices)?;
        // Vertex colours of one value give many meshes the same material.
        let known = (!shared).then(|| scene.materials.iter().rposition(|m| *m == material)).flatten();
        mesh.material = known.unwrap_or_else(|| scene.add_material(material));
        if shared {
            self.made.insert(key, mesh.material);
        }
        Ok(mesh)
    }

    /// The base colour.
    fn base(
        &mut self,
        material: &gltf::Material<'_>,
        uvs: bool,
        notices: &mut BTreeSet<String>,
    ) -> Result<Base, GltfError> {
        let pbr = material.pbr_metallic_roughness();
        let [r, g, b, _] = pbr.base_color_factor();
        let stated = Vec3::new(r, g, b);
        let factor = stated.clamp(Vec3::ZERO, Vec3::ONE);
        if factor != stated {
            notices.insert("what base colour factors have below 0 or above 1".into());
        }
        match pbr.base_color_texture() {
            Some(info) => self.texture(&info, factor, uvs, notices),
            None => Ok(Base { factor, texture: None }),
        }
    }

    fn make(
        &mut self,
        material: &gltf::Material<'_>,
        base: Base,
        notices: &mut BTreeSet<String>,
    ) -> Result<Material, GltfError> {
        let pbr = material.pbr_metallic_roughness();
        let left_out = [
            (material.normal_texture().is_some(), "normal maps"),
            (material.occlusion_texture().is_some(), "occlusion maps"),
            (pbr.metallic_roughness_texture().is_some(), "metallic-roughness textures"),
            (material.double_sided(), "double-sided materials"),
            (material.alpha_mode() != gltf::material::AlphaMode::Opaque, "alpha modes"),
        ];
        notices.extend(left_out.into_iter().filter(|(is, _)| *is).map(|(_, what)| what.to_owned()));
        let texture = base.texture.map(Texture::Image);
        let color = texture.map_or(Color::Constant(base.factor), Color::Texture);
        let scattering = if pbr.metallic_factor() >= 0.5 {
            let alpha = pbr.roughness_factor().powi(2).clamp(LEAST_ALPHA, 1.0);
            Scattering::Conductor { f0: color, alpha }
        } else {
            Scattering::Diffuse { albedo: color }
        };
        let emission = self.emission(material, notices)?;
        Ok(Material { emission, ..Material::dark(material.name().unwrap_or("unnamed"), scattering) })
    }

    /// What a material emits: factor, strength and texture together, or nothing. The factor alone would let a screen
    /// with one lit pixel shine all over.
    pub fn emission(
        &mut self,
        material: &gltf::Material<'_>,
        notices: &mut BTreeSet<String>,
    ) -> Result<Vec3, GltfError> {
        let strength = material.emissive_strength().unwrap_or(1.0);
        let factor = Vec3::from(material.emissive_factor()) * strength;
        if !(factor.is_finite() && factor.min_element() >= 0.0 && factor.max_element() <= MOST_RADIANCE) {
            let what = match material.index() {
                Some(index) => format!("material {index}"),
                None => "the default material".to_owned(),
            };
            let allowed = "allowed is finite, not negative and at most 1e15";
            return Err(GltfError::data(what, format!("emits {factor}, {allowed}")));
        }
        let Some(info) = material.emissive_texture() else { return Ok(factor) };
        if factor == Vec3::ZERO {
            return Ok(factor);
        }
        let image = self.images.get(&info.texture().source())?;
        match image.as_ref().and_then(|image| image.uniform()) {
            Some(color) => Ok(factor * color),
            None => {
                let what = "emissive textures of more than one colour, and their factors with them: such surfaces do not shine";
                notices.insert(what.into());
                Ok(Vec3::ZERO)
            }
        }
    }

    fn texture(
        &mut self,
        info: &Info<'_>,
        factor: Vec3,
        uvs: bool,
        notices: &mut BTreeSet<String>,
    ) -> Result<Base, GltfError> {
        let image = info.texture().source();
        let Some(image) = self.images.get(&image)? else {
            notices.insert("JPEG images: the base colour is its factor alone".into());
            return Ok(Base { factor, texture: None });
        };
        if info.tex_coord() != 0 || !uvs {
            let what = "textures without the first set of texture coordinates: their mean colour is shown";
            notices.insert(what.into());
            return Ok(Base { factor: factor * image.mean(), texture: None });
        }
        let sampler = info.texture().sampler();
        let wrap = [sampler.wrap_s(), sampler.wrap_t()].map(|mode| match mode {
            WrappingMode::Repeat => Wrap::Repeat,
            WrappingMode::ClampToEdge => Wrap::Clamp,
            WrappingMode::MirroredRepeat => Wrap::Mirror,
        });
        let index = info.texture().source().index();
        let texture = ImageTexture::new(image.width, image.height, image.pixels.clone(), wrap, factor)
            .map_err(|e| GltfError::image(index, e.to_string()))?;
        Ok(Base { factor, texture: Some(texture) })
    }
}
