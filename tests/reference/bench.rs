//! Cases as they are in the files, and scenes with one instrument.

use std::collections::BTreeMap;

use etendue::estimate::{Counters, Stop, Watch};
use etendue::measurement::{Measurement, Reading, measure};
use etendue::plan::{Plan, PlanOptions};
use etendue::scene::{Scene, scene_from_text};
use serde_json::Value;

/// Builds the scene of a case from its inputs and answers with the quantity that the case asks for.
pub(crate) type Family = fn(&Case) -> f64;

/// A reference case.
pub(crate) struct Case(Value);

/// The cases of a file of `tests/reference/`.
pub(crate) fn cases(group: &str) -> Vec<Case> {
    let path = format!("{}/tests/reference/{group}.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let file: Value = serde_json::from_str(&text).unwrap();
    let cases = file["cases"].as_array().unwrap();
    assert!(!cases.is_empty());
    cases.iter().cloned().map(Case).collect()
}

/// A number that the files hold as a decimal string.
fn decimal(value: &Value) -> f64 {
    let text = value.as_str().unwrap_or_else(|| panic!("{value} is no decimal string"));
    text.parse().unwrap_or_else(|_| panic!("{text} is no number"))
}

impl Case {
    pub(crate) fn id(&self) -> &str {
        self.0["id"].as_str().unwrap()
    }

    pub(crate) fn has_no_number(&self) -> bool {
        self.0.get("reference").is_none()
    }

    pub(crate) fn reference(&self) -> f64 {
        decimal(&self.0["reference"])
    }

    /// Largest deviation that passes.
    pub(crate) fn tolerance(&self) -> f64 {
        let of = |key: &str| self.0.get(key).map_or(0.0, |x| x.as_f64().unwrap());
        (of("rel_tol") * self.reference().abs()).max(of("abs_tol"))
    }

    /// |value − reference| over the tolerance; NaN for what is no number.
    pub(crate) fn deviation_in_tolerances(&self, value: f64) -> f64 {
        (value - self.reference()).abs() / self.tolerance()
    }

    /// Whether the values of the case are luminous.
    pub(crate) fn is_luminous(&self) -> bool {
        matches!(self.0["unit"].as_str().unwrap(), "lx" | "lm" | "cd/m^2")
    }

    /// An input as it is in the file.
    pub(crate) fn value(&self, input: &str) -> &Value {
        &self.0["inputs"][input]
    }

    pub(crate) fn text(&self, input: &str) -> &str {
        self.0["inputs"][input].as_str().unwrap_or_else(|| panic!("{} has no text `{input}`", self.id()))
    }

    pub(crate) fn number(&self, input: &str) -> f64 {
        decimal(&self.0["inputs"][input])
    }

    pub(crate) fn vector(&self, input: &str) -> [f64; 3] {
        vector(&self.0["inputs"][input])
    }

    /// A list of records of numbers.
    pub(crate) fn records(&self, input: &str) -> Vec<BTreeMap<String, f64>> {
        let list = self.0["inputs"][input].as_array().unwrap();
        list.iter().map(|record| record.as_object().unwrap().iter().map(|(key, value)| (key.clone(), decimal(value))).collect()).collect()
    }

    pub(crate) fn vectors(&self, input: &str) -> Vec<[f64; 3]> {
        self.0["inputs"][input].as_array().unwrap().iter().map(vector).collect()
    }
}

fn vector(value: &Value) -> [f64; 3] {
    let parts: Vec<f64> = value.as_array().unwrap().iter().map(decimal).collect();
    parts.try_into().unwrap()
}

/// A vector as scene files have it, every digit kept.
pub(crate) fn at([x, y, z]: [f64; 3]) -> String {
    format!("({x:e}, {y:e}, {z:e})")
}

/// Unit vector at an angle from +z towards +x; exact where the sine or cosine is.
pub(crate) fn tilted(angle_deg: f64) -> [f64; 3] {
    if angle_deg == 90.0 { [1.0, 0.0, 0.0] } else { [angle_deg.to_radians().sin(), 0.0, angle_deg.to_radians().cos()] }
}

/// The two systems in which a scene is written and read.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum System {
    Radiant,
    Luminous,
}

impl Case {
    pub(crate) fn system(&self) -> System {
        if self.is_luminous() { System::Luminous } else { System::Radiant }
    }
}

