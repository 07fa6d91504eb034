//! Camera files → cameras, and the cameras of a scene.
//!
//! ```ron
//! Camera(
//!     title: "RGB camera",
//!     lens: Thin(focal_length_mm: 16, f_number: 4, focus_m: 1.2),     // focus_m: inf for a lens focused at infinity
//!     transmittance: 0.9,
//!     columns: 1024, rows: 1024, pitch_um: 5, fill_factor: 0.6,
//!     mosaic: Bayer("RGGB"),
//!     channels: [(name: "R", quantum_efficiency: "r.csv"), (name: "G", quantum_efficiency: "g.csv"), (name: "B", quantum_efficiency: "b.csv")],
//!     exposure_ms: 10, temperature_c: 20,
//! )
//! ```
//!
//! | key | how it is written | if it is left out |
//! |---|---|---|
//! | `lens` | `Thin(focal_length_mm: 16, f_number: 4, focus_m: 1.2)`, `Pinhole(distance_mm: 16, diameter_mm: 0.2)` | |
//! | `transmittance` | a factor, 0 to 1 | 1 |
//! | `columns`, `rows` | whole numbers | |
//! | `pitch_um` | µm | |
//! | `fill_factor` | above 0 to 1 | 1 |
//! | `angular_response` | `Directional("table.csv")` | every direction alike |
//! | `mosaic` | `None`, `Bayer("RGGB")`, `Pattern([["R", "G"], ["G", "B"]])` | `None` |
//! | `exposure_ms` or `exposure_s` | above 0 | |
//! | `pixel` | `Pixel(…)` (`pixel_reader.rs`) | expected electrons, but no raw frames |
//! | `temperature_c` | °C, −273.15 to 200 | 20 |

use std::sync::Arc;

use super::Pose;
use super::camera::{PlacedCamera, Region};
use super::decode::{Fields, Value, readable};
use super::directional_table::read_directional;
use super::document::{Body, Kind};
use super::factor_range::{is_zero, outside_of};
use super::pixel_reader::read_pixel;
use super::placement::read_facing;
use super::reading::Reading;
use super::responsivity_reader::{other_unit, read_curve};
use super::spectrum_reader::read_factor;
use crate::math::DVec3;
use crate::naming::suggestion;
use crate::sensor::ResponsivityKind;
use crate::sensor::camera::{Camera, ColourChannel, Lens, MOST_PIXELS, Mosaic};
use crate::spectrum::{Factor, Outside};

/// The pupil of a lens in air is at most twice as wide as the focal length: the sine of the angle at the image is at most 1.
const LENSES_IN_AIR: &str = "0.5, the limit in air, to 1e6, such as 2.8";

const KEYS: [&str; 14] = [
    "title",
    "lens",
    "transmittance",
    "columns",
    "rows",
    "pitch_um",
    "fill_factor",
    "angular_response",
    "mosaic",
    "channels",
    "exposure_s",
    "exposure_ms",
    "temperature_c",
    "pixel",
];

/// Reads a camera of a scene.
pub(super) fn read_camera(value: &Value, name: Option<&str>, reading: &mut Reading) -> Option<PlacedCamera> {
    let fields = value.fields("a camera", &["name", "camera", "at", "facing", "up", "regions"], &mut reading.problems)?;
    let camera =
        fields.require("camera", "\"../sensors/rgb-camera.ron\"", &mut reading.problems).and_then(|v| read_camera_model(&v, reading));
    let at = fields.require("at", "(0, 0, 1)", &mut reading.problems).and_then(|v| v.point_m(&mut reading.problems));
    let facing = fields.require("facing", "(0, 1, 0)", &mut reading.problems);
    let frame = facing.and_then(|_| read_facing(&fields, DVec3::ZERO, &mut reading.problems));
    let regions = match (fields.get("regions"), &camera) {
        (Some(regions), Some(camera)) => read_regions(&regions, camera, reading),
        _ => Some(Vec::new()),
    };
    let frame = frame?;
    let pose = Pose { at: at?, normal: frame.z, x_axis: frame.x };
    Some(PlacedCamera { name: name?.into(), camera: camera?, pose, regions: regions? })
}

