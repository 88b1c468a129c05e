//! Changes of frames that a result should follow, or not notice.

use noisefloor_frame::{Estimate, FeatureId, Flash, Frame, Image, Optional, Statistic, Variance};

/// Edits the variance of the mean, if there is one.
pub fn set_variance(estimate: &mut Estimate, value: impl FnMut(f32) -> f32) {
    estimate.variance =
        estimate.variance.take().map(|v| Variance::of_mean(v.into_mean_variance().map(value)));
}

/// The frame with every radiance times `k`: colour, direct light and flash, with their statistics.
#[must_use]
pub fn exposed(frame: &Frame, k: f32) -> Frame {
    radiances(frame, &times(k))
}

/// The frame with red, green and blue times the factors: radiances and reflectances.
#[must_use]
pub fn tinted(frame: &Frame, k: [f32; 3]) -> Frame {
    colors(frame, &|image, power| {
        let factor = |c: usize| k[c % 3].powi(power);
        let (width, height) = (image.width(), image.height());
        Image::from_fn(width, height, image.channels(), |c, x, y| image.get(c, x, y) * factor(c))
    })
}

/// The frame with every feature whose unit is a choice times `k`: depth and density in units of length, and whatever has no
/// fixed meaning.
#[must_use]
pub fn in_units(frame: &Frame, k: f32) -> Frame {
    let free = |id: &FeatureId| matches!(id, FeatureId::Depth | FeatureId::Caustics | FeatureId::Extra(_));
    features(frame.clone(), free, &times(k))
}

/// Red takes the place of green, green that of blue, and blue that of red.
#[must_use]
pub fn turned(image: &Image) -> Image {
    let (width, height, channels) = (image.width(), image.height(), image.channels());
    Image::from_fn(width, height, channels, |c, x, y| image.get((c + channels - 1) % channels, x, y))
}

/// The frame with the channels of everything that has red, green and blue [`turned`].
#[must_use]
pub fn with_turned_channels(frame: &Frame) -> Frame {
    colors(frame, &|image, _| turned(image))
}

/// A factor on values, and its square on variances.
fn times(k: f32) -> impl Fn(&Image, i32) -> Image {
    // One after the other: the square of a large factor alone is infinite, and takes zeros to no number.
    move |image, power| image.map(|v| (0..power).fold(v, |v, _| v * k))
}

/// Changes whatever has red, green and blue. `change` gets an image and the power of its unit: 2 for variances, 3 for third
/// moments.
fn colors(frame: &Frame, change: &impl Fn(&Image, i32) -> Image) -> Frame {
    features(radiances(frame, change), |id| matches!(id, FeatureId::Albedo | FeatureId::Brdf), change)
}

fn radiances(frame: &Frame, change: &impl Fn(&Image, i32) -> Image) -> Frame {
    let mut out = features(frame.clone(), |id| *id == FeatureId::Direct, change);
    out.color = each(&frame.color, change);
    out.flash = frame.flash.as_ref().map(|flash| match flash {
        Flash::Parts { base, light, covariance } => Flash::Parts {
            base: each(base, change),
            light: each(light, change),
            covariance: covariance.as_ref().map(|c| change(c, 2)),
        },
        Flash::Ready(flash) => Flash::Ready(each(flash, change)),
    });
    out.optional = optional(&frame.optional, change);
    out
}

/// The same change of optional statistics; moments of transformed samples, which have no power, are left out, and so are all
/// samples of a pixel.
fn optional(of: &Optional, change: &impl Fn(&Image, i32) -> Image) -> Optional {
    let power = |statistic: &Statistic| match statistic {
        Statistic::ThirdMoment => Some(3),
        Statistic::Least | Statistic::Greatest | Statistic::FourParts | Statistic::Position => Some(1),
        _ => None,
    };
    let recorded = of.recorded().iter().filter_map(|(statistic, images)| {
        let power = power(statistic)?;
        Some((*statistic, images.iter().map(|image| change(image, power)).collect()))
    });
    let parts = of.four_parts().map(|parts| parts.samples.clone());
    Optional::new(recorded.collect(), parts, Vec::new()).unwrap_or_default()
}

