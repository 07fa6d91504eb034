//! Laws of the sheet.

use super::*;
use crate::observer::AlphaOpic;
use crate::spectrum::{Factor, Outside, Table};
use proptest::prelude::*;

fn sheet(name: &str) -> SpectrumSheet {
    SpectrumSheet::new(&library::density(name).unwrap(), &SheetOptions::default()).unwrap()
}

fn number(sheet: &SpectrumSheet, id: &str) -> f64 {
    sheet.number(id).unwrap_or_else(|| panic!("{id}: {:?}", sheet.row(id)))
}

fn close(a: f64, b: f64, relative: f64) -> bool {
    (a - b).abs() <= relative * b.abs()
}

#[test]
fn ids_are_unique_and_units_are_stated() {
    let sheet = sheet("D65");
    for (i, row) in sheet.rows.iter().enumerate() {
        assert!(sheet.rows[..i].iter().all(|other| other.id != row.id), "{}", row.id);
        assert!(!row.unit.is_empty() || matches!(row.value, SheetValue::Text(_)), "{}", row.id);
    }
}

#[test]
fn an_absolute_spectrum_keeps_its_numbers() {
    // A milliwatt at 555 nm is 0.683 lm; 1 W/m² of it are 683 lx, and 555.15414 nm in vacuum over hc N_A is 4.6407 µmol/J.
    let laser = Density::line(555.0, 1e-3).unwrap();
    let flux = SheetOptions { scale: Scale::Absolute(SpectralQuantity::Flux), ..SheetOptions::default() };
    let flux = SpectrumSheet::new(&laser, &flux).unwrap();
    assert!(close(number(&flux, "luminous"), 0.683_002, 1e-12));
    assert_eq!(flux.row("luminous").unwrap().unit, "lm");
    assert!(flux.row("mel_equivalent_daylight").is_none());
    let irradiance = SheetOptions { scale: Scale::Irradiance(1.0), ..SheetOptions::default() };
    let irradiance = SpectrumSheet::new(&laser, &irradiance).unwrap();
    assert!(close(number(&irradiance, "luminous"), 683.002, 1e-12));
    assert!(close(number(&irradiance, "photosynthetic_photon"), 555.154144781 / 119.626_565_6, 2e-8));
}

#[test]
fn daylight_is_its_own_equivalent() {
    let sheet = sheet("D65");
    for receptor in AlphaOpic::ALL {
        assert!(close(number(&sheet, &format!("{}_equivalent_daylight", receptor.index())), 1000.0, 1e-12));
        assert!(close(number(&sheet, &format!("{}_daylight_ratio", receptor.index())), 1.0, 1e-12));
    }
}

#[test]
fn what_is_invisible_is_scaled_in_watts_and_says_so() {
    let infrared = Density::gaussian(1.0, 950.0, 12.0).unwrap();
    let sheet = SpectrumSheet::new(&infrared, &SheetOptions::default()).unwrap();
    assert!(close(number(&sheet, "radiant"), 1.0, 1e-12));
    assert!(sheet.remarks.iter().any(|remark| remark.contains("1 W/m²")));
    let dark = Density::line(10_000.0, 1.0).unwrap();
    let sheet = SpectrumSheet::new(&dark, &SheetOptions::default()).unwrap();
    assert!(matches!(&sheet.row("chromaticity_x_1931").unwrap().value, SheetValue::Undefined(why) if why.contains("visible")));
    let asked = SheetOptions { scale: Scale::Illuminance(500.0), ..SheetOptions::default() };
    assert!(matches!(SpectrumSheet::new(&dark, &asked), Err(ObserverError::Zero { .. })));
    assert!(matches!(SpectrumSheet::new(&Density::zero(), &SheetOptions::default()), Err(ObserverError::Zero { .. })));
}

#[test]
fn what_lies_beyond_the_table_is_said() {
    let rows = [(400.0, 1.0), (700.0, 1.0)];
    let density = Density::table(Table::from_rows(&rows, Outside::Zero).unwrap()).unwrap();
    let options = SheetOptions { range_nm: Some((400.0, 700.0)), ..SheetOptions::default() };
    let sheet = SpectrumSheet::new(&density, &options).unwrap();
    let remark = sheet.remarks.iter().find(|remark| remark.contains("400 nm to 700 nm")).unwrap();
    assert!(remark.contains("of V(λ)") && !remark.contains("photosynthetic"), "{remark}");
}

#[test]
fn bad_options_are_refused() {
    let refused = |options: SheetOptions| SpectrumSheet::new(&Density::illuminant_a(), &options).is_err();
    let standard = SheetOptions::default;
    assert!(refused(SheetOptions { scale: Scale::Illuminance(-1.0), ..standard() }));
    assert!(refused(SheetOptions { scale: Scale::Irradiance(f64::NAN), ..standard() }));
    assert!(refused(SheetOptions { adaptation_cd_m2: -1.0, ..standard() }));
    assert!(refused(SheetOptions { white: "D66".into(), ..standard() }));
    let short = RowUncertainty { wavelengths_nm: vec![1.0, 2.0], standard_uncertainty: vec![0.1], correlated: false };
    assert!(refused(SheetOptions { uncertainty: Some(short), ..standard() }));
}

/// A spectrum of a LED with a few per cent of uncertainty a row.
fn uncertain_led() -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    let wavelengths_nm: Vec<f64> = (0..81).map(|i| 380.0 + 5.0 * f64::from(i)).collect();
    let led = library::density("LED-B3").unwrap();
    let largest = wavelengths_nm.iter().map(|nm| led.continuum_at(*nm)).fold(0.0, f64::max);
    // Far enough from zero that no trial has to be cut there.
    let values: Vec<f64> = wavelengths_nm.iter().map(|nm| led.continuum_at(*nm) / largest + 0.05).collect();
    // A tilt: what all rows have in common would leave no trace in a chromaticity.
    let u = wavelengths_nm.iter().zip(&values).map(|(nm, value)| 0.02 * value * (nm - 350.0) / 200.0).collect();
    (wavelengths_nm, values, u)
}