/// The name of a camera file, or the camera itself.
fn read_camera_model(value: &Value, reading: &mut Reading) -> Option<Arc<Camera>> {
    if let Kind::Text(name) = &value.node.kind {
        let path = reading.path(value, name)?;
        if let Some(known) = reading.cameras.get(&path) {
            return known.clone();
        }
        let document = reading.document(value, &path, "camera file");
        let camera = document.and_then(|document| read_camera_body(&Value::root(&document), &path, reading)).map(Arc::new);
        reading.cameras.insert(path, camera.clone());
        return camera;
    }
    read_camera_body(value, "camera", reading).map(Arc::new)
}

pub(super) fn read_camera_body(value: &Value, name: &str, reading: &mut Reading) -> Option<Camera> {
    if value.name() != "Camera" {
        let found = value.described();
        let help = if value.name() == "Sensor" {
            "a `Sensor` belongs into `instruments: [(name: …, sensor: …)]`"
        } else {
            "write the name of a camera file in quotes, or `Camera(lens: …, columns: …, rows: …, pitch_um: …, channels: […], exposure_ms: …)`"
        };
        value.problem_at(&value.name_span(), &mut reading.problems, format!("a camera is `Camera(…)`, not {found}"), help);
        return None;
    }
    let before = reading.problems.count();
    let fields = value.fields("`Camera`", &KEYS, &mut reading.problems)?;
    let title = fields.get("title").and_then(|title| title.text(&mut reading.problems)).unwrap_or(name).to_string();
    let example = "Thin(focal_length_mm: 16, f_number: 4, focus_m: 1.2)";
    let lens = fields.require("lens", example, &mut reading.problems).and_then(|v| read_lens(&v, reading));
    let transmittance = match fields.get("transmittance") {
        Some(given) => read_share(&given, "the transmittance", reading),
        None => Some(Factor::ONE),
    };
    let (columns, rows) = (read_count(&fields, "columns", reading), read_count(&fields, "rows", reading));
    if let (Some(columns), Some(rows)) = (columns, rows)
        && columns.saturating_mul(rows) > MOST_PIXELS
    {
        let found = format!("the camera has {} pixels", columns.saturating_mul(rows));
        value.problem_at(&fields.key_span("columns"), &mut reading.problems, found, format!("allowed: up to {MOST_PIXELS}"));
    }
    let pitch_m =
        fields.require("pitch_um", "5", &mut reading.problems).and_then(|v| v.length_m("`pitch_um`", 1e-6, &mut reading.problems));
    let fill_factor = match fields.get("fill_factor") {
        Some(v) => v.number_in("`fill_factor`", "above 0, up to 1", |x| x > 0.0 && x <= 1.0, &mut reading.problems),
        None => Some(1.0),
    };
    let angular_response = fields.get("angular_response").and_then(|v| {
        v.variant("a response of micro-lenses", &["Directional"], &mut reading.problems)?;
        let file = v.positional(1, "Directional(\"micro-lens.csv\")", &mut reading.problems)?.into_iter().next()?;
        read_directional(&file, reading)
    });
    let channels = read_channels(&fields, reading);
    let mosaic = match (fields.get("mosaic"), &channels) {
        (Some(mosaic), Some(channels)) => read_mosaic(&mosaic, channels, reading),
        _ => None,
    };
    let exposure_s = read_exposure(value, &fields, reading);
    let temperature_c = match fields.get("temperature_c") {
        Some(v) => v.number_in("`temperature_c`", "-273.15 to 200", |x| (-273.15..=200.0).contains(&x), &mut reading.problems),
        None => Some(20.0),
    };
    let pixel = fields.get("pixel").and_then(|v| read_pixel(&v, reading));
    if reading.problems.count() > before {
        return None;
    }
    Some(Camera {
        title,
        lens: lens?,
        transmittance: transmittance?,
        columns: columns?,
        rows: rows?,
        pitch_m: pitch_m?,
        fill_factor: fill_factor?,
        angular_response,
        mosaic,
        channels: channels?,
        pixel,
        exposure_s: exposure_s?,
        temperature_c: temperature_c?,
    })
}

