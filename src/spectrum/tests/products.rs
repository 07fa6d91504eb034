//! Laws of products of densities and factors, and the reference cases that need nothing but this layer.

use std::f64::consts::PI;

use proptest::prelude::*;

use crate::spectrum::*;

/// Numbers below the smallest normal one, as in the far tail of a Gaussian, have no relative precision to hold them to.
fn close(value: f64, reference: f64, relative: f64) -> bool {
    (value - reference).abs() <= (relative * reference.abs()).max(f64::MIN_POSITIVE)
}

fn any_table(nodes: std::ops::Range<usize>) -> impl Strategy<Value = Table> {
    (prop::collection::vec((0.01..60.0_f64, 0.0..1.0_f64), nodes), 300.0..700.0_f64, any::<bool>()).prop_map(|(steps, start, hold)| {
        let mut nm = start;
        let rows: Vec<(f64, f64)> = steps
            .into_iter()
            .map(|(step, value)| {
                nm += step;
                (nm, value)
            })
            .collect();
        Table::from_rows(&rows, if hold { Outside::Hold } else { Outside::Zero }).unwrap()
    })
}

/// The same function with one more node.
fn with_node(table: &Table, nm: f64) -> Table {
    let (from, to) = table.range_nm();
    let mut rows: Vec<(f64, f64)> = table.rows().collect();
    if from < nm && nm < to && !table.wavelengths_nm().contains(&nm) {
        rows.push((nm, table.at(nm)));
        rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    Table::from_rows(&rows, table.outside()).unwrap()
}

fn any_density() -> impl Strategy<Value = Density> {
    prop_oneof![
        any_table(2..12).prop_map(|table| Density::table(table).unwrap()),
        (1.0..2e4_f64).prop_map(|kelvin| Density::black_body(kelvin).unwrap()),
        (-6.0..2.0_f64, 350.0..800.0_f64).prop_map(|(ln, nm)| Density::gaussian(1.0, nm, 10.0_f64.powf(ln)).unwrap()),
        (350.0..800.0_f64).prop_map(|nm| Density::line(nm, 2.0).unwrap()),
        Just(Density::illuminant_a()),
    ]
}

proptest! {
    #[test]
    fn inserting_nodes_never_changes_an_integral(
        density in any_density(), table in any_table(2..12), other in any_table(2..12),
        extra in prop::collection::vec(300.0..1400.0_f64, 1..20),
    ) {
        let refined = extra.iter().fold(table.clone(), |table, nm| with_node(&table, *nm));
        let [coarse, fine, other] = [table, refined, other].map(Factor::Table);
        let (before, after) = (density.integral(&[&coarse, &other]), density.integral(&[&fine, &other]));
        // A line and a Gaussian of 1e-6 nm see the rounding of the inserted row's slope, hence not 1e-15.
        prop_assert!(close(after, before, 1e-11), "{before:e} {after:e}");
    }

    #[test]
    fn inserting_nodes_into_a_density_never_changes_its_integral(
        table in any_table(2..12), factor in any_table(2..12), extra in prop::collection::vec(300.0..1400.0_f64, 1..20),
    ) {
        let refined = extra.iter().fold(table.clone(), |table, nm| with_node(&table, *nm));
        let factor = Factor::Table(factor);
        let [coarse, fine] = [table, refined].map(|table| Density::table(table).unwrap());
        prop_assert!(close(fine.integral(&[&factor, &factor]), coarse.integral(&[&factor, &factor]), 1e-12));
        prop_assert!(close(fine.total(), coarse.total(), 1e-12));
    }

    #[test]
    fn integrals_are_linear_in_density_and_factor(
        a in any_density(), b in any_density(), f in any_table(2..12), g in any_table(2..12), scale in 0.0..10.0_f64,
    ) {
        let (f, g) = (Factor::Table(f), Factor::Table(g));
        let sum = a.scaled(scale).unwrap().plus(&b);
        prop_assert!(close(sum.integral(&[&f]), scale * a.integral(&[&f]) + b.integral(&[&f]), 1e-11));
        let factors = Factor::Sum(vec![f.clone().scaled(scale), g.clone()]);
        prop_assert!(close(a.integral(&[&factors]), scale * a.integral(&[&f]) + a.integral(&[&g]), 1e-11));
    }

    #[test]
    fn a_filter_may_stand_on_either_side(density in any_density(), f in any_table(2..12), g in any_table(2..12)) {
        let (f, g) = (Factor::Table(f), Factor::Table(g));
        let reference = density.integral(&[&f, &g]);
        prop_assert!(close(density.filtered(&f).integral(&[&g]), reference, 1e-12));
        prop_assert!(close(density.integral(&[&Factor::Product(vec![g.clone(), f.clone()])]), reference, 1e-12));
    }

    #[test]
    fn an_empty_joint_support_means_exactly_zero(density in any_density(), f in any_table(2..12), g in any_table(2..12)) {
        let (f, g) = (Factor::Table(f), Factor::Table(g));
        let integral = density.integral(&[&f, &g]);
        prop_assert!(integral >= 0.0);
        if density.joint_support(&[&f, &g]).is_empty() {
            prop_assert_eq!(integral, 0.0);
        }
    }

    #[test]
    fn a_gaussian_of_any_width_has_its_area(ln_sigma in -20.0..2.0_f64, centre in 350.0..1000.0_f64) {
        let sigma_nm = ln_sigma.exp();
        let gaussian = Density::gaussian(3.0, centre, sigma_nm).unwrap();
        prop_assert!(close(gaussian.total(), 3.0, 1e-13));
    }

    #[test]
    fn a_black_body_of_any_temperature_radiates_sigma_t_to_the_fourth(ln_kelvin in 0.0..16.118_f64) {
        let kelvin = ln_kelvin.exp();
        let total = Density::black_body(kelvin).unwrap().total();
        prop_assert!(close(total, black_body::radiance_w_m2_sr(kelvin), 1e-12));
        prop_assert!(close(total, 5.670_374_419e-8 / PI * kelvin.powi(4), 1e-9));
    }

    #[test]
    fn extreme_scales_only_scale(density in any_density(), table in any_table(2..12), exponent in -300..=300) {
        let scale = 10.0_f64.powi(exponent);
        let factor = Factor::Table(table);
        let reference = density.integral(&[&factor]);
        prop_assume!(reference == 0.0 || reference > 1e-7);
        let there = density.scaled(scale).unwrap();
        let back = Factor::Constant(1.0 / scale);
        prop_assert!(close(there.integral(&[&factor, &back]), reference, 1e-13));
    }
}

#[test]
fn the_wien_tail_is_not_lost_when_the_scale_brings_it_back() {
    // 20 K seen through 360-830 nm: about exp(-860), below any f64, times 1e300 twice.
    let band = Factor::band(360.0, 830.0, 1.0).unwrap();
    let far = Density::black_body(20.0).unwrap();
    assert_eq!(far.integral(&[&band]), 0.0);
    let near = far.scaled(1e300).unwrap().integral(&[&band, &Factor::Constant(1e100)]);
    // Leading order of the integral at its upper end b: L(b) · λ b T/c₂ with λ = b, corrected by the next two orders.
    let (b, t) = (830.0_f64, 20.0_f64);
    let x = black_body::SECOND_RADIATION_CONSTANT_NM_K / (b * t);
    let series = 1.0 + 3.0 / x + 6.0 / (x * x) + 6.0 / (x * x * x);
    let ln = black_body::ln_spectral_radiance(b, t) + (b / x * series).ln() + 400.0 * std::f64::consts::LN_10;
    assert!(close(near, ln.exp(), 1e-11), "{near:e} {:e}", ln.exp());
}

#[test]
fn a_laser_in_a_gap_of_the_responsivity_reads_exactly_nothing() {
    // g4h.laser-gap-1, as two bands and as a table.
    let bands = Factor::Sum(vec![Factor::band(300.0, 620.0, 1.0).unwrap(), Factor::band(640.0, 1100.0, 1.0).unwrap()]);
    let rows = [(300.0, 1.0), (620.0, 1.0), (620.0_f64.next_up(), 0.0), (640.0_f64.next_down(), 0.0), (640.0, 1.0)];
    let table = Factor::Table(Table::from_rows(&rows, Outside::Hold).unwrap());
    for responsivity in [bands, table] {
        let read = |nm| Density::line(nm, 0.005).unwrap().integral(&[&responsivity]);
        assert_eq!(read(633.0), 0.0);
        assert_eq!(read(641.0), 0.005);
        assert_eq!(read(640.0), 0.005);
        assert!(Density::line(633.0, 1.0).unwrap().joint_support(&[&responsivity]).is_empty());
    }
}

#[test]
fn a_line_is_counted_once_and_exactly() {
    let lines = [(435.8, 1.0), (546.1, 2.0), (578.0, 0.5)].map(|(wavelength_nm, power)| Line { wavelength_nm, power });
    let mercury = Density::lines_only(&lines).unwrap();
    let filter = Factor::Table(Table::from_rows(&[(400.0, 0.0), (600.0, 1.0)], Outside::Zero).unwrap());
    let expected: f64 = lines.iter().map(|line| line.power * filter.at(line.wavelength_nm)).sum();
    assert!(close(mercury.integral(&[&filter]), expected, 1e-15));
    assert_eq!(mercury.filtered(&filter).total(), mercury.integral(&[&filter]));
    let everything = mercury.plus(&Density::flat(400.0, 700.0, 0.01).unwrap());
    assert!(close(everything.total(), 6.5, 1e-15));
    assert_eq!(mercury.support().intervals().len(), 3);
}

#[test]
fn fractions_of_black_body_radiance_agree_with_the_reference_cases() {
    // /reference/g2_spectral.json, g2a.bb-band-1 and -3.
    for (kelvin, from, to, reference) in [(5772.0, 380.0, 780.0, 0.464969804178027), (2856.0, 780.0, 1100.0, 0.199027960003014)] {
        let band = Factor::band(from, to, 1.0).unwrap();
        let fraction = Density::black_body(kelvin).unwrap().mean_of(&band).unwrap();
        assert!(close(fraction, reference, 1e-12), "{fraction}");
    }
}

#[test]
fn illuminant_a_as_a_density_is_the_formula() {
    let density = Density::illuminant_a();
    for nm in (300..=830).map(f64::from) {
        assert!(close(density.continuum_at(nm), black_body::illuminant_a(nm), 1e-12));
    }
    assert_eq!(density.support().hull(), Some((300.0, 830.0)));
    assert_eq!(density.continuum_at(299.0), 0.0);
}

#[test]
fn densities_without_a_meaning_are_refused() {
    assert!(Density::line(633.0, -1.0).is_err());
    assert!(Density::line(0.0, 1.0).is_err());
    assert!(Density::black_body(0.0).is_err());
    assert!(Density::gaussian(1.0, 555.0, -1.0).is_err());
    assert!(Density::flat(500.0, 400.0, 1.0).is_err());
    assert!(Density::zero().scaled(f64::NAN).is_err());
    let negative = Table::from_rows(&[(400.0, 1.0), (500.0, -1.0)], Outside::Zero).unwrap();
    assert_eq!(Density::table(negative), Err(SpectrumError::Negative { row: 2, wavelength_nm: 500.0, value: -1.0 }));
}
