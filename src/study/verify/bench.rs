//! Scenes with one instrument, written as a user would write them, and read with the plan that they get.

use super::case::{Case, Fault, Found};
use crate::estimate::{Stop, Watch};
use crate::measurement::{Measurement, Reading, measure};
use crate::plan::{Plan, PlanOptions};
use crate::scene::{Scene, scene_from_text};

/// A vector as scene files have it, every digit kept.
pub fn at([x, y, z]: [f64; 3]) -> String {
    format!("({x:e}, {y:e}, {z:e})")
}

/// Unit vector at an angle from +z towards +x; exact where the sine or cosine is.
pub fn tilted(angle_deg: f64) -> [f64; 3] {
    if angle_deg == 90.0 { [1.0, 0.0, 0.0] } else { [angle_deg.to_radians().sin(), 0.0, angle_deg.to_radians().cos()] }
}

/// The two systems in which a scene is written and read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum System {
    /// Watts, at 555 nm.
    Radiant,
    /// Lumens, of CIE illuminant A.
    Luminous,
}

impl Case {
    /// The system of the values of the case.
    pub fn system(&self) -> System {
        if matches!(self.unit(), "lx" | "lm" | "cd/m^2") { System::Luminous } else { System::Radiant }
    }
}

impl System {
    fn spectrum(self) -> &'static str {
        if self == System::Luminous { "\"A\"" } else { "Line(555)" }
    }

    /// Strength and spectrum of a source with a radiance or luminance.
    pub fn radiance(self, l: f64) -> String {
        format!("strength: {}({l:e}), spectrum: {}", if self == System::Luminous { "Luminance" } else { "Radiance" }, self.spectrum())
    }

    /// Strength and spectrum of a point.
    pub fn intensity(self, i: f64) -> String {
        format!(
            "strength: {}({i:e}), spectrum: {}",
            if self == System::Luminous { "Candela" } else { "WattsPerSteradian" },
            self.spectrum()
        )
    }

    /// Strength and spectrum of a surface by its exitance.
    pub fn exitance(self, m: f64) -> String {
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
    pub fn meter(self) -> String {
        self.sensor("Point", "Cosine", ["Irradiance", "Illuminance"])
    }

    /// A meter at a point that sees a cone only.
    pub fn cone_meter(self, half_angle_deg: f64) -> String {
        self.sensor("Point", &format!("Cone(half_angle_deg: {half_angle_deg:e})"), ["Irradiance", "Illuminance"])
    }

    /// A small head that sees all round: `Spherical`, `Cylindrical`.
    pub fn head_meter(self, head: &str) -> String {
        self.sensor("Point", head, ["Irradiance", "Illuminance"])
    }

    /// A meter of radiance or luminance at a point.
    pub fn radiance_meter(self, half_angle_deg: f64) -> String {
        self.sensor("Point", &format!("Cone(half_angle_deg: {half_angle_deg:e})"), ["Radiance", "Luminance"])
    }

    /// A disc that collects flux.
    pub fn disc_meter(self, radius_m: f64, acceptance: &str) -> String {
        self.sensor(&format!("Disc(radius_m: {radius_m:e})"), acceptance, ["RadiantFlux", "LuminousFlux"])
    }

    /// A rectangle that collects flux.
    pub fn rectangle_meter(self, width_m: f64, height_m: f64, acceptance: &str) -> String {
        self.sensor(&format!("Rectangle(width_m: {width_m:e}, height_m: {height_m:e})"), acceptance, ["RadiantFlux", "LuminousFlux"])
    }
}

/// A scene of these sources (each without its brackets and name) with one instrument.
///
/// # Errors
/// With what is wrong with the scene, and its text.
pub fn scene(sources: &[String], sensor: &str, place: [f64; 3], facing: [f64; 3]) -> Result<Scene, Fault> {
    scene_with("", sources, sensor, place, facing)
}

/// The same with surfaces and objects, as they stand in a scene file, each field with its comma.
///
/// # Errors
/// As [`scene`].
pub fn scene_with(things: &str, sources: &[String], sensor: &str, place: [f64; 3], facing: [f64; 3]) -> Result<Scene, Fault> {
    let sources: Vec<String> = sources.iter().enumerate().map(|(i, source)| format!("(name: \"source {i}\", {source}),\n")).collect();
    read(&format!(
        "Scene({things} sources: [{}], instruments: [(name: \"meter\", sensor: {sensor}, at: {}, facing: {})])",
        sources.concat(),
        at(place),
        at(facing)
    ))
}

/// A scene from its text.
///
/// # Errors
/// With what is wrong with the scene, and its text.
pub fn read(text: &str) -> Result<Scene, Fault> {
    scene_from_text(text).map_err(|problems| Fault::wrong(format!("{problems}\n{text}")))
}

/// Reads a scene with the plan that it gets.
///
/// # Errors
/// When it cannot be planned or measured.
pub fn measured(scene: &Scene, stop: &Stop, seed: u64) -> Result<Measurement, Fault> {
    let plan = Plan::new(scene, &PlanOptions::default())?;
    Ok(measure(scene, &plan, stop, seed, &Watch { now: &|| 0.0, progress: &|_| {} })?)
}

fn first(found: Measurement) -> Result<Reading, Fault> {
    found.readings.into_iter().next().ok_or_else(|| Fault::wrong("the scene has no reading"))
}

/// The reading of a scene that needs neither rays nor samples.
///
/// # Errors
/// When it took rays or samples, its value is negative, or its uncertainty is no finite number.
pub fn exact(scene: &Scene) -> Result<Reading, Fault> {
    let found = measured(scene, &Stop::default(), 1)?;
    let counters = found.counters;
    if counters.rays != 0 || counters.samples != 0 {
        let plan = Plan::new(scene, &PlanOptions::default())?.explain(scene);
        return Err(Fault::wrong(format!("{} rays and {} samples where a formula was expected\n{plan}", counters.rays, counters.samples)));
    }
    let reading = first(found)?;
    if !(reading.standard_uncertainty().is_finite() && reading.value >= 0.0) {
        return Err(Fault::wrong(format!("reads {} with u = {}", reading.value, reading.standard_uncertainty())));
    }
    Ok(reading)
}

/// What [`exact`] reads.
///
/// # Errors
/// As [`exact`].
pub fn found(scene: &Scene) -> Result<Found, Fault> {
    Ok(Found::from(&exact(scene)?))
}

/// What the only instrument reads from so many samples.
///
/// # Errors
/// When the scene cannot be planned or measured.
pub fn sampled(scene: &Scene, samples: u64, seed: u64) -> Result<Found, Fault> {
    let stop = Stop { target: None, budget_seconds: None, samples: Some(samples) };
    Ok(Found::from(&first(measured(scene, &stop, seed)?)?))
}

/// What one instrument at the origin, facing +z, reads of some sources.
///
/// # Errors
/// As [`exact`].
pub fn read_up(sources: &[String], sensor: &str) -> Result<Found, Fault> {
    found(&scene(sources, sensor, [0.0; 3], [0.0, 0.0, 1.0])?)
}
