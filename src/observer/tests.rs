//! Laws and published figures of the observers.

use proptest::prelude::*;

use super::efficiency::{luminous, sp_ratio, sp_ratio_with};
use super::mesopic::{EFFICACY_RATIO, curve, max_efficacy_lm_w, mesopic};
use super::template::{alpha_band, govardovskii};
use super::*;
use crate::quantity::constants::K_M_LM_W;
use crate::spectrum::{Density, library};

fn assert_close(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "found {found:e}, expected {expected:e}");
}

/// Largest value of a table, and where.
fn peak(curve: &Factor) -> (f64, f64) {
    let at = curve.breakpoints().into_iter().map(|nm| (curve.at(nm), nm));
    at.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap()
}

#[test]
fn every_table_that_an_observer_asks_for_is_there() {
    let mut curves = Vec::new();
    curves.extend(Efficiency::ALL.map(Efficiency::curve));
    curves.extend(Matching::ALL.into_iter().flat_map(Matching::functions));
    curves.extend(AlphaOpic::ALL.map(AlphaOpic::curve));
    for cones in [Cones::StockmanSharpe2, Cones::StockmanSharpe10, Cones::Individual(Individual { age_yr: 32.0, field_deg: 2.0 })] {
        curves.extend(cones.fundamentals().unwrap());
    }
    for curve in &curves {
        assert!(matches!(curve, Factor::Table(_)), "{curve:?}");
        assert!(curve.at(480.0).is_finite());
    }
    assert!(Components::cie().is_ok());
    assert!(AlphaOpic::ALL.into_iter().all(|alpha| alpha.elr_of_d65().is_finite()));
}

#[test]
fn efficiencies_and_fundamentals_peak_at_one() {
    for efficiency in Efficiency::ALL {
        let (value, nm) = peak(&efficiency.curve());
        assert!((value - 1.0).abs() < 1e-4 && (500.0..=560.0).contains(&nm), "{}: {value} at {nm} nm", efficiency.name());
    }
    for cones in [Cones::StockmanSharpe2, Cones::StockmanSharpe10] {
        for (curve, near_nm) in cones.fundamentals().unwrap().iter().zip([569.0, 542.0, 445.0]) {
            let (value, nm) = peak(curve);
            assert!((value - 1.0).abs() < 1e-4 && (nm - near_nm).abs() <= 4.0, "{value} at {nm} nm");
        }
    }
    for alpha in AlphaOpic::ALL {
        assert!((peak(&alpha.curve()).0 - 1.0).abs() < 1e-4, "{}", alpha.name());
    }
}

/// 683 lm/W at 555.016 nm, whatever the observer. The tables are straight between nodes of 1 nm, which is worth 3e-5.
#[test]
fn a_watt_at_540_thz_is_683_lumens_to_every_observer() {
    for efficiency in Efficiency::ALL {
        let lumens = luminous(&Density::line(555.016, 1.0).unwrap(), efficiency);
        assert_close(lumens, 683.0, 3e-5);
        assert_eq!(Efficiency::named(efficiency.name()), Ok(efficiency));
        assert_eq!(Efficiency::named(efficiency.symbol()), Ok(efficiency));
    }
}

#[test]
fn the_second_matching_function_is_the_luminous_efficiency() {
    for set in Matching::ALL {
        assert_eq!(Matching::named(set.title()), Ok(set));
        let [_, middle, _] = set.functions();
        let Some(efficiency) = set.efficiency() else {
            assert!(set.functions().iter().all(|f| f.range_over(300.0, 900.0).0 < 0.0), "{}", set.title());
            continue;
        };
        let v = efficiency.curve();
        for nm in 400..=700 {
            let nm = f64::from(nm);
            assert!((middle.at(nm) - v.at(nm)).abs() < 2e-6, "{} at {nm} nm: {} and {}", set.title(), middle.at(nm), v.at(nm));
        }
    }
}

/// CIE S 026:2018, table 2, mW/lm; sums there, integrals here.
#[test]
fn efficacies_of_daylight_are_those_of_the_standard() {
    for (alpha, published) in AlphaOpic::ALL.into_iter().zip([0.8173, 1.4558, 1.6289, 1.4497, 1.3262]) {
        assert_close(1e3 * alpha.elr_of_d65(), published, 1e-4);
        assert_eq!(AlphaOpic::named(alpha.name()), Ok(alpha));
        let d65 = library::density("D65").unwrap();
        let lx = luminous(&d65, Efficiency::Photopic1924);
        assert_close(alpha.equivalent_daylight(&d65), lx, 1e-14);
        assert_close(alpha.daylight_efficacy_ratio(&d65).unwrap(), 1.0, 1e-14);
    }
    assert_eq!(AlphaOpic::Melanopic.daylight_efficacy_ratio(&Density::zero()), None);
}

