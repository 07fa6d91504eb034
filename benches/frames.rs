//! Noisy frames of a camera: elements are pixels, so 1e6 pixels a second are one frame of 1 megapixel.
#![allow(missing_docs)]

use std::hint::black_box;

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
