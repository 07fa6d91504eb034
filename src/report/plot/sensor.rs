//! Sensors: spectral responsivity of the channels with V(λ) behind, response over the angle of incidence with the cosine behind.
//!
//! ```text
//! s(λ) / max s                 r(θ, φ) = R(θ, φ) cos θ / R(0)                 d(θ, φ) = R(θ, φ) / R(0) − 1
//! ```
//!
//! Of a head that sees all round, its weight w(θ, φ) relative to the largest, over θ to 180° on either side, stands for R cos θ.
//!
//! R is relative to that along the normal, or to the largest where the sensor accepts nothing along its normal. A response that depends
//! on the azimuth is drawn in four planes through the normal; at the left of the normal, φ is larger by 180°.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::math::DVec3;
use crate::sensor::{Acceptance, Sensor};
use crate::spectrum::{Factor, library};

use super::PlotError;
use super::chart::{Axis, Chart, Curve, Dash, Ink};
use super::sample::{every, of_factor, strip, subscripted};

/// Azimuths of the planes of a response that depends on it, degrees.
const PLANES_DEG: [f64; 4] = [0.0, 45.0, 90.0, 135.0];
/// Step of the angle of incidence, degrees.
const STEP_DEG: f64 = 0.5;
/// Wavelengths beyond which no responsivity is drawn, nm.
const WIDEST_NM: (f64, f64) = (200.0, 3000.0);
/// Largest angle at which the deviation from the cosine is drawn, degrees: towards 90° both go to zero.
const DEVIATION_TO_DEG: f64 = 85.0;

/// A sensor, or one plane of it, as a function of the angle of incidence.
pub(super) struct Cut {
    /// Name of the sensor and of the plane.
    pub(super) label: String,
    acceptance: Acceptance,
    phi_rad: f64,
    /// What is one.
    unit: f64,
}

impl Cut {
    /// R(θ, φ) relative to that along the normal; θ negative is at the other side of the normal.
    pub(super) fn relative(&self, theta_rad: f64) -> f64 {
        let phi = if theta_rad < 0.0 { self.phi_rad + PI } else { self.phi_rad };
        let theta = theta_rad.abs();
        // At 90° the cosine of the nearest number to π/2 is not zero.
        let cos = if theta == FRAC_PI_2 || (theta > FRAC_PI_2 && !self.sees_all_round()) { 0.0 } else { theta.cos() };
        self.acceptance.at(cos, theta.sin(), phi) / self.unit
    }

    /// Response to a parallel beam, R cos θ or w, relative to one.
    pub(super) fn to_beam(&self, theta_rad: f64) -> f64 {
        if self.sees_all_round() { self.relative(theta_rad) } else { self.relative(theta_rad) * theta_rad.cos().max(0.0) }
    }

    /// Whether there is no horizon.
    pub(super) fn sees_all_round(&self) -> bool {
        !self.acceptance.has_horizon()
    }

    /// Angles at which the response is drawn, rad: every half degree and both sides of the limit of acceptance.
    pub(super) fn angles_rad(&self, from_deg: f64, to_deg: f64) -> Vec<f64> {
        let limit_deg = self.acceptance.limit_rad().to_degrees();
        let edges = [limit_deg, limit_deg * (1.0 + 1e-9)];
        let mut degrees = every(from_deg, to_deg, STEP_DEG);
        degrees.extend(edges.into_iter().flat_map(|edge| [edge, -edge]).filter(|edge| (from_deg..=to_deg).contains(edge)));
        degrees.sort_by(f64::total_cmp);
        degrees.dedup();
        degrees.into_iter().map(f64::to_radians).collect()
    }
}

