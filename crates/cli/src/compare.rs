//! `noisefloor compare`.
//!
//! Every image is measured against one reference; [`findings`] says what about the files limits the numbers, [`maps`]
//! draws where the error is, and [`text`] and [`json`] show all of it.

mod findings;
mod json;
mod maps;
mod pair;
mod text;

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::Context as _;
use noisefloor_frame::{Finding, Image, sorted_findings};
use noisefloor_inputs::Against;
use noisefloor_io::{ReadOptions, read_checked_reference, read_color};
use noisefloor_metrics::{Measured, Measurer, trimmed_count};

use crate::args::Compare;
use crate::exit::Exit;
use crate::out::{Out, say};

/// One image and what came out.
struct Compared<'a> {
    path: &'a Path,
    image: Image,
    measured: Measured,
    findings: Vec<Finding>,
    map: Option<maps::Map>,
}

impl Compared<'_> {
    /// Pixels that a metric averages.
    fn pixels(&self, metric: &str) -> usize {
        let dropped = if metric == "relmse_trimmed" { trimmed_count(self.measured.pixels) } else { 0 };
        self.measured.pixels - dropped
    }

    /// Metric id to the bias by the reference's noise that was taken out.
    fn bias(&self) -> BTreeMap<&str, f64> {
        let found = self.measured.reference.iter().filter(|(_, contribution)| contribution.bias != 0.0);
        found.map(|(id, contribution)| (id.as_str(), contribution.bias)).collect()
    }

    /// Metric id to the upper limit that stands for a value whose bias is in doubt.
    fn upper_limits(&self) -> BTreeMap<&str, f64> {
        let limit = |id: &String| {
            let value = self.measured.values.get(id).copied().flatten()?;
            // Two-sided 95 %.
            let high = self.measured.reference_se.get(id).map(|se| value + 1.96 * se);
            self.measured.reference.get(id)?.upper_limit(value, high)
        };
        self.measured.reference.keys().filter_map(|id| Some((id.as_str(), limit(id)?))).collect()
    }
}

pub fn run(args: &Compare) -> anyhow::Result<Exit> {
    let plan = maps::plan(args)?;
    // Headers first: nothing is decoded of files that cannot be held against each other.
    let pair = pair::Headers::read(args)?;
    // The sample count of a reference plays no part here, so a file without one is fine.
    let (reference, found) =
        read_checked_reference(&args.reference, &ReadOptions { spp: Some(1), ..ReadOptions::default() })?;
    let name = args.reference.display().to_string();
    let of_reference: Vec<Finding> = found.into_iter().map(|finding| finding.within(&name)).collect();
    let measurer = Measurer::new(&reference, None).with_context(|| args.reference.display().to_string())?;
    let measurer = measurer.with(&args.metrics);
    let against = Against::new(&reference, pair.reference.spp);
    let mut all = Vec::new();
    for path in &args.images {
        let image = read_color(path)?;
        let inputs = pair.check(&against, &reference, path, &image)?;
        let measured = measurer
            .measure(&image)
            .with_context(|| format!("{} against {}", path.display(), args.reference.display()))?;
        let findings = findings::of_pair(path, &measured, inputs).into_iter().chain(of_reference.clone());
        let findings = sorted_findings(findings);
        all.push(Compared { path, image, measured, findings, map: None });
    }
    if let Some(plan) = &plan {
        maps::write(plan, &reference, args.map_range, &mut all)?;
    }
    if args.json {
        say!(Out::Stdout, "{}", serde_json::to_string_pretty(&json::describe(args, &measurer, &all))?)?;
    } else {
        Out::Stdout.text(text::describe(&measurer, &all))?;
    }
    Ok(Exit::Done)
}