fn read_lens(value: &Value, reading: &mut Reading) -> Option<Lens> {
    let problems = &mut reading.problems;
    if value.variant("a lens", &["Thin", "Pinhole"], problems)? == "Pinhole" {
        let fields = value.fields("`Pinhole`", &["distance_mm", "diameter_mm"], problems)?;
        let mut length =
            |key: &str, example: &str| fields.require(key, example, problems).and_then(|v| v.length_m(&format!("`{key}`"), 1e-3, problems));
        let (distance_m, diameter_m) = (length("distance_mm", "16"), length("diameter_mm", "0.2"));
        return Some(Lens::Pinhole { distance_m: distance_m?, diameter_m: diameter_m? });
    }
    let fields = value.fields("`Thin`", &["focal_length_mm", "f_number", "focus_m"], problems)?;
    let focal_length_m = fields.require("focal_length_mm", "16", problems).and_then(|v| v.length_m("`focal_length_mm`", 1e-3, problems));
    let f_number = fields
        .require("f_number", "4", problems)
        .and_then(|v| v.number_in("the f-number", LENSES_IN_AIR, |x| (0.5..=1e6).contains(&x), problems));
    let focus = fields.require("focus_m", "1.2", problems)?;
    let focus_m = match focus.node.kind {
        Kind::Number(f64::INFINITY) => Some(f64::INFINITY),
        _ => focus.length_m("`focus_m`", 1.0, problems),
    };
    let (focal_length_m, f_number, focus_m) = (focal_length_m?, f_number?, focus_m?);
    if focus_m <= focal_length_m {
        let found =
            format!("the lens is focused at {focus_m} m, inside its focal length of {} mm: it forms no image there", 1e3 * focal_length_m);
        let help = format!("allowed: `focus_m` above {focal_length_m}, or `inf` for a lens focused at infinity");
        focus.problem(problems, found, help);
        return None;
    }
    Some(Lens::Thin { focal_length_m, f_number, focus_m })
}

/// A factor that is nowhere negative and nowhere above one.
fn read_share(value: &Value, what: &str, reading: &mut Reading) -> Option<Factor> {
    let factor = read_factor(value, Outside::Zero, reading)?;
    if let Some((nm, found)) = outside_of(&factor, 0.0, 1.0) {
        let place = if matches!(factor, Factor::Constant(_)) { String::new() } else { format!(" at {nm} nm") };
        let help = "allowed: 0 to 1 at every wavelength (85 % is written 0.85); `Scaled(0.5, …)` makes a relative curve smaller";
        value.problem(&mut reading.problems, format!("{what} is {}{place}", readable(found)), help);
        return None;
    }
    if is_zero(&factor) {
        value.problem(
            &mut reading.problems,
            format!("{what} is zero at every wavelength, so the image stays dark"),
            "give a factor that is above zero somewhere",
        );
        return None;
    }
    Some(factor)
}

/// A quantum efficiency; a file that states another unit is refused.
fn read_efficiency(value: &Value, reading: &mut Reading) -> Option<Factor> {
    let (_, stated, _) = read_curve(value, reading)?;
    if let Some((_, ResponsivityKind::AmperesPerWatt)) = stated {
        value.problem(
            &mut reading.problems,
            "the file says that its values are in A/W, but a quantum efficiency is in electrons per photon",
            "multiply them by h c/(e n λ), 1239.8/λ for λ in nm, or correct `# unit:` in the file",
        );
        return None;
    }
    if let Some(unit) = other_unit(value, reading) {
        value.problem(
            &mut reading.problems,
            format!("the file says that its values are in {unit}, but a quantum efficiency is in electrons per photon"),
            "give electrons per photon, 0 to 1, or correct `# unit:` in the file",
        );
        return None;
    }
    read_share(value, "the quantum efficiency", reading)
}

fn read_count(fields: &Fields, key: &str, reading: &mut Reading) -> Option<usize> {
    let whole = |x: f64| x >= 1.0 && x.fract() == 0.0 && x <= MOST_PIXELS as f64;
    let value = fields.require(key, "1024", &mut reading.problems)?;
    let allowed = format!("whole numbers from 1 to {MOST_PIXELS}");
    value.number_in(&format!("`{key}`"), &allowed, whole, &mut reading.problems).map(|x| x as usize)
}

