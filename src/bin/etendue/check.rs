//! `etendue check FILE`: every problem of the file, or "ok".

use etendue::scene::{Device, Scene, pixel_from_file};

use crate::{Failure, disk, print};

/// Every problem of a file, or "ok": a scene, a sensor, a camera, a pixel, or a calibration.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The file.
    #[arg(value_name = "SCENE")]
    file: String,
    /// The folder that no file may lie outside of; by default the one that holds `scenes/` and `sensors/`, else the file's own.
    #[arg(long, value_name = "DIR")]
    root: Option<String>,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let (file, root) = (arguments.file.as_str(), arguments.root.as_deref());
    let found = match disk::holds(file).as_deref() {
        Some("Sensor" | "Camera") => match disk::device(file, root)? {
            Device::Sensor(sensor) => format!("a sensor with {}", count(sensor.channels.len(), "channel", "channels")),
            Device::Camera(camera) => format!(
                "a camera of {} × {} pixels with {}{}",
                camera.columns,
                camera.rows,
                count(camera.channels.len(), "channel", "channels"),
                if camera.pixel.is_some() { "" } else { ", without electronics" },
            ),
        },
        Some("Pixel") => {
            let pixel = pixel_from_file(file, &disk::Anywhere).map_err(|problems| Failure::Input(problems.to_string()))?;
            format!("a pixel of {} e⁻ and {} bits", pixel.full_well_e, pixel.bits)
        }
        Some("Calibration") => {
            let calibration = disk::calibration(file, root)?;
            format!("a calibration with {}", count(calibration.exposures.len(), "exposure", "exposures"))
        }
        // What begins with anything else, too: the problems of a scene are told.
        _ => of_scene(&disk::scene(file, root)?),
    };
    print(&format!("ok: {found}\n"))
}

fn of_scene(scene: &Scene) -> String {
    let cameras = match scene.cameras.len() {
        0 => String::new(),
        n => format!(", {}", count(n, "camera", "cameras")),
    };
    format!(
        "{}, {}, {}{cameras}",
        count(scene.sources.len(), "source", "sources"),
        count(scene.elements.len(), "piece of surface", "pieces of surface"),
        count(scene.instruments.len(), "instrument", "instruments"),
    )
}

fn count(n: usize, one: &str, more: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { more })
}
