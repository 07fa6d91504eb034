//! Exposures of a calibration file.
//!
//! | exposures | what is put in front of the sensor |
//! |---|---|
//! | `Monochromator(from_nm: 380, to_nm: 780, step_nm: 5, fwhm_nm: 5, shape: Triangle, lamp: "A")` | a scan; `shape` `Triangle`, `Gaussian`, `Rectangle`; without `lamp` every setting has the same power |
//! | `Leds(spectra: ["LED-B3", Led(peak_nm: 630, fwhm_nm: 20)])` | one after the other |
//! | `Filters(lamp: "A", filters: ["filter.csv", Band(from_nm: 400, to_nm: 500)])` | a lamp behind each filter |
//! | `Chart(reflectances: ["red.csv", 0.9], lamps: ["D65", "A"])` | each patch on the test surface, under each lamp; `"ColorChecker"` for its 24 patches |
//!
//! Each takes `pose` (which pose of the instrument, from 0: distances), `attenuator` (a factor in the beam) and `labels`. A spectrum is scaled to the
//! power that the source of the bench has; filters and attenuators take from it.

use super::calibration::Exposure;
use super::decode::{Fields, Value};
use super::document::Kind;
use super::factor_range::outside_of;
use super::reading::Reading;
use super::spectrum_reader::{read_factor, read_spectrum};
use crate::spectrum::{Density, Factor, Outside, SpectrumError, Table, library};

pub(super) const FORMS: [&str; 4] = ["Monochromator", "Leds", "Filters", "Chart"];
/// Most exposures of one campaign.
pub(super) const MOST_EXPOSURES: usize = 10_000;

/// What the bench offers.
pub(super) struct Bench {
    /// Total of the source's density.
    pub(super) power: f64,
    /// How many poses its instrument has.
    pub(super) poses: usize,
    /// Whether there is a test surface.
    pub(super) test_surface: bool,
}

/// Reads one item of a list of exposures.
pub(super) fn read_exposures(value: &Value, bench: &Bench, reading: &mut Reading) -> Option<Vec<Exposure>> {
    match value.variant("a kind of exposures", &FORMS, &mut reading.problems)? {
        "Monochromator" => read_monochromator(value, bench, reading),
        "Leds" => {
            let fields = value.fields("`Leds`", &["spectra", "labels", "pose", "attenuator"], &mut reading.problems)?;
            let common = Common::read(&fields, bench, reading);
            let spectra = fields.require("spectra", "[\"LED-B3\", Led(peak_nm: 630, fwhm_nm: 20)]", &mut reading.problems)?;
            let items = some_of(&spectra, "spectra", reading)?;
            let found: Vec<Option<(String, Density)>> = items.iter().map(|item| read_normalised(item, bench, reading)).collect();
            let found = found.into_iter().collect::<Option<Vec<_>>>()?;
            let exposures = found.into_iter().map(|(label, emitted)| Exposure { label, emitted, patch: None, pose: 0 }).collect();
            common?.applied(exposures, &fields, reading)
        }
        "Filters" => {
            let fields = value.fields("`Filters`", &["lamp", "filters", "labels", "pose", "attenuator"], &mut reading.problems)?;
            let common = Common::read(&fields, bench, reading);
            let lamp = fields.require("lamp", "\"A\"", &mut reading.problems).and_then(|v| read_normalised(&v, bench, reading));
            let filters = fields.require("filters", "[\"filter.csv\"]", &mut reading.problems)?;
            let items = some_of(&filters, "filters", reading)?;
            let found: Vec<Option<(String, Factor)>> =
                items.iter().map(|item| Some((named(item), read_share(item, Outside::Zero, "the transmittance", reading)?))).collect();
            let (found, (lamp_name, lamp)) = (found.into_iter().collect::<Option<Vec<_>>>()?, lamp?);
            let exposures = found.into_iter().map(|(label, filter)| Exposure {
                label: format!("{lamp_name} behind {label}"),
                emitted: lamp.filtered(&filter),
                patch: None,
                pose: 0,
            });
            common?.applied(exposures.collect(), &fields, reading)
        }
        _ => read_chart(value, bench, reading),
    }
}

