//! `noisefloor convert`.

use std::collections::BTreeMap;

use noisefloor_io::{IoError, read_attributes, read_color, read_image, read_origin};

use crate::args::Convert;
use crate::exit::Exit;
use crate::output::Output;

pub fn run(args: &Convert) -> anyhow::Result<Exit> {
    let output = Output::new(&args.output, args.exposure)?;
    output.spare([args.input.as_path()])?;
    // A frame's colour; of a file without colour, such as a diagnostic, its bare channels.
    let image = match read_color(&args.input) {
        Err(IoError::MissingLayer { .. }) => read_image(&args.input)?,
        other => other?,
    };
    let attributes: BTreeMap<String, String> = read_attributes(&args.input)?;
    output.image(&image, &attributes, &read_origin(&args.input)?.window)?.tell("")?;
    Ok(Exit::Done)
}