/// CIE 170-1: fundamentals of the average observer of 32 years are those of Stockman and Sharpe, whose tables were made from templates of the
/// pigments every 0.1 nm and with other figures for the lens below 400 nm.
#[test]
fn the_individual_of_32_years_is_the_standard_observer() {
    for (field_deg, standard) in [(2.0, Cones::StockmanSharpe2), (10.0, Cones::StockmanSharpe10)] {
        let individual = Cones::Individual(Individual { age_yr: 32.0, field_deg }).fundamentals().unwrap();
        for ((mine, table), cone) in individual.iter().zip(standard.fundamentals().unwrap()).zip(Cone::ALL) {
            let worst = (390..=780).map(|nm| (mine.at(f64::from(nm)) - table.at(f64::from(nm))).abs()).fold(0.0, f64::max);
            assert!(worst < 4e-3, "{field_deg}° {}: {worst:e}", cone.name());
        }
    }
}

#[test]
fn ages_and_fields_out_of_range_are_errors_with_the_range() {
    let of = |age_yr, field_deg| Individual { age_yr, field_deg }.fundamentals().unwrap_err().to_string();
    assert_eq!(of(15.0, 2.0), "the age is 15; allowed: 20 yr to 80 yr");
    assert_eq!(of(30.0, 20.0), "the field is 20; allowed: 1° to 10°");
    assert!(of(f64::NAN, 2.0).contains("NaN"));
    let eye = Individual { age_yr: 30.0, field_deg: 2.0 };
    assert_eq!(eye.lens_density(1000.0).unwrap_err().to_string(), "the wavelength is 1000; allowed: 390 nm to 780 nm");
    assert!(mesopic(-1.0, 1.0).is_err() && mesopic(1.0, f64::NAN).is_err() && mesopic(f64::INFINITY, 1.0).is_err());
    assert!(curve(1.1).is_err() && max_efficacy_lm_w(-0.1).is_err());
    assert!(govardovskii(250.0, 500.0).is_err() && govardovskii(500.0, f64::NAN).is_err());
    assert!(Matching::named("CIE 1932").unwrap_err().to_string().contains("allowed: CIE 1931, CIE 1964"));
    assert!(AlphaOpic::named("melatopic").is_err() && Efficiency::named("").is_err());
}

#[test]
fn components_that_are_no_functions_of_wavelength_are_errors() {
    let with = |nm: &[f64], macula: &[f64]| {
        let ones = vec![1.0; 2];
        Components::new(nm.to_vec(), [ones.clone(), ones.clone(), ones.clone()], macula.to_vec(), [ones.clone(), ones])
    };
    assert!(with(&[400.0, 500.0], &[0.1, 0.2]).is_ok());
    assert!(with(&[500.0, 400.0], &[0.1, 0.2]).is_err());
    assert!(with(&[400.0, 500.0], &[0.1]).is_err());
    assert!(with(&[400.0, 500.0], &[0.1, -0.2]).is_err());
    assert!(with(&[400.0, 500.0], &[0.1, f64::NAN]).is_err());
    let blind = Components::new(vec![400.0, 500.0], [vec![0.0; 2], vec![1.0; 2], vec![1.0; 2]], vec![0.0; 2], [vec![0.0; 2], vec![0.0; 2]]);
    assert!(blind.unwrap().fundamentals(Individual { age_yr: 30.0, field_deg: 2.0 }).is_err());
}

#[test]
fn mesopic_ends_are_photopic_and_scotopic() {
    let (v, v_prime) = (Efficiency::Photopic1924.curve(), Efficiency::Scotopic1951.curve());
    for nm in 380..=780 {
        let nm = f64::from(nm);
        assert_close(curve(1.0).unwrap().at(nm), v.at(nm), 1e-15);
        assert_close(curve(0.0).unwrap().at(nm), v_prime.at(nm), 1e-15);
    }
    assert_eq!(max_efficacy_lm_w(1.0), Ok(K_M_LM_W));
    assert_close(max_efficacy_lm_w(0.0).unwrap(), 1699.0 * K_M_LM_W / 683.0, 1e-15);
    assert_eq!(mesopic(10.0, 2.5), Ok(Mesopic { adaptation: 1.0, luminance_cd_m2: 10.0 }));
    assert_eq!(mesopic(0.0, 2.5), Ok(Mesopic { adaptation: 0.0, luminance_cd_m2: 0.0 }));
    assert!(mesopic(0.5, 0.0).unwrap().luminance_cd_m2 > 0.0);
}

