//! The method and its candidates in every profile.

use noisefloor_rdfc::{Choice, Params, Profile, Rdfc};

pub fn of(profile: Profile) -> Params {
    Params { profile, ..Params::default() }
}

/// What the sources say, and the default.
pub fn profiles() -> [Params; 3] {
    [Profile::Paper, Profile::Authors, Profile::Best].map(of)
}

/// The whole method and its candidates.
pub fn methods(params: &Params) -> Vec<Rdfc> {
    let candidates = Choice::ALL.map(|choice| Rdfc::candidate(choice, params.clone()).unwrap());
    std::iter::once(Rdfc::new(params.clone()).unwrap()).chain(candidates).collect()
}
