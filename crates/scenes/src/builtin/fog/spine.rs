//! A curve with a thickness and a back: what a body is built around.

use glam::Vec3;

/// A point that the curve passes through.
#[derive(Clone, Copy)]
pub struct Joint {
    pub at: Vec3,
    pub radius: f32,
    /// Where the back looks, roughly; not along the curve.
    pub back: Vec3,
}

/// A place on the curve with an orthonormal frame.
#[derive(Clone, Copy)]
pub struct Station {
    pub at: Vec3,
    pub radius: f32,
    /// Unit direction from tail to head.
    pub forward: Vec3,
    pub back: Vec3,
    /// `back` × `forward`.
    pub side: Vec3,
    /// Length of the curve up to here.
    pub length: f32,
}

impl Station {
    /// Unit direction across the curve, `angle` in radians from the back towards `side`.
    pub fn outward(&self, angle: f32) -> Vec3 {
        self.back * angle.cos() + self.side * angle.sin()
    }
}

/// Catmull-Rom curve through `joints` (at least two), `steps` places from each to the next.
pub fn stations(joints: &[Joint], steps: u32) -> Vec<Station> {
    let last = joints.len() - 1;
    let mut all: Vec<Station> = vec![];
    for k in 0..last {
        let around = [k.saturating_sub(1), k, k + 1, (k + 2).min(last)].map(|i| joints[i]);
        for i in 0..steps + u32::from(k + 1 == last) {
            let t = i as f32 / steps as f32;
            let w = weights(t);
            let mix = |f: &dyn Fn(&Joint) -> Vec3| around.iter().zip(w).map(|(j, w)| f(j) * w).sum::<Vec3>();
            let slope = slopes(t);
            let forward = around.iter().zip(slope).map(|(j, w)| j.at * w).sum::<Vec3>().normalize();
            let back = mix(&|j| j.back).reject_from_normalized(forward).normalize();
            let at = mix(&|j| j.at);
            let length = all.last().map_or(0.0, |s| s.length + s.at.distance(at));
            // Thickness is blended linearly: a cubic could overshoot to nothing at the tip of the tail.
            let radius = around[1].radius + t * (around[2].radius - around[1].radius);
            all.push(Station { at, radius, forward, back, side: back.cross(forward), length });
        }
    }
    all
}

fn weights(t: f32) -> [f32; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [
        0.5 * (2.0 * t2 - t - t3),
        0.5 * (2.0 - 5.0 * t2 + 3.0 * t3),
        0.5 * (t + 4.0 * t2 - 3.0 * t3),
        0.5 * (t3 - t2),
    ]
}

fn slopes(t: f32) -> [f32; 4] {
    let t2 = t * t;
    [
        0.5 * (4.0 * t - 1.0 - 3.0 * t2),
        0.5 * (9.0 * t2 - 10.0 * t),
        0.5 * (1.0 + 8.0 * t - 9.0 * t2),
        0.5 * (3.0 * t2 - 2.0 * t),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curve_passes_its_joints_and_has_right_angles() {
        let joint =
            |x: f32, y: f32, z: f32| Joint { at: Vec3::new(x, y, z), radius: 0.1 + 0.1 * x, back: Vec3::Y };
        let joints = [joint(0.0, 0.0, 0.0), joint(1.0, 0.2, 0.1), joint(1.5, 0.5, 1.0), joint(1.0, 0.6, 2.0)];
        let all = stations(&joints, 10);
        assert_eq!(all.len(), 31);
        for (k, joint) in joints.iter().enumerate() {
            assert!(all[10 * k].at.distance(joint.at) < 1e-5, "joint {k}");
            assert!((all[10 * k].radius - joint.radius).abs() < 1e-6);
        }
        for s in &all {
            assert!(s.forward.dot(s.back).abs() < 1e-5 && (s.side.length() - 1.0).abs() < 1e-5);
        }
        // The derivative agrees with the difference of neighbours, to the square of the step.
        for w in all.windows(3) {
            assert!((w[2].at - w[0].at).normalize().dot(w[1].forward) > 0.99);
        }
    }
}
