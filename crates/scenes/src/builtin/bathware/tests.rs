use super::*;

/// Volume by the divergence theorem; positive if fronts look outwards.
fn volume(mesh: &Mesh) -> f32 {
    let at = |i: u32| mesh.positions[i as usize];
    mesh.triangles.iter().map(|&[a, b, c]| at(a).dot(at(b).cross(at(c))) / 6.0).sum()
}

#[test]
fn smooth_curve_runs_through_its_points_and_keeps_off_the_axis() {
    let points = [[0.0, 0.0], [0.5, 0.0], [0.5, 1.0], [0.02, 1.1], [0.0, 2.0]].map(Vec2::from);
    let curve = smooth(&points, 4);
    assert_eq!(curve.len(), 17);
    for (k, p) in points.iter().enumerate() {
        assert_eq!(curve[4 * k], *p);
    }
    assert!(curve.iter().all(|p| p.x >= 0.0));
    // On a straight line with equal steps the curve is the line.
    let line = [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [3.0, 3.0]].map(Vec2::from);
    assert!(smooth(&line, 4)[4..=8].iter().all(|p| (p.x - p.y).abs() < 1e-6));
}

#[test]
fn vessels_hold_less_than_the_box_around_them_and_face_outwards() {
    for (name, mesh, size) in [
        ("bathtub", bathtub(), Vec3::new(0.74, 0.6, 1.6)),
        ("basin", basin(), Vec3::new(0.44, 0.145, 0.44)),
        ("bottle", bottle(0.03, 0.2).0, Vec3::new(0.06, 0.168, 0.06)),
        ("hoop", hoop(0.1, 0.01), Vec3::new(0.21, 0.01, 0.21)),
    ] {
        let fold = |f: fn(Vec3, Vec3) -> Vec3| mesh.positions.iter().copied().reduce(f).unwrap();
        let extent = fold(Vec3::max) - fold(Vec3::min);
        assert!(
            // The curve swings out a little beyond the profile's points.
            extent.cmple(1.02 * size + 1e-6).all() && extent.cmpge(0.9 * size).all(),
            "{name} measures {extent}"
        );
        let inside = volume(&mesh);
        assert!(inside > 0.0 && inside < size.element_product(), "{name} holds {inside}");
    }
}

#[test]
fn towel_hangs_on_both_sides_of_its_bar() {
    let mesh = towel(0.5, 0.6, 0.4);
    let low = |front: bool| {
        let side = mesh.positions.iter().filter(|p| (p.z > 0.0) == front);
        side.fold(f32::INFINITY, |low, p| low.min(p.y))
    };
    assert!((low(true) + 0.6).abs() < 1e-5 && (low(false) + 0.4).abs() < 1e-5);
    let facing = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| mesh.positions[i as usize]);
        t.iter().all(|&i| mesh.normals[i as usize].dot((b - a).cross(c - a)) > 0.0)
    };
    assert!(mesh.triangles.iter().all(facing));
}
