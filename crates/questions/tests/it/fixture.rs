//! A made-up study with everything that a reader must see: intervals, limits below the floor, skipped and failed
//! rows, marks, violated promises and diagnostics.

mod claims;
mod found;

use std::collections::BTreeMap;

use noisefloor_study::RowFrames;
use noisefloor_study::summary::*;
use serde_json::json;

pub use claims::judge_all;
use found::{bound, comparison, coverage, estimate, flicker, paper, slope};

pub const SPP: [u32; 4] = [4, 16, 64, 256];

/// A method of the fixture: label, method id, error at one sample, error floor, seconds.
#[derive(Clone, Copy)]
pub struct Row(pub &'static str, pub &'static str, pub f64, pub f64, pub f64);

pub const ROWS: [Row; 3] = [
    Row("mc", "mc", 2.0, 0.0, 2e-5),
    Row("virtual-flash", "virtual-flash", 0.25, 1e-4, 0.061),
    Row("guarded(virtual-flash)", "guarded(virtual-flash)", 0.3, 0.0, 0.064),
];

pub fn interval(value: f64, half: f64) -> Interval {
    Interval {
        value,
        standard_error: Some(half / 3.18),
        low: Some(value - half),
        high: Some(value + half),
        confidence: 0.95,
        n: 4,
        source: Source::Replicates,
        below: None,
    }
}

fn ratio(value: f64) -> Interval {
    Interval { low: Some(value / 1.06), high: Some(value * 1.07), ..interval(value, 0.0) }
}

fn method(row: &Row) -> MethodSummary {
    MethodSummary {
        label: row.0.into(),
        method: row.1.into(),
        name: format!("The method {}", row.0),
        citation: if row.1 == "mc" { String::new() } else { "moon2013flash".into() },
        reference: "B. Moon et al., Robust Image Denoising using a Virtual Flash Image, CGF 32(1), 2013"
            .into(),
        params: json!({"steps": 2, "kappa": 2.0, "inner": {"window": 31}}),
        notes: vec!["Bounds need independent samples.".into()],
        frames: RowFrames::Uniform,
        estimates_error: row.1 == "virtual-flash",
    }
}

fn scene(position: usize, id: &str, title: &str, rows: &[Row], size: (u32, u32)) -> SceneSummary {
    let image = |label: usize, spp: u32| format!("images/{position}-{label}-{spp}.exr");
    let by_spp = |i: usize| SPP.iter().map(|&n| (n, image(i, n))).collect();
    let flash = BTreeMap::from([
        ("flash image".to_owned(), format!("images/{position}-flash.exr")),
        ("homogeneous count".to_owned(), format!("images/{position}-count.exr")),
    ]);
    SceneSummary {
        id: id.into(),
        title: title.into(),
        about: "Rings and a lamp, drawn by a formula.".into(),
        width: size.0,
        height: size.1,
        replicates: SPP.iter().map(|&n| (n, 4)).collect(),
        settings: BTreeMap::from([("random seed".into(), "7".into()), ("path depth".into(), "6".into())]),
        reference: ReferenceSummary {
            spp: 2048,
            exact: false,
            parts: 8,
            sampling: "low-discrepancy".into(),
            correction: "product of the residuals to its two halves".into(),
            ratio_to_top: 8.0,
            long_enough: false,
            floor: BTreeMap::from([("relmse".into(), 2.1e-4), ("mse".into(), 1e-4)]),
            bias: BTreeMap::from([("relmse".into(), 3.3e-5)]),
        },
        classes: BTreeMap::from([("flat".into(), 9000), ("edge".into(), 3000)]),
        reference_image: format!("images/{position}-reference.exr"),
        render_seconds: SPP.iter().map(|&n| (n, 0.011 * f64::from(n))).collect(),
        images: rows.iter().enumerate().map(|(i, r)| (r.0.to_owned(), by_spp(i))).collect(),
        diagnostics: BTreeMap::from([(rows[1].0.to_owned(), BTreeMap::from([(64, flash)]))]),
    }
}

