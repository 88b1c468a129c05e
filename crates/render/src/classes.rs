use noisefloor_frame::PixelFilter;

use crate::bvh::Ray;
use crate::camera::Eye;
use crate::limits::check_size;
use crate::surface::Scatter;
use crate::{Prepared, RenderError};

/// What a pixel shows, judged by one ray through the centres of pixel and lens. The first that applies, in this order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PixelClass {
    /// The ray leaves the scene.
    Background,
    /// The front of a light source.
    Emitter,
    /// Mirror, glass or conductor.
    Glossy,
    /// Spread by the lens over more than [`OUT_OF_FOCUS`] pixels.
    OutOfFocus,
    /// None of these.
    Plain,
}

impl PixelClass {
    /// Name in records.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Background => "background",
            Self::Emitter => "emitter",
            Self::Glossy => "glossy",
            Self::OutOfFocus => "out-of-focus",
            Self::Plain => "plain",
        }
    }
}

/// Diameter of the circle of confusion, in pixels, above which a pixel counts as out of focus.
pub const OUT_OF_FOCUS: f32 = 2.0;

/// Classes of all pixels, row by row.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ClassMap {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Row by row.
    pub classes: Vec<PixelClass>,
}

/// Classifies every pixel of an image of this size.
///
/// # Errors
/// [`RenderError::InvalidRequest`] for an empty or absurdly large image.
pub fn pixel_classes(scene: &Prepared, width: usize, height: usize) -> Result<ClassMap, RenderError> {
    check_size(width, height)?;
    let eye = Eye::new(&scene.camera, width, height, PixelFilter::Point);
    // In the middle of the time that the shutter is open.
    let mut stack = scene.traversal();
    scene.set_time(&mut stack, 0.5);
    let classes = (0..width * height)
        .map(|pixel| {
            let (origin, direction) = eye.ray(pixel % width, pixel / width, [0.5; 4]);
            let ray = Ray { origin, direction };
            let Some(hit) = scene.closest::<true>(&ray, f32::INFINITY, &mut stack) else {
                return PixelClass::Background;
            };
            let geometry = &scene.geometry[hit.primitive as usize];
            let at = scene.interact::<true>(&ray, &hit, &stack);
            let surface = &scene.surfaces[geometry.material as usize];
            if surface.emits && at.front {
                PixelClass::Emitter
            } else if !matches!(surface.scatter, Scatter::Diffuse(_)) {
                PixelClass::Glossy
            } else if eye.circle_of_confusion(at.point) > OUT_OF_FOCUS {
                PixelClass::OutOfFocus
            } else {
                PixelClass::Plain
            }
        })
        .collect();
    Ok(ClassMap { width, height, classes })
}
