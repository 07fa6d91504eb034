//! Noise of the readings, from none to a tenth of the largest.

use super::super::{Curve, Point, Sweep};
use super::design::{lux_meter, made, nodes, point, sets, sources, two_bands};

pub(in super::super) const SWEEP: Sweep = Sweep {
    name: "fit-noise",
    parameter: "noise over the largest reading",
    unit: "1",
    law: "the true curve, within bands of 99 % at 95 % of the nodes",
    points,
};

/// From no noise at all to a tenth.
const NOISES: [f64; 9] = [0.1, 0.03, 1e-2, 1e-3, 1e-4, 1e-6, 1e-9, 1e-12, 0.0];
/// Sets of readings of a point.
const SETS: u64 = 6;

fn points() -> Vec<Point> {
    let nodes = nodes(5.0);
    // A scan as a monochromator gives it, as filters give it, and what eleven LEDs show.
    let designs: [(&'static str, usize, f64, Curve); 4] = [
        ("scan, 10 nm", 81, 10.0, lux_meter),
        ("scan, two bands", 81, 10.0, two_bands),
        ("broad, 60 nm", 41, 60.0, lux_meter),
        ("LEDs", 11, 25.0, lux_meter),
    ];
    let one = |(name, count, fwhm_nm, curve): (&'static str, usize, f64, Curve), noise: f64| {
        let exposures = sources(&nodes, count, fwhm_nm)?;
        let truth = curve(&nodes);
        let sets = sets(&exposures, &truth, noise, SETS);
        Ok(point(name, noise, exposures, sets, truth))
    };
    made(designs.into_iter().flat_map(|d| NOISES.into_iter().map(move |noise| (d, noise))).map(|(d, noise)| one(d, noise)).collect())
}
