//! Metrics that are measured where somebody asks for them.

use noisefloor_frame::{Image, Reference};
use noisefloor_metrics::{
    Classes, METRICS, Measurer, Metric, MetricError, Rule, add, block_bootstrap, metric, on_request,
};

fn truth() -> Reference {
    Reference::exact(Image::from_fn(64, 64, 3, |_, x, y| ((x + y) % 7) as f32))
}

/// |x−r| in red, of an outsider.
const RED: Metric = Metric::new(
    "red",
    "red",
    "mean |x−r| in red",
    Rule::Map(|pixels| {
        let [x, r] = [pixels.test(), pixels.reference()].map(|image| image.plane(0));
        Ok(Some(x.iter().zip(r).map(|(x, r)| f64::from((x - r).abs())).collect()))
    }),
);

#[test]
fn one_entry_makes_a_metric_of_the_image_its_classes_and_its_blocks() {
    add(RED).unwrap();
    assert_eq!(add(RED).unwrap_err(), MetricError::Taken { id: "red" });
    assert_eq!(add(METRICS[0]).unwrap_err(), MetricError::Taken { id: "mse" });
    assert!(on_request().iter().any(|metric| metric.id == "red"));
    let truth = truth();
    // Off by 1 in the left half and by 2 in the right one; a pixel that is not finite is left out.
    let mut test =
        Image::from_fn(64, 64, 3, |c, x, y| truth.mean().get(c, x, y) + if x < 32 { 1.0 } else { 2.0 });
    test.set(1, 40, 0, f32::NAN);
    let names = ["left".to_owned(), "right".to_owned()];
    let of_pixel: Vec<u8> = (0..64 * 64).map(|p| u8::from(p % 64 >= 32)).collect();
    let classes = Classes { names: &names, of_pixel: &of_pixel };
    let red = metric("red").unwrap();
    let plain = Measurer::new(&truth, Some(classes)).unwrap();
    let measurer = Measurer::new(&truth, Some(classes)).unwrap().with(&[red, red, metric("mse").unwrap()]);
    let mut measured = measurer.measure(&test).unwrap();
    let of_classes = ["left", "right"].map(|class| measured.classes[class]["red"]);
    assert_eq!(of_classes, [Some(1.0), Some(2.0)]);
    let expected = (2048.0 + 2.0 * 2047.0) / 4095.0;
    assert!((measured.values.remove("red").unwrap().unwrap() - expected).abs() < 1e-12);
    let spread = block_bootstrap(&measurer, &test, 50, 1).unwrap();
    assert!(spread["red"] > 0.1, "{spread:?}");
    // Nothing else moves.
    assert_eq!(measured.values, plain.measure(&test).unwrap().values);
    assert!(!block_bootstrap(&plain, &test, 50, 1).unwrap().contains_key("red"));
}

#[test]
fn a_metric_may_be_undefined_and_must_not_be_misshapen() {
    let with = |id: &'static str, rule: Rule| {
        add(Metric::new(id, id, "", rule)).unwrap();
        let truth = truth();
        let measurer = Measurer::new(&truth, None).unwrap().with(&[metric(id).unwrap()]);
        measurer.measure(truth.mean()).map(|measured| measured.values[id])
    };
    assert_eq!(with("nowhere", Rule::Map(|_| Ok(None))), Ok(None));
    assert_eq!(with("infinite", Rule::Over(|_, _| Some(f64::INFINITY))), Ok(None));
    let error = with("short", Rule::Map(|_| Ok(Some(vec![0.0; 3])))).unwrap_err();
    assert_eq!(error, MetricError::Map { id: "short", pixels: 4096, got: 3 });
    let failed = || MetricError::Failed { id: "failing", reason: "no memory".into() };
    assert_eq!(
        with(
            "failing",
            Rule::Map(|_| Err(MetricError::Failed { id: "failing", reason: "no memory".into() }))
        ),
        Err(failed())
    );
}
