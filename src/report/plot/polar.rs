//! Directional responses in polar coordinates: the normal points up, the radius is the response.
//!
//! ```text
//! (x, y) = r(θ) (sin θ, cos θ),   r(θ) = R(θ) cos θ / R(0)
//! ```
//!
//! The cosine is then a circle of diameter one that touches the aperture. Circles stand for equal responses, spokes for equal angles.

use crate::sensor::Sensor;

use super::PlotError;
use super::chart::{Anchor, Axis, Chart, Curve, Ink, Note};
use super::sample::every;
use super::sensor::{Cut, cuts, reach_deg, response_words, styled, subtitle};

/// Response over the angle of incidence in polar coordinates, with the cosine behind. Errors if there is no sensor.
pub fn chart(sensors: &[Sensor]) -> Result<Chart, PlotError> {
    let cuts = cuts(sensors)?;
    let reach_deg = reach_deg(&cuts);
    let [what, one] = response_words(reach_deg);
    let curve = |cut: &Cut| -> Vec<[f64; 2]> { cut.angles_rad(-reach_deg, reach_deg).into_iter().map(|t| at(cut.to_beam(t), t)).collect() };
    let drawn: Vec<Vec<[f64; 2]>> = cuts.iter().map(curve).collect();
    let largest = drawn.iter().flatten().map(|p| p[0].hypot(p[1])).fold(1.0, f64::max);
    // A response that is larger along some other direction by a hair does not need another circle.
    let rim = 0.25 * (4.0 * largest - 0.05).ceil();
    let hidden = |from: f64, to: f64| Axis { visible: false, ..Axis::linear(&format!("Relative response {what}"), one, from, to) };
    let done = format!("response {what} to a parallel beam, {one}");
    let mut chart = Chart::new(
        "Directional response",
        &subtitle(sensors, &done),
        hidden(-1.18 * rim, 1.18 * rim),
        hidden(if reach_deg > 90.0 { -1.13 * rim } else { -0.12 * rim }, 1.13 * rim),
    );
    chart.equal_scale = true;
    chart.proportion = Some(if reach_deg > 90.0 { 1.0 } else { 0.58 });
    grid(&mut chart, rim, reach_deg);
    let cosine = every(-90.0, 90.0, 1.0).into_iter().map(f64::to_radians).map(|t| at(t.cos().max(0.0), t)).collect();
    chart.curves.push(Curve::new("cos θ", cosine, Ink::Muted).behind());
    chart.curves.extend(cuts.iter().zip(drawn).enumerate().map(|(index, (cut, points))| styled(&cut.label, points, index)));
    Ok(chart)
}

/// A radius in a direction.
fn at(radius: f64, theta_rad: f64) -> [f64; 2] {
    [radius * theta_rad.sin(), radius * theta_rad.cos()]
}

/// Half circles every quarter and spokes every 15°, with their numbers.
fn grid(chart: &mut Chart, rim: f64, reach_deg: f64) {
    let thin = |label: &str, points| Curve { width: 0.5, ..Curve::new(label, points, Ink::Grid).unwritten() };
    let note = |text: String, at: [f64; 2], shift_em: [f64; 2], anchor| Note { text, at, shift_em, anchor, ink: Ink::Muted };
    let circles = (4.0 * rim).round() as u32;
    for quarter in 1..=circles {
        let radius = 0.25 * f64::from(quarter);
        let circle = every(-reach_deg, reach_deg, 1.0).into_iter().map(|d| at(radius, d.to_radians())).collect();
        chart.curves.push(thin(&format!("response {radius}"), circle));
        if circles <= 6 || quarter % 2 == 0 {
            let place = at(radius, std::f64::consts::FRAC_PI_2);
            chart.notes.push(note(format!("{radius}"), place, [0.0, -0.9], Anchor::Middle));
        }
    }
    chart.notes.push(note("0".to_owned(), [0.0, 0.0], [0.0, -0.9], Anchor::Middle));
    chart.notes.push(note(format!("{} (1)", response_words(reach_deg)[0]), [-0.5 * rim, 0.0], [0.0, -0.9], Anchor::Middle));
    let spokes = (reach_deg / 15.0) as i32;
    // 180° on either side is the same spoke.
    for step in if spokes == 12 { -11 } else { -spokes }..=spokes {
        let degrees = 15.0 * f64::from(step);
        let theta = degrees.to_radians();
        chart.curves.push(thin(&format!("θ = {degrees}°"), vec![[0.0, 0.0], at(rim, theta)]));
        if step % 2 == 0 {
            let (sin, cos) = theta.sin_cos();
            let anchor = if step == 0 { Anchor::Middle } else { [Anchor::End, Anchor::Start][usize::from(step > 0)] };
            let name = if step == 0 { "θ = " } else { "" };
            chart.notes.push(note(format!("{name}{:.0}°", degrees.abs()), at(rim, theta), [0.5 * sin, 0.9 * cos], anchor));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensor::{Acceptance, Aperture};

    #[test]
    fn a_cosine_response_is_a_circle_of_diameter_one() {
        let sensor = Sensor::new("ideal", Aperture::Point, Acceptance::Cosine, Vec::new());
        let chart = chart(&[sensor]).unwrap();
        let curve = chart.curves.iter().find(|curve| curve.label == "ideal").unwrap();
        assert!(curve.points.iter().all(|[x, y]| (x.hypot(y - 0.5) - 0.5).abs() < 1e-12));
    }
}
