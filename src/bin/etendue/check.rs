//! `etendue check SCENE`: every problem of the file, or "ok".

use crate::{Failure, disk, print};

/// Every problem of a scene file, or "ok".
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The scene file.
    scene: String,
    /// The folder that no file may lie outside of; by default the one that holds `scenes/` and `sensors/`, else the scene's own.
    #[arg(long, value_name = "DIR")]
    root: Option<String>,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let scene = disk::scene(&arguments.scene, arguments.root.as_deref())?;
    let count = |n: usize, one: &str, more: &str| format!("{n} {}", if n == 1 { one } else { more });
    let cameras = match scene.cameras.len() {
        0 => String::new(),
        n => format!(", {}", count(n, "camera", "cameras")),
    };
    print(&format!(
        "ok: {}, {}, {}{cameras}\n",
        count(scene.sources.len(), "source", "sources"),
        count(scene.elements.len(), "piece of surface", "pieces of surface"),
        count(scene.instruments.len(), "instrument", "instruments"),
    ))
}
