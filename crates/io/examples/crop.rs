//! Cuts a rectangle out of an EXR file of any kind, keeping channel types and header attributes:
//!
//! ```text
//! cargo run -p noisefloor-io --example crop -- in.exr out.exr X Y WIDTH HEIGHT [--without LAYER]… [--pxr24]
//! ```
//!
//! X and Y count from the corner of the data window. `--without albedo.halfA` drops the channels of that layer, and
//! `--without albedo` those of all layers below it too. `--pxr24` compresses with PXR24 instead of ZIP, which
//! rounds 32-bit floats to 15 bits of mantissa.

use std::error::Error;
use std::process::ExitCode;

use exr::prelude::*;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &[String]) -> std::result::Result<(), Box<dyn Error>> {
    let [input, output, x, y, width, height, options @ ..] = arguments else {
        return Err("usage: crop in.exr out.exr X Y WIDTH HEIGHT [--without LAYER]… [--pxr24]".into());
    };
    let [x, y, width, height] = [x, y, width, height].map(|number| number.parse::<usize>());
    let (x, y, width, height) = (x?, y?, width?, height?);
    let (mut dropped, mut compression) = (Vec::new(), Compression::ZIP16);
    let mut options = options.iter();
    while let Some(option) = options.next() {
        match option.as_str() {
            "--pxr24" => compression = Compression::PXR24,
            "--without" => dropped.push(options.next().ok_or("--without needs a layer")?.as_str()),
            other => return Err(format!("unknown option {other}").into()),
        }
    }
    let layer = read_first_flat_layer_from_file(input)?.layer_data;
    let Vec2(columns, rows) = layer.size;
    let fits = |from: usize, size: usize, limit: usize| size > 0 && from.saturating_add(size) <= limit;
    if !fits(x, width, columns) || !fits(y, height, rows) {
        return Err(format!("{width}×{height} at ({x}, {y}) is not inside {columns}×{rows}").into());
    }
    let keep = |name: &str| {
        !dropped.iter().any(|layer| name.strip_prefix(layer).is_some_and(|r| r.starts_with('.')))
    };
    let pixels = || (y..y + height).flat_map(|row| row * columns + x..row * columns + x + width);
    let cut = |mut channel: AnyChannel<FlatSamples>| {
        channel.sample_data = match channel.sample_data {
            FlatSamples::F16(all) => FlatSamples::F16(pixels().map(|p| all[p]).collect()),
            FlatSamples::F32(all) => FlatSamples::F32(pixels().map(|p| all[p]).collect()),
            FlatSamples::U32(all) => FlatSamples::U32(pixels().map(|p| all[p]).collect()),
        };
        channel
    };
    let channels =
        layer.channel_data.list.into_iter().filter(|channel| keep(&channel.name.to_string())).map(cut);
    let encoding = Encoding { compression, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
    let attributes = LayerAttributes { layer_position: Vec2(0, 0), ..layer.attributes };
    let cropped = Layer::new((width, height), attributes, encoding, AnyChannels::sort(channels.collect()));
    Image::from_layer(cropped).write().to_file(output)?;
    Ok(())
}
