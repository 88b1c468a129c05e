use noisefloor_study::exhibit::{Exhibit, Part};

const LINES: [&str; 4] = [
    "An experiment is repeated with independent random seeds (replicates). Intervals are over replicates, because the pixels of a denoised \
     image depend on each other.",
    "Methods are compared on the same noisy inputs, as ratios paired over replicates. What the replicates cannot tell apart is marked as \
     such and no winner is named.",
    "The reference is an estimate too. Where the formula allows it, its noise is taken out of the error; what remains is the floor in the \
     plots.",
    "Coverage, bounds and errors are measured on these scenes, sizes and seeds. They do not carry over to others by themselves.",
];

/// How to read the page.
pub(super) fn about() -> Exhibit {
    Exhibit {
        id: "about".into(),
        name: "How to read".into(),
        title: "How to read this page".into(),
        parts: vec![Part::List(LINES.map(String::from).to_vec())],
    }
}
