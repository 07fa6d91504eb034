//! Sensor files → sensors.
//!
//! ```ron
//! Sensor(
//!     title: "Class B illuminance meter",
//!     aperture: Disc(radius_mm: 5),
//!     acceptance: Directional("directional.csv"),
//!     channels: [(name: "E_v", responsivity: "responsivity.csv", reads: Illuminance(adjusted_with: "A"))],
//! )
//! ```
//!
//! | part | how it is written |
//! |---|---|
//! | aperture | `Point`, `Disc(radius_mm: 5)`, `Rectangle(width_mm: 10, height_mm: 8)`; `_m` for metres |
//! | acceptance | `Cosine`, `Cone(half_angle_deg: 0.5)`, `Cylindrical` and more (`acceptance_reader.rs`) |
//! | channels | a list of `(name: …, responsivity: …, reads: …)` (`channel_reader.rs`) and `Observer("CIE 1931")` (`observer_reader.rs`), or one `Observer(…)` |
//! | readout | none, or `Photodiode(…)` (`readout_reader.rs`) |

use std::sync::Arc;

use super::acceptance_reader::{read_acceptance, words_of_head};
use super::channel_reader::read_channel;
use super::decode::{Fields, Value};
use super::document::Kind;
use super::observer_reader::{is_observer, read_observer};
use super::reading::Reading;
use super::readout_reader::read_readout;
use crate::sensor::{Acceptance, Aperture, Channel, Photodiode, Sensor};

/// The sensor of an instrument: the name of a file, or the sensor itself.
pub(super) fn read_sensor(value: &Value, reading: &mut Reading) -> Option<Arc<Sensor>> {
    if let Kind::Text(name) = &value.node.kind {
        let path = reading.path(value, name)?;
        if let Some(known) = reading.sensors.get(&path) {
            return known.clone();
        }
        let sensor = reading
            .document(value, &path, "sensor file")
            .and_then(|document| read_sensor_body(&Value::root(&document), &path, reading))
            .map(Arc::new);
        reading.sensors.insert(path, sensor.clone());
        return sensor;
    }
    if value.name() == "Sensor" {
        return read_sensor_body(value, "sensor", reading).map(Arc::new);
    }
    let found = value.described();
    value.problem(
        &mut reading.problems,
        format!("a sensor is expected, not {found}"),
        "write the name of a sensor file in quotes, or `Sensor(aperture: …, acceptance: …, channels: […])`",
    );
    None
}

pub(super) fn read_sensor_body(value: &Value, name: &str, reading: &mut Reading) -> Option<Sensor> {
    let problems = &mut reading.problems;
    if value.name() != "Sensor" {
        let found = value.described();
        value.problem_at(
            &value.name_span(),
            problems,
            format!("a sensor file holds `Sensor(…)`, not {found}"),
            "write `Sensor(aperture: …, acceptance: …, channels: […])`",
        );
        return None;
    }
    let before = problems.count();
    let fields = value.fields("`Sensor`", &["title", "aperture", "acceptance", "channels", "readout"], problems)?;
    let title = fields.get("title").and_then(|title| title.text(problems)).unwrap_or(name).to_string();
    let aperture_value = fields.require("aperture", "Point", problems);
    let aperture = aperture_value.as_ref().and_then(|v| read_aperture(v, reading));
    let acceptance = fields.require("acceptance", "Cosine", &mut reading.problems).and_then(|v| read_acceptance(&v, aperture, reading));
    let head = acceptance.as_ref().and_then(Acceptance::head);
    if let (Some(head), Some(value)) = (head, aperture_value.filter(|_| aperture.is_some_and(|a| a != Aperture::Point))) {
        value.problem(
            &mut reading.problems,
            format!("a {} receptor is a point here", head.name()),
            "give `aperture: Point`; its readings are per area of the receptor, whatever its size",
        );
    }
    let channels = fields.require("channels", "[(name: \"E_v\", responsivity: \"V\", reads: Illuminance)]", &mut reading.problems);
    let items =
        channels.as_ref().and_then(|v| if is_observer(v) { Some(vec![v.clone()]) } else { v.list("channels", &mut reading.problems) });
    let mut list: Vec<Channel> = Vec::new();
    for item in items.iter().flatten() {
        let observer = is_observer(item);
        let channels = if observer {
            let mut channels = read_observer(item, acceptance.as_ref(), reading).unwrap_or_default();
            channels.iter_mut().for_each(|channel| channel.reads = words_of_head(&channel.reads, head));
            channels
        } else {
            read_channel(item, aperture, acceptance.as_ref(), reading).into_iter().collect()
        };
        let known = channels.iter().find(|channel| list.iter().any(|earlier| earlier.name == channel.name));
        if let Some(channel) = known {
            let (span, help) = if observer {
                (item.name_span(), "give the two a sensor each: the names of an observer's channels are fixed")
            } else {
                (item.title_span(), "give each its own name")
            };
            item.problem_at(&span, &mut reading.problems, format!("two channels are called \"{}\"", channel.name), help);
        }
        list.extend(channels);
    }
    if let (Some(channels), Some([])) = (&channels, items.as_deref()) {
        channels.problem(
            &mut reading.problems,
            "the sensor has no channel, so there is nothing to read",
            "add `(name: \"E_v\", responsivity: \"V\", reads: Illuminance)`",
        );
    }
    let readout = fields.get("readout").map(|v| read_readout(&v, reading));
    if reading.problems.count() > before {
        return None;
    }
    let sensor = Sensor::new(title, aperture?, acceptance?, list);
    match readout {
        Some(readout) => with_readout(sensor, readout?, &fields, reading),
        None => Some(sensor),
    }
}

