//! The exponential of the weights.

use noisefloor_kernels::InstructionSet;
use noisefloor_kernels::inside::exp2;

#[test]
fn exp2_is_accurate_to_2e_7_and_alike_for_every_instruction_set() {
    for i in 0..=252_000u32 {
        let x = -(i as f32) / 2000.0;
        let y = exp2(InstructionSet::Portable, x).unwrap();
        let truth = f64::from(x).exp2();
        assert!((f64::from(y) / truth - 1.0).abs() < 2e-7, "2^{x} = {y}, not {truth}");
        for level in InstructionSet::ALL {
            let other = exp2(level, x);
            assert_eq!(other.is_some(), level.is_available());
            assert!(other.is_none_or(|v| v.to_bits() == y.to_bits()), "{level}: 2^{x}");
        }
    }
    assert_eq!(exp2(InstructionSet::Portable, 0.0), Some(1.0));
}
