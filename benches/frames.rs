//! Noisy frames of a camera: elements are pixels, so 1e6 pixels a second are one frame of 1 megapixel.
#![allow(missing_docs, clippy::print_stdout)]

use std::hint::black_box;
use std::time::Instant;

use criterion::{Criterion, Throughput};
use etendue::estimate::frames::expose_into;
use etendue::estimate::run::with_threads;
use etendue::report::image::{png16, tiff16};
use etendue::sensor::{Exposure, Pixel};

const SIDE: usize = 1024;

fn main() {
    let mut criterion = Criterion::default().sample_size(20).configure_from_args();
    exposures(&mut criterion);
    files(&mut criterion);
    criterion.final_summary();
    thousand();
}

/// A thousand frames in the memory of one, as a camera delivers them.
fn thousand() {
    const FRAMES: u64 = 1000;
    let electrons = vec![5000.0f32; SIDE * SIDE];
    let mut frame = vec![0u16; SIDE * SIDE];
    let resident = || {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let line = status.lines().find(|line| line.starts_with("VmHWM:")).unwrap_or_default().to_owned();
        line.split_whitespace().nth(1).and_then(|kb| kb.parse::<f64>().ok()).map(|kb| kb / 1024.0)
    };
    let shoot = |number: u64, frame: &mut [u16]| {
        let of = Exposure { exposure_s: 0.01, temperature_c: 20.0, seed: 1, frame: number };
        expose_into(&camera(), &of, black_box(&electrons), frame);
    };
    shoot(0, &mut frame);
    let before = resident();
    let start = Instant::now();
    (1..=FRAMES).for_each(|number| shoot(number, &mut frame));
    let seconds = start.elapsed().as_secs_f64();
    let memory = before.zip(resident()).map_or_else(
        || "memory is not known here".to_owned(),
        |(before, after)| format!("the peak of memory rose by {:.1} MB from {before:.0} MB", after - before),
    );
    println!(
        "{FRAMES} noisy frames of 1 megapixel take {seconds:.1} s, {:.0} a second on all threads; asked for: more than 20. From the first to the \
         last {memory}",
        FRAMES as f64 / seconds
    );
}

fn camera() -> Pixel {
    Pixel { dark_current_e_s: 300.0, read_noise_e: 8.0, dsnu_e: 3.0, prnu: 0.008, ..Pixel::ideal(0.25, 14000.0, 64.0, 12) }
}

fn exposures(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("frame of 1024 x 1024");
    group.throughput(Throughput::Elements((SIDE * SIDE) as u64));
    let ramp: Vec<f32> = (0..SIDE * SIDE).map(|i| 14_000.0 * (i % SIDE) as f32 / SIDE as f32).collect();
    for (name, electrons, threads) in [
        ("ramp to saturation, 1 thread", ramp.clone(), 1),
        ("ramp to saturation, 2 threads", ramp, 2),
        ("3 electrons, 1 thread", vec![3.0; SIDE * SIDE], 1),
    ] {
        let mut frame = vec![0u16; SIDE * SIDE];
        let mut number = 0;
        group.bench_function(name, |b| {
            with_threads(Some(threads), || {
                b.iter(|| {
                    number += 1;
                    let of = Exposure { exposure_s: 0.01, temperature_c: 20.0, seed: 1, frame: number };
                    expose_into(&camera(), &of, black_box(&electrons), &mut frame);
                    frame[0]
                });
            });
        });
    }
    group.finish();
}

fn files(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("file of 1024 x 1024");
    group.throughput(Throughput::Elements((SIDE * SIDE) as u64));
    let frame = camera().expose(&vec![5000.0; SIDE * SIDE], 0.01, 20.0, 1, 0);
    group.bench_function("png16", |b| b.iter(|| png16(black_box(&frame), SIDE, SIDE).map(|bytes| bytes.len())));
    group.bench_function("tiff16", |b| b.iter(|| tiff16(black_box(&frame), SIDE, SIDE).map(|bytes| bytes.len())));
    group.finish();
}
