//! What a reader sees of a made-up study.

mod answers;
mod charts;
mod fixture;
mod honest;
mod look;
mod methodology;
mod page;
mod readme;
mod tables;
