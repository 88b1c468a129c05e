use crate::noise::{noise, surfaces};
use noisefloor_frame::{Estimate, FeatureId, Frame, Image, Samples, Sampling, Variance};

/// A frame for whole methods as from a renderer at 16 low-discrepancy samples: flat surfaces of 40×40 pixels with
/// noise, and features with a tenth of it. Texture, depth, normal and visibility are 8 channels; with `position` in
/// place of depth they are 10.
#[must_use]
pub fn method_frame(width: usize, height: usize, position: bool) -> Frame {
    let mut noise = noise();
    let mut estimate = |channels: usize, error: f32| {
        // The error of a half is √2 times that of the mean of both.
        let mut half = || {
            Image::from_fn(width, height, channels, |c, x, y| {
                surfaces(c, x, y) + noise(error * std::f32::consts::SQRT_2)
            })
        };
        let halves = [half(), half()];
        let variance = Image::filled(width, height, channels, error * error);
        Estimate {
            mean: halves[0].zip_map(&halves[1], |a, b| 0.5 * (a + b)),
            variance: Some(Variance::of_mean(variance)),
            halves: Some(halves),
        }
    };
    let mut frame = Frame::from_color(estimate(3, 0.05), Samples::uniform(16), Sampling::LowDiscrepancy);
    let place = if position { (FeatureId::Extra("position".into()), 3) } else { (FeatureId::Depth, 1) };
    for (id, channels) in [(FeatureId::Albedo, 3), (FeatureId::Normal, 3), place, (FeatureId::Visibility, 1)]
    {
        frame.features.insert(id, estimate(channels, 0.005));
    }
    frame
}
