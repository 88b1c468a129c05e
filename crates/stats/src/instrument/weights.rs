use crate::instrument::Blocks;

/// Of a reference, √ε in units of its mean.
const DARK: f64 = 0.1;

/// w = (m² + ε)^-½ per block, with m the block's mean of a reference and √ε a tenth of the image's: smooth, so that the
/// reference's own noise does not weigh itself. `value` is the reference in a pixel; `None` where it does not count. Always
/// above 0; 1 for a black block of a black image.
#[must_use]
pub fn smooth_weights(blocks: &Blocks, value: impl Fn(usize) -> Option<f64>) -> Vec<f64> {
    let (mut sum, mut count) = (vec![0.0; blocks.count()], vec![0.0; blocks.count()]);
    for pixel in 0..blocks.pixels() {
        if let Some(value) = value(pixel) {
            let block = blocks.of(pixel);
            sum[block] += value;
            count[block] += 1.0;
        }
    }
    let all = sum.iter().sum::<f64>().abs() / count.iter().sum::<f64>().max(1.0);
    let floor = DARK * all;
    let weight = |(sum, count): (&f64, &f64)| {
        let brightness = (sum / count.max(1.0)).hypot(floor);
        if brightness > 0.0 { 1.0 / brightness } else { 1.0 }
    };
    sum.iter().zip(&count).map(weight).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_the_inverse_of_the_brightness_around() {
        let blocks = Blocks::with_edge(4, 2, 2);
        let bright = |p: usize| if p % 4 < 2 { Some(3.0) } else { None };
        let weights = smooth_weights(&blocks, bright);
        assert!((weights[0] - 1.0 / 3f64.hypot(0.3)).abs() < 1e-15 && (weights[1] - 1.0 / 0.3).abs() < 1e-12);
        assert_eq!(smooth_weights(&blocks, |_| Some(0.0)), [1.0; 2]);
    }
}
