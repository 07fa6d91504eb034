//! `etendue plot KIND`: pictures in SVG and PNG.

mod chromaticity;
mod output;
mod sensor;

use std::path::Path;

use clap::{Subcommand, ValueEnum};
use etendue::observer;
use etendue::report::plot::{self, Chart};
use etendue::scene::{GivenSpectrum, factor_from_text, spectrum_from_text};
use etendue::spectrum::{Outside, library};

use self::output::Output;
use crate::{Failure, complain, disk};

/// Draw a picture: SVG or PNG, light or dark, for paper or slides.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    kind: Kind,
}

#[derive(Subcommand)]
enum Kind {
    /// Luminous efficiency functions: photopic, scotopic, mesopic, Judd–Vos, CIE 2015.
    VLambda(VLambda),
    /// Cone fundamentals, of standard observers or of any age and field.
    Cones(Cones),
    /// What the photopigments of cones and rods absorb.
    Pigments(Pigments),
    /// Colour-matching functions, x̄ ȳ z̄ or r̄ ḡ b̄.
    Cmf(Cmf),
    /// Spectral distributions; lines as lines.
    Spectrum(Spectrum),
    /// Spectral reflectances, each in its own colour.
    Reflectance(Reflectance),
    /// Black bodies, both axes logarithmic.
    Blackbody(Blackbody),
    /// Chromaticity diagram: spectral, Planckian and daylight loci, white points, any spectra, gamuts of displays.
    Chromaticity(chromaticity::Arguments),
    /// Spectral responsivity and directional response of sensors.
    Sensor(sensor::Arguments),
}

#[derive(clap::Args)]
struct VLambda {
    /// Functions by name: photopic, scotopic, Judd-Vos, "CIE 2015 2 degree", "CIE 2015 10 degree", "CIE 1964" [default: photopic, scotopic,
    /// CIE 2015 2 degree].
    functions: Vec<String>,
    /// Adaptations m of mesopic functions, 0 (rods) to 1 (cones) [default without functions: 0.25,0.5,0.75].
    #[arg(long, value_name = "M,…", value_delimiter = ',', allow_hyphen_values = true)]
    mesopic: Option<Vec<f64>>,
    /// Luminous efficacy in lm/W, not relative to the peak.
    #[arg(long)]
    absolute: bool,
    /// A logarithmic axis.
    #[arg(long)]
    log: bool,
    #[command(flatten)]
    output: Output,
}

#[derive(clap::Args)]
struct Cones {
    /// Ages of observers of CIE 170-1, 20 to 80 years.
    #[arg(long, value_name = "YR,…", value_delimiter = ',', allow_hyphen_values = true)]
    age: Vec<f64>,
    /// Fields of view: without ages 2 and 10 are the standard observers of Stockman & Sharpe; others, 1° to 10°, of CIE 170-1
    /// [default: 2,10].
    #[arg(long, value_name = "DEG,…", value_delimiter = ',', allow_hyphen_values = true)]
    field: Vec<f64>,
    /// Share of the photons at the cornea that is absorbed, not relative to the peak.
    #[arg(long)]
    quantal: bool,
    /// A logarithmic axis.
    #[arg(long)]
    log: bool,
    #[command(flatten)]
    output: Output,
}

#[derive(clap::Args)]
struct Pigments {
    /// Absorbance relative to the peak, not the share of the photons.
    #[arg(long)]
    absorbance: bool,
    /// Field of view, 1° to 10°.
    #[arg(long, value_name = "DEG", default_value = "2", allow_hyphen_values = true)]
    field: f64,
    /// Age of lens, 20 to 80 years.
    #[arg(long, value_name = "YR", default_value = "32", allow_hyphen_values = true)]
    age: f64,
    /// Optical density of the rods along their axis, at their maximum.
    #[arg(long, value_name = "DENSITY", default_value = "0.4", allow_hyphen_values = true)]
    rod_density: f64,
    /// Leave the rods out.
    #[arg(long)]
    no_rods: bool,
    /// Draw what lens and macular pigment transmit, too.
    #[arg(long)]
    media: bool,
    /// A logarithmic axis.
    #[arg(long)]
    log: bool,
    #[command(flatten)]
    output: Output,
}

#[derive(clap::Args)]
struct Cmf {
    /// Sets by name: "CIE 1931", "CIE 1964", "CIE 2015 2 degree", "CIE 2015 10 degree", or "Wright-Guild", "Stiles & Burch 1955", "Stiles
    /// & Burch 1959"; `xyz` and `rgb` are the two of 1931.
    #[arg(default_value = "CIE 1931")]
    sets: Vec<String>,
    #[command(flatten)]
    output: Output,
}

