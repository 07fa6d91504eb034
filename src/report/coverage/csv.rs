//! Coverage of intervals as CSV: a row a reading, every digit kept. Scenes without samples have no row.

use super::StudiedScene;
use crate::study::coverage::lowest_share;

const HEAD: [&str; 19] = [
    "scene",
    "target",
    "reading",
    "poses",
    "unit",
    "samples",
    "truth",
    "truth_standard_uncertainty",
    "truth_origin",
    "truth_share_of_u",
    "readings",
    "covered",
    "covered_share",
    "lowest_share",
    "bias_in_standard_errors",
    "outside_target_share",
    "target_unmet_share",
    "claimed_over_rms",
    "verdict",
];

/// All rows as CSV.
#[must_use]
pub fn to_csv(studied: &[StudiedScene]) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    // Writing into memory does not fail.
    let _ = writer.write_record(HEAD);
    for (scene, row) in super::every(studied) {
        let _ = writer.write_record([
            scene.file.clone(),
            format!("{:e}", scene.target),
            row.reading.clone(),
            row.poses.to_string(),
            row.unit.clone(),
            format!("{:e}", row.samples),
            format!("{:e}", row.truth),
            format!("{:e}", row.truth_standard_uncertainty),
            row.origin.words(),
            format!("{:e}", row.truth_share),
            row.runs.to_string(),
            row.covered.to_string(),
            format!("{:e}", row.covered_share()),
            format!("{:e}", lowest_share(row.runs)),
            format!("{:e}", row.bias),
            format!("{:e}", row.outside_target),
            format!("{:e}", row.target_unmet),
            format!("{:e}", row.claimed_over_rms),
            row.verdict.words().to_owned(),
        ]);
    }
    writer.into_inner().map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).unwrap_or_default()
}
