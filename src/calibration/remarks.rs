//! What a reader of a fit has to be told beside its numbers: readings that state no noise and yet are not explained, channels that see nothing.
//!
//! Readings without noise are held to their rounding. If the curve misses them by more, the rest of the model is wrong by that much (nodes too coarse,
//! readings that contradict each other), and no band knows of it.

use super::exposures::Readings;
use super::fit::FittedCurve;

/// Roundings of a reading that a fit itself may add up to.
const ROUNDINGS: f64 = 1e4;
/// Standard uncertainties that a reading of nothing stays within; of 400 readings one in ten sets has one beyond.
const NOTHING: f64 = 3.5;

/// What is to be said of a channel.
pub(super) fn of(curve: &FittedCurve, readings: &Readings) -> Vec<String> {
    let mut said = Vec::new();
    let m = readings.values.len() as f64;
    let largest = readings.values.iter().fold(0.0f64, |most, y| most.max(y.abs()));
    let without_noise = readings.standard_uncertainties.contains(&0.0);
    let times = (curve.chi_squared / m).sqrt();
    if without_noise && times > ROUNDINGS {
        said.push(format!(
            "{}: some readings state no uncertainty, and the curve misses them by {times:.1e} times their rounding (RMS): its own uncertainty holds only for \
             readings without any error and a curve that is linear between its nodes; state the uncertainties, or give finer nodes",
            curve.channel
        ));
    }
    if readings.values.iter().zip(&readings.standard_uncertainties).all(|(y, u)| y.abs() <= NOTHING * u) {
        said.push(format!(
            "{}: no reading differs from zero by more than its noise (the largest is {largest:.2e}): the channel saw nothing, and its curve is no more than an upper \
             limit; is it connected?",
            curve.channel
        ));
    }
    said
}
