//! The reference of a calibration file: a detector of known responsivity, read in the place of the sensor.
//!
//! ```ron
//! reference: Substitution(
//!     sensor: "trap-detector.ron", noise: (relative: 1e-4, absolute: 1e-13), alignment: 5e-4, stability: 2e-4,
//!     beam: (factor: 0.8, drift: -0.1),
//! ),
//! ```
//!
//! | key | meaning |
//! |---|---|
//! | `sensor` | a sensor file with one channel in A/W that states its standard uncertainty |
//! | `noise` | of its readings; as for the sensor |
//! | `alignment` | relative standard uncertainty of its place in the beam, common to all readings; 0 |
//! | `stability` | relative standard deviation of the beam from the one reading to the other; 0 |
//! | `beam` | how a simulated beam differs from the file: `factor`, power over nominal power, 1; `drift`, relative change until the last exposure, 0 |

use super::calibration::{Beam, Substitution};
use super::calibration_reader::read_noise;
use super::decode::{Fields, Value};
use super::reading::Reading;
use super::sensor_reader::read_sensor;

const KEYS: [&str; 5] = ["sensor", "noise", "alignment", "stability", "beam"];

/// The reference, `Some(None)` if the file has none.
pub(super) fn read_reference(fields: &Fields, reading: &mut Reading) -> Option<Option<Substitution>> {
    let Some(value) = fields.get("reference") else { return Some(None) };
    value.variant("a reference", &["Substitution"], &mut reading.problems)?;
    if let Some(scale) = fields.get("scale_uncertainty") {
        let help = "leave `scale_uncertainty` out: the uncertainty of the reference takes its place";
        scale.problem(&mut reading.problems, "the irradiance is measured by the reference, and its scale is stated as well", help);
    }
    let inner = value.fields("`Substitution`", &KEYS, &mut reading.problems)?;
    let sensor = inner.require("sensor", "\"trap-detector.ron\"", &mut reading.problems).and_then(|v| {
        let sensor = read_sensor(&v, reading)?;
        let wrong = match sensor.channels.as_slice() {
            [one] if !one.kind.is_absolute() => Some((
                format!("the responsivity of the reference \"{}\" is relative, and gives no scale", sensor.title),
                "give one in A/W: `responsivity: AmperesPerWatt(\"curve.csv\")`",
            )),
            [one] if one.responsivity_uncertainty.is_empty() => Some((
                format!("the responsivity of the reference \"{}\" has no uncertainty", sensor.title),
                "state it in the sensor file: `uncertainty_percent: 0.05`, or a third column of the curve",
            )),
            [_] => None,
            several => Some((format!("the reference has {} channels", several.len()), "keep the one that measures the light")),
        };
        if let Some((message, help)) = wrong {
            v.problem(&mut reading.problems, message, help);
            return None;
        }
        Some(sensor)
    });
    let noise = inner.require("noise", "(relative: 1e-4)", &mut reading.problems).and_then(|v| read_noise(&v, reading));
    let alignment = share(&inner, "alignment", reading);
    let stability = share(&inner, "stability", reading);
    let beam = match inner.get("beam") {
        None => Some(Beam { factor: 1.0, drift: 0.0 }),
        Some(given) => read_beam(&given, reading),
    };
    Some(Some(Substitution { sensor: sensor?, noise: noise?, alignment: alignment?, stability: stability?, beam: beam? }))
}

fn share(fields: &Fields, key: &str, reading: &mut Reading) -> Option<f64> {
    fields.get(key).map_or(Some(0.0), |given| {
        given.number_in(&format!("`{key}`"), "0 to 1, a share", |x| (0.0..=1.0).contains(&x), &mut reading.problems)
    })
}

fn read_beam(value: &Value, reading: &mut Reading) -> Option<Beam> {
    let fields = value.fields("the beam", &["factor", "drift"], &mut reading.problems)?;
    let factor = fields
        .get("factor")
        .map_or(Some(1.0), |v| v.number_in("`factor`", "above 0, up to 1000", |x| x > 0.0 && x <= 1e3, &mut reading.problems));
    let drift = fields.get("drift").map_or(Some(0.0), |v| {
        v.number_in("`drift`", "above -1, up to 10: power is left at the end", |x| x > -1.0 && x <= 10.0, &mut reading.problems)
    });
    Some(Beam { factor: factor?, drift: drift? })
}