fn cell(position: usize, scene: &str, spp: u32, row: &Row) -> CellSummary {
    let scale = 1.0 + position as f64;
    let error = |r: &Row| scale * (r.2 / f64::from(spp) + r.3 * (1.0 + 4.0 * position as f64));
    let mc = scale * 2.0 / f64::from(spp);
    let value = error(row);
    // The guarded row drops under the floor at the top level of the first scene.
    let hidden = position == 0 && spp == 256 && row.1.starts_with("guarded");
    let mut relmse = interval(value, 0.05 * value);
    if hidden {
        relmse = Interval { value: -1e-5, below: Some(4e-4), ..interval(-1e-5, 2e-4) };
    }
    let psnr = interval(20.0 - 10.0 * value.log10(), 0.2);
    let metrics = BTreeMap::from([
        ("relmse".to_owned(), relmse),
        ("relmse_trimmed".to_owned(), interval(0.6 * value, 0.02 * value)),
        ("psnr".to_owned(), psnr),
    ]);
    let relative = BTreeMap::from([("relmse".to_owned(), ratio(value / mc))]);
    CellSummary {
        scene: scene.into(),
        spp,
        label: row.0.into(),
        ratio_to_mc: relative.clone(),
        classes: ["flat", "edge"].iter().map(|c| ((*c).to_owned(), metrics.clone())).collect(),
        class_ratio_to_mc: BTreeMap::from([("flat".to_owned(), relative)]),
        metrics,
        denoise_seconds: Some(row.4 * (1.0 + 0.1 * position as f64)),
        denoise_seconds_range: Some([row.4, row.4 * 1.2]),
        render_seconds: Some(0.011 * f64::from(spp)),
        equal_error: BTreeMap::from([("relmse".to_owned(), ratio(mc / value))]),
        equal_error_extrapolated: BTreeMap::from([("relmse".to_owned(), spp * 8 > 256)]),
        peak_memory_bytes: Some(123 << 20),
        enclosure_worst_ratio: row.1.starts_with("guarded").then_some(0.999_998),
        figures: BTreeMap::new(),
        replicates: 4,
        planned_replicates: 4,
        pixels: 48 * 36,
        pixels_of: 48 * 36,
        left_out: None,
        invalid_input_pixels: 0,
        reference_bias: BTreeMap::new(),
        non_finite_output: 0,
    }
}

pub fn metric(id: &str, name: &str, formula: &str, lower: bool, unit: &str) -> MetricInfo {
    MetricInfo {
        id: id.into(),
        name: name.into(),
        formula: formula.into(),
        lower_is_better: lower,
        ideal: (id == "energy").then_some(1.0),
        unit: unit.into(),
        reference_noise_removed: lower,
        order: match id {
            "relmse" => Some(2),
            "rmse" => Some(1),
            _ => None,
        },
    }
}

