//! Smooth dielectric: reflection or refraction, chosen by Fresnel reflectance.

use glam::Vec3A;

use crate::math::reflect;

/// Unpolarised Fresnel reflectance for cosine `cos` on a side of relative index `eta` (other side over this side), and
/// the cosine of the refracted direction; `None` for total reflection.
#[inline(always)]
pub fn fresnel(cos: f32, eta: f32) -> Option<(f32, f32)> {
    let squared_sine = (1.0 - cos * cos).max(0.0) / (eta * eta);
    if squared_sine >= 1.0 {
        return None;
    }
    let refracted = (1.0 - squared_sine).sqrt();
    // Both denominators are positive: cos ≥ 0, refracted > 0, eta > 0.
    let parallel = (eta * cos - refracted) / (eta * cos + refracted);
    let perpendicular = (cos - eta * refracted) / (cos + eta * refracted);
    Some((0.5 * (parallel * parallel + perpendicular * perpendicular), refracted))
}

/// Chooses with `u`; `front`: whether the viewer is outside. Unit direction, factor on radiance (1 for reflection, the
/// square of this side's index over the other's for refraction), and whether it was reflected.
#[inline(always)]
pub fn sample(ior: f32, normal: Vec3A, front: bool, out: Vec3A, u: f32) -> (Vec3A, f32, bool) {
    let eta = if front { ior } else { 1.0 / ior };
    let cos = out.dot(normal).min(1.0);
    match fresnel(cos, eta) {
        Some((reflectance, refracted)) if u >= reflectance => {
            let inverse = 1.0 / eta;
            let direction = (normal * (cos * inverse - refracted) - out * inverse).normalize();
            (direction, inverse * inverse, false)
        }
        _ => (reflect(out, normal), 1.0, true),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_incidence_reflects_the_textbook_fraction() {
        for ior in [1.1f32, 1.33, 1.5, 2.4] {
            let expected = ((ior - 1.0) / (ior + 1.0)).powi(2);
            for eta in [ior, 1.0 / ior] {
                assert!((fresnel(1.0, eta).unwrap().0 - expected).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn grazing_light_is_reflected_and_the_critical_angle_is_total() {
        assert!((fresnel(0.0, 1.5).unwrap().0 - 1.0).abs() < 1e-6);
        let critical = (1.0f32 - 1.0 / 2.25).sqrt();
        assert!(fresnel(critical - 1e-3, 1.0 / 1.5).is_none());
        assert!(fresnel(critical + 1e-3, 1.0 / 1.5).is_some());
    }

    #[test]
    fn refraction_obeys_snell_and_can_be_reversed() {
        let out = Vec3A::new(0.6, 0.0, 0.8);
        let (into, scale, _) = sample(1.5, Vec3A::Z, true, out, 1.0);
        assert!((into.x * 1.5 + 0.6).abs() < 1e-6);
        let (back, inverse, reflected) = sample(1.5, Vec3A::Z, false, -into, 1.0);
        assert!((back + out).length() < 1e-6 && !reflected);
        assert!((scale * inverse - 1.0).abs() < 1e-6);
    }
}
