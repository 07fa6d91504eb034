//! Laws of integrals over wavelength: a line is a line whatever the grid, nodes that add nothing change nothing, scales cancel, black bodies
//! radiate σT⁴.

use etendue::quantity::constants::K_M_LM_W;
use etendue::spectrum::resample::{Lines, Rule, resample};
use etendue::spectrum::{Density, Factor, Outside, Table, black_body, library, photometry};
use proptest::prelude::*;

use crate::bench::exact;

/// 683.002 lm/W times V at a wavelength.
fn lumens_of_a_watt_at(nm: f64) -> f64 {
    K_M_LM_W * library::v_lambda().at(nm)
}

/// Rows of a table from 300 nm on.
fn rows() -> impl Strategy<Value = Vec<(f64, f64)>> {
    prop::collection::vec((0.01..40.0_f64, 0.0..10.0_f64), 2..60).prop_map(|steps| {
        let mut nm = 300.0;
        steps
            .into_iter()
            .map(|(step, value)| {
                nm += step;
                (nm, value)
            })
            .collect()
    })
}

fn table(rows: &[(f64, f64)]) -> Table {
    Table::from_rows(rows, Outside::Zero).unwrap()
}

/// The same straight lines with further nodes on them, at these places between the first and the last row.
fn with_nodes(table: &Table, places: &[f64]) -> Table {
    let (from, to) = table.range_nm();
    let mut rows: Vec<(f64, f64)> = table.rows().collect();
    rows.extend(places.iter().map(|t| from + t * (to - from)).map(|nm| (nm, table.at(nm))));
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    rows.dedup_by(|a, b| a.0 == b.0);
    Table::from_rows(&rows, table.outside()).unwrap()
}

#[test]
fn a_watt_of_the_green_mercury_line_has_683_002_times_v_lumens() {
    let line = Density::line(546.07, 1.0).unwrap();
    let v = library::v_lambda();
    assert_eq!(photometry::luminous(&line, &v), lumens_of_a_watt_at(546.07));
    // CIE 1924: V(546 nm) = 0.98409…, V(547 nm) = 0.98748…; the line lies 0.07 of the way.
    assert!((lumens_of_a_watt_at(546.07) - 672.3).abs() < 0.1);
    for step in [0.5, 1.0, 5.0, 10.0, 20.0] {
        assert_eq!(photometry::luminous(&line.summed(380.0, 780.0, step).unwrap(), &v), lumens_of_a_watt_at(546.07));
        let kept = resample(&line, 380.0, 780.0, step, Rule::BinAverages, Lines::Keep).unwrap();
        assert_eq!(photometry::luminous(&kept.density, &v), lumens_of_a_watt_at(546.07));
    }
}

#[test]
fn a_lamp_of_one_line_reads_so_in_a_scene() {
    // 1 W/sr from 1 m: 1 W/m².
    let scene = r#"Scene(
        sources: [(name: "s", shape: Point, at: (0, 0, 1), strength: WattsPerSteradian(1), spectrum: Line(546.07))],
        instruments: [(name: "m", at: (0, 0, 0), facing: (0, 0, 1), sensor:
            Sensor(aperture: Point, acceptance: Cosine, channels: [(name: "E", responsivity: "V", reads: Illuminance)]))],
    )"#;
    assert!((exact(scene)[0] / lumens_of_a_watt_at(546.07) - 1.0).abs() < 1e-12);
}

