//! Laws of the photodiode readout: closed forms of its noise, conservation, order, and the spread of noisy readings.

use proptest::prelude::*;

use super::*;
use crate::metrology::distribution::chi_squared_quantile;
use crate::quantity::constants::{BOLTZMANN_J_K, ELEMENTARY_CHARGE_C};

fn diode(ohms: &[f64]) -> Photodiode {
    let ranges = ohms.iter().map(|&feedback_ohm| Range { feedback_ohm, error: 0.0 }).collect();
    Photodiode { saturation_v: Some(10.0), ..Photodiode::new(ranges, Bandwidth::Hertz(25.0)) }
}

fn noise(readout: &Readout, cause: Noise) -> f64 {
    readout.noise_a.iter().find(|(c, _)| *c == cause).map_or(0.0, |(_, a)| *a)
}

fn close(found: f64, expected: f64, relative: f64) -> bool {
    (found - expected).abs() <= relative * expected.abs()
}

#[test]
fn shot_and_johnson_noise_have_their_closed_forms() {
    let mut d = diode(&[1e7]);
    d.shunt_ohm = Some(1e8);
    d.dark = Some(DarkCurrent { current_a: 2e-9, reference_temperature_c: 25.0, doubling_k: 10.0, zeroed_at_c: Some(25.0) });
    d.temperature_c = 35.0;
    let readout = d.readout(1e-7);
    let (q, kt) = (ELEMENTARY_CHARGE_C, BOLTZMANN_J_K * 308.15);
    for (cause, variance) in [
        (Noise::Shot, 2.0 * q * 1e-7 * 25.0),
        (Noise::DarkShot, 2.0 * q * 4e-9 * 25.0),
        (Noise::Johnson, 4.0 * kt * 25.0 / 1e7),
        (Noise::ShuntJohnson, 4.0 * kt * 25.0 / 1e8),
    ] {
        assert!(close(noise(&readout, cause).powi(2), variance, 1e-12), "{cause:?}");
    }
    assert_eq!(readout.deviations_a, [(Deviation::Dark, 2e-9)]);
    assert!(close(readout.indicated_a, 1e-7 + 2e-9, 1e-12));
}

#[test]
fn flicker_noise_is_the_integral_of_its_density() {
    let mut d = diode(&[1e6]);
    let white = d.readout(1e-7).standard_deviation_a();
    d.flicker = Some(Flicker { corner_hz: 3.0, lowest_hz: 0.01 });
    // ∫ white² f_c/f df by the midpoint rule in ln f.
    let n = 1000;
    let step = (25.0_f64 / 0.01).ln() / f64::from(n);
    let integral: f64 = (0..n).map(|_| white * white / 25.0 * 3.0 * step).sum();
    assert!(close(noise(&d.readout(1e-7), Noise::Flicker).powi(2), integral, 1e-9));
    d.flicker = Some(Flicker { corner_hz: 3.0, lowest_hz: 30.0 });
    assert_eq!(noise(&d.readout(1e-7), Noise::Flicker), 0.0);
}

#[test]
fn photons_become_electrons_become_codes() {
    // 10¹¹ photons a second, η = 0.8: 12.8 nA; over 10 MΩ and 12 bits of 2 V.
    let (photons_per_s, efficiency) = (1e11, 0.8);
    let current_a = photons_per_s * efficiency * ELEMENTARY_CHARGE_C;
    let mut d = diode(&[1e7]);
    d.adc = Some(Adc { bits: 12, full_scale_v: 2.0 });
    let adc = d.adc.unwrap();
    let readout = d.readout(current_a);
    let code = adc.code(readout.voltage_v);
    let electrons_per_s = code * adc.step_v() / 1e7 / ELEMENTARY_CHARGE_C;
    let one_code_per_s = adc.step_v() / 1e7 / ELEMENTARY_CHARGE_C;
    assert!((electrons_per_s - photons_per_s * efficiency).abs() <= 0.5 * one_code_per_s * (1.0 + 1e-12));
    assert_eq!((adc.code(-1.0), adc.code(1e3)), (0.0, 4095.0));
}

#[test]
fn noisy_readings_scatter_as_stated() {
    let mut d = diode(&[1e6]);
    d.flicker = Some(Flicker { corner_hz: 10.0, lowest_hz: 0.1 });
    let (current_a, n) = (1e-8, 2000);
    let readout = d.readout(current_a);
    let s = readout.standard_deviation_a();
    let z: Vec<f64> = (0..n).map(|seed| (d.noisy_a(current_a, seed, &[3, 1]) - readout.indicated_a) / s).collect();
    let chi_squared: f64 = z.iter().map(|z| z * z).sum();
    let bounds = [0.0005, 0.9995].map(|p| chi_squared_quantile(p, n as f64).unwrap());
    assert!((bounds[0]..bounds[1]).contains(&chi_squared), "{chi_squared} of {bounds:?}");
    let mean = z.iter().sum::<f64>() / n as f64;
    assert!(mean.abs() < 3.5 / (n as f64).sqrt(), "{mean}");
    assert_eq!(d.noisy_a(current_a, 7, &[3, 1]), d.noisy_a(current_a, 7, &[3, 1]));
    assert_ne!(d.noisy_a(current_a, 7, &[3, 1]), d.noisy_a(current_a, 7, &[3, 2]));
}

