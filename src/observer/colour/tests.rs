//! Laws of colour.

use super::*;
use crate::observer::Matching;
use crate::spectrum::{Density, Factor, library};
use proptest::prelude::*;

fn matching() -> [Factor; 3] {
    Matching::Cie1931.functions()
}

fn chromaticity_of(density: &Density) -> Chromaticity {
    Tristimulus::of(density, &matching()).chromaticity().unwrap()
}

fn close(a: f64, b: f64, relative: f64) -> bool {
    (a - b).abs() <= relative * b.abs()
}

#[test]
fn a_black_body_has_its_own_temperature_and_lies_on_the_locus() {
    let locus = PlanckianLocus::new(&matching());
    for kelvin in [1000.0, 1001.0, 1500.0, 2041.4, 2856.0, 4000.0, 6504.0, 1e4, 25e3, 5e4, 1e5] {
        let p = chromaticity_of(&Density::black_body(kelvin).unwrap());
        let found = correlated_temperature(p, &locus).unwrap();
        assert!(close(found.cct_k, kelvin, 1e-8), "{kelvin} K: {} K", found.cct_k);
        assert!(found.duv.abs() < 1e-11, "{kelvin} K: Duv {}", found.duv);
        let q = locus.chromaticity(kelvin).unwrap();
        assert!(p.distance(&q) < 1e-12, "{kelvin} K: {p:?} {q:?}");
    }
}

#[test]
fn a_summed_black_body_lies_on_the_summed_locus() {
    let locus = PlanckianLocus::summed(&matching(), 360.0, 830.0, 1.0);
    // x of a black body of 2000 K by summation: tests/reference/g2_spectral.json, g2a.bb-x-2.
    assert!((locus.chromaticity(2000.0).unwrap().x - 0.526_677_486_643_232).abs() < 1e-14);
}

#[test]
fn the_locus_ends_at_infinity() {
    let locus = PlanckianLocus::new(&matching());
    let end = locus.chromaticity(f64::INFINITY).unwrap();
    // The limit λ⁻⁴ as a sum of table rows.
    let sums = matching().map(|f| (360..=830).map(|nm| f.at(f64::from(nm)) * f64::from(nm).powi(-4)).sum::<f64>());
    assert!(end.distance(&Tristimulus::from(sums).chromaticity().unwrap()) < 1e-5, "{end:?}");
    assert!(locus.chromaticity(1e9).unwrap().distance(&end) < 1e-6);
    assert!(correlated_temperature(end, &locus).unwrap().cct_k > 1e9);
    let bluer = Chromaticity { x: end.x - 0.005, y: end.y - 0.01 };
    assert_eq!(correlated_temperature(bluer, &locus), Err(NoTemperature::BeyondInfinity));
}

#[test]
fn without_a_meaning_there_is_no_temperature() {
    let locus = PlanckianLocus::new(&matching());
    let green = Chromaticity { x: 0.2, y: 0.7 };
    assert!(matches!(correlated_temperature(green, &locus), Err(NoTemperature::TooFar { duv }) if duv > 0.05));
    let red = locus.chromaticity(800.0).unwrap();
    assert_eq!(correlated_temperature(red, &locus), Err(NoTemperature::TooCold));
    let nothing = Chromaticity { x: f64::NAN, y: 0.3 };
    assert_eq!(correlated_temperature(nothing, &locus), Err(NoTemperature::NotFinite));
}

#[test]
fn a_laser_is_its_own_dominant_wavelength() {
    let white = white_point("E", &matching()).unwrap().unwrap();
    for nm in [420.3, 460.0, 480.25, 505.5, 555.0, 589.3, 632.8] {
        let p = chromaticity_of(&Density::line(nm, 1.0).unwrap());
        let found = dominant_wavelength(p, white, &matching()).unwrap();
        let Hue::Spectral(dominant_nm) = found.hue else { panic!("{nm} nm is not purple") };
        assert!((dominant_nm - nm).abs() < 1e-6, "{nm} nm: {dominant_nm}");
        assert!(close(found.excitation_purity, 1.0, 1e-9) && close(found.colorimetric_purity, 1.0, 1e-9));
    }
}

