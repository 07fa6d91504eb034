//! Time of a data sheet: meters by goniometer and monochromator, cameras by frames of a flat field.
//!
//! Says in plain words what one sheet takes on all threads; asked for is less than 10 s.
#![allow(missing_docs, dead_code, clippy::print_stdout, clippy::unwrap_used)]

#[path = "../tests/disk/mod.rs"]
mod disk;

use std::hint::black_box;
use std::time::Instant;

use criterion::Criterion;
use disk::Repository;
use etendue::characterization::sheet::{self, camera, data_sheet};
use etendue::estimate::Watch;
use etendue::scene::{Device, device_from_file};

/// A plain meter, one with four channels and ranges, a head, a spot, and both cameras.
const SHELF: [&str; 6] =
    ["class-b-lux-meter", "silicon-photodiode-meter", "cylindrical-illuminance-meter", "luminance-meter-1deg", "mono-camera", "rgb-camera"];

fn main() {
    let mut criterion = Criterion::default().sample_size(10).configure_from_args();
    let mut group = criterion.benchmark_group("data sheet");
    let devices: Vec<(&str, Device)> = SHELF
        .into_iter()
        .map(|name| {
            let device = device_from_file(&format!("sensors/{name}.ron"), &Repository, None);
            (name, device.unwrap_or_else(|problems| panic!("{problems}")))
        })
        .collect();
    for (name, device) in &devices {
        group.bench_function(*name, |b| b.iter(|| made(black_box(device))));
    }
    group.finish();
    criterion.final_summary();
    for (name, device) in &devices {
        let start = Instant::now();
        made(device);
        println!("the data sheet of {name} takes {:.2} s; asked for: less than 10 s", start.elapsed().as_secs_f64());
    }
}

/// Makes a sheet and gives the number of readings or frames that it took.
fn made(device: &Device) -> u64 {
    let watch = Watch { now: &|| 0.0, progress: &|_| {} };
    match device {
        Device::Sensor(sensor) => data_sheet(sensor, &sheet::Options::default(), &watch).unwrap().tally.0 as u64,
        Device::Camera(model) => camera::camera_sheet(model, &camera::Options::default(), &watch).unwrap().frames,
    }
}
