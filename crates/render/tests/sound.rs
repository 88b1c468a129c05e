//! What the renderer records never contradicts itself, whatever the scene.

use noisefloor_frame::{Fidelity, Sampling};
use noisefloor_render::{Prepared, RenderRequest, Rounds, Silent, render};

#[test]
fn frames_of_every_built_in_scene_pass_the_checks_of_frames_from_outside() {
    for entry in noisefloor_scenes::builtin() {
        let scene = Prepared::new(&(entry.build)()).unwrap();
        for (spp, sampling) in
            [(2, Sampling::Independent), (9, Sampling::Independent), (16, Sampling::LowDiscrepancy)]
        {
            let request = RenderRequest { sampling, seed: 5, ..RenderRequest::new(&scene, 24, 18, spp) };
            let mut frame = render(&request, &Silent).unwrap();
            let before = frame.clone();
            let found = frame.inspect(Fidelity::Rounded).unwrap_or_else(|e| panic!("{}: {e}", entry.id));
            assert_eq!(found.findings, [], "{} at {spp}", entry.id);
            assert_eq!(frame, before);
        }
    }
}

#[test]
fn frames_of_several_rounds_pass_too() {
    let entry = noisefloor_scenes::find("cornell").unwrap();
    let scene = Prepared::new(&(entry.build)()).unwrap();
    let mut rounds = Rounds::start(&RenderRequest::new(&scene, 24, 18, 5), &Silent).unwrap();
    let extra: Vec<u32> = (0..24 * 18).map(|p| p % 12).collect();
    rounds.add(&extra, &Silent).unwrap();
    let found = rounds.frame().unwrap().inspect(Fidelity::Rounded).unwrap();
    assert_eq!(found.findings, []);
}