fn features(
    mut frame: Frame,
    of: impl Fn(&FeatureId) -> bool,
    change: &impl Fn(&Image, i32) -> Image,
) -> Frame {
    for (_, feature) in frame.features.iter_mut().filter(|(id, _)| of(id)) {
        *feature = each(feature, change);
    }
    frame
}

/// The same change of mean, variance and halves.
fn each(estimate: &Estimate, change: &impl Fn(&Image, i32) -> Image) -> Estimate {
    let halves = estimate.halves.as_ref();
    Estimate {
        mean: change(&estimate.mean, 1),
        variance: estimate.variance.as_ref().map(|v| Variance::of_mean(change(v.mean_variance(), 2))),
        halves: halves.map(|halves| halves.each_ref().map(|half| change(half, 1))),
    }
}

#[cfg(test)]
mod tests {
    use noisefloor_frame::{Samples, Sampling};

    use super::*;

    fn frame() -> Frame {
        let mean = Image::from_vec(1, 1, 3, vec![1.0, 2.0, 3.0]).unwrap();
        let color =
            Estimate { mean: mean.clone(), variance: Some(Variance::of_mean(mean.clone())), halves: None };
        let mut frame = Frame::from_color(color, Samples::uniform(4), Sampling::Independent);
        for id in [FeatureId::Albedo, FeatureId::Normal, FeatureId::Direct] {
            frame.features.insert(id, Estimate::from_mean(mean.clone()));
        }
        frame.features.insert(FeatureId::Depth, Estimate::from_mean(Image::filled(1, 1, 1, 5.0)));
        frame
    }

    #[test]
    fn an_exposure_goes_into_variances_by_its_square_and_spares_what_is_no_radiance() {
        let bright = exposed(&frame(), 4.0);
        assert_eq!(bright.color.mean.data(), [4.0, 8.0, 12.0]);
        assert_eq!(bright.color.variance.unwrap().mean_variance().data(), [16.0, 32.0, 48.0]);
        assert_eq!(bright.features[&FeatureId::Direct].mean.data(), [4.0, 8.0, 12.0]);
        assert_eq!(bright.features[&FeatureId::Albedo].mean.data(), [1.0, 2.0, 3.0]);
    }

    #[test]
    fn an_exposure_goes_into_third_moments_by_its_cube() {
        let mut frame = frame();
        let image = || vec![Image::filled(1, 1, 3, 1.0)];
        let recorded = vec![(Statistic::ThirdMoment, image()), (Statistic::Greatest, image())];
        frame.optional = Optional::new(recorded, None, vec![]).unwrap();
        let bright = exposed(&frame, 4.0).optional;
        assert_eq!(bright.third_moment().unwrap().data(), [64.0; 3]);
        assert_eq!(bright.greatest().unwrap().data(), [4.0; 3]);
    }

    #[test]
    fn channels_turn_where_they_are_colours_and_three_turns_are_none() {
        let once = with_turned_channels(&frame());
        assert_eq!(once.color.mean.data(), [3.0, 1.0, 2.0]);
        assert_eq!(once.features[&FeatureId::Albedo].mean.data(), [3.0, 1.0, 2.0]);
        assert_eq!(once.features[&FeatureId::Normal].mean.data(), [1.0, 2.0, 3.0]);
        assert_eq!(with_turned_channels(&with_turned_channels(&once)), frame());
    }

    #[test]
    fn a_tint_is_a_factor_for_each_channel() {
        let blue = tinted(&frame(), [1.0, 0.5, 4.0]);
        assert_eq!(blue.color.mean.data(), [1.0, 1.0, 12.0]);
        assert_eq!(blue.color.variance.unwrap().mean_variance().data(), [1.0, 0.5, 48.0]);
        assert_eq!(blue.features[&FeatureId::Albedo].mean.data(), [1.0, 1.0, 12.0]);
    }

    #[test]
    fn units_are_those_of_length_alone() {
        let far = in_units(&frame(), 100.0);
        assert_eq!(far.features[&FeatureId::Depth].mean.data(), [500.0]);
        assert_eq!(far.features[&FeatureId::Albedo], frame().features[&FeatureId::Albedo]);
    }
}
