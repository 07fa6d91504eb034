//! Fits of responsivity curves with their bands, on one thread.

use std::hint::black_box;

use criterion::Criterion;
use etendue::calibration::{Exposures, FitOptions, PriorKind, Readings, fit, warm};
use etendue::characterization::campaign::normal;
use etendue::spectrum::{Density, Factor, Outside, Table, library};

fn main() {
    let mut criterion = Criterion::default().sample_size(10).configure_from_args();
    let mut group = criterion.benchmark_group("calibration");
    let nodes: Vec<f64> = (380..=780).map(f64::from).collect();
    let scan: Vec<(String, Density)> = (0..80)
        .map(|i| {
            let nm = 382.5 + 5.0 * f64::from(i);
            let rows = [(nm - 5.0, 0.0), (nm, 0.2), (nm + 5.0, 0.0)];
            let passed = Table::from_rows(&rows, Outside::Zero).and_then(Density::table).unwrap_or_else(|e| panic!("{e}"));
            (format!("{nm} nm"), passed)
        })
        .collect();
    let exposures = Exposures::new(&nodes, &scan).unwrap_or_else(|e| panic!("{e}"));
    let v = library::v_lambda();
    let truth: Vec<f64> = nodes.iter().map(|nm| v.at(*nm)).collect();
    let noisy = |values: Vec<f64>, channel: &str| {
        let wobble = |i: usize| 0.002 * (1.7 * i as f64 * i as f64).sin();
        Readings {
            channel: channel.to_owned(),
            standard_uncertainties: vec![0.0015; values.len()],
            values: values.into_iter().enumerate().map(|(i, y)| y + wobble(i)).collect(),
        }
    };
    let readings = [noisy(exposures.expected(&truth), "E_v")];
    group.bench_function("401 nodes, 80 exposures, with bands", |b| {
        b.iter(|| fit(black_box(&exposures), &readings, &FitOptions::default()).map(|f| f.length_nm));
    });
    let refitter = warm(&exposures, &readings, &PriorKind::Smooth).unwrap_or_else(|e| panic!("{e}"));
    let redrawn = |draw: u64| -> Vec<f64> {
        let both = readings[0].values.iter().zip(&readings[0].standard_uncertainties).enumerate();
        both.map(|(i, (y, u))| y + u * normal(draw, &[i as u64])).collect()
    };
    group.bench_function("1000 Monte Carlo refits of the same", |b| {
        b.iter(|| (0..1000).map(|draw| refitter.refit(&[redrawn(draw)]).map_or(f64::NAN, |curves| curves[0][200])).sum::<f64>());
    });

    let nodes: Vec<f64> = (380..=780).step_by(5).map(f64::from).collect();
    let chart = library::set("ColorChecker").unwrap_or_else(|e| panic!("{e}"));
    let patches: Vec<Factor> = chart.iter().filter_map(|entry| library::factor(&entry.name).ok()).collect();
    let lamps = ["D65", "A"].map(|name| library::density(name).unwrap_or_else(|e| panic!("{e}")));
    let light: Vec<(String, Density)> =
        lamps.iter().flat_map(|lamp| patches.iter().map(move |patch| ("patch".to_owned(), lamp.filtered(patch)))).collect();
    let exposures = Exposures::new(&nodes, &light).unwrap_or_else(|e| panic!("{e}"));
    let camera = ["red", "green", "blue"].map(|channel| {
        let s = library::factor(&format!("Nikon 5100 (NPL) {channel}")).unwrap_or_else(|e| panic!("{e}"));
        let values = exposures.expected(&nodes.iter().map(|nm| s.at(*nm)).collect::<Vec<_>>());
        let u = values.iter().map(|y| 0.002 * y).collect();
        Readings { channel: channel.to_owned(), standard_uncertainties: u, values }
    });
    let prior = PriorKind::camera(&nodes).unwrap_or_else(|e| panic!("{e}"));
    let options = FitOptions { prior, ..FitOptions::default() };
    group.bench_function("camera, 3 channels, 48 exposures, with bands", |b| {
        b.iter(|| fit(black_box(&exposures), &camera, &options).map(|f| f.length_nm));
    });
    group.finish();
}