/// Spectral responsivities of all channels, each relative to its largest value. Errors if there is no channel, or one that is zero
/// everywhere.
pub fn responsivity(sensors: &[Sensor]) -> Result<Chart, PlotError> {
    let channels: Vec<(String, &Factor)> = sensors
        .iter()
        .flat_map(|sensor| sensor.channels.iter().map(move |channel| (sensor, channel)))
        .map(|(sensor, channel)| {
            let name = subscripted(&channel.name);
            let label = if sensors.len() > 1 { format!("{}: {name}", sensor.title) } else { name };
            (label, &channel.responsivity)
        })
        .collect();
    if channels.is_empty() {
        return Err(PlotError::Nothing { what: "no sensor with a channel was asked for".to_owned() });
    }
    let ends = channels.iter().flat_map(|(_, factor)| match factor {
        Factor::Table(table) => vec![table.range_nm().0, table.range_nm().1],
        other => other.breakpoints(),
    });
    let (from, to) = ends.filter(|nm| nm.is_finite()).fold((380.0_f64, 780.0_f64), |(low, high), nm| (low.min(nm), high.max(nm)));
    let (from, to) = (from.max(WIDEST_NM.0), to.min(WIDEST_NM.1));
    let x = Axis::linear("Wavelength λ", "nm", from, to);
    let y = Axis::linear("Relative spectral responsivity", "1 at the peak", 0.0, 1.05);
    let title = if let [one] = sensors { format!("{}; ", one.title) } else { String::new() };
    let mut chart = Chart::new("Spectral responsivity", &format!("{title}each channel relative to its peak"), x, y);
    let v = of_factor(&library::v_lambda(), from, to);
    chart.curves.push(Curve::new("V(λ)", v, Ink::Muted).behind());
    for (index, (label, factor)) in channels.into_iter().enumerate() {
        let peak = factor.max_over(from, to);
        if !(peak.is_finite() && peak > 0.0) {
            let what = format!("the responsivity of `{label}` has no positive value from {from} nm to {to} nm");
            return Err(PlotError::Request { what });
        }
        let points = of_factor(factor, from, to).into_iter().map(|[nm, s]| [nm, s / peak]).collect();
        // With more channels the colours come again, dashed and then dotted.
        let dash = [Dash::Solid, Dash::Dashed, Dash::Dotted][(index / 8).min(2)];
        chart.curves.push(Curve::new(&label, points, Ink::Palette(index)).dashed(dash));
    }
    chart.strip = strip(from, to);
    Ok(chart)
}

/// Response over the angle of incidence with the cosine behind. Errors if there is no sensor.
pub fn directional(sensors: &[Sensor]) -> Result<Chart, PlotError> {
    let cuts = cuts(sensors)?;
    let reach_deg = reach_deg(&cuts);
    let degrees = |from: f64, to: f64| Axis {
        ticks: (-6..=6)
            .map(|i| f64::from(i) * reach_deg / 3.0)
            .filter(|d| d.abs() <= reach_deg)
            .map(|d| (d, format!("{d:.0}").replace('-', "−")))
            .collect(),
        ..Axis::linear("Angle of incidence θ", "°", from, to)
    };
    let largest = cuts.iter().flat_map(|cut| cut.angles_rad(-reach_deg, reach_deg).into_iter().map(|t| cut.to_beam(t))).fold(1.0, f64::max);
    let y = Axis::linear(&format!("Relative response {}", response_words(reach_deg)[0]), response_words(reach_deg)[1], 0.0, 1.05 * largest);
    let mut chart = Chart::new("Directional response", &subtitle(sensors, "to a parallel beam"), degrees(-reach_deg, reach_deg), y);
    let cosine = every(-90.0, 90.0, STEP_DEG).into_iter().map(|d| [d, d.to_radians().cos().max(0.0)]).collect();
    chart.curves.push(Curve::new("cos θ", cosine, Ink::Muted).behind());
    for (index, cut) in cuts.iter().enumerate() {
        let points = cut.angles_rad(-reach_deg, reach_deg).into_iter().map(|t| [t.to_degrees(), cut.to_beam(t)]);
        chart.curves.push(styled(&cut.label, points.collect(), index));
    }
    Ok(chart)
}

/// Deviation from the cosine, percent, over the angle of incidence to 85°. Errors if there is no sensor.
pub fn deviation(sensors: &[Sensor]) -> Result<Chart, PlotError> {
    let cuts = cuts(sensors)?;
    if let Some(head) = sensors.iter().find_map(|sensor| sensor.acceptance.head()) {
        let what = format!("a {} receptor is not meant to follow the cosine; its directional and polar views show its weight", head.name());
        return Err(PlotError::Request { what });
    }
    let symmetric = sensors.iter().all(|sensor| is_symmetric(&sensor.acceptance));
    let from = if symmetric { 0.0 } else { -DEVIATION_TO_DEG };
    let curves: Vec<Curve> = cuts
        .iter()
        .enumerate()
        .map(|(index, cut)| {
            let points = cut.angles_rad(from, DEVIATION_TO_DEG).into_iter().map(|t| [t.to_degrees(), 100.0 * (cut.relative(t) - 1.0)]);
            styled(&cut.label, points.collect(), index)
        })
        .collect();
    let reach = curves.iter().flat_map(|curve| &curve.points).fold((-1.0_f64, 1.0_f64), |(low, high), p| (low.min(p[1]), high.max(p[1])));
    let margin = 0.08 * (reach.1 - reach.0);
    let x = Axis::linear("Angle of incidence θ", "°", from, DEVIATION_TO_DEG);
    let y = Axis::linear("Deviation from the cosine", "%", reach.0 - margin, reach.1 + margin);
    let mut chart = Chart::new("Deviation from the cosine", &subtitle(sensors, "R(θ)/R(0) − 1"), x, y);
    let zero = vec![[from, 0.0], [DEVIATION_TO_DEG, 0.0]];
    chart.curves.push(Curve::new("cos θ", zero, Ink::Muted).behind());
    chart.curves.extend(curves);
    Ok(chart)
}

