//! The source work, and what is said about it.

use noisefloor_denoiser::{Citation, Entry, Published};

/// The source work of both variants.
pub const CITATION: Citation = Citation::with_entry(
    "finalstage2020",
    "Simple Geometric Image Denoising for Real-time Path Tracers, slides about the Final Stage renderer, 2020",
    Entry {
        authors: "",
        title: "Simple Geometric Image Denoising for Real-time Path Tracers",
        published: Published::Otherwise { how: "Slides about the renderer Final Stage" },
        year: 2020,
        pages: "",
        doi: "",
    },
);

/// What a reader of the method should know: idea, requirements, symbols, deviations, failures, reference; Markdown.
pub const README: &str = include_str!("../README.md");
