//! Time of a picture: one megapixel of a chart under two lamps, on one thread. Says in plain words what one takes.
#![allow(missing_docs, clippy::print_stdout)]

use std::fmt::Write as _;
use std::hint::black_box;
use std::time::Instant;

use criterion::{Criterion, Throughput};
use etendue::estimate::run::with_threads;
use etendue::estimate::{Stop, Watch};
use etendue::measurement::expose;
use etendue::plan::{Plan, PlanOptions};
use etendue::scene::scene_from_text;

/// Columns and rows.
const SIZE: [usize; 2] = [1024, 1024];

fn main() {
    let mut criterion = Criterion::default().sample_size(10).configure_from_args();
    let mut group = criterion.benchmark_group("camera");
    let scene = scene_from_text(&chart()).unwrap_or_else(|problems| panic!("{problems}"));
    let plan = Plan::new(&scene, &PlanOptions::default()).unwrap_or_else(|e| panic!("{e}"));
    let watch = Watch { now: &|| 0.0, progress: &|_| {} };
    group.throughput(Throughput::Elements((SIZE[0] * SIZE[1]) as u64));
    for samples in [4, 8, 16] {
        let stop = Stop { target: None, budget_seconds: None, samples: Some(samples) };
        group.bench_function(format!("chart of 24 patches, {samples} samples a pixel"), |b| {
            b.iter_custom(|rounds| {
                let work = || {
                    let start = Instant::now();
                    for round in 0..rounds {
                        let frame = expose(&scene, &plan, 0, &stop, round, &watch).unwrap_or_else(|e| panic!("{e}"));
                        black_box(frame.planes[0].expected_e[0]);
                    }
                    start.elapsed()
                };
                with_threads(Some(1), work)
            });
        });
    }
    group.finish();
    criterion.final_summary();
    let stop = Stop { target: None, budget_seconds: None, samples: Some(8) };
    let start = Instant::now();
    let frame = with_threads(Some(1), || expose(&scene, &plan, 0, &stop, 0, &watch)).unwrap_or_else(|e| panic!("{e}"));
    println!(
        "a frame of {} megapixels of a direct-lit chart, 8 samples a pixel, takes {:.2} s of one thread; asked for: less than 5 s",
        (frame.columns * frame.rows) as f64 / f64::from(1 << 20),
        start.elapsed().as_secs_f64()
    );
}

/// 24 patches in a plane between two panels, before a Bayer camera.
fn chart() -> String {
    let (mut surfaces, mut objects) = (String::new(), String::new());
    for k in 0..24 {
        let (x, z) = (0.048 * (f64::from(k % 6) - 2.5), 0.048 * (1.5 - f64::from(k / 6)));
        let _ = writeln!(surfaces, "\"{k}\": Lambertian(Gaussian(peak: 0.9, centre_nm: {}, fwhm_nm: 150)),", 400 + 13 * k);
        let _ =
            writeln!(objects, "(name: \"{k}\", shape: Rectangle(0.04, 0.04), at: ({x}, 0, {z}), facing: (0, -1, 0), surface: \"{k}\"),");
    }
    let panel = |x: f64| {
        format!(
            "(name: \"panel {x}\", shape: Rectangle(0.3, 0.3), at: ({x}, -0.6, 0), facing: ({}, 0.6, 0), strength: Luminance(5000), spectrum: \"D65\")",
            -x
        )
    };
    let channel =
        |name: &str, nm: u32| format!("(name: \"{name}\", quantum_efficiency: Gaussian(peak: 0.5, centre_nm: {nm}, fwhm_nm: 90))");
    format!(
        "Scene(surfaces: {{ {surfaces} }}, objects: [{objects}], sources: [{}, {}],
        cameras: [(name: \"cam\", at: (0, -1, 0), facing: (0, 1, 0), camera: Camera(
            lens: Thin(focal_length_mm: 16, f_number: 4, focus_m: 1), columns: {}, rows: {}, pitch_um: 5, mosaic: Bayer(\"RGGB\"),
            channels: [{}, {}, {}], exposure_ms: 10,
        ))])",
        panel(-0.6),
        panel(0.6),
        SIZE[0],
        SIZE[1],
        channel("R", 610),
        channel("G", 535),
        channel("B", 460),
    )
}
