//! A toy block with a letter on each side.

use glam::{Vec2, Vec3};

use crate::Mesh;
use crate::shape::rounded_box;
use crate::texture::{ImageTexture, Texture, Wrap};

/// Five columns by seven rows, the upper row first, the left column in the highest of five bits.
const LETTERS: [[u8; 7]; 6] = [
    [0b10001, 0b11001, 0b10101, 0b10011, 0b10001, 0b10001, 0b10001],
    [0b11111, 0b10000, 0b11110, 0b10000, 0b10000, 0b10000, 0b10000],
    [0b11110, 0b10001, 0b11110, 0b10010, 0b10001, 0b10001, 0b10001],
    [0b11111, 0b10000, 0b11110, 0b10000, 0b10000, 0b10000, 0b11111],
    [0b01110, 0b10001, 0b10001, 0b11111, 0b10001, 0b10001, 0b10001],
    [0b11110, 0b10001, 0b11110, 0b10001, 0b10001, 0b10001, 0b11110],
];

const INKS: [[f32; 3]; 3] = [[0.72, 0.07, 0.06], [0.05, 0.2, 0.6], [0.06, 0.4, 0.14]];

/// Dots along a side of a face (a letter with frame and margins) and pixels along a dot.
const DOTS: usize = 13;
const FINE: usize = 4;

/// A cube about the origin with half its size given; face k shows part k of [`letters`].
pub fn block(half: f32) -> Mesh {
    let mut mesh = rounded_box(Vec3::splat(half), 0.12 * half, 3);
    // The builder joins six equal faces and measures u and v from the corner of the flat part of each.
    let per_face = mesh.uvs.len() / 6;
    for (i, uv) in mesh.uvs.iter_mut().enumerate() {
        let on_face = ((*uv + 0.12 * half) / (2.0 * half)).clamp(Vec2::splat(0.002), Vec2::splat(0.998));
        *uv = Vec2::new(((i / per_face) as f32 + on_face.x) / 6.0, 1.0 - on_face.y);
    }
    mesh
}

/// Six framed letters side by side over [0, 1]².
pub fn letters() -> Texture {
    let side = DOTS * FINE;
    let width = 6 * side;
    let pixels = (0..width * side).map(|i| pixel((i % width) / FINE, i / width / FINE)).collect();
    // The number of pixels is right by construction; were it not, the block would be plain.
    ImageTexture::new(width, side, pixels, [Wrap::Clamp; 2], Vec3::ONE)
        .map_or(Texture::Checker { frequency: Vec2::ONE, a: PAPER, b: PAPER }, Texture::Image)
}

const PAPER: Vec3 = Vec3::new(0.82, 0.74, 0.56);

fn pixel(x: usize, y: usize) -> Vec3 {
    let (face, x) = (x / DOTS, x % DOTS);
    let ink = Vec3::from(INKS[face % INKS.len()]);
    let rim = x.min(y).min(DOTS - 1 - x).min(DOTS - 1 - y);
    let on_letter = (4..9).contains(&x) && (3..10).contains(&y) && LETTERS[face][y - 3] >> (8 - x) & 1 == 1;
    if rim == 1 || on_letter { ink } else { PAPER }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_show_different_letters_in_a_frame() {
        let Texture::Image(_) = letters() else { panic!("the block is plain") };
        let face = |k: usize| (0..DOTS * DOTS).map(move |i| pixel(k * DOTS + i % DOTS, i / DOTS) == PAPER);
        for (k, letter) in LETTERS.iter().enumerate() {
            let inked = face(k).filter(|paper| !paper).count();
            let strokes: u32 = letter.iter().map(|row| row.count_ones()).sum();
            assert_eq!(inked, 4 * 10 + strokes as usize, "face {k}");
            assert!((0..k).all(|other| !face(k).eq(face(other))), "face {k} repeats another");
        }
    }

    #[test]
    fn every_face_looks_at_its_own_letter_only() {
        let mesh = block(0.5);
        for t in &mesh.triangles {
            let faces = t.map(|i| (mesh.uvs[i as usize].x * 6.0) as u32);
            assert!(faces[0] < 6 && faces.iter().all(|f| *f == faces[0]), "{faces:?}");
        }
    }
}
