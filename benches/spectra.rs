//! Integrals over wavelength, on one thread.

use std::hint::black_box;

use criterion::Criterion;
use etendue::spectrum::file::{FileRules, Meaning, read, write_csv};
use etendue::spectrum::kernel::Weights;
use etendue::spectrum::resample::{Lines, Rule, resample};
use etendue::spectrum::{Density, Factor, Outside, Table, library};

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let grid: Vec<f64> = (380..=780).map(f64::from).collect();
    let values: Vec<f64> = grid.iter().map(|nm| 1.0 + (nm / 20.0).sin()).collect();
    let v = library::v_lambda();
    let table = Table::new(grid.clone(), values.clone(), Outside::Zero).unwrap_or_else(|error| panic!("{error}"));
    let density = Density::table(table.clone()).unwrap_or_else(|error| panic!("{error}"));
    let paint = Factor::Table(table.clone());

    let weights = Weights::new(&grid, &[&v]).unwrap_or_else(|error| panic!("{error}"));
    let mut group = criterion.benchmark_group("401 nodes");
    group.bench_function("weights, dot product with V", |b| b.iter(|| weights.integral(black_box(&values))));
    group.bench_function("weights, made for V", |b| b.iter(|| Weights::new(black_box(&grid), &[&v])));
    group.bench_function("table × V", |b| b.iter(|| black_box(&density).integral(&[&v])));
    group.bench_function("table × V × table", |b| b.iter(|| black_box(&density).integral(&[&v, &paint])));
    group.bench_function("total of a table", |b| b.iter(|| black_box(&density).total()));
    group.bench_function("sum over 1 nm steps × V", |b| {
        b.iter(|| black_box(&density).summed(380.0, 780.0, 1.0).map(|sum| sum.integral(&[&v])))
    });
    group.bench_function("resampled to 5 nm", |b| {
        b.iter(|| resample(black_box(&density), 380.0, 780.0, 5.0, Rule::BinAverages, Lines::Keep).map(|found| found.largest_change));
    });
    let text = write_csv(&table, None, Meaning::Density, &[]).unwrap_or_else(|error| panic!("{error}"));
    group.bench_function("read CSV", |b| b.iter(|| read(black_box(text.as_bytes()), &FileRules::default()).map(|file| file.density)));
    group.finish();

    let mut group = criterion.benchmark_group("laws");
    let black_body = Density::black_body(2856.0).unwrap_or_else(|error| panic!("{error}"));
    group.bench_function("black body × V", |b| b.iter(|| black_box(&black_body).integral(&[&v])));
    group.bench_function("daylight", |b| b.iter(|| Density::daylight(black_box(6504.0))));
    let led = Density::led(530.0, 30.0).unwrap_or_else(|error| panic!("{error}"));
    group.bench_function("LED × V", |b| b.iter(|| black_box(&led).integral(&[&v])));
    group.finish();
    criterion.final_summary();
}
