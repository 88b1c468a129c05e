use noisefloor_denoiser::{choices, parameters};

choices! {
    /// What is halved from level to level for the colour.
    pub enum Halving {
        /// The divisor, as in the shader printed in the paper.
        Divisor = "divisor",
        /// Its square root, as σ in the formula: the divisor falls by 4.
        Sigma = "sigma",
    }
}

parameters! {
    /// Parameters of `dshl10`. The paper tunes per scene; the defaults are ours.
    pub struct Params {
        /// Passes.
        levels: usize = 5, integer(1..=8).symbol("N");
        /// What squared differences of the colour are divided by at the first level, at a mean luminance of 0.5.
        sigma_color: f64 = 0.1, above(0.0).symbol("σ_rt");
        /// How it falls from level to level.
        halve: Halving = Halving::Divisor, choice::<Halving>();
        /// The first level that looks at the colour: 1 lets isolated bright pixels be averaged away, which is not in the
        /// paper.
        color_from_level: usize = 0, integer(0..=8);
        /// What squared differences of normals, over the squared gap of the taps, are divided by.
        sigma_normal: f64 = 0.1, above(0.0).symbol("σ_n");
        /// What squared differences of depth, in units of its 99th percentile, are divided by.
        sigma_depth: f64 = 1e-3, above(0.0).symbol("σ_x");
        /// Whether the albedo is divided out before and multiplied in after.
        demodulate: bool = false, flag();
    }
}
