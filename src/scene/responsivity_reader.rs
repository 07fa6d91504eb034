//! Responsivities of channels: a curve, how it is stated, and how well it is known.
//!
//! | `responsivity:` | kind |
//! |---|---|
//! | `"V"`, `0.85`, `"curve.csv"`, any factor | relative; what a file says in `# unit:` if it says A/W, mA/W or electrons per photon; with another unit, such as V/W, for `Signal` and adjusted quantities alone |
//! | `Relative(f)` | relative, whatever the file says |
//! | `AmperesPerWatt(f)` | A/W |
//! | `QuantumEfficiency(f)` | electrons per photon, 0 to 1: `s = η e n λ/(h c)` |
//! | `Chain(filter: f, window: f, detector: s)` | transmittances times a responsivity of any kind; the kind is the detector's |
//! | `Bandpass(centre_nm: 550, fwhm_nm: 5, shape: Triangle)` | relative, 1 at the centre; `Triangle`, `Gaussian`, `Rectangle` |
//!
//! The third column of a file is a standard uncertainty of each row; it is taken to have one cause for all rows.

use super::decode::{Value, readable};
use super::document::{Body, Kind};
use super::factor_range::{LARGEST, is_zero, outside_of};
use super::reading::Reading;
use super::spectrum_reader::{FACTORS, is_file, read_factor};
use crate::metrology::rounding::format_significant;
use crate::naming::nearest;
use crate::sensor::channel::quantum_limit_a_w;
use crate::sensor::{ResponsivityKind, ResponsivityUncertainty};
use crate::spectrum::file::{CurveFile, Meaning};
use crate::spectrum::{Factor, Outside, Table};

const FORMS: [&str; 5] = ["Relative", "AmperesPerWatt", "QuantumEfficiency", "Chain", "Bandpass"];

/// A responsivity that is nowhere negative and somewhere above zero.
#[derive(Clone, Debug)]
pub(super) struct Responsivity {
    /// Relative or in A/W.
    pub(super) curve: Factor,
    pub(super) kind: ResponsivityKind,
    /// One for each cause.
    pub(super) uncertainty: Vec<ResponsivityUncertainty>,
    /// The unit that the file states, where it is none of those that have a kind, such as V/W; the sensor does not say `Relative`.
    pub(super) other_unit: Option<String>,
}

impl Responsivity {
    /// The same behind something that lets a share of the light through.
    fn behind(self, part: &Responsivity) -> Responsivity {
        let product = |a: &Factor, b: &Factor| Factor::Product(vec![a.clone(), b.clone()]);
        let times = |list: &[ResponsivityUncertainty], other: &Factor| -> Vec<ResponsivityUncertainty> {
            let one = |u: &ResponsivityUncertainty| match u {
                ResponsivityUncertainty::Relative(share) => ResponsivityUncertainty::Relative(*share),
                ResponsivityUncertainty::Curve(curve) => ResponsivityUncertainty::Curve(product(curve, other)),
            };
            list.iter().map(one).collect()
        };
        let uncertainty = [times(&self.uncertainty, &part.curve), times(&part.uncertainty, &self.curve)].concat();
        Responsivity { curve: product(&self.curve, &part.curve), kind: self.kind, uncertainty, other_unit: self.other_unit }
    }
}

/// Reads a responsivity; what is unusual about it goes into the remarks.
pub(super) fn read_responsivity(value: &Value, reading: &mut Reading) -> Option<Responsivity> {
    let found = read_form(value, reading)?;
    if is_zero(&found.curve) {
        value.problem(
            &mut reading.problems,
            "the responsivity is zero at every wavelength, so nothing can be read",
            "give a responsivity that is above zero somewhere",
        );
        return None;
    }
    if found.kind == ResponsivityKind::AmperesPerWatt {
        remark_on_gain(value, &found.curve, reading);
    }
    Some(found)
}

fn read_form(value: &Value, reading: &mut Reading) -> Option<Responsivity> {
    if !FORMS.contains(&value.name()) {
        if let Some(meant) = nearest(value.name(), FORMS).filter(|_| !FACTORS.contains(&value.name())) {
            let message = format!("`{}` is not a responsivity", value.name());
            value.problem_at(&value.name_span(), &mut reading.problems, message, format!("did you mean `{meant}`?"));
            return None;
        }
        let (curve, stated, uncertainty) = read_curve(value, reading)?;
        let (scale, kind) = stated.unwrap_or((1.0, ResponsivityKind::Relative));
        let found = finished(value, curve, kind, scale, uncertainty, reading)?;
        return Some(Responsivity { other_unit: other_unit(value, reading), ..found });
    }
    match value.name() {
        "Chain" => read_chain(value, reading),
        "Bandpass" => {
            let curve = read_bandpass(value, reading)?;
            Some(Responsivity { curve, kind: ResponsivityKind::Relative, uncertainty: Vec::new(), other_unit: None })
        }
        name => {
            let form = format!("{name}(\"curve.csv\")");
            let inner = value.positional(1, &form, &mut reading.problems)?.into_iter().next()?;
            let (curve, stated, uncertainty) = read_curve(&inner, reading)?;
            let kind = match name {
                "AmperesPerWatt" => ResponsivityKind::AmperesPerWatt,
                "QuantumEfficiency" => ResponsivityKind::QuantumEfficiency,
                _ => ResponsivityKind::Relative,
            };
            let scale = match stated {
                Some((scale, in_file)) if in_file == kind => scale,
                Some((_, in_file)) if kind != ResponsivityKind::Relative => {
                    let says = if in_file == ResponsivityKind::AmperesPerWatt { "A/W" } else { "electrons per photon" };
                    let right = if in_file == ResponsivityKind::AmperesPerWatt { "AmperesPerWatt" } else { "QuantumEfficiency" };
                    inner.problem(
                        &mut reading.problems,
                        format!("the file says that its values are in {says}, the sensor that it is `{name}`"),
                        format!("write `{right}(…)`, or correct `# unit:` in the file"),
                    );
                    return None;
                }
                _ => 1.0,
            };
            finished(&inner, curve, kind, scale, uncertainty, reading)
        }
    }
}

