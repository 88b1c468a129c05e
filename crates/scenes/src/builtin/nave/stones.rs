//! What the church is built of.

use glam::{Vec2, Vec3};

use crate::texture::{Bricks, Clouds, Texture, Wood};
use crate::{Material, MaterialIndex, Scene};

/// Materials that several parts share.
pub struct Stones {
    pub ashlar: MaterialIndex,
    pub dressed: MaterialIndex,
    pub marble: MaterialIndex,
    pub voussoirs: MaterialIndex,
    pub plaster: MaterialIndex,
    pub oak: MaterialIndex,
    pub lead: MaterialIndex,
}

/// Adds them to a scene.
pub fn stones(scene: &mut Scene) -> Stones {
    let clouds = |frequency: f32, a: Vec3, b: Vec3, seed: u32| {
        Texture::Clouds(Clouds { frequency: Vec2::splat(frequency), octaves: 4, a, b, seed })
    };
    let mut add = |name: &str, texture: Texture| scene.add_material(Material::diffuse(name, texture));
    Stones {
        ashlar: add(
            "ashlar",
            Texture::Bricks(Bricks {
                size: Vec2::new(0.8, 0.4),
                joint: 0.02,
                colors: [Vec3::new(0.66, 0.56, 0.43), Vec3::new(0.78, 0.7, 0.57)],
                mortar: Vec3::new(0.42, 0.37, 0.3),
                seed: 4,
            }),
        ),
        dressed: add("limestone", clouds(5.0, Vec3::new(0.6, 0.54, 0.44), Vec3::new(0.82, 0.76, 0.65), 5)),
        marble: add("marble", clouds(2.2, Vec3::new(0.4, 0.28, 0.23), Vec3::new(0.76, 0.62, 0.53), 6)),
        voussoirs: add(
            "voussoirs",
            Texture::Stripes {
                period: 0.62,
                share: 0.5,
                base: Vec3::new(0.78, 0.71, 0.58),
                stripe: Vec3::new(0.5, 0.24, 0.16),
            },
        ),
        plaster: add("plaster", clouds(0.9, Vec3::new(0.66, 0.6, 0.5), Vec3::new(0.84, 0.79, 0.7), 7)),
        oak: add(
            "oak",
            Texture::Wood(Wood {
                plank: 0.4,
                length: 4.0,
                ring: 0.035,
                dark: Vec3::new(0.16, 0.09, 0.05),
                light: Vec3::new(0.38, 0.25, 0.14),
                seed: 8,
            }),
        ),
        lead: scene.add_material(Material::diffuse("lead", Vec3::splat(0.06))),
    }
}