/// Electronics need a photocurrent of every channel.
fn with_readout(sensor: Sensor, readout: Photodiode, fields: &Fields, reading: &mut Reading) -> Option<Sensor> {
    let sensor = Sensor { readout: Some(readout), ..sensor };
    let lacking = sensor.channels.iter().find(|channel| sensor.photocurrent_per_unit_a(channel).is_none());
    let Some(channel) = lacking else { return Some(sensor) };
    let (name, unit) = (&channel.name, channel.reads.unit());
    let why = match channel.kind.is_absolute() {
        true => "the aperture is a point, and a current is collected by an area",
        false => "its responsivity is not in A/W",
    };
    let value = fields.get("readout")?;
    value.problem_at(
        &value.name_span(),
        &mut reading.problems,
        format!("the readout does not know the photocurrent of the channel \"{name}\": {why}"),
        format!("add `current_a_per_unit: 1e-9` to the readout, in A per {unit}, or give the channel `AmperesPerWatt(…)` and the aperture a size"),
    );
    None
}

/// A length given in one of two units.
fn read_length(value: &Value, fields: &Fields, stem: &str, reading: &mut Reading) -> Option<f64> {
    let (mm, m) = (format!("{stem}_mm"), format!("{stem}_m"));
    let problems = &mut reading.problems;
    match (fields.get(&mm), fields.get(&m)) {
        (Some(_), Some(_)) => {
            value.problem_at(&fields.key_span(&m), problems, format!("both `{mm}` and `{m}` are given"), "keep one of them");
            None
        }
        (Some(given), None) => given.length_m(&format!("`{mm}`"), 1e-3, problems),
        (None, Some(given)) => given.length_m(&format!("`{m}`"), 1.0, problems),
        (None, None) => {
            fields.require(&mm, "5", problems);
            None
        }
    }
}

fn read_aperture(value: &Value, reading: &mut Reading) -> Option<Aperture> {
    match value.variant("an aperture", &["Point", "Disc", "Rectangle"], &mut reading.problems)? {
        "Point" => value.without_brackets(&mut reading.problems).map(|()| Aperture::Point),
        "Disc" => {
            let fields = value.fields("`Disc`", &["radius_mm", "radius_m"], &mut reading.problems)?;
            Some(Aperture::Disc { radius_m: read_length(value, &fields, "radius", reading)? })
        }
        _ => {
            let fields = value.fields("`Rectangle`", &["width_mm", "height_mm", "width_m", "height_m"], &mut reading.problems)?;
            let (width, height) = (read_length(value, &fields, "width", reading), read_length(value, &fields, "height", reading));
            Some(Aperture::Rectangle { half_width_m: 0.5 * width?, half_height_m: 0.5 * height? })
        }
    }
}
