//! A file of the shelf, whatever it holds: a sensor or a camera.

use super::camera_reader::read_camera_body;
use super::decode::Value;
use super::diagnostic::Diagnostics;
use super::files::{Files, normalised, root_of};
use super::reading::Reading;
use super::sensor_reader::read_sensor_body;
use crate::sensor::Sensor;
use crate::sensor::camera::Camera;

/// What a file of the shelf holds.
#[derive(Clone, Debug)]
pub enum Device {
    /// `Sensor(…)`.
    Sensor(Box<Sensor>),
    /// `Camera(…)`.
    Camera(Box<Camera>),
}

/// The name that a file begins with, such as `Scene`, `Sensor` or `Pixel`; `None` if it cannot be read or holds nothing of that form.
#[must_use]
pub fn held_by(path: &str, files: &dyn Files) -> Option<String> {
    let path = normalised(path);
    let mut reading = Reading::new(files, &path, root_of(&path));
    let document = reading.first_document(&path, "file")?;
    Some(Value::root(&document).name().to_owned()).filter(|name| !name.is_empty())
}

/// Reads a file that holds `Sensor(…)` or `Camera(…)` and the files that it mentions, as [`sensor_from_file`] does.
///
/// # Errors
/// Every problem of every file, at least one.
pub fn device_from_file(path: &str, files: &dyn Files, root: Option<&str>) -> Result<Device, Diagnostics> {
    read_file(path, files, root, read_device)
}

fn read_device(value: &Value, path: &str, reading: &mut Reading) -> Option<Device> {
    match value.name() {
        "Camera" => read_camera_body(value, path, reading).map(|camera| Device::Camera(Box::new(camera))),
        "Sensor" => read_sensor_body(value, path, reading).map(|sensor| Device::Sensor(Box::new(sensor))),
        _ => {
            let found = value.described();
            value.problem_at(
                &value.name_span(),
                &mut reading.problems,
                format!("a file with a data sheet holds `Sensor(…)` or `Camera(…)`, not {found}"),
                "write `Sensor(aperture: …, acceptance: …, channels: […])` or `Camera(lens: …, columns: …, rows: …, pixel: Pixel(…), …)`",
            );
            None
        }
    }
}

/// Reads a file as [`device_from_file`] for a data sheet: a camera needs its pixel there.
///
/// # Errors
/// Every problem of every file, at least one.
pub fn characterised_from_file(path: &str, files: &dyn Files, root: Option<&str>) -> Result<Device, Diagnostics> {
    read_file(path, files, root, |value, path, reading| {
        if value.name() != "Camera" {
            return read_device(value, path, reading);
        }
        let camera = read_camera_body(value, path, reading)?;
        if camera.pixel.is_none() {
            value.problem_at(
                &value.name_span(),
                &mut reading.problems,
                "the camera has no `pixel`, so it gives expected electrons and no frames to measure",
                "add `pixel: Pixel(gain_dn_per_e: 0.35, full_well_e: 10500, bits: 12, black_dn: 64, read_noise_e: 3, dark_current_e_s: 5, \
                 dsnu_e: 1.5, prnu: 0.006)`",
            );
        }
        Some(Device::Camera(Box::new(camera)))
    })
}

/// Reads one sensor file and the files that it mentions, without a scene.
///
/// `path` is what `files` is asked for; the names in the file may not leave the folder `root`, by default as for a scene.
///
/// # Errors
/// Every problem of every file, at least one.
pub fn sensor_from_file(path: &str, files: &dyn Files, root: Option<&str>) -> Result<Sensor, Diagnostics> {
    read_file(path, files, root, read_sensor_body)
}

fn read_file<T>(
    path: &str,
    files: &dyn Files,
    root: Option<&str>,
    read: impl FnOnce(&Value, &str, &mut Reading) -> Option<T>,
) -> Result<T, Diagnostics> {
    let path = normalised(path);
    let root = root.map_or_else(|| root_of(&path), normalised);
    let mut reading = Reading::new(files, &path, root);
    let document = reading.first_document(&path, "sensor file");
    match document.and_then(|document| read(&Value::root(&document), &path, &mut reading)) {
        Some(found) if reading.problems.count() == 0 => Ok(found),
        _ => Err(reading.problems.finish()),
    }
}