fn read_monochromator(value: &Value, bench: &Bench, reading: &mut Reading) -> Option<Vec<Exposure>> {
    let keys = ["from_nm", "to_nm", "step_nm", "fwhm_nm", "shape", "lamp", "labels", "pose", "attenuator"];
    let fields = value.fields("`Monochromator`", &keys, &mut reading.problems)?;
    let common = Common::read(&fields, bench, reading);
    let mut number = |key: &str, example: &str| {
        let given = fields.require(key, example, &mut reading.problems)?;
        given.number_in(&format!("`{key}`"), "above 0, in nm", |x| x > 0.0, &mut reading.problems)
    };
    let (from, to) = (number("from_nm", "380"), number("to_nm", "780"));
    let (step, fwhm) = (number("step_nm", "5"), number("fwhm_nm", "5"));
    let shape = match fields.get("shape") {
        None => Some("Triangle"),
        Some(shape) => shape.variant("a bandpass", &["Triangle", "Gaussian", "Rectangle"], &mut reading.problems),
    };
    let lamp = match fields.get("lamp") {
        None => Some(None),
        Some(lamp) => read_normalised(&lamp, bench, reading).map(Some),
    };
    let (from, to, step, fwhm) = (from?, to?, step?, fwhm?);
    let count = ((to - from) / step + 1e-9).floor() + 1.0;
    if !(1.0..=MOST_EXPOSURES as f64).contains(&count) {
        value.problem(
            &mut reading.problems,
            format!("the scan has no setting, or too many: {from} nm to {to} nm in steps of {step} nm"),
            format!("give `from_nm` at most as large as `to_nm`, and at most {MOST_EXPOSURES} settings"),
        );
        return None;
    }
    if from <= 2.0 * fwhm {
        value.problem(
            &mut reading.problems,
            format!("a bandpass of {fwhm} nm at {from} nm reaches beyond 0 nm"),
            "give a narrower bandpass",
        );
        return None;
    }
    let (shape, lamp) = (shape?, lamp?);
    let mut exposures = Vec::new();
    for i in 0..count as usize {
        let nm = from + step * i as f64;
        let emitted = match &lamp {
            None => bandpass(shape, nm, fwhm, 1.0 / fwhm).and_then(|passed| passed.scaled(bench.power)),
            // A bandpass that is 1 at its centre passes that share of the lamp.
            Some((_, lamp)) => bandpass_factor(shape, nm, fwhm).map(|passes| lamp.filtered(&passes)),
        };
        let emitted = emitted.map_err(|e| value.problem(&mut reading.problems, e.to_string(), "")).ok()?;
        exposures.push(Exposure { label: format!("{} nm", rounded(nm)), emitted, patch: None, pose: 0 });
    }
    common?.applied(exposures, &fields, reading)
}

/// A wavelength without the rounding of sums of steps.
fn rounded(nm: f64) -> f64 {
    (nm * 1e6).round() / 1e6
}

fn bandpass_factor(shape: &str, nm: f64, fwhm: f64) -> Result<Factor, SpectrumError> {
    Ok(match shape {
        "Triangle" => Factor::Table(Table::from_rows(&[(nm - fwhm, 0.0), (nm, 1.0), (nm + fwhm, 0.0)], Outside::Zero)?),
        "Gaussian" => Factor::gaussian(1.0, nm, fwhm / (8.0 * std::f64::consts::LN_2).sqrt())?,
        _ => Factor::band(nm - 0.5 * fwhm, nm + 0.5 * fwhm, 1.0)?,
    })
}

fn bandpass(shape: &str, nm: f64, fwhm: f64, height: f64) -> Result<Density, SpectrumError> {
    match shape {
        "Triangle" => Density::table(Table::from_rows(&[(nm - fwhm, 0.0), (nm, height), (nm + fwhm, 0.0)], Outside::Zero)?),
        "Gaussian" => Density::gaussian(1.0, nm, fwhm / (8.0 * std::f64::consts::LN_2).sqrt()),
        _ => Density::flat(nm - 0.5 * fwhm, nm + 0.5 * fwhm, height),
    }
}

fn read_chart(value: &Value, bench: &Bench, reading: &mut Reading) -> Option<Vec<Exposure>> {
    let fields = value.fields("`Chart`", &["reflectances", "lamps", "labels", "pose", "attenuator"], &mut reading.problems)?;
    let common = Common::read(&fields, bench, reading);
    if !bench.test_surface {
        let help = "give a surface of the bench that takes the reflectances: `test_surface: \"patch\"`";
        value.problem_at(&value.name_span(), &mut reading.problems, "a chart needs a surface in the bench", help);
    }
    let reflectances = fields.require("reflectances", "\"ColorChecker\"", &mut reading.problems);
    let lamps = fields.require("lamps", "[\"D65\", \"A\"]", &mut reading.problems);
    let lamps: Vec<Option<(String, Density)>> =
        some_of(&lamps?, "lamps", reading)?.iter().map(|item| read_normalised(item, bench, reading)).collect();
    let patches = read_patches(&reflectances?, reading)?;
    let lamps = lamps.into_iter().collect::<Option<Vec<_>>>()?;
    let mut exposures = Vec::new();
    for (lamp_name, lamp) in &lamps {
        for (name, patch) in &patches {
            let label = format!("{name} under {lamp_name}");
            exposures.push(Exposure { label, emitted: lamp.clone(), patch: Some(patch.clone()), pose: 0 });
        }
    }
    common?.applied(exposures, &fields, reading)
}

