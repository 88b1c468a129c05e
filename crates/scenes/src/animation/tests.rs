use super::*;
use crate::Scene;

fn rolling() -> Body {
    Body {
        meshes: vec![0],
        translation: Vec3::new(0.5, 0.0, 0.0),
        spin: Some(Spin { center: Vec3::new(1.0, 2.0, 0.0), axis: Vec3::Z, degrees: 90.0 }),
    }
}

#[test]
fn a_body_turns_about_its_moving_centre() {
    let body = rolling();
    let center = body.at(0.6).transform_point3(Vec3::new(1.0, 2.0, 0.0));
    assert!((center - Vec3::new(1.3, 2.0, 0.0)).length() < 1e-6);
    // One unit to the right of the centre; a quarter turn later above it.
    let rim = body.at(1.0).transform_point3(Vec3::new(2.0, 2.0, 0.0));
    assert!((rim - Vec3::new(1.5, 3.0, 0.0)).length() < 1e-6);
}

#[test]
fn a_later_frame_goes_on_where_the_earlier_one_ends() {
    let mut scene = (crate::find("two-quads").unwrap().build)();
    scene.add_body(0.5, rolling());
    let scene = scene.with_camera_move(CameraMove { orbit_degrees: 3.0, translation: Vec3::X });
    let two = scene.clone().at_frame(2);
    let stepped = scene.clone().at_frame(1).at_frame(1);
    assert!((two.camera.eye - stepped.camera.eye).length() < 1e-5);
    assert!((two.camera.eye - scene.camera.eye).length() > 1.0);
    for (a, b) in two.meshes[0].positions.iter().zip(&stepped.meshes[0].positions) {
        assert!((*a - *b).length() < 1e-5, "{a} {b}");
    }
    assert_ne!(two.meshes[0].positions, scene.meshes[0].positions);
    assert_eq!(two.meshes[1], scene.meshes[1]);
    assert_eq!(two.check(), Ok(()));
    assert_eq!(
        (crate::find("cornell").unwrap().build)().at_frame(7),
        (crate::find("cornell").unwrap().build)()
    );
}

#[test]
fn movements_without_meaning_are_named() {
    let base = (crate::find("cornell-diffuse").unwrap().build)();
    let lamp = base.meshes.iter().position(|m| base.materials[m.material].emission != Vec3::ZERO).unwrap();
    let body = |f: &dyn Fn(&mut Body)| {
        let mut body = Body { meshes: vec![0], ..rolling() };
        f(&mut body);
        Animation { shutter: 1.0, bodies: vec![body], ..Animation::default() }
    };
    let spin = |f: &dyn Fn(&mut Spin)| {
        let mut s = rolling().spin.unwrap();
        f(&mut s);
        body(&|b| b.spin = Some(s))
    };
    assert_eq!(body(&|_| {}).problem(&base), None);
    for (animation, word) in [
        (Animation { shutter: f32::NAN, ..Animation::default() }, "shutter"),
        (Animation { shutter: 1.5, ..Animation::default() }, "shutter"),
        (body(&|b| b.meshes = vec![99]), "mesh of body 0"),
        (body(&|b| b.meshes = vec![1, 1]), "mesh of body 0"),
        (body(&|b| b.meshes = vec![lamp]), "mesh of body 0"),
        (body(&|b| b.translation.y = f32::INFINITY), "way of body 0"),
        (spin(&|s| s.axis = Vec3::ZERO), "axis of body 0"),
        (spin(&|s| s.center.x = f32::NAN), "centre of body 0"),
        (spin(&|s| s.degrees = 1e9), "rotation of body 0"),
    ] {
        let (what, _, _) = animation.problem(&base).expect(word);
        assert_eq!(what, word);
        let scene = Scene { animation: Some(animation), ..base.clone() };
        assert!(scene.check().unwrap_err().to_string().contains(word));
    }
}
