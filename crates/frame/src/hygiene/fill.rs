//! Values for pixels that have none, from the pixels around them.

/// The pixels without a value in the order in which they can be filled: first those that touch a pixel with a value, then
/// those that touch these, and so on. Each pixel is visited once, whatever the size of the hole.
#[derive(Debug, Clone)]
pub(crate) struct Rings {
    width: usize,
    height: usize,
    /// Pixels to fill, nearest first.
    order: Vec<usize>,
    /// Distance to the nearest pixel with a value, in steps to any of the eight neighbours; 0 for pixels with a value.
    distance: Vec<u32>,
}

/// Of a pixel that was not reached yet.
const FAR: u32 = u32::MAX;

impl Rings {
    /// `None` if no pixel has a value. `without` has an entry for each pixel of an image of this width.
    pub(crate) fn new(width: usize, without: &[bool]) -> Option<Self> {
        let mut order: Vec<usize> = Vec::new();
        if !without.contains(&false) {
            return None;
        }
        let distance = without.iter().map(|&none| if none { FAR } else { 0 }).collect();
        let mut rings = Self { width, height: without.len() / width, order: Vec::new(), distance };
        for pixel in (0..without.len()).filter(|&p| without[p]) {
            if rings.neighbours(pixel).any(|q| !without[q]) {
                order.push(pixel);
            }
        }
        order.iter().for_each(|&pixel| rings.distance[pixel] = 1);
        let mut next = 0;
        while let Some(&pixel) = order.get(next) {
            next += 1;
            let step = rings.distance[pixel] + 1;
            let fresh: Vec<usize> = rings.neighbours(pixel).filter(|&q| rings.distance[q] == FAR).collect();
            for q in fresh {
                rings.distance[q] = step;
                order.push(q);
            }
        }
        rings.order = order;
        Some(rings)
    }

    /// Row-major distances to the nearest pixel with a value.
    pub(crate) fn distance(&self) -> &[u32] {
        &self.distance
    }

    /// Gives each pixel without a value the mean over those of its eight neighbours that are nearer to a value than
    /// itself: for a pixel that touches pixels with values that is their mean.
    pub(crate) fn fill(&self, plane: &mut [f32]) {
        for &pixel in &self.order {
            let (mut sum, mut count) = (0.0, 0u32);
            for q in self.neighbours(pixel).filter(|&q| self.distance[q] < self.distance[pixel]) {
                sum += f64::from(plane[q]);
                count += 1;
            }
            plane[pixel] = (sum / f64::from(count)) as f32; // a pixel in the order has a nearer neighbour
        }
    }

    /// The up to eight neighbours, row by row.
    fn neighbours(&self, pixel: usize) -> impl Iterator<Item = usize> + use<> {
        let (width, height) = (self.width, self.height);
        let (x, y) = (pixel % width, pixel / width);
        (y.saturating_sub(1)..(y + 2).min(height))
            .flat_map(move |row| {
                (x.saturating_sub(1)..(x + 2).min(width)).map(move |column| row * width + column)
            })
            .filter(move |&q| q != pixel)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lone_pixel_takes_the_mean_of_its_ring() {
        let without: Vec<bool> = (0..9).map(|p| p == 4).collect();
        let mut plane: Vec<f32> = (0..9).map(|v| v as f32).collect();
        plane[4] = f32::NAN;
        plane[8] = 100.0;
        Rings::new(3, &without).unwrap().fill(&mut plane);
        assert_eq!(plane[4], (0.0 + 1.0 + 2.0 + 3.0 + 5.0 + 6.0 + 7.0 + 100.0) / 8.0);
    }

    #[test]
    fn every_pixel_is_visited_once_however_large_the_hole() {
        for side in [64, 1024] {
            let without: Vec<bool> = (0..side * side).map(|p| p % side < side / 2).collect();
            let rings = Rings::new(side, &without).unwrap();
            assert_eq!(rings.order.len(), side * side / 2, "each pixel of the hole once");
            assert_eq!(rings.distance[0], side as u32 / 2);
            let mut plane: Vec<f32> = without.iter().map(|&none| if none { f32::NAN } else { 3.0 }).collect();
            rings.fill(&mut plane);
            assert!(plane.iter().all(|&v| v == 3.0), "a constant image stays constant");
        }
    }

    #[test]
    fn without_a_value_there_is_nothing_to_fill_from() {
        assert!(Rings::new(2, &[true; 4]).is_none());
        assert!(Rings::new(2, &[false; 4]).unwrap().order.is_empty());
    }
}
