//! What about an image and its reference limits the numbers.

use std::path::Path;

use noisefloor_frame::{Finding, FindingKind};
use noisefloor_metrics::Measured;

/// Findings about one image, most serious first.
pub fn of_pair(path: &Path, measured: &Measured) -> Vec<Finding> {
    let mut found = Vec::new();
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