#[test]
fn steps_of_the_converter_scatter_as_a_twelfth_of_their_square() {
    // Steps smaller than the noise: the quantisation is as good as independent.
    let mut d = diode(&[1e6]);
    d.bandwidth = Bandwidth::Hertz(1e6);
    let noise_v = d.readout(1e-8).standard_deviation_a() * 1e6;
    d.adc = Some(Adc { bits: 16, full_scale_v: 65536.0 * noise_v });
    d.saturation_v = None;
    let readout = d.readout(1e-8);
    assert!(close(noise(&readout, Noise::Converter), noise_v / 1e6 / 12f64.sqrt(), 1e-12));
    // Far from code zero, where the noise would be cut off.
    let current_a = 20.0 * noise_v / 1e6;
    let (readout, n) = (d.readout(current_a), 2000);
    let variance: f64 = (0..n).map(|seed| (d.noisy_a(current_a, seed, &[]) - readout.indicated_a).powi(2)).sum::<f64>() / n as f64;
    let ratio = variance / readout.standard_deviation_a().powi(2) * n as f64;
    let bounds = [0.0005, 0.9995].map(|p| chi_squared_quantile(p, n as f64).unwrap());
    assert!((bounds[0]..bounds[1]).contains(&ratio), "{ratio} of {bounds:?}");
}

#[test]
fn what_is_cut_off_is_said() {
    let d = diode(&[1e6, 1e4]);
    let over = d.readout(2e-3);
    assert_eq!((over.saturation, over.range, over.voltage_v), (Some(Saturation::Whole), 1, 10.0));
    assert!(close(over.indicated_a, 1e-3, 1e-12));
    assert!(d.readout(9e-4).saturation.is_none());
    let mut flickering = d.clone();
    flickering.bandwidth = Bandwidth::Integration(0.1);
    flickering.modulation = Some(Modulation { frequency_hz: 100.0, depth: 0.5, waveform: Waveform::Sine });
    assert_eq!(flickering.readout(9e-4).saturation, Some(Saturation::Crests));
    // The crests decide on the range.
    assert_eq!((d.range_for(8e-6), flickering.range_for(8e-6)), (0, 1));
}

#[test]
fn the_display_shows_as_many_digits_as_it_has() {
    let mut d = diode(&[1e6, 1e4]);
    d.display_digits = Some(4);
    // 1 nA per lx: 10 V over 1 MΩ are 10 000 lx, five digits before the point.
    assert_eq!(d.display_step(0, 1e-9), Some(10.0));
    assert_eq!(d.display_step(0, 5.1e-9), Some(1.0));
    assert_eq!(d.display_step(1, 1e-9), Some(1000.0));
}

#[test]
fn whole_periods_leave_no_ripple() {
    for waveform in [Waveform::Sine, Waveform::Square] {
        let m = Modulation { frequency_hz: 100.0, depth: 0.8, waveform };
        assert!(m.ripple(0.1) < 1e-15 && m.ripple(0.105) > 0.01);
    }
}

proptest! {
    #[test]
    fn deviations_add_up_to_the_whole(
        photocurrent in 1e-12..1e-2f64, per_a in -10.0..10.0f64, error in -0.01..0.01f64, celsius in -20.0..60.0f64,
    ) {
        let mut d = diode(&[1e6, 1e4]);
        d.ranges[0].error = error;
        d.nonlinearity = Some(Nonlinearity::Quadratic { per_a });
        d.temperature_c = celsius;
        d.dark = Some(DarkCurrent { current_a: 1e-9, reference_temperature_c: 25.0, doubling_k: 8.0, zeroed_at_c: Some(20.0) });
        let readout = d.readout(photocurrent);
        let whole = readout.indicated_a - photocurrent;
        let sum: f64 = readout.deviations_a.iter().map(|(_, a)| a).sum();
        prop_assert!((whole - sum).abs() <= 1e-13 * photocurrent.max(1e-9), "{} {}", whole, sum);
    }

    #[test]
    fn a_change_of_range_keeps_readings_in_order(currents in proptest::collection::vec(1e-12..1e-2f64, 2..20)) {
        let d = diode(&[1e8, 1e4, 1e6]);
        let mut currents = currents;
        currents.sort_by(f64::total_cmp);
        let readings: Vec<(f64, f64)> = currents.iter().map(|&a| {
            let readout = d.readout(a);
            (d.ranges[readout.range].feedback_ohm, readout.indicated_a)
        }).collect();
        prop_assert!(readings.windows(2).all(|w| w[0].0 >= w[1].0 && w[0].1 <= w[1].1), "{:?}", readings);
    }

    #[test]
    fn ripple_is_the_spread_of_means_over_the_phase(frequency in 1.0..500.0f64, seconds in 1e-3..0.2f64, square in any::<bool>()) {
        let m = Modulation { frequency_hz: frequency, depth: 0.7, waveform: if square { Waveform::Square } else { Waveform::Sine } };
        let n = 4000;
        let means: Vec<f64> = (0..n).map(|i| m.mean_over((f64::from(i) + 0.5) / f64::from(n), seconds) - 1.0).collect();
        let mean = means.iter().sum::<f64>() / f64::from(n);
        let rms = (means.iter().map(|x| x * x).sum::<f64>() / f64::from(n)).sqrt();
        prop_assert!(mean.abs() < 1e-6 && (rms - m.ripple(seconds)).abs() <= 1e-3 * rms + 1e-6, "{} {} {}", mean, rms, m.ripple(seconds));
    }

    #[test]
    fn a_saturating_current_stays_below_its_limit(current in 0.0..1e3f64) {
        let n = Nonlinearity::Saturating { limit_a: 1e-3 };
        prop_assert!(n.of_a(current) <= current && n.of_a(current) < 1e-3);
    }
}
