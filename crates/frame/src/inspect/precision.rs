//! How exactly values were kept, as far as the values themselves show it.

/// Significant bits of half floats, and the fewest that are believed: simple values of a synthetic image have fewer.
const HALF: u32 = 11;
/// Significant bits of floats.
const FULL: u32 = 24;
/// Largest half float.
const LARGEST_HALF: f32 = 65504.0;

/// The format that values look as if they had gone through: half floats, floats with a rounded mantissa, or plain floats.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Precision {
    bits: u32,
    in_half_range: bool,
}

impl Precision {
    /// Of all finite values.
    pub(crate) fn of(values: &[f32]) -> Self {
        let (mut mantissas, mut largest) = (0, 0.0f32);
        for value in values.iter().filter(|v| v.is_finite()) {
            mantissas |= value.to_bits() & 0x007F_FFFF;
            largest = largest.max(value.abs());
        }
        // Trailing zeros that all mantissas share carry nothing.
        let bits = FULL - mantissas.trailing_zeros().min(FULL - HALF);
        Self { bits, in_half_range: largest <= LARGEST_HALF }
    }

    /// The less exact of both.
    pub(crate) fn coarser(self, other: Self) -> Self {
        if other.bits < self.bits { other } else { self }
    }

    /// Whether all values are half floats. Values that are simple enough pass for such.
    pub(crate) fn is_half(self) -> bool {
        self.bits == HALF && self.in_half_range
    }

    /// Largest relative error of rounding to nearest.
    pub(crate) fn relative(self) -> f64 {
        0.5f64.powi(self.bits as i32)
    }

    /// Largest absolute error of rounding to nearest where values are too small for the full mantissa.
    pub(crate) fn absolute(self) -> f64 {
        if self.is_half() { 0.5f64.powi(25) } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_are_told_by_their_values() {
        let values: Vec<f32> = (1..500).map(|k| (k as f32).sqrt() * 0.37).collect();
        let rounded = |bits: u32| -> Vec<f32> {
            let step = 1 << (24 - bits);
            values.iter().map(|v| f32::from_bits((v.to_bits() + step / 2) & !(step - 1))).collect()
        };
        assert_eq!(Precision::of(&values).bits, 24);
        assert_eq!(Precision::of(&rounded(16)).bits, 16);
        let half = Precision::of(&rounded(11));
        assert!(half.is_half() && half.relative() == 2f64.powi(-11));
        assert!(!Precision::of(&rounded(11).iter().map(|v| v * 65536.0).collect::<Vec<_>>()).is_half());
        assert_eq!(Precision::of(&[0.0, f32::NAN]).bits, 11, "nothing is known: as coarse as a half float");
        assert_eq!(half.coarser(Precision::of(&values)), half);
    }
}