/// The summary of the made-up study.
pub fn summary(titles: &[(&str, &str)], rows: &[Row], size: (u32, u32)) -> Summary {
    let ids: Vec<&str> = titles.iter().map(|t| t.0).collect();
    let mut cells = Vec::new();
    for (i, id) in ids.iter().enumerate() {
        for spp in SPP {
            cells.extend(rows.iter().map(|r| cell(i, id, spp, r)));
        }
    }
    let per_level = || ids.iter().flat_map(|id| SPP.map(|n| (*id, n)));
    let coverage = per_level()
        .flat_map(|(id, n)| [0.95, 0.99, 0.998].map(|c| (id, n, c)))
        .flat_map(|(id, n, c)| ["all", "flat", "edge"].map(|class| coverage(id, n, c, class)))
        .collect();
    let claims = |id, n, class| {
        [
            bound(id, n, &rows[1], "Theorem 3.1 for two steps", false, class),
            bound(id, n, &rows[1], "composite bound", true, class),
            bound(id, n, &rows[2], "Theorem 3.1", true, class),
        ]
    };
    let estimates = per_level()
        .flat_map(|(id, n)| ["all", "flat", "edge"].map(|class| estimate(id, n, &rows[1], class)))
        .collect();
    let bounds =
        per_level().flat_map(|(id, n)| ["all", "edge"].map(|class| claims(id, n, class))).flatten().collect();
    let mut summary = Summary {
        schema: SUMMARY_SCHEMA,
        study: StudyInfo {
            name: "fixture".into(),
            title: "Rings & lamps: do the denoisers agree?".into(),
            question: "Which method is closest to the truth at equal samples, and do its promises hold?"
                .into(),
            analysis: vec![
                "The source reports the lowest error from 4 to 2048 samples; we see the same.".into(),
            ],
            command: "noisefloor run fixture --size 160x120".into(),
            primary_metric: "relmse".into(),
            metrics: vec![
                metric("relmse", "rMSE", "mean (x − r)² / (r² + 0.01)", true, ""),
                metric("relmse_trimmed", "rMSE trimmed", "rMSE without the worst 0.1 % of pixels", true, ""),
                metric("psnr", "PSNR", "10 log₁₀(1 / MSE) after the tone map", false, "dB"),
            ],
            spp: SPP.to_vec(),
            viewer_spp: vec![16, 64],
            figures: Vec::new(),
            reproduces: Some("moon2013flash Fig. 9".into()),
        },
        environment: Environment {
            version: "0.1.0".into(),
            cpu: "Made-up CPU".into(),
            logical_cpus: 2,
            threads: 2,
            simd: "avx2".into(),
            platform: "linux x86_64".into(),
            load_at_start: Some(0.1),
            profile: "release".into(),
            date: "2025-01-02T03:04:05Z".into(),
        },
        scenes: titles.iter().enumerate().map(|(i, t)| scene(i, t.0, t.1, rows, size)).collect(),
        methods: rows.iter().map(method).chain([method(&Row("oidn", "oidn", 0.0, 0.0, 0.0))]).collect(),
        slopes: ids.iter().flat_map(|id| rows.iter().map(|r| slope(id, r))).collect(),
        comparisons: per_level().map(|(id, n)| comparison(&cells, id, n)).collect(),
        cells,
        skipped: vec![Skipped {
            scene: ids[0].into(),
            spp: SPP.to_vec(),
            label: "oidn".into(),
            status: Status::Skipped,
            reason: "needs albedo and normal, which this frame does not have".into(),
        }],
        coverage,
        bounds,
        estimates,
        equal_time: Vec::new(),
        flicker: SPP.iter().flat_map(|&n| rows.iter().map(move |r| flicker(n, r, &rows[0]))).collect(),
        paper: per_level().map(|(id, n)| paper(id, n, rows)).collect(),
        progress: Some(Completion { planned: 96, finished: 96, missing: Vec::new() }),
        recorded: false,
        findings: Vec::new(),
        warnings: vec![Warning::new(
            WarningKind::ShortReference,
            "The references have only 8 times the samples of the top level.",
        )],
        claims: Vec::new(),
        family: ClaimFamily::default(),
        answers: BTreeMap::new(),
    };
    judge_all(&mut summary);
    summary
}

pub const TITLES: [(&str, &str); 2] = [("rings", "Rings"), ("lamps", "Lamps")];

/// The study as most tests begin with it.
pub fn study() -> Summary {
    summary(&TITLES, &ROWS, (48, 36))
}

/// The same with a single level of samples.
pub fn single_level() -> Summary {
    let mut study = study();
    study.study.spp = vec![16];
    study.cells.retain(|cell| cell.spp == 16);
    study.comparisons.retain(|comparison| comparison.spp == 16);
    study.slopes.clear();
    study
}