#[test]
fn a_purple_has_a_complementary_wavelength() {
    let white = white_point("E", &matching()).unwrap().unwrap();
    let lights = Density::line(450.0, 1.0).unwrap().plus(&Density::line(650.0, 1.0).unwrap());
    let found = dominant_wavelength(chromaticity_of(&lights), white, &matching()).unwrap();
    let Hue::Purple(nm) = found.hue else { panic!("{found:?}") };
    // Together with its complementary wavelength, a purple can be mixed to white.
    let complement = chromaticity_of(&Density::line(nm, 1.0).unwrap());
    let p = chromaticity_of(&lights);
    let cross = (complement.x - white.x) * (p.y - white.y) - (complement.y - white.y) * (p.x - white.x);
    assert!(cross.abs() < 1e-12 && found.excitation_purity > 0.5 && found.excitation_purity < 1.0);
}

#[test]
fn white_has_no_dominant_wavelength() {
    let white = white_point("E", &matching()).unwrap().unwrap();
    assert_eq!(dominant_wavelength(white, white, &matching()), None);
}

#[test]
fn the_primaries_and_the_white_of_srgb_come_out() {
    let white = Chromaticity { x: 0.3127, y: 0.3290 }.with_luminance(1.0).unwrap();
    assert_eq!(Srgb::of(&white, Gamut::Clip).unwrap().bytes, [255, 255, 255]);
    assert!(!Srgb::of(&white, Gamut::Clip).unwrap().outside_gamut);
    let red = tristimulus_of_linear_srgb([1.0, 0.0, 0.0]);
    // Y of the red primary: IEC 61966-2-1.
    assert!((red.y - 0.2126).abs() < 5e-5);
    assert_eq!(Srgb::of(&red, Gamut::Desaturate).unwrap().hex(), "#ff0000");
    let grey = Chromaticity { x: 0.3127, y: 0.3290 }.with_luminance(0.18).unwrap();
    assert_eq!(Srgb::of(&grey, Gamut::Clip).unwrap().bytes, [118, 118, 118]);
}

#[test]
fn a_laser_is_outside_the_gamut_and_desaturating_keeps_its_luminance() {
    let laser = Tristimulus::of(&Density::line(500.0, 1.0).unwrap(), &matching());
    let laser = laser.scaled(0.4 / laser.y);
    for gamut in [Gamut::Clip, Gamut::Desaturate] {
        assert!(Srgb::of(&laser, gamut).unwrap().outside_gamut);
    }
    let shown = Srgb::of(&laser, Gamut::Desaturate).unwrap();
    assert!((tristimulus_of_linear_srgb(shown.linear).y - 0.4).abs() < 1e-12);
    assert!(shown.linear.iter().any(|c| c.abs() < 1e-12));
    let brightest = Srgb::brightest(&laser, Gamut::Desaturate).unwrap();
    assert!(brightest.outside_gamut && brightest.bytes.contains(&255) && brightest.bytes.contains(&0));
}

#[test]
fn what_is_dark_has_no_colour() {
    assert_eq!(Tristimulus::of(&Density::line(10_000.0, 1.0).unwrap(), &matching()).chromaticity(), None);
    assert_eq!(Srgb::brightest(&Tristimulus { x: 0.0, y: 0.0, z: 0.0 }, Gamut::Clip), None);
}

#[test]
fn y_of_a_density_in_watts_is_luminous() {
    let density = library::density("LED-B3").unwrap();
    let v = crate::spectrum::photometry::luminous(&density, &library::v_lambda());
    assert!(close(Tristimulus::absolute(&density, &matching()).y, v, 1e-9));
}

