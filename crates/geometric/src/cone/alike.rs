//! Which neighbours a pixel takes, and with what weight.

/// Up to where neighbours are alike.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Thresholds {
    /// Largest depth difference as a fraction of the larger depth.
    pub depth: f32,
    /// Smallest cosine between normals.
    pub normal: f32,
    /// Largest difference of albedo in a channel, as a fraction of the largest value of both pixels.
    pub albedo: f32,
}

/// What a pixel compares its neighbours with.
#[derive(Clone, Copy, Default)]
pub(super) struct Own {
    pub id: f32,
    pub depth: f32,
    pub normal: [f32; 3],
    pub albedo: [f32; 3],
    /// 1/R.
    pub inverse: f32,
}

impl Own {
    /// Weight of a neighbour of this id, depth and normal at this distance.
    #[inline(always)]
    #[expect(clippy::neg_cmp_op_on_partial_ord, reason = "a normal that is NaN has to pass")]
    pub fn weight(&self, most: &Thresholds, id: f32, depth: f32, normal: [f32; 3], distance: f32) -> f32 {
        let cosine = self.normal[0] * normal[0] + self.normal[1] * normal[1] + self.normal[2] * normal[2];
        // Listing, line 11: 1 − distance/R in place of (1 − distance)/R.
        let cone = 1.0 - distance * self.inverse;
        // Listing, lines 5-6, lines 7-8 and lines 9-10, the last with its comparison turned round.
        // No id equals that outside the image. A depth that is NaN makes its comparison false and keeps the neighbour out; a
        // normal that is NaN is none, and keeps nobody out.
        let alike = (id == self.id)
            & ((depth - self.depth).abs() <= most.depth * larger(self.depth, depth))
            & !(cosine < most.normal)
            & (cone > 0.0);
        if alike { cone } else { 0.0 }
    }

    /// Whether a neighbour's albedo is like that of the pixel: ours, for Listing, lines 5-6.
    #[inline(always)]
    pub fn is_tinted_like(&self, most: &Thresholds, albedo: [f32; 3]) -> bool {
        let [r, g, b] = albedo;
        let [own_r, own_g, own_b] = self.albedo;
        let difference = larger(larger((r - own_r).abs(), (g - own_g).abs()), (b - own_b).abs());
        let brightest = larger(larger(larger(r, g), b), larger(larger(own_r, own_g), own_b));
        difference <= most.albedo * brightest
    }
}

/// The second if one is NaN: a comparison and a choice, which every instruction set has.
#[inline(always)]
fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}
