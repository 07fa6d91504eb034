//! Times of small things: a reading by formula, paths in a box, planning, parsing.
#![allow(missing_docs)]

use std::fmt::Write as _;
use std::hint::black_box;
use std::time::Instant;

use criterion::{Criterion, Throughput};
use etendue::estimate::run::with_threads;
use etendue::estimate::{Stop, Watch};
use etendue::measurement::measure;
use etendue::plan::{Plan, PlanOptions};
use etendue::scene::{MemoryFiles, Scene, read_scene};

/// Samples of a reading with paths; rates are per sample.
const SAMPLES: u64 = 4096;

const METER: &str = "Sensor(aperture: Point, acceptance: Cosine, channels: [(name: \"E_v\", responsivity: \"V\", reads: Illuminance)])";

fn main() {
    let mut criterion = Criterion::default().sample_size(20).configure_from_args();
    readings(&mut criterion);
    planning(&mut criterion);
    parsing(&mut criterion);
    criterion.final_summary();
}

fn readings(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("reading");
    let cases = [
        ("bench by formula", read(&bench(1)), 0),
        ("100 x 100 points by formula", read(&bench(100)), 0),
        ("box of 16 rectangles, grey", read(&cornell("Lambertian(0.7)", "Lambertian(0.3)")), SAMPLES),
        ("box of 16 rectangles, spectral", read(&cornell("Lambertian(\"paint.csv\")", "Lambertian(\"brick.csv\")")), SAMPLES),
    ];
    for (name, scene, samples) in &cases {
        let plan = Plan::new(scene, &PlanOptions::default()).unwrap_or_else(|e| panic!("{e}"));
        let stop = Stop { target: None, budget_seconds: None, samples: Some((*samples).max(1)) };
        let watch = Watch { now: &|| 0.0, progress: &|_| {} };
        let poses: usize = scene.instruments.iter().map(|i| i.poses.len()).sum();
        group.throughput(Throughput::Elements(if *samples == 0 { poses as u64 } else { *samples }));
        let read = |seed| measure(scene, &plan, &stop, seed, &watch).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(read(0).counters.rays == 0, *samples == 0, "{name}");
        group.bench_function(*name, |b| {
            b.iter_custom(|rounds| {
                let work = || {
                    let start = Instant::now();
                    for round in 0..rounds {
                        black_box(read(black_box(round)).readings[0].value);
                    }
                    start.elapsed()
                };
                with_threads(Some(1), work)
            });
        });
    }
    group.finish();
}

fn planning(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("plan");
    for (name, scene) in [("office, 78 elements, 8000 poses", read(&office(1))), ("hall, 1926 elements, 8000 poses", read(&office(5)))] {
        group.throughput(Throughput::Elements(scene.elements.len() as u64));
        group.bench_function(name, |b| b.iter(|| Plan::new(black_box(&scene), &PlanOptions::default())));
    }
    group.finish();
}

fn parsing(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("parse");
    for (name, text) in [("office", office(1)), ("hall", office(5))] {
        group.throughput(Throughput::Bytes(text.len() as u64));
        let files = files(&text);
        group.bench_function(name, |b| b.iter(|| read_scene("scene.ron", black_box(&files), None).map(|scene| scene.elements.len())));
    }
    group.finish();
}

fn files(text: &str) -> MemoryFiles {
    let curve = |low: f64, high: f64| {
        let rows = (0..=40).map(|i| format!("{},{}", 380 + 10 * i, low + (high - low) / (1.0 + (-(f64::from(i) - 20.0) / 3.0).exp())));
        rows.collect::<Vec<_>>().join("\n")
    };
    MemoryFiles::new().with("scene.ron", text).with("paint.csv", curve(0.6, 0.75)).with("brick.csv", curve(0.06, 0.64))
}

fn read(text: &str) -> Scene {
    read_scene("scene.ron", &files(text), None).unwrap_or_else(|problems| panic!("{problems}"))
}

