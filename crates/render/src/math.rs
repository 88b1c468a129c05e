//! Small vector and sampling helpers of the hot path.

use std::f32::consts::FRAC_PI_4;

use glam::Vec3A;

/// Two unit vectors that make a right-handed orthonormal basis with the unit vector `n` (Duff et al. 2017).
#[inline]
pub fn tangents(n: Vec3A) -> (Vec3A, Vec3A) {
    let sign = 1.0f32.copysign(n.z);
    let a = -1.0 / (sign + n.z); // |sign + n.z| ≥ 1
    let b = n.x * n.y * a;
    (Vec3A::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x), Vec3A::new(b, sign + n.y * n.y * a, -n.y))
}

/// Sine and cosine for |x| ≤ π/4 by their series; error below 4e-8. The same bits on every machine.
#[inline]
fn sin_cos_octant(x: f32) -> (f32, f32) {
    let y = x * x;
    let sin = x * (1.0 + y * (-1.0 / 6.0 + y * (1.0 / 120.0 - y * (1.0 / 5040.0))));
    let cos = 1.0 + y * (-0.5 + y * (1.0 / 24.0 + y * (-1.0 / 720.0 + y * (1.0 / 40320.0))));
    (sin, cos)
}

/// Maps the unit square to the unit disc, keeping areas and neighbourhoods (Shirley and Chiu 1997).
#[inline]
pub fn concentric_disc(u: f32, v: f32) -> (f32, f32) {
    let (a, b) = (2.0 * u - 1.0, 2.0 * v - 1.0);
    let wide = a.abs() > b.abs();
    let (radius, other) = if wide { (a, b) } else { (b, a) };
    if radius == 0.0 {
        return (0.0, 0.0);
    }
    let (sin, cos) = sin_cos_octant(FRAC_PI_4 * (other / radius));
    if wide { (radius * cos, radius * sin) } else { (radius * sin, radius * cos) }
}

/// Sine and cosine of 2πu for u in [0, 1).
#[inline]
pub fn turn(u: f32) -> (f32, f32) {
    let quarter = (4.0 * u + 0.5) as i32 as f32; // rounds, since u is not negative
    let (s, c) = sin_cos_octant(std::f32::consts::FRAC_PI_2 * (4.0 * u - quarter));
    match quarter as i32 & 3 {
        0 => (s, c),
        1 => (c, -s),
        2 => (-s, -c),
        _ => (-c, s),
    }
}

/// Unit vector around `n` with density cos/π; also returns the cosine.
#[inline]
pub fn cosine_hemisphere(n: Vec3A, u: f32, v: f32) -> (Vec3A, f32) {
    let (x, y) = concentric_disc(u, v);
    let z = (1.0 - x * x - y * y).max(0.0).sqrt();
    let (t, b) = tangents(n);
    (t * x + b * y + n * z, z)
}

/// Rec. 709 luminance.
#[inline]
pub fn luminance(c: Vec3A) -> f32 {
    noisefloor_frame::luminance([c.x, c.y, c.z])
}

/// Power heuristic with exponent 2 (Veach 1997) for a sample of density `own` > 0 against one of density `other` ≥ 0.
#[inline]
pub fn power_heuristic(own: f32, other: f32) -> f32 {
    let ratio = other / own;
    1.0 / (1.0 + ratio * ratio)
}

/// Mirror image of `w` about `n`, both pointing away from the surface.
#[inline]
pub fn reflect(w: Vec3A, n: Vec3A) -> Vec3A {
    n * (2.0 * w.dot(n)) - w
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tangents_are_orthonormal() {
        for i in 0..200 {
            let (s, c) = turn(i as f32 / 200.0);
            for z in [-1.0f32, -0.99, -0.3, 0.0, 0.7, 1.0] {
                let r = (1.0 - z * z).sqrt();
                let n = Vec3A::new(r * c, r * s, z).normalize();
                let (t, b) = tangents(n);
                assert!(t.dot(b).abs() < 1e-6 && t.dot(n).abs() < 1e-6 && b.dot(n).abs() < 1e-6);
                assert!((t.length() - 1.0).abs() < 1e-6 && (b.length() - 1.0).abs() < 1e-6);
                assert!((t.cross(b) - n).length() < 1e-6);
            }
        }
    }

    #[test]
    fn turn_agrees_with_the_library_sine() {
        for i in 0..1000 {
            let u = i as f32 / 1000.0;
            let angle = f64::from(u) * std::f64::consts::TAU;
            let (s, c) = turn(u);
            assert!((f64::from(s) - angle.sin()).abs() < 1e-6, "{u}");
            assert!((f64::from(c) - angle.cos()).abs() < 1e-6, "{u}");
        }
    }

    #[test]
    fn the_disc_keeps_areas() {
        // A quarter of the square's area goes to the disc of half the radius.
        let n = 400;
        let inside = (0..n * n)
            .filter(|i| {
                let (x, y) =
                    concentric_disc(((i % n) as f32 + 0.5) / n as f32, ((i / n) as f32 + 0.5) / n as f32);
                x * x + y * y < 0.25
            })
            .count();
        assert_eq!(inside, n * n / 4);
    }
}
