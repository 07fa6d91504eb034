//! The figures as JSON.
//!
//! ```text
//! {"schema", "title", "figures": {KEY: {"symbol", "name", "unit", "value", "standard_uncertainty", "note"?}},
//!  "photon_transfer": [{"exposure_s", "photons", "mean_dn", "variance_dn2", "dark_mean_dn", "dark_variance_dn2"}], "saturation_index"}
//! ```

use std::collections::BTreeMap;

use serde::Serialize;

use crate::characterization::emva::Figures;

#[derive(Serialize)]
struct Figure<'a> {
    symbol: &'a str,
    name: &'a str,
    unit: &'a str,
    value: f64,
    standard_uncertainty: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    note: Option<&'a str>,
}

#[derive(Serialize)]
struct Point {
    exposure_s: f64,
    photons: f64,
    mean_dn: f64,
    variance_dn2: f64,
    dark_mean_dn: f64,
    dark_variance_dn2: f64,
}

#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    title: &'a str,
    figures: BTreeMap<&'a str, Figure<'a>>,
    photon_transfer: Vec<Point>,
    saturation_index: usize,
}

/// Figures and photon-transfer curve; numbers keep all their digits.
#[must_use]
pub fn to_json(title: &str, of: &Figures) -> String {
    let figure = |f: &crate::characterization::emva::Figure| Figure {
        symbol: f.symbol,
        name: f.name,
        unit: f.unit,
        value: f.value,
        standard_uncertainty: f.standard_uncertainty,
        note: f.note,
    };
    let document = Document {
        schema: 1,
        title,
        figures: of.list.iter().map(|f| (f.key, figure(f))).collect(),
        photon_transfer: of
            .points
            .iter()
            .map(|p| Point {
                exposure_s: p.level.exposure_s,
                photons: p.level.photons,
                mean_dn: p.bright.mean_dn,
                variance_dn2: p.bright.variance_dn2,
                dark_mean_dn: p.dark.mean_dn,
                dark_variance_dn2: p.dark.variance_dn2,
            })
            .collect(),
        saturation_index: of.saturation,
    };
    // Strings and numbers only: there is nothing that could not be written.
    let mut text = serde_json::to_string_pretty(&document).unwrap_or_default();
    text.push('\n');
    text
}
