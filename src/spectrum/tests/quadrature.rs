//! The spectral quadrature: partition of unity, grey scenes, lines, jumps, and the residual against exact integrals.

use proptest::prelude::*;

use crate::spectrum::quadrature::{DEFAULT_MAX_NODES, SpectralNodes};
use crate::spectrum::{Density, Factor, Line, Outside, Table, library};

/// The reflectances of the benchmark scene S2s, 380-780 nm in steps of 10 nm: white, red, green, block.
fn room_paints() -> [Factor; 4] {
    let table = |values: [f64; 41]| {
        let wavelengths_nm = (0..41).map(|i| 380.0 + 10.0 * f64::from(i)).collect();
        Factor::Table(Table::new(wavelengths_nm, values.to_vec(), Outside::Hold).unwrap())
    };
    [WHITE, RED, GREEN, BLOCK].map(table)
}

const WHITE: [f64; 41] = [
    0.6358, 0.63, 0.6358, 0.6515, 0.6731, 0.6955, 0.7151, 0.7297, 0.7393, 0.7449, 0.7478, 0.7491, 0.7497, 0.7499, 0.75, 0.75, 0.75, 0.75,
    0.75, 0.75, 0.75, 0.75, 0.75, 0.75, 0.75, 0.75, 0.75, 0.75, 0.75, 0.75, 0.75, 0.75, 0.75, 0.75, 0.75, 0.75, 0.75, 0.75, 0.75, 0.75,
    0.75,
];
const RED: [f64; 41] = [
    0.06, 0.06, 0.06, 0.06, 0.06, 0.06, 0.06, 0.06, 0.06, 0.06, 0.06, 0.0601, 0.0601, 0.0603, 0.0607, 0.0617, 0.0639, 0.0689, 0.08, 0.104,
    0.1521, 0.2357, 0.35, 0.4643, 0.5479, 0.596, 0.62, 0.6311, 0.6361, 0.6383, 0.6393, 0.6397, 0.6399, 0.6399, 0.64, 0.64, 0.64, 0.64,
    0.64, 0.64, 0.64,
];
const GREEN: [f64; 41] = [
    0.08, 0.08, 0.08, 0.0801, 0.0804, 0.0814, 0.0843, 0.0912, 0.1061, 0.1346, 0.1818, 0.2496, 0.3322, 0.4148, 0.4769, 0.5, 0.4769, 0.4148,
    0.3322, 0.2496, 0.1818, 0.1346, 0.1061, 0.0912, 0.0843, 0.0814, 0.0804, 0.0801, 0.08, 0.08, 0.08, 0.08, 0.08, 0.08, 0.08, 0.08, 0.08,
    0.08, 0.08, 0.08, 0.08,
];
const BLOCK: [f64; 41] = [
    0.4, 0.4075, 0.415, 0.4225, 0.43, 0.4375, 0.445, 0.4525, 0.46, 0.4675, 0.475, 0.4825, 0.49, 0.4975, 0.505, 0.5125, 0.52, 0.5275, 0.535,
    0.5425, 0.55, 0.5575, 0.565, 0.5725, 0.58, 0.5875, 0.595, 0.6025, 0.61, 0.6175, 0.625, 0.6325, 0.64, 0.6475, 0.655, 0.6625, 0.67,
    0.6775, 0.685, 0.6925, 0.7,
];

/// Exact integral of a product of reflectances, and what the nodes make of it, both relative to the brightest grey path.
fn exact_and_found(nodes: &SpectralNodes, source: &Density, sensor: &Factor, path: &[&Factor]) -> (f64, f64) {
    let mut factors = vec![sensor];
    factors.extend(path);
    let brightest: f64 = path.iter().map(|factor| factor.max_over(380.0, 780.0)).product();
    let scale = source.integral(&[sensor]) * brightest;
    let samples: Vec<Vec<f64>> = path.iter().map(|factor| nodes.sample(factor)).collect();
    let weights = nodes.weights(source, sensor);
    let found: f64 = weights.iter().enumerate().map(|(k, weight)| samples.iter().map(|sample| sample[k]).product::<f64>() * weight).sum();
    (source.integral(&factors) / scale, found / scale)
}

#[test]
fn the_benchmark_room_is_held_to_a_few_ten_thousandths_by_64_nodes() {
    let (source, sensor, paints) = (Density::illuminant_a(), library::v_lambda(), room_paints());
    let reflectances: Vec<&Factor> = paints.iter().collect();
    let nodes = SpectralNodes::compile_default(&[(&source, &sensor)], &reflectances);
    assert!(nodes.wavelengths_nm().len() <= DEFAULT_MAX_NODES);
    // As a share of the light from the darkest of these paints; 5e-5 of the light without reflection.
    assert!(nodes.residual() < 2.5e-4, "{:e}", nodes.residual());
    let [white, red, green, block] = &paints;
    assert!(nodes.path_residual() < 1e-3, "{:e}", nodes.path_residual());
    let paths: [&[&Factor]; 6] = [
        &[white],
        &[white, red],
        &[red, green, white],
        &[red, white, red, white, red, white, red, white],
        &[green; 8],
        &[block, green, block, white, white],
    ];
    for path in paths {
        let (exact, found) = exact_and_found(&nodes, &source, &sensor, path);
        assert!((exact - found).abs() <= 1.5 * nodes.path_residual(), "{exact} {found} against {:e}", nodes.residual());
    }
}

#[test]
fn more_nodes_lower_the_residual_with_the_second_power() {
    let (source, sensor, paints) = (Density::illuminant_a(), library::v_lambda(), room_paints());
    let reflectances: Vec<&Factor> = paints.iter().collect();
    let residual = |nodes| SpectralNodes::compile(&[(&source, &sensor)], &reflectances, nodes, 0.0).residual();
    let (few, many) = (residual(16), residual(64));
    assert!(many < few / 8.0, "{few:e} {many:e}");
}

