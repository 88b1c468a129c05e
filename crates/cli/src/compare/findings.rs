//! What about an image and its reference limits the numbers.

use std::path::Path;

use noisefloor_frame::{Finding, FindingKind};
use noisefloor_metrics::Measured;

/// Standard errors below zero from which on a squared error is a contradiction.
const CONTRADICTION: f64 = 3.0;

/// Findings about one image, most serious first; `inputs` are those of image and reference held against each other.
pub fn of_pair(path: &Path, measured: &Measured, inputs: Vec<Finding>) -> Vec<Finding> {
    let mut found = inputs;
    let dependent = found.iter().any(|f| matches!(f.kind, FindingKind::Dependent | FindingKind::EqualData));
    if let (Some(Some(mse)), Some(se)) = (measured.values.get("mse"), measured.reference_se.get("mse"))
        && *mse < -CONTRADICTION * se
        && !dependent
    {
        let text = format!(
            "test and reference are not independent: its mse is {:.1} standard errors below zero",
            mse.abs() / se
        );
        let size = mse / se; // a negative mse below a non-negative error
        found.push(
            Finding::new(FindingKind::Dependent, path.display().to_string(), text)
                .with_value(size)
                .with_standard_errors(size.abs()),
        );
    }
    let values = measured.non_finite_values;
    if values > 0 {
        let text = match values {
            1 => "1 value is not finite; its pixel is left out".to_owned(),
            _ => format!("{values} values are not finite; their pixels are left out"),
        };
        let finding = Finding::new(FindingKind::NonFiniteOutput, "color", text)
            .with_value(values as f64)
            .within(&path.display().to_string());
        found.push(finding);
    }
    noisefloor_frame::sorted_findings(found)
}