/// What a file states: a scale to the unit of the kind, and the kind.
pub(super) type Stated = Option<(f64, ResponsivityKind)>;

/// A factor, what its file says about its unit, and the uncertainties of its rows.
pub(super) fn read_curve(value: &Value, reading: &mut Reading) -> Option<(Factor, Stated, Option<Factor>)> {
    let curve = read_factor(value, Outside::Zero, reading)?;
    let Some(file) = file_of(value, reading) else { return Some((curve, None, None)) };
    let rows = file.standard_uncertainty.as_ref().map(|u| file.table.wavelengths_nm().iter().copied().zip(u.iter().copied()));
    let uncertainty = rows.and_then(|rows| Table::from_rows(&rows.collect::<Vec<_>>(), Outside::Zero).ok()).map(Factor::Table);
    Some((curve, file.unit.as_deref().and_then(kind_of_unit), uncertainty))
}

/// The file that a curve was read from.
fn file_of(value: &Value, reading: &mut Reading) -> Option<CurveFile> {
    match &value.node.kind {
        Kind::Text(name) if is_file(name) => {
            let path = reading.path(value, name)?;
            reading.curves.get(&(path, Meaning::Factor)).cloned().flatten()
        }
        _ => None,
    }
}

/// The unit that the file of a curve states, if that is neither a number's nor one that has a kind.
pub(super) fn other_unit(value: &Value, reading: &mut Reading) -> Option<String> {
    let unit = file_of(value, reading)?.unit?;
    let plain = unit.trim().to_lowercase();
    let number = matches!(plain.as_str(), "" | "1" | "-" | "–" | "none" | "a.u." | "au")
        || ["1 (", "%", "per cent", "percent"].iter().any(|start| plain.starts_with(start))
        || ["relative", "arbitrary", "arb", "normal", "dimensionless", "unitless"].iter().any(|word| plain.contains(word));
    if number || kind_of_unit(&unit).is_some() { None } else { Some(unit) }
}

/// The kind that a unit says, with the scale to A/W or to electrons per photon.
fn kind_of_unit(unit: &str) -> Stated {
    let plain: String = unit.to_lowercase().chars().filter(|c| !c.is_whitespace() && !matches!(c, '^' | '-' | '−' | '⁻')).collect();
    match plain.as_str() {
        "a/w" | "aw1" | "a*w1" | "a·w1" | "aw¹" => Some((1.0, ResponsivityKind::AmperesPerWatt)),
        "ma/w" | "maw1" | "maw¹" => Some((1e-3, ResponsivityKind::AmperesPerWatt)),
        "electronsperphoton" | "electrons/photon" | "e/photon" | "e/ph" => Some((1.0, ResponsivityKind::QuantumEfficiency)),
        _ => None,
    }
}

/// Checks a curve in the unit of its kind and turns it into A/W.
fn finished(
    value: &Value,
    curve: Factor,
    kind: ResponsivityKind,
    scale: f64,
    uncertainty: Option<Factor>,
    reading: &mut Reading,
) -> Option<Responsivity> {
    let scaled = |factor: Factor| if scale == 1.0 { factor } else { factor.scaled(scale) };
    let (curve, uncertainty) = (scaled(curve), uncertainty.map(scaled));
    let quantum = kind == ResponsivityKind::QuantumEfficiency;
    let most = if quantum { 1.0 } else { LARGEST };
    if let Some((nm, found)) = outside_of(&curve, 0.0, most) {
        let (what, allowed) = match quantum {
            true => ("quantum efficiency", "0 to 1 electron per photon at every wavelength".to_owned()),
            false => ("responsivity", format!("0 to {LARGEST:e} at every wavelength")),
        };
        let percent = if quantum && found > 1.5 && found <= 100.0 { "; percent are written `Scaled(0.01, …)`" } else { "" };
        value.problem(
            &mut reading.problems,
            format!("the {what} is {} at {nm} nm", readable(found)),
            format!("allowed: {allowed}{percent}"),
        );
        return None;
    }
    let to_a_w = |factor: Factor| if quantum { Factor::Product(vec![factor, quantum_limit_a_w()]) } else { factor };
    let uncertainty = uncertainty.map(|u| ResponsivityUncertainty::Curve(to_a_w(u))).into_iter().collect();
    Some(Responsivity { curve: to_a_w(curve), kind, uncertainty, other_unit: None })
}

