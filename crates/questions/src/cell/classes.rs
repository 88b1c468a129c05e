//! One class per pixel, so that a mean over an image cannot hide where a method fails.

use noisefloor_frame::{Image, Reference, Variance, luminance};

use noisefloor_study::Bits;

/// Relative step of luminance between neighbours that makes an edge.
const EDGE_STEP: f64 = 0.1;
/// Luminance below which steps are compared with this instead.
const EDGE_FLOOR: f64 = 0.01;
/// Standard errors of the reference that a step must exceed as well, so that its noise makes no edges.
const EDGE_SIGNIFICANCE: f64 = 4.0;

/// A class for every pixel.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PixelClasses {
    /// Names, indexed by the entries of `of_pixel`.
    pub names: Vec<String>,
    /// Row-major.
    pub of_pixel: Vec<u8>,
}

impl From<noisefloor_synthetic::Classes> for PixelClasses {
    fn from(classes: noisefloor_synthetic::Classes) -> Self {
        Self { names: classes.names, of_pixel: classes.of_pixel }
    }
}

impl PixelClasses {
    const EDGE: &str = "edge";
    const FLAT: &str = "flat";

    /// `edge` and `flat` alone, from the reference image.
    ///
    /// A pixel is an edge if its luminance differs from that of one of its four neighbours by more than 10 % of the
    /// brighter one (at least 0.01 of radiance counts as brightness), and by more than four standard errors of the
    /// reference's difference where the reference states its variance.
    #[must_use]
    pub fn from_reference(reference: &Reference) -> Self {
        let edges = edges(reference);
        Self {
            names: vec![Self::EDGE.into(), Self::FLAT.into()],
            of_pixel: edges.into_iter().map(|edge| u8::from(!edge)).collect(),
        }
    }

    /// The first of the scene's own classes that a pixel belongs to, else `edge` or `flat`.
    #[must_use]
    pub fn from_masks(masks: &[(&str, Vec<bool>)], reference: &Reference) -> Self {
        let mut names: Vec<String> = masks.iter().map(|(name, _)| (*name).to_owned()).collect();
        let edge = names.len() as u8;
        names.extend([Self::EDGE.into(), Self::FLAT.into()]);
        let of_pixel = edges(reference)
            .into_iter()
            .enumerate()
            .map(|(pixel, is_edge)| {
                let own = masks.iter().position(|(_, mask)| mask[pixel]);
                own.map_or(if is_edge { edge } else { edge + 1 }, |index| index as u8)
            })
            .collect();
        Self { names, of_pixel }
    }

    /// Adds names and classes to a hash.
    pub fn add_to(&self, bits: &mut Bits) {
        bits.number(self.names.len() as u64);
        self.names.iter().for_each(|name| bits.text(name));
        bits.number(self.of_pixel.len() as u64);
        self.of_pixel.iter().for_each(|class| bits.number(u64::from(*class)));
    }

    /// As an image of indices, for the study's folder.
    #[must_use]
    pub fn to_image(&self, width: usize, height: usize) -> Image {
        Image::from_fn(width, height, 1, |_, x, y| f32::from(self.of_pixel[y * width + x]))
    }

    /// Inverse of [`PixelClasses::to_image`].
    ///
    /// # Errors
    /// If a pixel has an index without a name.
    pub fn from_image(names: Vec<String>, image: &Image) -> Result<Self, UnknownClass> {
        let of_pixel: Vec<u8> = image.plane(0).iter().map(|&v| v as u8).collect();
        match of_pixel.iter().find(|&&class| usize::from(class) >= names.len()) {
            Some(&class) => Err(UnknownClass { class, names }),
            None => Ok(Self { names, of_pixel }),
        }
    }
}

/// An index of a pixel class that has no name.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("pixel class {class} has no name among {}", names.join(", "))]
pub struct UnknownClass {
    /// The index.
    pub class: u8,
    /// The names that there are.
    pub names: Vec<String>,
}

fn edges(reference: &Reference) -> Vec<bool> {
    let mean = reference.mean();
    let (width, height) = (mean.width(), mean.height());
    let at = |image: &Image, p: usize| [0, 1, 2].map(|c| image.plane(c)[p]);
    let light: Vec<f64> = (0..mean.pixels()).map(|p| f64::from(luminance(at(mean, p)))).collect();
    // Channels are correlated: the squared weights alone would understate, so take fully correlated channels.
    let noise: Vec<f64> = match reference.frame.color.variance.as_ref().map(Variance::mean_variance) {
        Some(v) => (0..mean.pixels())
            .map(|p| f64::from(luminance(at(v, p).map(|v| v.max(0.0).sqrt()))).powi(2))
            .collect(),
        None => vec![0.0; mean.pixels()],
    };
    let step = |p: usize, q: usize| {
        let difference = (light[p] - light[q]).abs();
        let brightness = light[p].max(light[q]).max(EDGE_FLOOR);
        difference > EDGE_STEP * brightness && difference > EDGE_SIGNIFICANCE * (noise[p] + noise[q]).sqrt()
    };
    let mut out = vec![false; mean.pixels()];
    for y in 0..height {
        for x in 0..width {
            let p = y * width + x;
            for q in [(x + 1 < width).then_some(p + 1), (y + 1 < height).then_some(p + width)] {
                if let Some(q) = q
                    && step(p, q)
                {
                    out[p] = true;
                    out[q] = true;
                }
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_sides_of_a_step_are_edges_and_noise_of_the_reference_is_none() {
        let image = Image::from_fn(6, 2, 3, |_, x, _| if x < 3 { 1.0 } else { 2.0 });
        let classes = PixelClasses::from_reference(&Reference::exact(image.clone()));
        assert_eq!(classes.of_pixel[..6], [1, 1, 0, 0, 1, 1]);
        let mut noisy = Reference::exact(image);
        noisy.frame.color.variance = Some(Variance::of_mean(Image::filled(6, 2, 3, 0.1)));
        // A step of 1 with a standard error of √0.2 = 0.45 is below 4 standard errors.
        assert!(PixelClasses::from_reference(&noisy).of_pixel.iter().all(|&c| c == 1));
    }

    #[test]
    fn the_scenes_own_classes_come_first() {
        let image = Image::from_fn(4, 1, 3, |_, x, _| if x < 2 { 1.0 } else { 2.0 });
        let masks =
            [("emitter", vec![false, true, false, false]), ("glossy", vec![false, true, true, false])];
        let classes = PixelClasses::from_masks(&masks, &Reference::exact(image.clone()));
        let names: Vec<&str> =
            classes.of_pixel.iter().map(|&c| classes.names[usize::from(c)].as_str()).collect();
        assert_eq!(names, ["flat", "emitter", "glossy", "flat"]);
        let again = PixelClasses::from_image(classes.names.clone(), &classes.to_image(4, 1)).unwrap();
        assert_eq!(again, classes);
    }
}