fn read_exposure(value: &Value, fields: &Fields, reading: &mut Reading) -> Option<f64> {
    let problems = &mut reading.problems;
    let allowed = "above 0, up to 1e6 s";
    match (fields.get("exposure_s"), fields.get("exposure_ms")) {
        (Some(_), Some(_)) => {
            let span = fields.key_span("exposure_ms");
            value.problem_at(&span, problems, "both `exposure_s` and `exposure_ms` are given", "keep one of them");
            None
        }
        (Some(s), None) => s.number_in("`exposure_s`", allowed, |x| x > 0.0 && x <= 1e6, problems),
        (None, Some(ms)) => ms.number_in("`exposure_ms`", allowed, |x| x > 0.0 && x <= 1e9, problems).map(|x| 1e-3 * x),
        (None, None) => {
            fields.require("exposure_ms", "10", problems);
            None
        }
    }
}

fn read_channels(fields: &Fields, reading: &mut Reading) -> Option<Vec<ColourChannel>> {
    let example = "[(name: \"grey\", quantum_efficiency: 0.6)]";
    let value = fields.require("channels", example, &mut reading.problems)?;
    let items = value.list("channels", &mut reading.problems)?;
    if items.is_empty() {
        value.problem(&mut reading.problems, "the camera has no channel, so nothing is recorded", format!("write `{example}`"));
        return None;
    }
    let mut channels: Vec<ColourChannel> = Vec::new();
    let count = items.len();
    for item in items {
        let Some(parts) = item.fields("a channel of a camera", &["name", "quantum_efficiency"], &mut reading.problems) else { continue };
        let name = parts.require("name", "\"R\"", &mut reading.problems).and_then(|v| v.text(&mut reading.problems));
        let efficiency = parts.require("quantum_efficiency", "0.6", &mut reading.problems);
        let efficiency = efficiency.and_then(|v| read_efficiency(&v, reading));
        if let Some(name) = name
            && channels.iter().any(|channel| channel.name == name)
        {
            let message = format!("two channels are called \"{name}\"");
            item.problem_at(&item.title_span(), &mut reading.problems, message, "give each its own name");
        }
        if let (Some(name), Some(quantum_efficiency)) = (name, efficiency) {
            channels.push(ColourChannel { name: name.into(), quantum_efficiency });
        }
    }
    (channels.len() == count).then_some(channels)
}

/// A mosaic in which every channel has a pixel.
fn read_mosaic(value: &Value, channels: &[ColourChannel], reading: &mut Reading) -> Option<Mosaic> {
    let mosaic = read_pattern(value, channels, reading)?;
    for (_, channel) in channels.iter().enumerate().filter(|(index, _)| !mosaic.has(*index)) {
        let found = format!("no pixel is behind the filter of the channel \"{}\": the mosaic does not name it", channel.name);
        value.problem(&mut reading.problems, found, "name it in the mosaic, or take it out of `channels`");
    }
    Some(mosaic)
}