/// A panel over an unobstructed grid of n × n points.
fn bench(n: usize) -> String {
    let place = if n == 1 { "at: (0, 0, 0)".to_owned() } else { format!("grid: (from: (-1, -1, 0), to: (1, 1, 0), points: ({n}, {n}))") };
    format!(
        "Scene(sources: [(name: \"panel\", shape: Rectangle(0.6, 0.6), at: (0, 0, 2), facing: (0, 0, -1), strength: Radiance(1000), spectrum: \"A\")],
        instruments: [(name: \"meter\", sensor: {METER}, {place}, facing: (0, 0, 1))])"
    )
}

/// A room of one metre, open in front, with two blocks of five sides each and a lamp under the ceiling: 16 rectangles.
fn cornell(white: &str, wall: &str) -> String {
    let mut objects = String::new();
    for (name, quad, surface) in [
        ("floor", "corner: (0, 0, 0), u: (1, 0, 0), v: (0, 1, 0)", "white"),
        ("ceiling", "corner: (0, 0, 1), u: (0, 1, 0), v: (1, 0, 0)", "white"),
        ("back", "corner: (0, 1, 0), u: (1, 0, 0), v: (0, 0, 1)", "white"),
        ("left", "corner: (0, 0, 0), u: (0, 1, 0), v: (0, 0, 1)", "wall"),
        ("right", "corner: (1, 0, 0), u: (0, 0, 1), v: (0, 1, 0)", "wall"),
    ] {
        let _ = writeln!(objects, "(name: \"{name}\", surface: \"{surface}\", shape: Quad({quad})),");
    }
    for (name, x, y, side, height) in [("tall", 0.2, 0.5, 0.3, 0.6), ("short", 0.55, 0.2, 0.3, 0.3)] {
        block(&mut objects, name, [x, y], [side, side], height, "white");
    }
    format!(
        "Scene(surfaces: {{ \"white\": {white}, \"wall\": {wall} }}, objects: [{objects}],
        sources: [(name: \"lamp\", shape: Rectangle(0.3, 0.3), at: (0.5, 0.5, 0.99), facing: (0, 0, -1), strength: Lumens(1000), spectrum: \"A\")],
        instruments: [(name: \"meter\", sensor: {METER}, at: (0.12, 0.42, 0.0001), facing: (0, 0, 1))])"
    )
}

/// Five sides of an upright block on the floor.
fn block(objects: &mut String, name: &str, [x, y]: [f64; 2], [a, b]: [f64; 2], h: f64, surface: &str) {
    for (side, quad) in [
        ("top", format!("corner: ({x}, {y}, {h}), u: ({a}, 0, 0), v: (0, {b}, 0)")),
        ("south", format!("corner: ({x}, {y}, 0), u: ({a}, 0, 0), v: (0, 0, {h})")),
        ("east", format!("corner: ({}, {y}, 0), u: (0, {b}, 0), v: (0, 0, {h})", x + a)),
        ("north", format!("corner: ({}, {}, 0), u: (-{a}, 0, 0), v: (0, 0, {h})", x + a, y + b)),
        ("west", format!("corner: ({x}, {}, 0), u: (0, -{b}, 0), v: (0, 0, {h})", y + b)),
    ] {
        let _ = writeln!(objects, "(name: \"{name} {side}\", surface: \"{surface}\", shape: Quad({quad})),");
    }
}

/// Rooms of 10 m × 8 m × 3 m in one, `size` × `size` of them, each with 12 panels over 12 desks, and 100 × 80 points.
fn office(size: usize) -> String {
    let (width, depth) = (10.0 * size as f64, 8.0 * size as f64);
    let (mut objects, mut sources) = (String::new(), String::new());
    for (name, quad, surface) in [
        ("floor", format!("corner: (0, 0, 0), u: ({width}, 0, 0), v: (0, {depth}, 0)"), "floor"),
        ("ceiling", format!("corner: (0, 0, 3), u: (0, {depth}, 0), v: ({width}, 0, 0)"), "ceiling"),
        ("south", format!("corner: (0, 0, 0), u: (0, 0, 3), v: ({width}, 0, 0)"), "wall"),
        ("north", format!("corner: (0, {depth}, 0), u: ({width}, 0, 0), v: (0, 0, 3)"), "wall"),
        ("west", format!("corner: (0, 0, 0), u: (0, {depth}, 0), v: (0, 0, 3)"), "wall"),
        ("east", format!("corner: ({width}, 0, 0), u: (0, 0, 3), v: (0, {depth}, 0)"), "wall"),
    ] {
        let _ = writeln!(objects, "(name: \"{name}\", surface: \"{surface}\", shape: Quad({quad})),");
    }
    for i in 0..4 * size {
        for j in 0..3 * size {
            let (x, y) = (1.25 + 2.5 * i as f64, 4.0 / 3.0 + 8.0 / 3.0 * j as f64);
            let _ = writeln!(
                sources,
                "(name: \"panel {i} {j}\", shape: Rectangle(1.2, 0.3), at: ({x}, {y}, 2.99), facing: (0, 0, -1), strength: Radiance(1000), spectrum: \"A\"),"
            );
            block(&mut objects, &format!("desk {i} {j}"), [x - 0.8, y - 0.4], [1.6, 0.8], 0.75, "desk");
        }
    }
    format!(
        "Scene(surfaces: {{ \"floor\": Lambertian(0.2), \"ceiling\": Lambertian(0.8), \"wall\": Lambertian(0.5), \"desk\": Lambertian(0.5) }},
        objects: [{objects}], sources: [{sources}],
        instruments: [(name: \"plane\", sensor: {METER}, grid: (from: (0.05, 0.05, 0.8), to: ({}, {}, 0.8), points: (100, 80)), facing: (0, 0, 1))])",
        width - 0.05,
        depth - 0.05
    )
}