/// Every sensor in every plane that differs. Errors if there is no sensor.
pub(super) fn cuts(sensors: &[Sensor]) -> Result<Vec<Cut>, PlotError> {
    if sensors.is_empty() {
        return Err(PlotError::Nothing { what: "no sensor was asked for".to_owned() });
    }
    let cut = |sensor: &Sensor, phi_deg: Option<f64>| {
        let along_normal = sensor.acceptance.at(1.0, 0.0, 0.0);
        let largest = if let Acceptance::Directional(table) = &sensor.acceptance { table.max() } else { 1.0 };
        let plane = phi_deg.map(|deg| format!("φ = {deg:.0}°"));
        let label = match (plane, sensors.len()) {
            (Some(plane), 1) => plane,
            (Some(plane), _) => format!("{}, {plane}", sensor.title),
            (None, _) => sensor.title.clone(),
        };
        let unit = match sensor.acceptance.head() {
            // Along the normal, but for a cylinder, whose side it is.
            Some(head) => head.weight(DVec3::Z).max(head.weight(DVec3::X)),
            None if along_normal > 0.0 => along_normal,
            None => largest,
        };
        Cut { label, acceptance: sensor.acceptance.clone(), phi_rad: phi_deg.unwrap_or(0.0).to_radians(), unit }
    };
    Ok(sensors
        .iter()
        .flat_map(|sensor| match is_symmetric(&sensor.acceptance) {
            true => vec![cut(sensor, None)],
            false => PLANES_DEG.iter().map(|deg| cut(sensor, Some(*deg))).collect(),
        })
        .collect())
}

/// What is drawn, and where it is one.
pub(super) fn response_words(reach_deg: f64) -> [&'static str; 2] {
    if reach_deg > 90.0 { ["w(θ)", "1 at the largest"] } else { ["R(θ) cos θ", "1 along the normal"] }
}

/// How far from the normal a chart goes, degrees.
pub(super) fn reach_deg(cuts: &[Cut]) -> f64 {
    if cuts.iter().any(Cut::sees_all_round) { 180.0 } else { 90.0 }
}

fn is_symmetric(acceptance: &Acceptance) -> bool {
    match acceptance {
        Acceptance::Directional(table) => table.rotationally_symmetric().is_some(),
        other => *other != Acceptance::Semicylindrical,
    }
}

/// A curve of the palette; the second round of it is dashed.
pub(super) fn styled(label: &str, points: Vec<[f64; 2]>, index: usize) -> Curve {
    let dash = if index < 8 { Dash::Solid } else { Dash::Dashed };
    Curve::new(label, points, Ink::Palette(index)).dashed(dash)
}

/// The sensor, unless its name stands at its curve, and what was done.
pub(super) fn subtitle(sensors: &[Sensor], done: &str) -> String {
    match sensors {
        [one] if !is_symmetric(&one.acceptance) => format!("{}; {done}", one.title),
        _ => done.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensor::Aperture;

    fn ideal(acceptance: Acceptance) -> Sensor {
        Sensor::new("ideal", Aperture::Point, acceptance, Vec::new())
    }

    #[test]
    fn a_cosine_response_is_the_cosine() {
        let chart = directional(&[ideal(Acceptance::Cosine)]).unwrap();
        for [deg, response] in &chart.curves[1].points {
            assert!((response - deg.to_radians().cos().max(0.0)).abs() < 1e-12, "{deg}: {response}");
        }
        let flat = deviation(&[ideal(Acceptance::Cosine)]).unwrap();
        assert!(flat.curves[1].points.iter().all(|point| point[1] == 0.0));
    }

    #[test]
    fn a_cone_ends_at_its_half_angle() {
        let half = 20.3_f64.to_radians();
        let chart = directional(&[ideal(Acceptance::Cone { half_angle_rad: half })]).unwrap();
        for [deg, response] in &chart.curves[1].points {
            let expected = if deg.abs() < 20.2999 { deg.to_radians().cos() } else { 0.0 };
            assert!((deg.abs() - 20.3).abs() < 1e-3 || (response - expected).abs() < 1e-12, "{deg}: {response}");
        }
    }

    #[test]
    fn nothing_to_draw_is_told() {
        assert!(responsivity(&[]).is_err() && directional(&[]).is_err() && deviation(&[]).is_err());
        assert!(responsivity(&[ideal(Acceptance::Cosine)]).is_err());
    }
}
