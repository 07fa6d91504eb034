//! A data sheet as JSON.
//!
//! Schema 1: `{"schema", "title", "receptor", "options", "readings", "rays", "directional": [index], "goniogram", "channels": [{"name",
//! "quantity", "unit", "target", "indices": [index], "lamps", "not_known", "class", "total", "responsivity"}]}`. An index is `{"symbol", "name", "unit",
//! "computed", "measured", "deviation_in_standard_uncertainties", "class", "probability", "conditions"}`, a figure
//! `{"value", "standard_uncertainty"}`. What is not there or not finite is `null`.

use serde::Serialize;

use crate::characterization::Figure;
use crate::characterization::bench::goniometer::Goniogram;
use crate::characterization::class_limits::{self, Classified};
use crate::characterization::sheet::{Absent, ChannelSheet, DataSheet, Index, Receptor};

#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    title: &'a str,
    receptor: &'static str,
    half_angle_deg: Option<f64>,
    seed: u64,
    monochromator_step_nm: f64,
    readings: usize,
    rays: u64,
    limits: &'static str,
    directional: Vec<IndexLine<'a>>,
    absent: Vec<AbsentLine<'a>>,
    goniogram: Option<GoniogramLine>,
    channels: Vec<ChannelLine<'a>>,
}

#[derive(Serialize)]
struct FigureLine {
    value: Option<f64>,
    standard_uncertainty: Option<f64>,
}

#[derive(Serialize)]
struct IndexLine<'a> {
    symbol: &'a str,
    name: &'a str,
    unit: &'a str,
    computed: FigureLine,
    measured: FigureLine,
    standard_uncertainty_by_stated_uncertainty_of_curves: f64,
    deviation_in_standard_uncertainties: Option<f64>,
    class: Option<&'static str>,
    probability: Option<f64>,
    limits: Option<[f64; 4]>,
    conditions: &'a str,
}

#[derive(Serialize)]
struct AbsentLine<'a> {
    symbol: &'a str,
    why: &'a str,
}

#[derive(Serialize)]
struct GoniogramLine {
    theta_deg: Vec<f64>,
    phi_deg: Vec<f64>,
    relative_readings: Vec<Vec<f64>>,
}

#[derive(Serialize)]
struct ClassLine {
    class: Option<&'static str>,
    probability: f64,
}

#[derive(Serialize)]
struct TotalLine {
    figure: FigureLine,
    class: ClassLine,
}

#[derive(Serialize)]
struct LampLine<'a> {
    lamp: &'a str,
    computed: FigureLine,
    measured: FigureLine,
    deviation_in_standard_uncertainties: Option<f64>,
}

#[derive(Serialize)]
struct ResponsivityLine<'a> {
    wavelengths_nm: &'a [f64],
    readings_per_watt_per_m2: Vec<f64>,
}

#[derive(Serialize)]
struct ChannelLine<'a> {
    name: &'a str,
    quantity: &'a str,
    unit: &'a str,
    target: Option<&'a str>,
    adjusted_with: Option<&'a str>,
    indices: Vec<IndexLine<'a>>,
    absent: Vec<AbsentLine<'a>>,
    lamps: Vec<LampLine<'a>>,
    /// Indices that have limits and are not known; class and total are lower bounds then.
    not_known: &'a [&'static str],
    class: Option<ClassLine>,
    total_percent: Option<TotalLine>,
    responsivity: ResponsivityLine<'a>,
}

fn finite(x: f64) -> Option<f64> {
    Some(x).filter(|x| x.is_finite())
}

fn figure(figure: &Figure) -> FigureLine {
    FigureLine { value: finite(figure.value), standard_uncertainty: finite(figure.standard_uncertainty) }
}

fn class(found: &Classified) -> ClassLine {
    ClassLine { class: found.class.map(class_limits::Class::letter), probability: found.probability }
}

fn index(index: &Index) -> IndexLine<'_> {
    let found = index.classified();
    IndexLine {
        symbol: index.symbol,
        name: index.name,
        unit: index.unit,
        computed: figure(&index.computed),
        measured: figure(&index.measured),
        standard_uncertainty_by_stated_uncertainty_of_curves: index.stated_u,
        deviation_in_standard_uncertainties: finite(index.deviation_u()),
        class: found.and_then(|c| c.class).map(class_limits::Class::letter),
        probability: found.map(|c| c.probability),
        limits: index.limits.map(|limits| limits.largest),
        conditions: &index.conditions,
    }
}

fn absent(absent: &[Absent]) -> Vec<AbsentLine<'_>> {
    absent.iter().map(|one| AbsentLine { symbol: one.symbol, why: &one.why }).collect()
}

fn goniogram(goniogram: &Goniogram) -> GoniogramLine {
    let degrees = |angles: &[f64]| angles.iter().map(|angle| angle.to_degrees()).collect();
    GoniogramLine {
        theta_deg: degrees(&goniogram.theta_rad),
        phi_deg: degrees(&goniogram.phi_rad),
        relative_readings: goniogram.readings.iter().map(|row| row.iter().map(|f| f.value).collect()).collect(),
    }
}

fn channel(sheet: &ChannelSheet) -> ChannelLine<'_> {
    ChannelLine {
        name: &sheet.name,
        quantity: sheet.reads.name(),
        unit: sheet.reads.unit(),
        target: sheet.target.as_ref().map(|target| target.name.as_str()),
        adjusted_with: sheet.target.as_ref().map(|target| target.calibration_name),
        indices: sheet.indices.iter().map(index).collect(),
        absent: absent(&sheet.absent),
        lamps: sheet
            .lamps
            .iter()
            .map(|lamp| LampLine {
                lamp: &lamp.name,
                computed: figure(&lamp.computed),
                measured: figure(&lamp.measured),
                deviation_in_standard_uncertainties: finite(lamp.computed.deviation_u(&lamp.measured)),
            })
            .collect(),
        not_known: &sheet.unknown,
        class: sheet.class.as_ref().map(class),
        total_percent: sheet.total.as_ref().map(|(sum, found)| TotalLine { figure: figure(sum), class: class(found) }),
        responsivity: ResponsivityLine {
            wavelengths_nm: &sheet.responsivity.wavelengths_nm,
            readings_per_watt_per_m2: sheet.responsivity.readings.iter().map(|f| f.value).collect(),
        },
    }
}

/// The sheet as JSON text, ending in a line break.
#[must_use]
pub fn to_json(sheet: &DataSheet) -> String {
    let (receptor, half_angle) = match sheet.receptor {
        Receptor::Planar => ("planar", None),
        Receptor::Cone { half_angle_rad } => ("cone", Some(half_angle_rad.to_degrees())),
        Receptor::Spot { half_angle_rad, .. } => ("spot", Some(half_angle_rad.to_degrees())),
        Receptor::Head(head) => (head.name(), None),
    };
    let document = Document {
        schema: 1,
        title: &sheet.title,
        receptor,
        half_angle_deg: half_angle,
        seed: sheet.options.seed,
        monochromator_step_nm: sheet.options.step_nm,
        readings: sheet.tally.0,
        rays: sheet.tally.1,
        limits: class_limits::SOURCE,
        directional: sheet.directional.iter().map(index).collect(),
        absent: absent(&sheet.absent),
        goniogram: sheet.goniogram.as_ref().map(goniogram),
        channels: sheet.channels.iter().map(channel).collect(),
    };
    // Strings and numbers only: there is nothing that could not be written.
    let mut text = serde_json::to_string_pretty(&document).unwrap_or_default();
    text.push('\n');
    text
}