proptest! {
    #[test]
    fn a_line_counts_the_same_on_any_continuum_and_behind_any_grid(rows in rows(), places in prop::collection::vec(0.0..1.0_f64, 0..40)) {
        let (continuum, line) = (Density::table(table(&rows)).unwrap(), Density::line(546.07, 1.0).unwrap());
        let v = library::v_lambda();
        let Factor::Table(v_table) = &v else { panic!("V is a table") };
        let v_with_nodes = Factor::Table(with_nodes(v_table, &places));
        let without = photometry::luminous(&continuum, &v);
        let with = photometry::luminous(&continuum.plus(&line), &v_with_nodes);
        prop_assert!((with - without - lumens_of_a_watt_at(546.07)).abs() <= 1e-12 * (with + 1.0), "{} {}", with, without);
    }

    #[test]
    fn nodes_that_add_nothing_change_nothing(
        a in rows(), b in rows(), places in prop::collection::vec(0.0..1.0_f64, 0..60), more in prop::collection::vec(0.0..1.0_f64, 0..60),
    ) {
        let (a, b) = (table(&a), table(&b).with_outside(Outside::Hold));
        let band = Factor::band(350.0, 620.0, 1.0).unwrap();
        for others in [vec![], vec![&band]] {
            let value = |a: &Table, b: &Table| {
                let b = Factor::Table(b.clone());
                Density::table(a.clone()).unwrap().integral(&[&[&b][..], &others].concat())
            };
            let (plain, refined) = (value(&a, &b), value(&with_nodes(&a, &places), &with_nodes(&b, &more)));
            prop_assert!((refined - plain).abs() <= 1e-12 * plain, "{} {}", plain, refined);
        }
    }

    #[test]
    fn scales_cancel(rows in rows(), exponent in -300..=300_i32) {
        let density = Density::table(table(&rows)).unwrap();
        let v = library::v_lambda();
        let plain = density.integral(&[&v]);
        let scale = 10.0_f64.powi(exponent);
        let scaled = density.scaled(scale).unwrap().integral(&[&v, &Factor::Constant(1.0 / scale)]);
        prop_assert!((scaled - plain).abs() <= 1e-13 * plain);
        // 1e-300 and 1e300 as values of the tables themselves.
        let values: Vec<(f64, f64)> = rows.iter().map(|(nm, value)| (*nm, value * scale)).collect();
        let inside = Density::table(table(&values)).unwrap().integral(&[&v, &Factor::Constant(1.0 / scale)]);
        prop_assert!((inside - plain).abs() <= 1e-12 * plain, "{} {}", plain, inside);
    }

    #[test]
    fn black_bodies_radiate_the_fourth_power(ln_kelvin in 0.0..16.2_f64) {
        let kelvin = ln_kelvin.exp().min(1e7);
        let total = Density::black_body(kelvin).unwrap().total();
        prop_assert!((total / black_body::radiance_w_m2_sr(kelvin) - 1.0).abs() < 1e-11);
    }
}

#[test]
fn black_bodies_from_1_kelvin_to_ten_million_radiate_the_fourth_power() {
    for exponent in 0..=28 {
        let kelvin = 10.0_f64.powf(f64::from(exponent) / 4.0);
        let exitance = std::f64::consts::PI * Density::black_body(kelvin).unwrap().total();
        assert!((exitance / black_body::exitance_w_m2(kelvin) - 1.0).abs() < 1e-11, "{kelvin} K");
    }
}

#[test]
fn lines_of_a_picometre_on_a_wide_continuum_are_all_counted() {
    // 40 lines of 1 W and 1 pm width on 1 W/nm from 300 nm to 2300 nm.
    let sigma_nm = 1e-3 / (8.0 * std::f64::consts::LN_2).sqrt();
    let centres: Vec<f64> = (0..40).map(|i| 401.5 + 9.0 * f64::from(i)).collect();
    let wide = Density::flat(300.0, 2300.0, 1.0).unwrap();
    let lamp = centres.iter().fold(wide.clone(), |lamp, nm| lamp.plus(&Density::gaussian(1.0, *nm, sigma_nm).unwrap()));
    assert!((lamp.total() / 2040.0 - 1.0).abs() < 1e-12);
    let v = library::v_lambda();
    let expected = wide.integral(&[&v]) + centres.iter().map(|nm| v.at(*nm)).sum::<f64>();
    assert!((lamp.integral(&[&v]) / expected - 1.0).abs() < 1e-12);
    // Lines of no width at the same places are the same light, because V is straight there.
    let sharp = centres.iter().fold(wide, |lamp, nm| lamp.plus(&Density::line(*nm, 1.0).unwrap()));
    assert!((lamp.integral(&[&v]) / sharp.integral(&[&v]) - 1.0).abs() < 1e-12);
}
