//! The model of the curve in a calibration file.
//!
//! | model | the curve |
//! |---|---|
//! | `Smooth` | any smooth curve: what is taken without `model` |
//! | `SumOfGaussians(3)` | a sum of 1 to 8 bell curves |
//! | `FilterOnDetector(detector: "silicon.csv")` | a band of transmittance before a detector; the scale of the detector's curve does not count |
//! | `VisualPigment` | a dilute visual pigment: height and wavelength of its maximum |
//! | `VisualPigment(optical_density: 0.4)` | one of this peak optical density, or `Fitted` |

use super::calibration::CurveModel;
use super::decode::Value;
use super::document::{Body, Kind};
use super::factor_range::outside_of;
use super::reading::Reading;
use super::spectrum_reader::read_factor;
use crate::spectrum::Outside;

const FORMS: [&str; 4] = ["Smooth", "SumOfGaussians", "FilterOnDetector", "VisualPigment"];
/// Most bell curves of a sum.
const MOST_GAUSSIANS: f64 = 8.0;

/// Reads a model for a curve between these wavelengths, nm.
pub(super) fn read_curve_model(value: &Value, range_nm: (f64, f64), reading: &mut Reading) -> Option<CurveModel> {
    match value.variant("a model of the curve", &FORMS, &mut reading.problems)? {
        "Smooth" => value.without_brackets(&mut reading.problems).map(|()| CurveModel::Smooth),
        "SumOfGaussians" => {
            let count = value.positional(1, "SumOfGaussians(3)", &mut reading.problems)?;
            let allowed = |x: f64| x.fract() == 0.0 && (1.0..=MOST_GAUSSIANS).contains(&x);
            let count = count[0].number_in("the number of Gaussians", "whole numbers, 1 to 8", allowed, &mut reading.problems)?;
            Some(CurveModel::SumOfGaussians(count as usize))
        }
        "FilterOnDetector" => {
            let fields = value.fields("`FilterOnDetector`", &["detector"], &mut reading.problems)?;
            let given = fields.require("detector", "\"silicon.csv\"", &mut reading.problems)?;
            let detector = read_factor(&given, Outside::Zero, reading)?;
            if let Some((nm, found)) = outside_of(&detector, 0.0, f64::MAX) {
                let message = format!("the responsivity of the detector is {found} at {nm} nm");
                given.problem(&mut reading.problems, message, "allowed: 0 and above at every wavelength");
                return None;
            }
            if !detector.support().intervals().iter().any(|&(low, high)| low < range_nm.1 && high > range_nm.0) {
                let message = format!("the detector sees nothing within the curve, {} nm to {} nm", range_nm.0, range_nm.1);
                given.problem(&mut reading.problems, message, "give another detector, or widen `curve`");
                return None;
            }
            Some(CurveModel::FilterOnDetector(detector))
        }
        _ => read_pigment(value, reading),
    }
}

fn read_pigment(value: &Value, reading: &mut Reading) -> Option<CurveModel> {
    if matches!(&value.node.kind, Kind::Struct { body: Body::None, .. }) {
        return Some(CurveModel::DilutePigment);
    }
    let fields = value.fields("`VisualPigment`", &["optical_density"], &mut reading.problems)?;
    let given = fields.require("optical_density", "0.4", &mut reading.problems)?;
    if given.name() == "Fitted" {
        return given.without_brackets(&mut reading.problems).map(|()| CurveModel::PigmentOfUnknownDensity);
    }
    let allowed = "above 0, at most 10, decadic; or `Fitted`; without brackets the pigment is dilute";
    let density = given.number_in("the peak optical density", allowed, |x| x > 0.0 && x <= 10.0, &mut reading.problems)?;
    Some(CurveModel::Pigment(density))
}
