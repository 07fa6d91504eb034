//! Linearity: a reading is proportional to the strength of the sources and to the responsivity, and additive in the responsivity.

use proptest::prelude::*;

use crate::bench::{EXACT, apart, exact, measured, room, samples};

/// Three channels f, g and a f + b g under one lamp, in a room if it reflects.
fn channels(a: f64, b: f64, rho: f64, watts: f64) -> String {
    let (f, g) = ("\"V\"", "Gaussian(peak: 0.8, centre_nm: 450, fwhm_nm: 60)");
    format!(
        r#"Scene(
            surfaces: {{ "paint": Lambertian({rho}) }},
            objects: [(name: "walls", shape: Box(size: (2, 2, 2)), at: (-1, -1, -1), surface: "paint", seen_from: Inside)],
            sources: [(name: "lamp", shape: Disc(0.2), at: (0.1, 0.2, 0.9), facing: (0, 0.1, -1), strength: Watts({watts:e}), spectrum: "A")],
            instruments: [(name: "m", at: (0.3, -0.2, -0.5), facing: (0, 0.3, 1), sensor: Sensor(aperture: Point, acceptance: Cosine, channels: [
                (name: "f", responsivity: {f}, reads: Irradiance),
                (name: "g", responsivity: {g}, reads: Irradiance),
                (name: "af+bg", responsivity: Sum([Scaled({a:e}, {f}), Scaled({b:e}, {g})]), reads: Irradiance),
            ]))],
        )"#
    )
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(16) })]

    #[test]
    fn readings_are_linear_in_the_responsivity(a in 1e-3..1e3_f64, b in 1e-3..1e3_f64) {
        let direct = exact(&channels(a, b, 0.0, 1.0));
        prop_assert!(apart(direct[2], a * direct[0] + b * direct[1]) < EXACT, "{direct:?}");
        // One run of paths serves all channels, so that reflections are as linear as formulas.
        let all: Vec<f64> = measured(&channels(a, b, 0.6, 1.0), &samples(1 << 8), 5).readings.iter().map(|r| r.value).collect();
        prop_assert!(all[0] > 1.01 * direct[0]);
        prop_assert!(apart(all[2], a * all[0] + b * all[1]) < EXACT, "{all:?}");
    }

    #[test]
    fn readings_are_proportional_to_the_strength(exponent in -12..12_i32, seed in 0..1000_u64) {
        let k = 10f64.powi(exponent);
        let (one, more) = (exact(&channels(1.0, 1.0, 0.0, 1.0)), exact(&channels(1.0, 1.0, 0.0, k)));
        let read = |k: f64| -> Vec<(f64, f64)> {
            measured(&room(1.0, 0.6, 5.0 * k, k), &samples(1 << 8), seed).readings.iter().map(|r| (r.value, r.standard_uncertainty())).collect()
        };
        for (one, more) in one.iter().zip(&more) {
            prop_assert!(apart(*more, k * one) < EXACT);
        }
        for (one, more) in read(1.0).iter().zip(read(k)) {
            prop_assert!(apart(more.0, k * one.0) < EXACT && apart(more.1, k * one.1) < 1e-6, "{one:?} {more:?}");
        }
    }
}