fn of_rows(wavelengths_nm: &[f64], values: Vec<f64>, options: &SheetOptions) -> SpectrumSheet {
    let table = Table::new(wavelengths_nm.to_vec(), values, Outside::Zero).unwrap();
    SpectrumSheet::new(&Density::table(table).unwrap(), options).unwrap()
}

/// Standard deviation over trials with the rows moved, against the propagated one.
#[test]
fn propagated_uncertainties_are_those_of_a_monte_carlo() {
    const TRIALS: usize = 200;
    let (wavelengths_nm, values, u) = uncertain_led();
    let ids = [
        "radiant",
        "luminous_efficacy",
        "photosynthetic_photon",
        "sp_ratio",
        "mesopic",
        "mel_equivalent_daylight",
        "chromaticity_x_1931",
        "chromaticity_v_prime_1964",
        "tristimulus_z_1931",
        "cct",
        "duv",
        "dominant_wavelength",
        "excitation_purity",
        "centroid_wavelength",
        "s_cone_2_degree",
        "l_cone_10_degree",
    ];
    for correlated in [false, true] {
        let uncertainty = RowUncertainty { wavelengths_nm: wavelengths_nm.clone(), standard_uncertainty: u.clone(), correlated };
        let scale = Scale::Absolute(SpectralQuantity::Irradiance);
        let propagated =
            of_rows(&wavelengths_nm, values.clone(), &SheetOptions { scale, uncertainty: Some(uncertainty), ..SheetOptions::default() });
        let mut state = 1_u64;
        // Sum of twelve uniform numbers: variance one.
        let mut normal = || {
            (0..12).fold(-6.0, |sum, _| {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                sum + (state >> 11) as f64 / (1_u64 << 53) as f64
            })
        };
        let mut found: Vec<Vec<f64>> = vec![Vec::new(); ids.len()];
        for _ in 0..TRIALS {
            let common = normal();
            let moved: Vec<f64> = values.iter().zip(&u).map(|(value, u)| value + u * if correlated { common } else { normal() }).collect();
            let sheet = of_rows(&wavelengths_nm, moved, &SheetOptions { scale, ..SheetOptions::default() });
            ids.iter().zip(&mut found).for_each(|(id, list)| list.push(number(&sheet, id)));
        }
        for (id, list) in ids.iter().zip(found) {
            let mean = list.iter().sum::<f64>() / TRIALS as f64;
            let deviation = (list.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (TRIALS - 1) as f64).sqrt();
            let u = propagated.row(id).unwrap().standard_uncertainty.unwrap();
            // The deviation of 200 trials is good to 1/√400 = 5 %; four times that.
            assert!(close(deviation, u, 0.2), "{id}, correlated {correlated}: {deviation:e} against {u:e}");
        }
    }
}

#[test]
fn a_common_factor_does_not_reach_ratios_and_a_scaled_quantity_is_exact() {
    let (wavelengths_nm, values, _) = uncertain_led();
    let u = values.iter().map(|value| 0.03 * value).collect();
    let uncertainty = Some(RowUncertainty { wavelengths_nm: wavelengths_nm.clone(), standard_uncertainty: u, correlated: true });
    let sheet = of_rows(&wavelengths_nm, values, &SheetOptions { uncertainty, ..SheetOptions::default() });
    for id in ["luminous", "sp_ratio", "chromaticity_x_1931", "luminous_efficacy", "mel_daylight_ratio"] {
        let row = sheet.row(id).unwrap();
        let SheetValue::Number(value) = row.value else { panic!("{row:?}") };
        assert!(row.standard_uncertainty.unwrap() < 1e-8 * value.abs(), "{row:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn hat_weights_give_the_exact_integral(values in prop::collection::vec(0.0..10.0_f64, 12), start in 350.0..500.0_f64, step in 0.3..40.0_f64) {
        let wavelengths_nm: Vec<f64> = (0..12).map(|i| start + step * f64::from(i)).collect();
        let density = Density::table(Table::new(wavelengths_nm.clone(), values.clone(), Outside::Zero).unwrap()).unwrap();
        let band = Factor::Band { from_nm: 420.3, to_nm: 633.3, value: 2.0 };
        for factor in [library::v_lambda(), Factor::Proportional(0.3), band.clone(), Factor::Product(vec![Factor::Proportional(1.0), band])] {
            let sum: f64 = functional::hat_weights(&wavelengths_nm, &factor).iter().zip(&values).map(|(w, v)| w * v).sum();
            let exact = density.integral(&[&factor]);
            prop_assert!((sum - exact).abs() <= 1e-12 * exact.abs().max(1e-9), "{sum} {exact}");
        }
    }

    #[test]
    fn the_scale_of_a_relative_spectrum_does_not_matter(exponent in -290.0..290.0_f64) {
        let density = library::density("FL2").unwrap();
        let scaled = density.scaled(10f64.powf(exponent)).unwrap();
        let [a, b] = [density, scaled].map(|density| SpectrumSheet::new(&density, &SheetOptions::default()).unwrap());
        for (row, other) in a.rows.iter().zip(&b.rows) {
            match (&row.value, &other.value) {
                // Duv is a difference of chromaticities, whose own rounding stays.
                (SheetValue::Number(x), SheetValue::Number(y)) => prop_assert!((x - y).abs() <= 1e-11 * x.abs().max(1.0), "{row:?} {y}"),
                (x, y) => prop_assert_eq!(x, y),
            }
        }
    }
}
