//! A sensor file with fitted curves.

use std::fmt::Write;

use crate::quantity::Measurand;
use crate::sensor::{Acceptance, Aperture, DirectionalResponse, Sensor};
use crate::study::calibrate::Calibrated;

/// The text of a sensor file: aperture and acceptance of `sensor`, channels with the fitted curves in these files. `directional` is the file
/// that [`directional_to_csv`] goes to.
#[must_use]
pub fn to_sensor_file(calibrated: &Calibrated, sensor: &Sensor, curve_files: &[String], directional: &str) -> String {
    let origin = if calibrated.simulated { format!("simulated, seed {}", calibrated.seed) } else { "a laboratory's readings".to_owned() };
    let mut text = format!(
        "// {}, calibrated: responsivities fitted to {} readings.\n//\n// What it shows: the sensor as its calibration knows it.\n// Source: {} ({origin}), etendue {} calibrate; uncertainties stand in the curve files.\n",
        one_line(&calibrated.sensor),
        calibrated.labels.len(),
        one_line(&calibrated.title),
        env!("CARGO_PKG_VERSION"),
    );
    if calibrated.channels.iter().any(|c| c.curve.parametric.is_some()) {
        let _ = writeln!(text, "// Model: {}. Its parameters stand in the report.", one_line(&calibrated.prior.0));
    }
    for channel in calibrated.channels.iter().filter(|c| !c.unseen_nm.is_empty()) {
        let ranges: Vec<String> = channel.unseen_nm.iter().map(|(a, b)| format!("{a} nm to {b} nm")).collect();
        let _ = writeln!(text, "// Not determined, channel {}: {}.", one_line(&channel.readings.channel), ranges.join(", "));
    }
    let _ = writeln!(text, "Sensor(\n    title: {},", quoted(&format!("{}, calibrated", calibrated.sensor)));
    let aperture = match sensor.aperture {
        Aperture::Point => "Point".to_owned(),
        Aperture::Disc { radius_m } => format!("Disc(radius_m: {radius_m:e})"),
        Aperture::Rectangle { half_width_m, half_height_m } => {
            format!("Rectangle(width_m: {:e}, height_m: {:e})", 2.0 * half_width_m, 2.0 * half_height_m)
        }
    };
    let acceptance = match &sensor.acceptance {
        Acceptance::Cosine => "Cosine".to_owned(),
        Acceptance::Cone { half_angle_rad } => format!("Cone(half_angle_deg: {})", half_angle_rad.to_degrees()),
        Acceptance::Directional(_) => format!("Directional({})", quoted(directional)),
        Acceptance::Spot(spot) => {
            let field_deg = 2.0 * spot.half_angle_rad.to_degrees();
            format!("Spot(field_deg: {field_deg}, focus_m: {:e}, edge: {})", spot.focus_m, spot.edge)
        }
        Acceptance::Spherical => "Spherical".to_owned(),
        Acceptance::Hemispherical => "Hemispherical".to_owned(),
        Acceptance::Cylindrical => "Cylindrical".to_owned(),
        Acceptance::Semicylindrical => "Semicylindrical".to_owned(),
    };
    let _ = writeln!(text, "    aperture: {aperture},\n    acceptance: {acceptance},\n    channels: [");
    for (channel, file) in calibrated.channels.iter().zip(curve_files) {
        let (name, reads) = (quoted(&channel.readings.channel), reads(&channel.readings.measurand));
        // A current needs a curve with a unit.
        let curve =
            if channel.readings.measurand == Measurand::Photocurrent { format!("AmperesPerWatt({})", quoted(file)) } else { quoted(file) };
        let _ = writeln!(text, "        (name: {name}, responsivity: {curve}, reads: {reads}),");
    }
    text.push_str("    ],\n)\n");
    text
}

/// How a channel says what it reads when its curve is absolute: indication = ∫ curve · E dλ.
fn reads(measurand: &Measurand) -> String {
    match measurand {
        Measurand::Irradiance => "Irradiance".to_owned(),
        Measurand::RadiantFlux => "RadiantFlux".to_owned(),
        Measurand::Radiance => "Radiance".to_owned(),
        Measurand::Photocurrent => "Photocurrent".to_owned(),
        Measurand::Illuminance => "Illuminance(efficacy_lm_w: 1)".to_owned(),
        Measurand::LuminousFlux => "LuminousFlux(efficacy_lm_w: 1)".to_owned(),
        Measurand::Luminance => "Luminance(efficacy_lm_w: 1)".to_owned(),
        Measurand::Signal { unit } => format!("Signal(unit: {}, per_watt: 1)", quoted(unit)),
        other => format!(
            "Weighted(name: {}, symbol: {}, unit: {}, per_watt: 1)",
            quoted(other.name()),
            quoted(other.symbol()),
            quoted(other.unit())
        ),
    }
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

fn one_line(text: &str) -> String {
    text.split(['\r', '\n']).collect::<Vec<_>>().join(" ")
}

/// The table of a directional response, as sensor files read it.
#[must_use]
pub fn directional_to_csv(response: &DirectionalResponse) -> String {
    let (theta, phi, values) = response.table();
    let mut text = "theta_deg".to_owned();
    if phi.len() == 1 {
        text.push_str(",R");
    } else {
        phi.iter().for_each(|phi| text.push_str(&format!(",{}", phi.to_degrees())));
    }
    text.push('\n');
    for (i, theta) in theta.iter().enumerate() {
        // Angles went through radians: rounding must not carry 90° beyond 90°.
        let _ = write!(text, "{}", theta.to_degrees().min(90.0));
        values.iter().for_each(|row| text.push_str(&format!(",{}", row[i])));
        text.push('\n');
    }
    text
}
