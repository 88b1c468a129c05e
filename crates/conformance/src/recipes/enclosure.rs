//! Frames that drive an average far from its centre. Enclosures are checked on the frames of all recipes; here are the worst.

use std::sync::OnceLock;

use noisefloor_frame::{Flash, Frame, Image, Samples};

use crate::case::Case;
use crate::change::set_variance;
use crate::trial::Trial;
use crate::{Outcome, Violation};

pub(super) fn run(trial: &mut Trial<'_>) -> Result<Outcome, Violation> {
    static CASES: OnceLock<Vec<Case>> = OnceLock::new();
    if trial.card.claims.enclosure.is_empty() {
        return Ok(Outcome::Idle("it claims none"));
    }
    trial.survive(CASES.get_or_init(|| {
        let wild = |name: &'static str, edit: fn(&mut Frame)| {
            Case::edited(name, |f| {
                guides_of_something_else(f);
                edit(f);
            })
        };
        vec![
            wild("guides that show something else", |_| {}),
            wild("variances of many scales", |f| {
                let mut k = 0i32;
                set_variance(&mut f.color, |v| {
                    k += 1;
                    if k % 5 == 0 { 0.0 } else { v * 10f32.powi(k % 13 - 6) }
                });
            }),
            wild("two samples here and a thousand there", |f| {
                let counts = (0..f.pixels()).map(|p| if p % 3 == 0 { 2 } else { 1000 }).collect();
                f.samples = Samples::per_pixel(counts);
            }),
            wild("a checkerboard of dark and bright", |f| {
                let dark = f.color.mean.clone();
                let (w, h) = (f.width(), f.height());
                f.color.mean = Image::from_fn(w, h, 3, |c, x, y| {
                    dark.get(c, x, y) * if (x + y) % 2 == 0 { 1e3 } else { 1.0 }
                });
            }),
        ]
    }))
}

/// Features and flash from the other end of the image.
fn guides_of_something_else(frame: &mut Frame) {
    let reverse = |image: &mut Image| image.planes_mut().for_each(<[f32]>::reverse);
    frame.features.values_mut().for_each(|feature| reverse(&mut feature.mean));
    if let Some(Flash::Parts { base, light, .. }) = &mut frame.flash {
        reverse(&mut base.mean);
        reverse(&mut light.mean);
    }
}