fn read_patches(value: &Value, reading: &mut Reading) -> Option<Vec<(String, Factor)>> {
    if let Kind::Text(name) = &value.node.kind {
        let entries = match library::set(name) {
            Ok(entries) => entries,
            Err(error) => {
                value.problem(&mut reading.problems, error.to_string(), "write `\"ColorChecker\"`, or a list of reflectances");
                return None;
            }
        };
        let found = entries.iter().map(|entry| Some((entry.column.clone(), library::factor(&entry.name).ok()?)));
        return found.collect();
    }
    let items = some_of(value, "reflectances", reading)?;
    let found: Vec<Option<(String, Factor)>> =
        items.iter().map(|item| Some((named(item), read_share(item, Outside::Hold, "the reflectance", reading)?))).collect();
    found.into_iter().collect()
}

/// A factor from 0 to 1.
fn read_share(value: &Value, outside: Outside, what: &str, reading: &mut Reading) -> Option<Factor> {
    let factor = read_factor(value, outside, reading)?;
    if let Some((nm, found)) = outside_of(&factor, 0.0, 1.0) {
        value.problem(&mut reading.problems, format!("{what} is {found} at {nm} nm"), "allowed: 0 to 1 at every wavelength");
        return None;
    }
    Some(factor)
}

/// A spectrum with the power of the bench's source, and its name.
fn read_normalised(value: &Value, bench: &Bench, reading: &mut Reading) -> Option<(String, Density)> {
    let density = read_spectrum(value, reading)?;
    let total = density.total();
    let scaled = density.scaled(bench.power / total).ok().filter(|_| total > 0.0 && total.is_finite());
    if scaled.is_none() {
        value.problem(&mut reading.problems, "the spectrum has no finite power above zero", "give another spectrum");
    }
    Some((named(value), scaled?))
}

/// What an item is called in reports: its own text.
fn named(value: &Value) -> String {
    match &value.node.kind {
        Kind::Text(name) => name.clone(),
        Kind::Number(x) => x.to_string(),
        _ => value.document.slice(&value.node.span).split_whitespace().collect::<Vec<_>>().join(" "),
    }
}

/// The items of a list that must not be empty.
fn some_of<'d>(value: &Value<'d>, what: &str, reading: &mut Reading) -> Option<Vec<Value<'d>>> {
    let items = value.list(what, &mut reading.problems)?;
    if items.is_empty() {
        value.problem(&mut reading.problems, format!("the list of {what} is empty"), "give at least one");
        return None;
    }
    Some(items)
}

/// What every kind of exposures can say.
struct Common {
    pose: usize,
    attenuator: Option<Factor>,
    labels: Option<Vec<String>>,
}

impl Common {
    fn read(fields: &Fields, bench: &Bench, reading: &mut Reading) -> Option<Common> {
        let pose = match fields.get("pose") {
            None => Some(0.0),
            Some(pose) => {
                let allowed = format!("whole numbers, 0 to {}: the instrument of the bench has {} poses", bench.poses - 1, bench.poses);
                pose.number_in("`pose`", &allowed, |x| x.fract() == 0.0 && (0.0..bench.poses as f64).contains(&x), &mut reading.problems)
            }
        };
        let attenuator = match fields.get("attenuator") {
            None => Some(None),
            Some(given) => read_share(&given, Outside::Zero, "the transmittance", reading).map(Some),
        };
        let labels = match fields.get("labels") {
            None => Some(None),
            Some(given) => {
                let items = given.list("labels", &mut reading.problems)?;
                let texts: Vec<Option<&str>> = items.iter().map(|item| item.text(&mut reading.problems)).collect();
                texts.into_iter().map(|text| text.map(str::to_owned)).collect::<Option<Vec<_>>>().map(Some)
            }
        };
        Some(Common { pose: pose? as usize, attenuator: attenuator?, labels: labels? })
    }

    fn applied(self, mut exposures: Vec<Exposure>, fields: &Fields, reading: &mut Reading) -> Option<Vec<Exposure>> {
        if let (Some(labels), Some(given)) = (&self.labels, fields.get("labels"))
            && labels.len() != exposures.len()
        {
            let message = format!("there are {} labels for {} exposures", labels.len(), exposures.len());
            given.problem(&mut reading.problems, message, "give one for each, in their order, or leave `labels` out");
            return None;
        }
        for (i, exposure) in exposures.iter_mut().enumerate() {
            exposure.pose = self.pose;
            if let Some(label) = self.labels.as_ref().and_then(|labels| labels.get(i)) {
                exposure.label.clone_from(label);
            } else if self.pose > 0 {
                exposure.label = format!("{}, pose {}", exposure.label, self.pose);
            }
            if let Some(attenuator) = &self.attenuator {
                exposure.emitted = exposure.emitted.filtered(attenuator);
            }
        }
        Some(exposures)
    }
}
