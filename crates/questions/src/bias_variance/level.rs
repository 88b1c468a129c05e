//! Bias and variance of every row that has outputs of two replicates.

use noisefloor_frame::{Image, Reference, SquaredError, Variance};
use noisefloor_metrics::EPSILON;
use noisefloor_stats::{
    BiasReference, BiasVariance, BiasVarianceError, Groups, ReferenceNoise, Replicates, bias_variance,
};

use super::ID;
use super::answer::{Answer, RowAnswer, Split};
use super::maps;
use crate::answers;
use crate::cell::MeasureError;
use crate::level::{LevelCell, LevelFound};

pub(super) fn measure(level: &LevelCell<'_>, found: &mut LevelFound) -> Result<(), MeasureError> {
    if level.frames.len() < 2 {
        return Ok(());
    }
    let truth = level.reference.mean();
    let weights: Vec<f64> = truth.data().iter().map(|&r| weight(f64::from(r))).collect();
    let shown = level.study.viewer_spp.is_empty() || level.study.viewer_spp.contains(&level.spp);
    let mut answer: Answer = Vec::new();
    for label in level.rows {
        let outputs: Vec<Image> = (level.outputs)(label)
            .into_iter()
            .map(|(_, image)| image)
            .filter(|i| i.same_shape(truth))
            .collect();
        let Some((row, split)) = of_row(level, label, &outputs, &weights)? else { continue };
        answer.push(row);
        if shown {
            found.maps.push(maps::bias(label, truth, &split.maps.bias));
        }
    }
    if shown {
        found.maps.extend(maps::misses(level)?);
    }
    if !answer.is_empty() {
        answers::keep(&mut found.answers, ID, &answer);
    }
    Ok(())
}

/// w = 1/(max(r,0)² + ε), as relMSE has it.
fn weight(r: f64) -> f64 {
    1.0 / (r.max(0.0).powi(2) + EPSILON) // ε > 0
}

/// Nothing below two outputs, or where no pixel can be compared.
fn of_row(
    level: &LevelCell<'_>,
    label: &str,
    outputs: &[Image],
    weights: &[f64],
) -> Result<Option<(RowAnswer, BiasVariance)>, MeasureError> {
    let images: Vec<&[f32]> = outputs.iter().map(Image::data).collect();
    let noise = Noise::of(level.reference);
    let reference = BiasReference { mean: level.reference.mean().data(), noise: noise.told() };
    let pixels = level.reference.mean().pixels();
    let split = |weight, groups| match bias_variance(
        &Replicates { images: &images, pixels, valid: None, weight },
        &reference,
        groups,
    ) {
        Ok(split) => Ok(Some(split)),
        Err(BiasVarianceError::TooFewReplicates { .. }) => Ok(None),
        Err(BiasVarianceError::Shape(source)) => Err(MeasureError::from(source)),
    };
    let groups = Groups { of_pixel: &level.classes.of_pixel, count: level.classes.names.len() };
    let Some((plain, relative)) = split(None, None)?.zip(split(Some(weights), Some(groups))?) else {
        return Ok(None);
    };
    let total = |split: &BiasVariance, index: usize| split.totals.get(index)?.as_ref().map(Split::of);
    let Some((all, all_relative)) = total(&plain, 0).zip(total(&relative, 0)) else { return Ok(None) };
    let classes = level.classes.names.iter().enumerate();
    let of_class = |(k, name): (usize, &String)| {
        let split = total(&relative, 1 + k)?;
        Some((name.clone(), Split { bias: None, ..split }))
    };
    let row = RowAnswer {
        label: label.to_owned(),
        replicates: images.len() as u32,
        left_out: plain.left_out,
        plain: all,
        relative: all_relative,
        classes: classes.filter_map(of_class).collect(),
    };
    Ok(Some((row, plain)))
}

/// The reference's noise, with the slices that it is told by.
struct Noise<'a> {
    reference: &'a Reference,
    parts: [Vec<&'a [f32]>; 2],
}

impl<'a> Noise<'a> {
    fn of(reference: &'a Reference) -> Self {
        // Halves are the means of the first and of the last parts.
        let (first, last) = reference.parts.split_at(reference.parts.len().div_ceil(2));
        let slices = |parts: &'a [Image]| parts.iter().map(Image::data).collect();
        Self { reference, parts: [slices(first), slices(last)] }
    }

    fn told(&self) -> ReferenceNoise<'_> {
        let color = &self.reference.frame.color;
        let variance = color.variance.as_ref().map(Variance::mean_variance);
        match (self.reference.squared_error(), &color.halves, variance) {
            (SquaredError::Exact, ..) => ReferenceNoise::Exact,
            (SquaredError::Halves, Some([a, b]), _) => {
                let [first, last] = &self.parts;
                ReferenceNoise::Halves { halves: [a.data(), b.data()], parts: [first, last] }
            }
            (SquaredError::SubtractVariance, _, Some(variance)) => ReferenceNoise::Variance(variance.data()),
            _ => ReferenceNoise::Unknown,
        }
    }
}

#[cfg(test)]
mod tests;
