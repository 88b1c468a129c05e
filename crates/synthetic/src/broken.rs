//! Ways in which frames of other programs are broken, applied to a sound frame.

use noisefloor_frame::{Counts, Estimate, FeatureId, Flash, Frame, Image, Samples, Variance};

/// Replaces some values of an image by `value`, at pixels that no simple stride hits in all images alike.
fn scatter(image: &mut Image, value: f32, phase: usize) {
    let n = image.data().len();
    for k in 0..n.div_ceil(50) {
        image.data_mut()[(phase + 37 * k) % n] = value;
    }
}

fn edit_variance(estimate: &mut Estimate, edit: impl FnOnce(&mut Image)) {
    if let Some(variance) = estimate.variance.take() {
        let mut image = variance.into_mean_variance();
        edit(&mut image);
        estimate.variance = Some(Variance::of_mean(image));
    }
}

/// All estimates of a frame but the colour.
fn guides(frame: &mut Frame) -> Vec<&mut Estimate> {
    let mut all: Vec<&mut Estimate> = frame.features.values_mut().collect();
    match &mut frame.flash {
        Some(Flash::Parts { base, light, .. }) => all.extend([base, light]),
        Some(Flash::Ready(flash)) => all.push(flash),
        None => {}
    }
    all
}

/// Scattered `value` in the means, variances and halves of colour, features and flash.
pub(crate) fn scattered(frame: &mut Frame, value: f32) {
    scatter(&mut frame.color.mean, value, 3);
    edit_variance(&mut frame.color, |v| scatter(v, value, 11));
    if let Some([a, _]) = &mut frame.color.halves {
        scatter(a, value, 23);
    }
    for (k, estimate) in guides(frame).into_iter().enumerate() {
        scatter(&mut estimate.mean, value, 5 + k);
        edit_variance(estimate, |v| scatter(v, value, 13 + k));
    }
}

/// Every colour but that of one pixel in the middle is NaN.
pub(crate) fn one_color(frame: &mut Frame) {
    let middle = frame.pixels() / 2;
    for plane in frame.color.mean.planes_mut() {
        let kept = plane[middle];
        plane.fill(f32::NAN);
        plane[middle] = kept;
    }
}

/// A quarter of the colours is NaN: more than is taken for part of the image.
pub(crate) fn quarter_nan(frame: &mut Frame) {
    frame.color.mean.plane_mut(1).iter_mut().step_by(4).for_each(|value| *value = f32::NAN);
}

/// Scattered pixels of the colour are `factor` times brighter, as one extreme sample of n leaves them: mean,
/// and the standard error equal to the excess.
pub(crate) fn fireflies(frame: &mut Frame, factor: f32) {
    let n = frame.color.mean.data().len();
    for k in 0..n.div_ceil(60) {
        let i = (7 + 41 * k) % n;
        let old = frame.color.mean.data()[i];
        frame.color.mean.data_mut()[i] = old * factor;
        edit_variance(&mut frame.color, |v| v.data_mut()[i] = (old * factor).powi(2));
        if let Some([a, b]) = &mut frame.color.halves {
            a.data_mut()[i] = 2.0 * old * factor;
            b.data_mut()[i] = old;
        }
    }
}

/// No variance in these channels of the colour: mean and halves stay, halves become equal.
pub(crate) fn zero_variance(frame: &mut Frame, channels: &[usize]) {
    for &c in channels {
        edit_variance(&mut frame.color, |v| v.plane_mut(c).fill(0.0));
        let mean = frame.color.mean.plane(c).to_vec();
        for half in frame.color.halves.iter_mut().flatten() {
            half.plane_mut(c).copy_from_slice(&mean);
        }
    }
}

/// No variance in any feature or flash.
pub(crate) fn zero_guide_variance(frame: &mut Frame) {
    for estimate in guides(frame) {
        edit_variance(estimate, |v| v.data_mut().fill(0.0));
        let mean = estimate.mean.clone();
        for half in estimate.halves.iter_mut().flatten() {
            *half = mean.clone();
        }
    }
}

