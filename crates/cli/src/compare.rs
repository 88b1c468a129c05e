//! `noisefloor compare`.

use anyhow::bail;
use noisefloor_io::{ReadOptions, read_color, read_reference};
use noisefloor_metrics::{METRICS, Measurer};
use serde_json::{Map, Value, json};

use crate::args::Compare;
use crate::table::{aligned, number};

pub fn run(args: &Compare) -> anyhow::Result<()> {
    let test = read_color(&args.test)?;
    // The sample count of a reference plays no part here, so a file without one is fine.
    let reference = read_reference(&args.reference, &ReadOptions { spp: Some(1) })?;
    let mean = reference.mean();
    if !test.same_shape(mean) {
        bail!(
            "{} is {}×{} but {} is {}×{}",
            args.test.display(),
            test.width(),
            test.height(),
            args.reference.display(),
            mean.width(),
            mean.height()
        );
    }
    let measurer = Measurer::new(&reference, None)?;
    let measured = measurer.measure(&test)?;
    if args.json {
        let values: Map<String, Value> = METRICS
            .iter()
            .map(|m| (m.id.to_owned(), measured.values.get(m.id).copied().flatten().into()))
            .collect();
        let object = json!({
            "test": args.test,
            "reference": args.reference,
            "metrics": values,
            "reference_standard_error": measured.reference_se,
            "reference_noise": measurer.correction(),
            "non_finite_values": measured.non_finite_values,
        });
        println!("{}", serde_json::to_string_pretty(&object)?);
        return Ok(());
    }
    println!("reference noise: {}", measurer.correction());
    let mut rows = vec![vec!["metric".into(), "value".into(), "± reference".into(), "better".into()]];
    for metric in METRICS {
        let value = measured.values.get(metric.id).copied().flatten();
        rows.push(vec![
            metric.id.into(),
            value.map_or("not finite".into(), |v| format!("{}{}", number(v), suffix(metric.unit))),
            measured.reference_se.get(metric.id).map_or("".into(), |se| number(*se)),
            if metric.lower_is_better { "lower".into() } else { "higher".into() },
        ]);
    }
    print!("{}", aligned(&rows));
    if measured.non_finite_values > 0 {
        println!(
            "{} values of {} are not finite; their pixels are left out",
            measured.non_finite_values,
            args.test.display()
        );
    }
    Ok(())
}

fn suffix(unit: &str) -> String {
    if unit.is_empty() { String::new() } else { format!(" {unit}") }
}
