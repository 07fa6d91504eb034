//! Model densities: sums over steps, LEDs, phases of daylight.

use proptest::prelude::*;

use crate::spectrum::{Density, Factor, LED_WIDTH_OVER_FWHM, Line, Outside, SpectrumError, Table, black_body, daylight, library};

#[test]
fn a_sum_over_steps_is_the_sum_of_products() {
    let a = Density::illuminant_a();
    let v = library::v_lambda();
    let sum = a.summed(360.0, 830.0, 1.0).unwrap();
    let by_hand: f64 = (360..=830).map(|nm| a.continuum_at(f64::from(nm)) * v.at(f64::from(nm))).sum();
    assert!((sum.integral(&[&v]) / by_hand - 1.0).abs() < 1e-14);
    assert_eq!(sum.lines().len(), 471);
    assert_eq!(sum.continuum_at(555.0), 0.0);
}

#[test]
fn lines_stay_what_they_are_in_a_sum() {
    let lamp = Density::flat(400.0, 500.0, 2.0).unwrap().plus(&Density::line(546.07, 3.0).unwrap());
    let sum = lamp.summed(400.0, 500.0, 10.0).unwrap();
    assert_eq!(sum.lines().len(), 12);
    assert_eq!(sum.total(), 2.0 * 110.0 + 3.0);
    assert!(sum.lines().contains(&Line { wavelength_nm: 546.07, power: 3.0 }));
}

#[test]
fn the_last_step_is_taken_however_the_step_is_rounded() {
    let flat = Density::flat(1.0, 1000.0, 1.0).unwrap();
    for (from, to, step, rows) in [(380.0, 780.0, 0.1, 4001), (400.0, 400.9, 0.3, 4), (400.0, 401.0, 0.3, 4), (400.0, 499.9, 10.0, 10)] {
        assert_eq!(flat.summed(from, to, step).map(|sum| sum.lines().len()), Ok(rows), "{from} {to} {step}");
    }
    let tiny = Density::flat(0.0, 1.0, 1.0).unwrap();
    assert_eq!(tiny.summed(0.1, 0.7, 0.1).map(|sum| sum.lines().len()), Ok(7));
    for (from, to, step) in [(400.0, 300.0, 1.0), (400.0, 500.0, 0.0), (400.0, 500.0, -1.0), (400.0, 500.0, 1e-9), (f64::NAN, 500.0, 1.0)] {
        assert!(flat.summed(from, to, step).is_err(), "{from} {to} {step}");
    }
}

#[test]
fn scales_out_of_range_of_a_product_do_not_matter_to_a_sum() {
    let flat = Density::flat(400.0, 500.0, 1e-200).unwrap().scaled(1e-100).unwrap();
    let sum = flat.summed(400.0, 500.0, 1.0).unwrap();
    assert!((sum.integral(&[&Factor::Constant(1e300)]) - 101.0).abs() < 1e-12);
}

#[test]
fn daylight_meets_the_published_d65_within_its_rounding() {
    let formula = Density::daylight(6500.0 * daylight::NOMINAL_TO_CCT).unwrap();
    let table = library::density("D65").unwrap();
    let worst =
        (60..=166).map(|i| 5.0 * f64::from(i)).map(|nm| (formula.continuum_at(nm) - table.continuum_at(nm)).abs()).fold(0.0, f64::max);
    // M₁ and M₂ with three decimals instead of all move S by less than 0.0005 (|S₁| + |S₂|).
    assert!(worst < 0.06, "{worst}");
    assert!(worst > 0.0, "the coefficients are not rounded");
    assert!((formula.continuum_at(560.0) - 100.0).abs() < 1e-9);
}

#[test]
fn daylight_outside_of_its_range_is_an_error_that_names_it() {
    for cct_k in [3999.9, 25000.1, 0.0, -5000.0, f64::NAN, f64::INFINITY] {
        let error = Density::daylight(cct_k).unwrap_err();
        assert!(matches!(error, SpectrumError::Parameter { .. }));
        assert!(error.to_string().contains("4000 to 25000"), "{error}");
    }
    assert!(Density::daylight(4000.0).is_ok() && Density::daylight(25000.0).is_ok());
}

proptest! {
    #[test]
    fn daylight_is_never_negative_and_has_its_chromaticity_from_the_locus(cct_k in 4000.0..25000.0_f64) {
        prop_assert!(Density::daylight(cct_k).is_ok());
        let (x, y) = daylight::chromaticity(cct_k).unwrap();
        prop_assert!((0.24..0.40).contains(&x) && (0.24..0.40).contains(&y));
    }

    #[test]
    fn an_led_has_unit_area_its_peak_and_its_width(peak in 200.0..2000.0_f64, share in 1e-6..0.1_f64) {
        let fwhm = share * peak;
        let led = Density::led(peak, fwhm).unwrap();
        prop_assert!((led.total() - 1.0).abs() < 1e-12);
        let top = led.continuum_at(peak);
        for side in [-0.5, 0.5] {
            let half = led.continuum_at(peak + side * fwhm) / top;
            prop_assert!((half - 0.5).abs() < 1e-9, "{}", half);
        }
        // The formula as it is printed.
        let w = LED_WIDTH_OVER_FWHM * fwhm;
        for t in [0.1, 0.3, 1.0, 2.0_f64] {
            let g = (-(t * fwhm / w).powi(2)).exp();
            let printed = (g + 2.0 * g.powi(5)) / 3.0;
            prop_assert!((led.continuum_at(peak + t * fwhm) / top / printed - 1.0).abs() < 1e-8);
        }
    }
}

#[test]
fn cold_black_bodies_are_integrated_without_end_of_digits() {
    for kelvin in [1e-12, 1e-3, 1.0, 2.0, 1e7] {
        let body = Density::black_body(kelvin).unwrap();
        let reference = black_body::radiance_w_m2_sr(kelvin);
        assert!((body.total() / reference - 1.0).abs() < 1e-12, "{kelvin} K");
        assert!(body.integral(&[&library::v_lambda()]) >= 0.0);
    }
    // Far in the tail, scaled into the range of f64: ∫ L V dλ at 20 K is that of the last nanometres of V, near x = c₂/(λT) = 867.
    let tail = Density::black_body(20.0).unwrap().scaled(1e300).unwrap();
    let table = Factor::Table(Table::from_rows(&[(829.0, 1.0), (830.0, 1.0)], Outside::Zero).unwrap());
    let found = tail.integral(&[&table]);
    let nodes = 200_000;
    let step = 1.0 / f64::from(nodes);
    let middle = (0..nodes).map(|i| black_body::ln_spectral_radiance(829.0 + (f64::from(i) + 0.5) * step, 20.0));
    let expected: f64 = middle.map(|ln| (ln + 300.0 * std::f64::consts::LN_10).exp() * step).sum();
    assert!((found / expected - 1.0).abs() < 1e-8, "{found:e} {expected:e}");
    for wrong in [0.0, -1.0, 1e-13, 1e13, f64::NAN, f64::INFINITY] {
        assert!(Density::black_body(wrong).is_err(), "{wrong}");
    }
}