/// Every feature and the flash become constant over the image.
pub(crate) fn constant_guides(frame: &mut Frame) {
    for estimate in guides(frame) {
        let constant = |image: &mut Image| {
            for plane in image.planes_mut() {
                let first = plane[0];
                plane.fill(first);
            }
        };
        constant(&mut estimate.mean);
        estimate.halves.iter_mut().flatten().for_each(constant);
    }
}

/// Normal and depth become multiples of the albedo, so that no regression on the features has a unique
/// answer.
pub(crate) fn collinear_features(frame: &mut Frame) {
    let Some(albedo) = frame.features.get(&FeatureId::Albedo).cloned() else { return };
    let scaled = |channels: usize, factor: f32| {
        let plane = |image: &Image| {
            let (w, h) = (image.width(), image.height());
            Image::from_fn(w, h, channels, |_, x, y| factor * image.get(0, x, y))
        };
        Estimate {
            mean: plane(&albedo.mean),
            variance: albedo.variance.as_ref().map(|v| {
                let squared = plane(v.mean_variance());
                Variance::of_mean(squared.map(|v| factor * v))
            }),
            halves: albedo.halves.as_ref().map(|[a, b]| [plane(a), plane(b)]),
        }
    };
    frame.features.insert(FeatureId::Normal, scaled(3, 2.0));
    frame.features.insert(FeatureId::Depth, scaled(1, 0.5));
}

/// The upper half shows the background: depth `depth`, normal zero, material −1.
pub(crate) fn background(frame: &mut Frame, depth: f32) {
    let upper = (frame.height() / 2) * frame.width();
    let values = [(FeatureId::Depth, depth), (FeatureId::Normal, 0.0), (FeatureId::Material, -1.0)];
    for (id, value) in values {
        if let Some(estimate) = frame.features.get_mut(&id) {
            let images = std::iter::once(&mut estimate.mean).chain(estimate.halves.iter_mut().flatten());
            images.for_each(|image| image.planes_mut().for_each(|plane| plane[..upper].fill(value)));
        }
    }
}

/// All colour values and their spread times `factor`; the flash too, the features stay.
pub(crate) fn scaled(frame: &mut Frame, factor: f32) {
    let mut images = vec![&mut frame.color];
    match &mut frame.flash {
        Some(Flash::Parts { base, light, covariance }) => {
            if let Some(covariance) = covariance {
                *covariance = covariance.map(|v| v * factor * factor);
            }
            images.extend([base, light]);
        }
        Some(Flash::Ready(flash)) => images.push(flash),
        None => {}
    }
    for estimate in images {
        estimate.mean = estimate.mean.map(|v| v * factor);
        edit_variance(estimate, |v| *v = v.map(|v| v * factor * factor));
        for half in estimate.halves.iter_mut().flatten() {
            *half = half.map(|v| v * factor);
        }
    }
}

/// The flash image is black: no reused light and no eye light.
pub(crate) fn black_flash(frame: &mut Frame) {
    let black = |estimate: &mut Estimate| {
        estimate.mean.data_mut().fill(0.0);
        edit_variance(estimate, |v| v.data_mut().fill(0.0));
        estimate.halves.iter_mut().flatten().for_each(|half| half.data_mut().fill(0.0));
    };
    match &mut frame.flash {
        Some(Flash::Parts { base, light, .. }) => [base, light].into_iter().for_each(black),
        Some(Flash::Ready(flash)) => black(flash),
        None => {}
    }
}

/// Scattered variances become negative, as rounding in other programs leaves them.
pub(crate) fn negative_variances(frame: &mut Frame) {
    edit_variance(&mut frame.color, |v| scatter(v, -1e-3, 2));
    for estimate in guides(frame) {
        edit_variance(estimate, |v| scatter(v, -1e-3, 4));
    }
}

/// Counts that differ from pixel to pixel, from `least` on.
pub(crate) fn uneven_counts(frame: &mut Frame, least: u32) {
    let counts = (0..frame.pixels()).map(|p| least + (p as u32 * 7) % 60).collect();
    frame.samples = Samples::per_pixel(counts);
    // Half B of a pixel with one sample is empty.
    debug_assert!(matches!(frame.samples.total(), Counts::PerPixel(_)));
}