#[derive(clap::Args)]
struct Spectrum {
    /// Files (.csv, .spdx), names of the library such as D65, or forms such as "BlackBody(3000)" or "Line(546.07)".
    #[arg(required = true)]
    spectra: Vec<String>,
    /// What a height of one means.
    #[arg(long, value_enum, default_value_t = ScalingName::Peak)]
    relative_to: ScalingName,
    /// First and last wavelength, nm.
    #[arg(long, value_name = "FROM,TO", value_parser = range, default_value = "380,780", allow_hyphen_values = true)]
    range: (f64, f64),
    #[command(flatten)]
    output: Output,
}

#[derive(Clone, Copy, ValueEnum)]
enum ScalingName {
    /// The largest value of each.
    Peak,
    /// The value of each at 560 nm.
    #[value(name = "560nm")]
    At560Nm,
    /// Nothing: the numbers as given.
    Nothing,
}

#[derive(clap::Args)]
struct Reflectance {
    /// Charts or patches of the library ("ColorChecker", "ColorChecker dark skin"), or files.
    #[arg(default_value = "ColorChecker")]
    items: Vec<String>,
    #[command(flatten)]
    output: Output,
}

#[derive(clap::Args)]
struct Blackbody {
    /// Temperatures, K [default: 300 1000 2856 5772 20000].
    #[arg(allow_negative_numbers = true)]
    temperatures: Vec<f64>,
    /// Exitance (π times the radiance), not radiance.
    #[arg(long)]
    exitance: bool,
    #[command(flatten)]
    output: Output,
}

fn range(given: &str) -> Result<(f64, f64), String> {
    let ends = given.split_once([',', ':']).and_then(|(from, to)| Some((from.trim().parse().ok()?, to.trim().parse().ok()?)));
    ends.filter(|(from, to): &(f64, f64)| *from > 0.0 && from < to && to.is_finite())
        .ok_or_else(|| "two positive wavelengths in nm, rising, such as 380,780".to_owned())
}

fn bad(problem: impl std::fmt::Display) -> Failure {
    Failure::Input(format!("error: {problem}"))
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    match &arguments.kind {
        Kind::VLambda(given) => given.output.draw("v-lambda", || given.chart()),
        Kind::Cones(given) => given.output.draw("cones", || given.chart()),
        Kind::Pigments(given) => given.output.draw("pigments", || given.chart()),
        Kind::Cmf(given) => given.output.draw("cmf", || given.chart()),
        Kind::Spectrum(given) => given.output.draw("spectrum", || given.chart()),
        Kind::Reflectance(given) => given.output.draw("reflectance", || given.chart()),
        Kind::Blackbody(given) => given.output.draw("blackbody", || given.chart()),
        Kind::Chromaticity(given) => given.output.draw("chromaticity", || given.chart()),
        Kind::Sensor(given) => given.output.draw("sensor", || given.chart()),
    }
}

impl VLambda {
    fn chart(&self) -> Result<Chart, Failure> {
        let usual = plot::v_lambda::Choice::default();
        let functions = all(&self.functions, observer::Efficiency::named)?;
        let (functions, mesopic) = match (functions.is_empty() && self.mesopic.is_none(), &self.mesopic) {
            (true, _) => (usual.functions, usual.mesopic),
            (false, mesopic) => (functions, mesopic.clone().unwrap_or_default()),
        };
        plot::v_lambda::chart(&plot::v_lambda::Choice { functions, mesopic, absolute: self.absolute, log: self.log }).map_err(bad)
    }
}

impl Cones {
    fn chart(&self) -> Result<Chart, Failure> {
        let individual = |age_yr, field_deg| observer::Cones::Individual(observer::Individual { age_yr, field_deg });
        let standard = |field: &f64| match (*field, self.quantal) {
            (2.0, false) => observer::Cones::StockmanSharpe2,
            (10.0, false) => observer::Cones::StockmanSharpe10,
            // The age of the standard observers.
            (field, _) => individual(32.0, field),
        };
        let fields: &[f64] = match (self.field.is_empty(), self.age.is_empty()) {
            (true, true) => &[2.0, 10.0],
            (true, false) => &[2.0],
            _ => &self.field,
        };
        let sets = if self.age.is_empty() {
            fields.iter().map(standard).collect()
        } else {
            self.age.iter().flat_map(|age| fields.iter().map(|field| individual(*age, *field))).collect()
        };
        plot::cones::chart(&plot::cones::Choice { sets, quantal: self.quantal, log: self.log }).map_err(bad)
    }
}

impl Pigments {
    fn chart(&self) -> Result<Chart, Failure> {
        use plot::pigments::{Choice, Quantity};
        let quantity = if self.absorbance { Quantity::Absorbance } else { Quantity::Absorptance };
        let individual = observer::Individual { age_yr: self.age, field_deg: self.field };
        let rod_density = (!self.no_rods).then_some(self.rod_density);
        plot::pigments::chart(&Choice { quantity, individual, rod_density, media: self.media, log: self.log }).map_err(bad)
    }
}

