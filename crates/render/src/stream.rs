//! The random numbers of the samples of a pixel.

use crate::sampler::{Independent, OwenSobol, Sampler, Sequence, SobolTables};

/// Sequences of a reference are numbered from here on, those of a frame from 0: equal seeds do not make a frame a part
/// of its own reference.
const REFERENCE_SEQUENCES: u32 = 1 << 16;

/// The samples of a pixel, or of one part of a reference there.
pub trait Stream<'a> {
    /// What gives the random numbers of one sample.
    type Sampler<'s>: Sampler
    where
        Self: 's;

    /// Of the pixel with this key; `part`: of a reference.
    fn new(tables: &'a SobolTables, key: u64, part: Option<u32>) -> Self;

    /// Sample `index`.
    fn sample(&self, index: u32) -> Self::Sampler<'_>;
}

/// Independent samples. References have none.
#[derive(Debug, Clone, Copy)]
pub struct IndependentSamples(u64);

impl<'a> Stream<'a> for IndependentSamples {
    type Sampler<'s> = Independent;

    #[inline(always)]
    fn new(_: &'a SobolTables, key: u64, _: Option<u32>) -> Self {
        Self(key)
    }

    #[inline(always)]
    fn sample(&self, index: u32) -> Independent {
        Independent::new(self.0, index)
    }
}

/// Low-discrepancy samples: the even and the odd ones of a frame are points of two sequences, a part is one sequence.
#[derive(Debug)]
pub struct Sequences<'a> {
    tables: &'a SobolTables,
    even: Sequence,
    odd: Option<Sequence>,
}

impl<'a> Stream<'a> for Sequences<'a> {
    type Sampler<'s>
        = OwenSobol<'s>
    where
        Self: 's;

    fn new(tables: &'a SobolTables, key: u64, part: Option<u32>) -> Self {
        match part {
            Some(part) => Self { tables, even: Sequence::new(key, REFERENCE_SEQUENCES + part), odd: None },
            None => Self { tables, even: Sequence::new(key, 0), odd: Some(Sequence::new(key, 1)) },
        }
    }

    #[inline(always)]
    fn sample(&self, index: u32) -> OwenSobol<'_> {
        match &self.odd {
            None => OwenSobol::new(self.tables, &self.even, index),
            Some(odd) => {
                let sequence = if index & 1 == 0 { &self.even } else { odd };
                OwenSobol::new(self.tables, sequence, index >> 1)
            }
        }
    }
}