/// The plain iteration of CIE 191, for comparison.
fn iterated(photopic: f64, ratio: f64) -> f64 {
    let (v, mut m) = (683.0 / 1699.0, 0.5);
    for _ in 0..200_000 {
        let luminance = (m * photopic + (1.0 - m) * ratio * photopic * v) / (m + (1.0 - m) * v);
        m = (0.7670 + 0.3334 * luminance.log10()).clamp(0.0, 1.0);
    }
    m
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn mesopic_luminance_is_where_the_published_iteration_ends(log_l in -4.0..2.0_f64, log_ratio in -2.0..1.0_f64) {
        let (photopic, ratio) = (10f64.powf(log_l), 10f64.powf(log_ratio));
        let found = mesopic(photopic, ratio).unwrap();
        prop_assert!((found.adaptation - iterated(photopic, ratio)).abs() < 1e-6);
        let (low, high) = (photopic.min(ratio * photopic), photopic.max(ratio * photopic));
        prop_assert!(low * (1.0 - 1e-14) <= found.luminance_cd_m2 && found.luminance_cd_m2 <= high * (1.0 + 1e-14));
    }

    #[test]
    fn mesopic_luminance_is_the_integral_with_its_own_curve(log_l in -3.0..1.0_f64, kelvin in 1500.0..10_000.0_f64) {
        let lamp = Density::black_body(kelvin).unwrap();
        let lamp = lamp.scaled(10f64.powf(log_l) / luminous(&lamp, Efficiency::Photopic1924)).unwrap();
        let state = mesopic(10f64.powf(log_l), sp_ratio_with(&lamp, EFFICACY_RATIO).unwrap()).unwrap();
        let direct = max_efficacy_lm_w(state.adaptation).unwrap() * lamp.integral(&[&curve(state.adaptation).unwrap()]);
        prop_assert!((state.luminance_cd_m2 / direct - 1.0).abs() < 1e-12);
    }

    #[test]
    fn an_eye_absorbs_a_share_between_none_and_all(age_yr in 20.0..80.0_f64, field_deg in 1.0..10.0_f64, nm in 390.0..780.0_f64) {
        let eye = Individual { age_yr, field_deg };
        for cone in Cone::ALL {
            let (inside, outside) = (eye.absorptance(cone, nm).unwrap(), eye.quantal_sensitivity(cone, nm).unwrap());
            prop_assert!(0.0 <= outside && outside <= inside && inside < 1.0);
        }
        // An older lens is denser, a smaller field has more macular pigment.
        let older = Individual { age_yr: (age_yr + 5.0).min(80.0), ..eye };
        prop_assert!(older.lens_density(nm).unwrap() >= eye.lens_density(nm).unwrap());
        let wider = Individual { field_deg: (field_deg + 1.0).min(10.0), ..eye };
        prop_assert!(wider.macular_density(nm).unwrap() <= eye.macular_density(nm).unwrap());
        for fundamental in eye.fundamentals().unwrap() {
            let (least, most) = fundamental.range_over(0.0, 2000.0);
            prop_assert!(least >= 0.0 && most == 1.0);
        }
    }

    #[test]
    fn equivalent_daylight_does_not_depend_on_the_scale(log_scale in -250.0..250.0_f64) {
        let lamp = library::density("LED-B3").unwrap();
        let scaled = lamp.scaled(10f64.powf(log_scale)).unwrap();
        for alpha in AlphaOpic::ALL {
            let (a, b) = (alpha.daylight_efficacy_ratio(&lamp).unwrap(), alpha.daylight_efficacy_ratio(&scaled).unwrap());
            prop_assert!((a / b - 1.0).abs() < 1e-13);
        }
        prop_assert!((sp_ratio(&scaled).unwrap() / sp_ratio(&lamp).unwrap() - 1.0).abs() < 1e-13);
    }

    #[test]
    fn a_pigment_peaks_where_its_template_says(lambda_max_nm in 357.0..620.0_f64) {
        let peak = alpha_band(lambda_max_nm, lambda_max_nm).unwrap();
        prop_assert!((peak - 1.0).abs() < 0.01);
        prop_assert!(alpha_band(lambda_max_nm, lambda_max_nm - 10.0).unwrap() < peak);
        prop_assert!(alpha_band(lambda_max_nm, lambda_max_nm + 10.0).unwrap() < peak);
    }
}