impl Cmf {
    fn chart(&self) -> Result<Chart, Failure> {
        let sets = all(&self.sets, |name| match name {
            "xyz" => Ok(observer::Matching::Cie1931),
            "rgb" => Ok(observer::Matching::WrightGuild1931),
            name => observer::Matching::named(name),
        })?;
        plot::cmf::chart(&sets).map_err(bad)
    }
}

impl Spectrum {
    fn chart(&self) -> Result<Chart, Failure> {
        use plot::spectrum::{Choice, Item, Scaling};
        let given = all(&self.spectra, |text| spectrum_from_text(text, &disk::Anywhere))?;
        given.iter().flat_map(|one| &one.remarks).for_each(|remark| complain(&format!("remark: {remark}")));
        // Units are written only where all agree.
        let unit = |one: &GivenSpectrum| match &one.file {
            Some(file) => file.unit.as_deref().map(|unit| drawn_unit(unit, file.remarks.iter().any(|r| r.ends_with("to be per nm")))),
            None => library::entry(&one.name).ok().map(|entry| entry.unit.clone()),
        };
        let mut units: Vec<String> = given.iter().map(|one| unit(one).unwrap_or_default()).collect();
        units.dedup();
        let scaling = match self.relative_to {
            ScalingName::Peak => Scaling::Peak,
            ScalingName::At560Nm => Scaling::At560Nm,
            ScalingName::Nothing => Scaling::AsGiven,
        };
        if let (Scaling::AsGiven, [_, _, ..]) = (scaling, &units[..]) {
            return Err(bad(format!(
                "spectra in different units cannot be drawn as given: {}; leave --relative-to at its default",
                units.join(", ")
            )));
        }
        let items = given.into_iter().map(|one| Item { name: official(&one.name), density: one.density }).collect();
        let (from_nm, to_nm) = self.range;
        plot::spectrum::chart(&Choice { items, scaling, unit: units.join(""), from_nm, to_nm }).map_err(bad)
    }
}

/// The unit of the numbers of a file once they are read: per nm, whatever the file has.
fn drawn_unit(unit: &str, converted: bool) -> String {
    match observer::sheet::SpectralQuantity::of_unit(unit).map(|quantity| quantity.spectral_words().rsplit_once(" in ")) {
        Some(Some((_, per_nm))) => per_nm.to_owned(),
        _ if converted => format!("{unit}, converted to per nm"),
        _ => unit.to_owned(),
    }
}

/// The name of the library for one of its entries, the bare name of a file, or the text as it is.
fn official(name: &str) -> String {
    match library::entry(name) {
        Ok(entry) => entry.name.clone(),
        Err(_) => {
            Path::new(name).file_name().filter(|_| name.contains(['/', '\\'])).map_or(name.to_owned(), |n| n.to_string_lossy().into_owned())
        }
    }
}

impl Reflectance {
    fn chart(&self) -> Result<Chart, Failure> {
        use plot::reflectance::Item;
        let found = all(&self.items, |text| match library::set(text) {
            Ok(entries) => entries
                .into_iter()
                .map(|entry| {
                    let name = if entry.column.is_empty() { entry.name.clone() } else { entry.column.replace('_', " ") };
                    Ok(Item { name, factor: library::factor(&entry.name).map_err(|e| e.to_string())? })
                })
                .collect::<Result<Vec<_>, String>>(),
            Err(_) => factor_from_text(text, Outside::Hold, &disk::Anywhere)
                .map(|given| {
                    given.remarks.iter().for_each(|remark| complain(&format!("remark: {remark}")));
                    vec![Item { name: official(&given.name), factor: given.factor }]
                })
                .map_err(|e| e.to_string()),
        })?;
        let title = match &self.items[..] {
            [one] => library::set(one).ok().and_then(|entries| entries.first()?.set.clone()).unwrap_or_else(|| official(one)),
            _ => "Reflectances".to_owned(),
        };
        plot::reflectance::chart(&title, &found.concat()).map_err(bad)
    }
}

impl Blackbody {
    fn chart(&self) -> Result<Chart, Failure> {
        use plot::blackbody::{Quantity, TEMPERATURES_K, chart};
        let temperatures = if self.temperatures.is_empty() { TEMPERATURES_K.to_vec() } else { self.temperatures.clone() };
        chart(&temperatures, if self.exitance { Quantity::Exitance } else { Quantity::Radiance }).map_err(bad)
    }
}

/// What is meant by each name, or every problem at once.
fn all<T, E: std::fmt::Display>(names: &[String], meant: impl Fn(&str) -> Result<T, E>) -> Result<Vec<T>, Failure> {
    let (mut found, mut problems) = (Vec::new(), Vec::new());
    for name in names {
        match meant(name) {
            Ok(one) => found.push(one),
            Err(problem) => {
                let problem = problem.to_string();
                // Diagnostics of files say so themselves.
                problems.push(if problem.starts_with("error") { problem } else { format!("error: {problem}") });
            }
        }
    }
    if problems.is_empty() { Ok(found) } else { Err(Failure::Input(problems.join("\n"))) }
}