impl System {
    fn spectrum(self) -> &'static str {
        if self == System::Luminous { "\"A\"" } else { "Line(555)" }
    }

    /// Strength and spectrum of a source with a radiance or luminance.
    pub(crate) fn radiance(self, l: f64) -> String {
        format!("strength: {}({l:e}), spectrum: {}", if self == System::Luminous { "Luminance" } else { "Radiance" }, self.spectrum())
    }

    /// Strength and spectrum of a point.
    pub(crate) fn intensity(self, i: f64) -> String {
        format!(
            "strength: {}({i:e}), spectrum: {}",
            if self == System::Luminous { "Candela" } else { "WattsPerSteradian" },
            self.spectrum()
        )
    }

    /// Strength and spectrum of a surface by its exitance.
    pub(crate) fn exitance(self, m: f64) -> String {
        format!(
            "strength: {}: {m:e}), spectrum: {}",
            if self == System::Luminous { "LuminousExitance(lumens_per_m2" } else { "Exitance(watts_per_m2" },
            self.spectrum()
        )
    }

    fn sensor(self, aperture: &str, acceptance: &str, [radiant, luminous]: [&str; 2]) -> String {
        let (responsivity, reads) = if self == System::Luminous { ("\"V\"", luminous) } else { ("1", radiant) };
        format!(
            "Sensor(aperture: {aperture}, acceptance: {acceptance}, channels: [(name: \"x\", responsivity: {responsivity}, reads: {reads})])"
        )
    }

    /// An ideal meter at a point.
    pub(crate) fn meter(self) -> String {
        self.sensor("Point", "Cosine", ["Irradiance", "Illuminance"])
    }

    /// A meter at a point that sees a cone only.
    pub(crate) fn cone_meter(self, half_angle_deg: f64) -> String {
        self.sensor("Point", &format!("Cone(half_angle_deg: {half_angle_deg:e})"), ["Irradiance", "Illuminance"])
    }

    /// A meter of radiance or luminance at a point.
    pub(crate) fn radiance_meter(self, half_angle_deg: f64) -> String {
        self.sensor("Point", &format!("Cone(half_angle_deg: {half_angle_deg:e})"), ["Radiance", "Luminance"])
    }

    /// A disc that collects flux.
    pub(crate) fn disc_meter(self, radius_m: f64, acceptance: &str) -> String {
        self.sensor(&format!("Disc(radius_m: {radius_m:e})"), acceptance, ["RadiantFlux", "LuminousFlux"])
    }

    /// A rectangle that collects flux.
    pub(crate) fn rectangle_meter(self, width_m: f64, height_m: f64, acceptance: &str) -> String {
        self.sensor(&format!("Rectangle(width_m: {width_m:e}, height_m: {height_m:e})"), acceptance, ["RadiantFlux", "LuminousFlux"])
    }
}

/// A scene of these sources (each without its brackets and name) with one instrument.
pub(crate) fn scene(sources: &[String], sensor: &str, place: [f64; 3], facing: [f64; 3]) -> Scene {
    let sources: Vec<String> = sources.iter().enumerate().map(|(i, source)| format!("(name: \"source {i}\", {source}),\n")).collect();
    let text = format!(
        "Scene(sources: [{}], instruments: [(name: \"meter\", sensor: {sensor}, at: {}, facing: {})])",
        sources.concat(),
        at(place),
        at(facing)
    );
    scene_from_text(&text).unwrap_or_else(|problems| panic!("{problems}\n{text}"))
}

/// Reads a scene with the plan that it gets.
pub(crate) fn measured(scene: &Scene, stop: &Stop, seed: u64) -> Measurement {
    let plan = Plan::new(scene, &PlanOptions::default()).unwrap();
    measure(scene, &plan, stop, seed, &Watch { now: &|| 0.0, progress: &|_| {} }).unwrap()
}

/// The reading of a scene that needs neither rays nor samples. Its stated uncertainty must be a finite number.
pub(crate) fn exact(scene: &Scene) -> Reading {
    let mut found = measured(scene, &Stop::default(), 1);
    assert_eq!(
        (found.counters.rays, found.counters.samples),
        (Counters::default().rays, 0),
        "{}",
        Plan::new(scene, &PlanOptions::default()).unwrap().explain(scene)
    );
    let reading = found.readings.remove(0);
    assert!(reading.standard_uncertainty().is_finite() && reading.value >= 0.0, "{reading:?}");
    reading
}

/// The value that one instrument at the origin, facing +z, reads of some sources.
pub(crate) fn read_up(sources: &[String], sensor: &str) -> f64 {
    exact(&scene(sources, sensor, [0.0; 3], [0.0, 0.0, 1.0])).value
}
