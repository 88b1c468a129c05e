//! What a method makes of a frame, as its tests read it: its image against the truth, its diagnostics and figures by name.

use noisefloor_denoiser::{Denoiser, Diagnostics, Input, Output};
use noisefloor_frame::{Frame, Image};

/// What the method makes of the frame alone.
///
/// # Panics
///
/// With the method's own words if it refuses the frame.
#[must_use]
pub fn run(method: &dyn Denoiser, frame: &Frame) -> Output {
    method.denoise(&Input::new(frame)).unwrap_or_else(|e| panic!("{e}"))
}

/// The same with diagnostics.
///
/// # Panics
///
/// With the method's own words if it refuses the frame.
#[must_use]
pub fn diagnose(method: &dyn Denoiser, frame: &Frame) -> Output {
    let input = Input::new(frame).with_diagnostics(Diagnostics::On { probe: None });
    method.denoise(&input).unwrap_or_else(|e| panic!("{e}"))
}

/// The diagnostic image of this name.
///
/// # Panics
///
/// If there is none.
#[must_use]
pub fn diagnostic<'a>(output: &'a Output, name: &str) -> &'a Image {
    &output.diagnostics.iter().find(|d| d.name == name).unwrap_or_else(|| panic!("no `{name}`")).image
}

/// The figure of this name.
///
/// # Panics
///
/// If there is none.
#[must_use]
pub fn figure(output: &Output, name: &str) -> f64 {
    output.figures.iter().find(|f| f.name == name).unwrap_or_else(|| panic!("no `{name}`")).value
}

/// The largest difference of two values; infinite if a value is no number.
///
/// # Panics
///
/// If the images differ in shape.
#[must_use]
pub fn largest_difference(a: &Image, b: &Image) -> f32 {
    let far = |(a, b): (&f32, &f32)| (a - b).abs();
    let worst = |most: f32, d: f32| if d.is_nan() { f32::INFINITY } else { most.max(d) };
    values(a, b).map(far).fold(0.0, worst)
}

/// Mean over pixels and channels of the squared difference.
///
/// # Panics
///
/// If the images differ in shape.
#[must_use]
pub fn squared_error(image: &Image, truth: &Image) -> f64 {
    let square = |(a, b): (&f32, &f32)| (f64::from(*a) - f64::from(*b)).powi(2);
    values(image, truth).map(square).sum::<f64>() / image.data().len() as f64
}

/// The sum of all values.
#[must_use]
pub fn light(image: &Image) -> f64 {
    image.data().iter().copied().map(f64::from).sum()
}

fn values<'a>(a: &'a Image, b: &'a Image) -> impl Iterator<Item = (&'a f32, &'a f32)> {
    assert!(a.same_shape(b), "images of different shapes");
    a.data().iter().zip(b.data())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_of_values_and_none_is_lost() {
        let of = |values: [f32; 3]| Image::from_vec(1, 1, 3, values.to_vec()).unwrap();
        let (a, b) = (of([1.0, 2.0, 3.0]), of([1.5, 0.0, 3.0]));
        assert_eq!(largest_difference(&a, &b), 2.0);
        assert_eq!(squared_error(&a, &b), (0.25 + 4.0) / 3.0);
        assert_eq!(light(&a), 6.0);
        assert_eq!(largest_difference(&a, &of([f32::NAN, 2.0, 3.0])), f32::INFINITY);
    }
}