fn read_pattern(value: &Value, channels: &[ColourChannel], reading: &mut Reading) -> Option<Mosaic> {
    let kind = value.variant("a mosaic", &["None", "Bayer", "Pattern"], &mut reading.problems)?;
    if kind == "None" {
        value.without_brackets(&mut reading.problems);
        return None;
    }
    let names: Vec<&str> = channels.iter().map(|channel| channel.name.as_str()).collect();
    let index = |name: &str, at: &Value, reading: &mut Reading| {
        let found = names.iter().position(|known| *known == name);
        if found.is_none() {
            let help = format!("{}; a mosaic is made of the names of the channels", suggestion(name, &names));
            at.problem(&mut reading.problems, format!("the mosaic names \"{name}\", but there is no such channel"), help);
        }
        found
    };
    if kind == "Bayer" {
        let item = value.positional(1, "Bayer(\"RGGB\")", &mut reading.problems)?.into_iter().next()?;
        let letters: Vec<String> = item.text(&mut reading.problems)?.chars().map(String::from).collect();
        if letters.len() != 4 {
            let found = format!("a Bayer pattern has 2 × 2 filters, not {}", letters.len());
            item.problem(&mut reading.problems, found, "write four letters, row by row, such as `Bayer(\"RGGB\")`");
            return None;
        }
        let cells: Vec<Option<usize>> = letters.iter().map(|letter| index(letter, &item, reading)).collect();
        let cells = cells.into_iter().collect::<Option<Vec<usize>>>()?;
        return Mosaic::new(&[cells[..2].to_vec(), cells[2..].to_vec()]);
    }
    let item = value.positional(1, "Pattern([[\"R\", \"G\"], [\"G\", \"B\"]])", &mut reading.problems)?.into_iter().next()?;
    let rows = item.list("the rows of a pattern", &mut reading.problems)?;
    let mut cells: Vec<Vec<usize>> = Vec::new();
    let mut complete = true;
    for row in &rows {
        let items = row.list("the filters of a row", &mut reading.problems)?;
        let found: Vec<Option<usize>> =
            items.iter().map(|cell| cell.text(&mut reading.problems).and_then(|name| index(name, cell, reading))).collect();
        complete &= found.iter().all(Option::is_some);
        cells.push(found.into_iter().map(Option::unwrap_or_default).collect());
    }
    let mosaic = Mosaic::new(&cells);
    if mosaic.is_none() {
        let lengths: Vec<String> = cells.iter().map(|row| row.len().to_string()).collect();
        let found = format!("the rows of the pattern have {} filters", if lengths.is_empty() { "no".into() } else { lengths.join(", ") });
        item.problem(&mut reading.problems, found, "give every row the same number of filters, at least one");
    }
    mosaic.filter(|_| complete)
}

fn read_regions(value: &Value, camera: &Camera, reading: &mut Reading) -> Option<Vec<Region>> {
    let Kind::Map(entries) = &value.node.kind else {
        // `{}` and `()` hold no region.
        if matches!(&value.node.kind, Kind::Struct { body: Body::Positional(items), .. } if items.is_empty()) {
            return Some(Vec::new());
        }
        let found = value.described();
        let help = "write `{ \"patch 1\": (x: 10, y: 12, width: 8, height: 8) }`";
        value.problem(&mut reading.problems, format!("regions are written as a map, not {found}"), help);
        return None;
    };
    let mut regions: Vec<Region> = Vec::new();
    let before = reading.problems.count();
    for (key, node) in entries {
        let Some(name) = value.child(key, "key").text(&mut reading.problems) else { continue };
        let item = value.child(node, &format!("[\"{name}\"]"));
        if regions.iter().any(|region| region.name == name) {
            item.problem_at(&key.span, &mut reading.problems, format!("two regions are called \"{name}\""), "give each its own name");
        }
        let Some(fields) = item.fields("a region", &["x", "y", "width", "height"], &mut reading.problems) else { continue };
        let mut pixel = |key: &str, least: f64| {
            let v = fields.require(key, "8", &mut reading.problems)?;
            let allowed = format!("whole numbers from {least}");
            v.number_in(&format!("`{key}`"), &allowed, |x| x >= least && x.fract() == 0.0 && x <= 1e9, &mut reading.problems)
                .map(|x| x as usize)
        };
        let (x, y, width, height) = (pixel("x", 0.0), pixel("y", 0.0), pixel("width", 1.0), pixel("height", 1.0));
        let (Some(x), Some(y), Some(width), Some(height)) = (x, y, width, height) else { continue };
        if x + width > camera.columns || y + height > camera.rows {
            let found = format!("the region \"{name}\" ends at column {} and row {}, outside of the image", x + width, y + height);
            let help =
                format!("allowed: up to column {} and row {}; both are counted from 0 at the upper left", camera.columns, camera.rows);
            item.problem(&mut reading.problems, found, help);
            continue;
        }
        regions.push(Region { name: name.into(), x, y, width, height });
    }
    (reading.problems.count() == before).then_some(regions)
}
