use super::*;

fn area(id: &str, width: usize, height: usize) -> f64 {
    closed_form(id, 2, Rays::Area, (width, height)).expect("a formula")
}

#[test]
fn the_furnace_is_the_sum_that_its_depth_allows() {
    for (depth, mean) in [(1, 1.0), (2, 1.5), (3, 1.75), (1000, 2.0), (u32::MAX, 2.0)] {
        assert_eq!(closed_form("furnace", depth, Rays::Area, (4, 3)), Some(mean));
    }
}

#[test]
fn the_centres_of_many_pixels_are_the_area() {
    for id in ["direct", "gradient"] {
        let mut last = f64::INFINITY;
        for fine in [10, 40, 160] {
            let centres = closed_form(id, 2, Rays::Centres, (4 * fine, 3 * fine)).expect("a formula");
            let off = (centres / area(id, 4, 3) - 1.0).abs();
            // The plane of `direct` ends inside of the image: there the error falls as the size of a pixel, or faster.
            assert!(off < 0.02 / fine as f64 && off < last, "{id}, {fine}: {off}");
            last = off;
        }
    }
}

#[test]
fn a_finer_rule_gives_the_same() {
    for (id, scene, radiance) in
        [("direct", direct(), under_panel as fn(f64, f64) -> f64), ("gradient", gradient(), under_ball)]
    {
        let seen = Seen::new(&scene, 4.0 / 3.0, radiance);
        // Unequal halves of rows and of columns, each by the whole rule.
        let of_row = |v: f64| {
            let Some((from, to)) = seen.lit(v) else { return 0.0 };
            let middle = from + 0.4 * (to - from);
            integral(from, middle, |u| seen.at(u, v)) + integral(middle, to, |u| seen.at(u, v))
        };
        let halves = |ends: &[f64]| {
            let middle = ends[0] + 0.3 * (ends[1] - ends[0]);
            integral(ends[0], middle, of_row) + integral(middle, ends[1], of_row)
        };
        let fine = seen.corners().windows(2).map(halves).sum::<f64>() / (4.0 * seen.aspect);
        assert!((fine / area(id, 4, 3) - 1.0).abs() < 1e-7, "{id}: {fine}");
    }
}

#[test]
fn a_mean_over_pixels_of_plain_rays_is_the_same() {
    // Ray by ray, as a renderer without anything clever has it. The camera of `direct` is rolled.
    let (width, height) = (400, 300);
    for (id, scene, radiance) in
        [("direct", direct(), under_panel as fn(f64, f64) -> f64), ("gradient", gradient(), under_ball)]
    {
        let camera = &scene.camera;
        let forward = (camera.target - camera.eye).as_dvec3().normalize();
        let right = forward.cross(camera.up.as_dvec3()).normalize();
        let up = right.cross(forward);
        let half = (0.5 * f64::from(camera.vertical_fov_degrees)).to_radians().tan();
        let mut sum = 0.0;
        for j in 0..height {
            for i in 0..width {
                let x = (f64::from(i) + 0.5) / f64::from(width) * 2.0 - 1.0;
                let y = 1.0 - (f64::from(j) + 0.5) / f64::from(height) * 2.0;
                let ray = forward + right * (x * half * 4.0 / 3.0) + up * (y * half);
                let hit = camera.eye.as_dvec3() - ray * (f64::from(camera.eye.y) / ray.y);
                if ray.y < 0.0 && hit.x.abs() <= 5.0 && hit.z.abs() <= 5.0 {
                    sum += radiance(hit.x, hit.z);
                }
            }
        }
        let mean = sum / f64::from(width * height);
        let centres = closed_form(id, 2, Rays::Centres, (400, 300)).expect("a formula");
        assert!((mean / centres - 1.0).abs() < 1e-9, "{id}: {mean}, {centres}");
        assert!((mean / area(id, 4, 3) - 1.0).abs() < 1e-3, "{id}: {mean}");
    }
}

#[test]
fn images_without_a_formula_have_none() {
    assert_eq!(closed_form("cornell", 5, Rays::Area, (4, 3)), None);
    for id in ["direct", "gradient"] {
        assert_eq!(closed_form(id, 1, Rays::Area, (4, 3)), None, "nothing in view is a lamp");
        assert_eq!(closed_form(id, 2, Rays::Area, (4, 0)), None);
        assert!(closed_form(id, 20, Rays::Area, (3, 2)).is_some());
    }
    assert_eq!(closed_form("gradient", 2, Rays::Area, (2, 1)), None, "its lamp is in the image");
    assert!(closed_form("direct", 2, Rays::Centres, (2, 1)).is_some());
}
