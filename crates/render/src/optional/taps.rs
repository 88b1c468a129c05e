//! Samples of tapped pixels.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use noisefloor_frame::{Tapped, TappedSample};

/// Samples of tapped pixels, from all threads.
#[derive(Debug, Default)]
pub struct Taps(Mutex<BTreeMap<usize, Vec<TappedSample>>>);

impl Taps {
    /// Keeps those of a pixel.
    pub fn put(&self, pixel: usize, samples: &[TappedSample]) {
        // A poisoned lock only means that another thread panicked; the samples are plain numbers.
        self.0.lock().unwrap_or_else(PoisonError::into_inner).insert(pixel, samples.to_vec());
    }

    /// The tapped pixels, row by row, of an image of this width; `first`: index of their first sample.
    pub fn into_tapped(self, width: usize, first: u32) -> Vec<Tapped> {
        let taps = self.0.into_inner().unwrap_or_else(PoisonError::into_inner);
        let tapped = taps.into_iter();
        tapped.map(|(at, samples)| Tapped { x: at % width, y: at / width, first, samples }).collect()
    }
}