/// More than one electron a photon is possible with gain, and more often a slip.
fn remark_on_gain(value: &Value, curve: &Factor, reading: &mut Reading) {
    let above = Factor::Sum(vec![curve.clone(), quantum_limit_a_w().scaled(-1.0)]);
    let Some((nm, _)) = outside_of(&above, -LARGEST, 0.0) else { return };
    let digits = |x: f64| format_significant(x, 3);
    let remark = format!(
        "{}: {} A/W at {} nm is more than one electron a photon, {} A/W: right for a detector with gain; else write `QuantumEfficiency(…)` \
         for electrons per photon, or `Relative(…)` for a curve without a unit",
        value.document.file,
        digits(curve.at(nm)),
        digits(nm),
        digits(quantum_limit_a_w().at(nm)),
    );
    if !reading.remarks.contains(&remark) {
        reading.remarks.push(remark);
    }
}

fn read_chain(value: &Value, reading: &mut Reading) -> Option<Responsivity> {
    let fields = value.fields("`Chain`", &["filter", "window", "detector"], &mut reading.problems)?;
    let detector =
        fields.require("detector", "QuantumEfficiency(\"detector.csv\")", &mut reading.problems).and_then(|v| read_form(&v, reading));
    let mut parts = Vec::new();
    for key in ["filter", "window"] {
        if let Some(given) = fields.get(key) {
            parts.push(read_transmittance(&given, key, reading));
        }
    }
    if parts.is_empty() && matches!(&value.node.kind, Kind::Struct { body: Body::Named(_), .. }) {
        value.problem(
            &mut reading.problems,
            "the chain has neither `filter` nor `window`",
            "add `filter: \"filter.csv\"`, or write the detector alone",
        );
        return None;
    }
    let parts = parts.into_iter().collect::<Option<Vec<Responsivity>>>()?;
    Some(parts.iter().fold(detector?, Responsivity::behind))
}

/// A share of light that passes, 0 to 1, with the uncertainties of its file.
fn read_transmittance(value: &Value, key: &str, reading: &mut Reading) -> Option<Responsivity> {
    let (curve, stated, uncertainty) =
        if value.name() == "Bandpass" { (read_bandpass(value, reading)?, None, None) } else { read_curve(value, reading)? };
    if stated.is_some() {
        let message = format!("a transmittance is expected as `{key}`, not a responsivity");
        value.problem(&mut reading.problems, message, "give it as `detector`");
        return None;
    }
    if let Some((nm, found)) = outside_of(&curve, 0.0, 1.0) {
        let message = format!("the transmittance of the {key} is {} at {nm} nm", readable(found));
        value.problem(&mut reading.problems, message, "allowed: 0 to 1 at every wavelength");
        return None;
    }
    let uncertainty = uncertainty.map(ResponsivityUncertainty::Curve).into_iter().collect();
    Some(Responsivity { curve, kind: ResponsivityKind::Relative, uncertainty, other_unit: None })
}

fn read_bandpass(value: &Value, reading: &mut Reading) -> Option<Factor> {
    let problems = &mut reading.problems;
    let fields = value.fields("`Bandpass`", &["centre_nm", "fwhm_nm", "shape"], problems)?;
    let centre = fields.require("centre_nm", "550", problems);
    let centre_nm = centre.and_then(|v| v.number_in("the centre", "10 nm to 1e9 nm", |x| (10.0..=1e9).contains(&x), problems));
    let width = fields.require("fwhm_nm", "5", problems);
    let fwhm_nm = width.as_ref().and_then(|v| v.number_in("the full width at half maximum", "above 0 nm", |x| x > 0.0, problems));
    let shape = fields.require("shape", "Triangle", problems);
    let shape = shape.and_then(|v| v.variant("a shape of a bandpass", &["Triangle", "Gaussian", "Rectangle"], problems));
    let (centre_nm, fwhm_nm, shape) = (centre_nm?, fwhm_nm?, shape?);
    if fwhm_nm >= centre_nm {
        let message = format!("a bandpass of {fwhm_nm} nm about {centre_nm} nm reaches down to wavelengths of zero");
        width?.problem(problems, message, format!("allowed: below {centre_nm} nm"));
        return None;
    }
    let made = match shape {
        "Triangle" => {
            Table::from_rows(&[(centre_nm - fwhm_nm, 0.0), (centre_nm, 1.0), (centre_nm + fwhm_nm, 0.0)], Outside::Zero).map(Factor::Table)
        }
        "Gaussian" => Factor::gaussian(1.0, centre_nm, fwhm_nm / (8.0 * std::f64::consts::LN_2).sqrt()),
        _ => Factor::band(centre_nm - 0.5 * fwhm_nm, centre_nm + 0.5 * fwhm_nm, 1.0),
    };
    made.map_err(|error| value.problem(problems, error.to_string(), "")).ok()
}
