//! The figures as JSON.
//!
//! ```text
//! {"schema", "title", "figures": {KEY: {"symbol", "name", "unit", "value", "standard_uncertainty", "note"?}},
//!  "photon_transfer": [{"exposure_s", "photons", "mean_dn", "variance_dn2", "dark_mean_dn", "dark_variance_dn2"}], "saturation_index"}
//! ```
//!
//! The data sheet of a camera has a list of `channels` with the same keys, each figure with `computed` and `measured`.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::characterization::emva::{Figures, TransferPoint};
use crate::characterization::sheet::camera::{CameraSheet, Comparison, F_NUMBER};

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
        photon_transfer: points(of),
        saturation_index: of.saturation,
    };
    written(&document)
}

fn points(of: &Figures) -> Vec<Point> {
    let point = |p: &TransferPoint| Point {
        exposure_s: p.level.exposure_s,
        photons: p.level.photons,
        mean_dn: p.bright.mean_dn,
        variance_dn2: p.bright.variance_dn2,
        dark_mean_dn: p.dark.mean_dn,
        dark_variance_dn2: p.dark.variance_dn2,
    };
    of.points.iter().map(point).collect()
}

fn written(document: &impl Serialize) -> String {
    // Strings and numbers only: there is nothing that could not be written.
    let mut text = serde_json::to_string_pretty(document).unwrap_or_default();
    text.push('\n');
    text
}

#[derive(Serialize)]
struct Number {
    value: f64,
    standard_uncertainty: f64,
}

impl From<crate::characterization::Figure> for Number {
    fn from(of: crate::characterization::Figure) -> Self {
        Number { value: of.value, standard_uncertainty: of.standard_uncertainty }
    }
}

#[derive(Serialize)]
struct BothRoutes<'a> {
    symbol: &'a str,
    name: &'a str,
    unit: &'a str,
    computed: Number,
    measured: Number,
    deviation_in_standard_uncertainties: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    note: Option<&'a str>,
}

#[derive(Serialize)]
struct ChannelLine<'a> {
    name: &'a str,
    wavelength_nm: f64,
    photons_per_s: Number,
    longest_exposure_s: f64,
    figures: BTreeMap<&'a str, BothRoutes<'a>>,
    photon_transfer: Vec<Point>,
    saturation_index: usize,
}

#[derive(Serialize)]
struct SheetDocument<'a> {
    schema: u32,
    title: &'a str,
    temperature_c: f64,
    f_number: f64,
    seed: u64,
    frames: u64,
    channels: Vec<ChannelLine<'a>>,
}

/// The data sheet of a camera; numbers keep all their digits.
#[must_use]
pub fn sheet_to_json(sheet: &CameraSheet) -> String {
    let both = |c: &Comparison| BothRoutes {
        symbol: c.symbol,
        name: c.name,
        unit: c.unit,
        computed: c.computed.into(),
        measured: c.measured.into(),
        deviation_in_standard_uncertainties: c.deviation_u(),
        note: c.note,
    };
    let channels = sheet.channels.iter().map(|channel| ChannelLine {
        name: &channel.name,
        wavelength_nm: channel.wavelength_nm,
        photons_per_s: channel.photons_per_s.into(),
        longest_exposure_s: channel.longest_s,
        figures: channel.comparisons.iter().map(|c| (c.key, both(c))).collect(),
        photon_transfer: points(&channel.measured),
        saturation_index: channel.measured.saturation,
    });
    written(&SheetDocument {
        schema: 1,
        title: &sheet.title,
        temperature_c: sheet.temperature_c,
        f_number: F_NUMBER,
        seed: sheet.options.seed,
        frames: sheet.frames,
        channels: channels.collect(),
    })
}
