//! Frames beside the target.

use noisefloor_conformance::known::{frame, step};
use noisefloor_conformance::outputs::{run, squared_error};
use noisefloor_denoiser::{Denoiser, Input};
use noisefloor_frame::Image;
use noisefloor_rdfc::{Params, Rdfc};

#[test]
fn neighbouring_frames_of_a_still_scene_take_noise_away() {
    let truth = step(40, 30);
    let method = |neighbors| Rdfc::new(Params { neighbors, ..Params::default() }).unwrap();
    assert_eq!(method(2).card().neighbors, 2);
    let mut errors = [0.0; 2];
    for draw in 0..4 {
        let frames: Vec<_> = (0..3).map(|k| frame(&truth, 0.1, 50 + 10 * draw + k)).collect();
        let input = Input::new(&frames[1]).with_neighbors(&frames[..1], &frames[2..]);
        for (error, neighbors) in errors.iter_mut().zip([0, 1]) {
            *error += squared_error(&method(neighbors).denoise(&input).unwrap().image, &truth);
        }
    }
    // Three times the samples could at best leave a third.
    assert!(errors[1] < 0.8 * errors[0], "{errors:?}");
}

#[test]
fn only_as_many_frames_count_as_are_asked_for_and_the_nearest_of_each_side() {
    let truth = step(30, 22);
    let frames: Vec<_> = (0..5).map(|k| frame(&truth, 0.1, 90 + k)).collect();
    let image = |neighbors: usize, before: &[_], after: &[_]| -> Image {
        let input = Input::new(&frames[2]).with_neighbors(before, after);
        Rdfc::new(Params { neighbors, ..Params::default() }).unwrap().denoise(&input).unwrap().image
    };
    assert_eq!(image(0, &frames[..2], &frames[3..]), run(&Rdfc::default(), &frames[2]).image);
    assert_eq!(image(1, &frames[..2], &frames[3..]), image(1, &frames[1..2], &frames[3..4]));
    assert_eq!(image(2, &frames[1..2], &[]), image(1, &frames[1..2], &[]));
    // Not even their exposure.
    let mut blinding = frames[1].clone();
    blinding.color.mean.set(0, 3, 3, 1e13);
    assert_eq!(image(0, &[blinding], &[]), image(0, &[], &[]));
    assert_ne!(image(1, &frames[1..2], &[]), image(0, &[], &[]));
    assert_ne!(image(2, &frames[..2], &frames[3..]), image(1, &frames[..2], &frames[3..]));
}