#[test]
fn a_dark_paint_is_held_as_well_as_a_light_one() {
    let (source, sensor, paints) = (library::density("FL11").unwrap(), library::v_lambda(), room_paints());
    let of = |brightness: f64| {
        let paint = paints[2].clone().scaled(brightness);
        let nodes = SpectralNodes::compile_default(&[(&source, &sensor)], &[&paint]);
        let exact = source.integral(&[&sensor, &paint]);
        let found: f64 = nodes.weights(&source, &sensor).iter().zip(nodes.sample(&paint)).map(|(w, r)| w * r).sum();
        assert!(
            (found / exact - 1.0).abs() <= nodes.residual() + 1e-12,
            "{brightness}: {} against {:e}",
            found / exact - 1.0,
            nodes.residual()
        );
        assert!(nodes.residual() < 1e-3, "{brightness}: {:e}", nodes.residual());
    };
    for exponent in 0..=6 {
        of(10f64.powi(-exponent));
    }
}

#[test]
fn a_scene_without_colour_needs_one_node() {
    let (source, sensor) = (Density::illuminant_a(), library::v_lambda());
    // Grey where source and sensor overlap; what it does at 1000 nm does not matter.
    let rows = [(300.0, 0.5), (900.0, 0.5), (1000.0, 0.1)];
    let paint = Factor::Table(Table::from_rows(&rows, Outside::Hold).unwrap());
    let nodes = SpectralNodes::compile_default(&[(&source, &sensor)], &[&paint, &Factor::Constant(0.2)]);
    assert_eq!((nodes.wavelengths_nm().len(), nodes.residual()), (1, 0.0));
    assert_eq!(nodes.weights(&source, &sensor), [source.integral(&[&sensor])]);
    assert_eq!(nodes.sample(&paint), [0.5]);
}

#[test]
fn without_a_common_wavelength_there_is_no_node() {
    let infrared = Density::gaussian(1.0, 940.0, 1.0).unwrap();
    let nodes = SpectralNodes::compile_default(&[(&infrared, &library::v_lambda())], &room_paints().each_ref());
    assert!(nodes.wavelengths_nm().is_empty() && nodes.weights(&infrared, &library::v_lambda()).is_empty());
}

#[test]
fn no_node_lies_where_no_sensor_sees() {
    let source = Density::black_body(3000.0).unwrap();
    let sensor = Factor::band(500.0, 600.0, 1.0).unwrap();
    let nodes = SpectralNodes::compile_default(&[(&source, &sensor)], &room_paints().each_ref());
    assert!(nodes.wavelengths_nm().iter().all(|nm| (500.0..=600.0).contains(nm)));
}

#[test]
fn lines_are_exact_at_their_wavelengths() {
    let lines = [435.8, 546.1, 611.0].map(|wavelength_nm| Line { wavelength_nm, power: 1.0 });
    let (lamp, v, paints) = (Density::lines_only(&lines).unwrap(), library::v_lambda(), room_paints());
    let nodes = SpectralNodes::compile_default(&[(&lamp, &v)], &paints.each_ref());
    assert!(nodes.residual() < 1e-12, "{:e}", nodes.residual());
    assert!(nodes.wavelengths_nm().len() <= 4, "{:?}", nodes.wavelengths_nm());
    let (exact, found) = exact_and_found(&nodes, &lamp, &v, &[&paints[1]; 8]);
    assert!((exact - found).abs() < 1e-12);
    let laser = Density::line(633.0, 1.0).unwrap();
    assert!(SpectralNodes::compile_default(&[(&laser, &v)], &paints.each_ref()).wavelengths_nm().len() <= 2);
}

#[test]
fn a_filter_edge_gets_a_node_on_either_side() {
    let (source, v) = (Density::illuminant_a(), library::v_lambda());
    let filter = Factor::band(560.0, 2000.0, 0.9).unwrap();
    let nodes = SpectralNodes::compile_default(&[(&source, &v)], &[&filter]);
    let (exact, found) = exact_and_found(&nodes, &source, &v, &[&filter; 8]);
    assert!((exact - found).abs() < 1e-12, "{exact} {found}");
    assert!(nodes.wavelengths_nm().len() <= 5 && nodes.residual() < 1e-12);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn weights_are_positive_and_sum_to_the_exact_integral(
        kelvin in 500.0..20000.0_f64, centre in 400.0..700.0_f64, power in 0.0..1e6_f64, max_nodes in 2..70_usize,
    ) {
        let source = Density::black_body(kelvin).unwrap().plus(&Density::line(centre, power).unwrap());
        let led = Density::gaussian(2.0, centre, 12.0).unwrap();
        let (v, x) = (library::v_lambda(), library::factor("xbar").unwrap());
        let terms = [(&source, &v), (&led, &v), (&source, &x)];
        let nodes = SpectralNodes::compile(&terms, &room_paints().each_ref(), max_nodes, 1e-5);
        prop_assert!(nodes.wavelengths_nm().len() <= max_nodes);
        prop_assert!(nodes.wavelengths_nm().windows(2).all(|pair| pair[0] < pair[1]));
        // Also for a term that had no part in choosing the nodes.
        for (density, factor) in terms.into_iter().chain([(&led, &x)]) {
            let weights = nodes.weights(density, factor);
            prop_assert!(weights.iter().all(|weight| *weight >= 0.0));
            let (sum, exact) = (weights.iter().sum::<f64>(), density.integral(&[factor]));
            prop_assert!((sum - exact).abs() <= 1e-12 * exact, "{sum} {exact}");
        }
    }
}