#[test]
fn the_rgb_of_wright_and_guild_become_the_xyz_of_1931() {
    // x̄, ȳ, z̄ were smoothed and extrapolated after the transformation: they agree as chromaticities do in old tables.
    for name in ["A", "D65", "E", "FL2", "LED-B3"] {
        let density = library::density(name).unwrap();
        let rgb = Tristimulus::of(&density, &Matching::WrightGuild1931.functions());
        let (p, q) = (xyz_of_wright_guild(&rgb).chromaticity().unwrap(), chromaticity_of(&density));
        assert!(p.distance(&q) < 2e-3, "{name}: {p:?} {q:?}");
        let xyz = Tristimulus::of(&density, &matching());
        assert!(close(xyz_of_wright_guild(&rgb).y, xyz.y, 5e-3), "{name}");
    }
}

proptest! {
    #[test]
    fn coordinates_go_there_and_back(x in 0.01..0.75_f64, share in 0.01..0.99_f64) {
        let p = Chromaticity { x, y: (1.0 - x) * share };
        let ((u, v), (u_prime, v_prime)) = (p.uv_1960(), p.uv_prime());
        prop_assert!(p.distance(&Chromaticity::from_uv_1960(u, v)) < 1e-13);
        prop_assert!(p.distance(&Chromaticity::from_uv_prime(u_prime, v_prime)) < 1e-13);
        prop_assert!(p.distance(&p.with_luminance(3.0).unwrap().chromaticity().unwrap()) < 1e-14);
    }

    #[test]
    fn rgb_goes_there_and_back(r in 0.0..1.0_f64, g in 0.0..1.0_f64, b in 0.0..1.0_f64) {
        let back = linear_srgb_of(&tristimulus_of_linear_srgb([r, g, b]));
        prop_assert!(back.iter().zip([r, g, b]).all(|(a, b)| (a - b).abs() < 1e-13));
    }

    #[test]
    fn brightness_does_not_change_the_colour(exponent in -290.0..290.0_f64) {
        let density = library::density("LED-B3").unwrap();
        let p = chromaticity_of(&density);
        let q = chromaticity_of(&density.scaled(10f64.powf(exponent)).unwrap());
        prop_assert!(p.distance(&q) < 1e-14);
    }

    #[test]
    fn a_mixture_lies_on_the_line_between_its_parts(share in 0.01..0.99_f64, nm in 400.0..700.0_f64) {
        let (a, b) = (library::density("A").unwrap(), Density::line(nm, 5000.0).unwrap());
        let (p, q) = (chromaticity_of(&a), chromaticity_of(&b));
        let m = chromaticity_of(&a.scaled(share).unwrap().plus(&b.scaled(1.0 - share).unwrap()));
        prop_assert!(((p.x - m.x) * (q.y - m.y) - (p.y - m.y) * (q.x - m.x)).abs() < 1e-14);
        prop_assert!((p.x - m.x) * (q.x - m.x) + (p.y - m.y) * (q.y - m.y) <= 1e-14);
    }

    #[test]
    fn a_step_off_the_locus_is_duv(beta in 1e-6..9.9e-4_f64, duv in -0.049..0.049_f64) {
        let locus = PlanckianLocus::new(&matching());
        // A neighbour on either side gives the direction of the locus.
        let uv = |beta: f64| locus.chromaticity(1.0 / beta).unwrap().uv_1960();
        let ((u0, v0), (u1, v1), (u, v)) = (uv(beta * 0.9999), uv(beta * 1.0001), uv(beta));
        let length = (u1 - u0).hypot(v1 - v0);
        let p = Chromaticity::from_uv_1960(u - duv * (v1 - v0) / length, v + duv * (u1 - u0) / length);
        // Far below the locus its coldest end can be as near as the foot that the step began at.
        if let Ok(found) = correlated_temperature(p, &locus) {
            prop_assert!((found.duv - duv).abs() < 1e-6 && (found.cct_k * beta - 1.0).abs() < 1e-4, "{found:?}");
        } else {
            prop_assert!(1.0 / beta < 1100.0 || 1.0 / beta > 1e5);
        }
    }
}
