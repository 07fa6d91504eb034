//! How strong a source is, in the words of the field → the amount of its spectral density.
//!
//! ```text
//! point        I = Φ/4π,  I = E r²
//! flat         L = Φ/πA,  L = I/A,     L = M/π,  rectangle: E(r) = 2L [X/√(1+X²) atan(Y/√(1+X²)) + Y/√(1+Y²) atan(X/√(1+Y²))]
//!                                                with X = w/2r, Y = h/2r;   disc: E(r) = πL R²/(R² + r²)
//! sphere       L = Φ/πA,  L = I/πR²,   L = M/π,  E(r) = πL (R/r)²
//! environment  L = E/π
//! ```
//!
//! A is the emitting area (both sides if both emit), r is on the axis from the centre. The rectangle is four times the
//! configuration factor from a plane element to a parallel rectangle with one corner on its normal; this and the other
//! two are in J. R. Howell, *A Catalog of Radiation Heat Transfer Configuration Factors*, section B and C.

use std::f64::consts::PI;

use super::decode::Value;
use super::diagnostic::Problems;
use super::document::Kind;
use crate::geometry::shape::Shape;
use crate::quantity::constants::K_M_LM_W;
use crate::spectrum::{Density, Factor};

/// Which quantity is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Given {
    Flux,
    Intensity,
    FluxDensity,
    FluxDensityAt,
    Exitance,
    Radiance,
    Electrical,
    Absolute,
}

/// Name, how it is written, the quantity, and whether it is luminous.
const FORMS: [(&str, &str, Given, bool); 14] = [
    ("Watts", "Watts(1.5)", Given::Flux, false),
    ("Lumens", "Lumens(800)", Given::Flux, true),
    ("WattsPerSteradian", "WattsPerSteradian(0.2)", Given::Intensity, false),
    ("Candela", "Candela(100)", Given::Intensity, true),
    ("WattsPerSquareMetre", "WattsPerSquareMetre(1000)", Given::FluxDensity, false),
    ("Lux", "Lux(10000)", Given::FluxDensity, true),
    ("Irradiance", "Irradiance(watts_per_m2: 0.1, at_m: 2)", Given::FluxDensityAt, false),
    ("Illuminance", "Illuminance(lux: 25, at_m: 2)", Given::FluxDensityAt, true),
    ("Exitance", "Exitance(watts_per_m2: 10)", Given::Exitance, false),
    ("LuminousExitance", "LuminousExitance(lumens_per_m2: 3000)", Given::Exitance, true),
    ("Radiance", "Radiance(5)", Given::Radiance, false),
    ("Luminance", "Luminance(1000)", Given::Radiance, true),
    ("Electrical", "Electrical(volts: 12, amperes: 0.35, efficiency: 0.4)", Given::Electrical, false),
    ("Absolute", "Absolute(1)", Given::Absolute, false),
];

/// What emits, as far as its strength is concerned.
#[derive(Clone, Copy, Debug)]
pub(super) enum Emission<'s> {
    Point,
    Directional,
    Environment,
    /// Shapes, and on how many of their sides (1 or 2) they emit; whether they emit inwards only.
    Area {
        shapes: &'s [Shape],
        sides: f64,
        inwards: bool,
    },
}

impl Emission<'_> {
    fn name(&self) -> &'static str {
        match self {
            Emission::Point => "a point",
            Emission::Directional => "directional light",
            Emission::Environment => "an environment",
            Emission::Area { shapes: [Shape::Sphere(_)], inwards: true, .. } => "the inside of a sphere",
            Emission::Area { shapes: [Shape::Rectangle(_)], .. } => "a rectangle",
            Emission::Area { shapes: [Shape::Polygon(_)], .. } => "a polygon",
            Emission::Area { shapes: [Shape::Disc(d)], .. } if d.hole_radius_m > 0.0 => "a ring",
            Emission::Area { shapes: [Shape::Disc(_)], .. } => "a disc",
            Emission::Area { shapes: [Shape::Sphere(_)], .. } => "a sphere",
            Emission::Area { .. } => "a source of this shape",
        }
    }

    /// Intensity or radiance per unit of the quantity; none if the quantity does not say how strong such a source is.
    ///
    /// The answer is a point's W/sr, directional light's W/m², and W/(m² sr) of the others. `at_m` is used by flux densities.
    fn per_unit(&self, given: Given, at_m: f64) -> Option<f64> {
        match (*self, given) {
            (_, Given::Absolute) => Some(1.0),
            (Emission::Point, Given::Flux | Given::Electrical) => Some(1.0 / (4.0 * PI)),
            (Emission::Point, Given::Intensity) | (Emission::Directional, Given::FluxDensity) => Some(1.0),
            (Emission::Point, Given::FluxDensityAt) => Some(at_m * at_m),
            (Emission::Environment, Given::FluxDensity) | (Emission::Area { .. }, Given::Exitance) => Some(1.0 / PI),
            (Emission::Environment | Emission::Area { .. }, Given::Radiance) => Some(1.0),
            (Emission::Area { shapes, sides, .. }, Given::Flux | Given::Electrical) => {
                let area_m2: f64 = shapes.iter().map(Shape::area_m2).sum();
                Some(1.0 / (PI * area_m2 * sides))
            }
            (Emission::Area { shapes: [shape], inwards, .. }, Given::Intensity) => match shape {
                Shape::Rectangle(_) | Shape::Polygon(_) | Shape::Disc(_) => Some(1.0 / shape.area_m2()),
                Shape::Sphere(s) if !inwards => Some(1.0 / (PI * s.radius_m * s.radius_m)),
                _ => None,
            },
            (Emission::Area { shapes: [shape], inwards, .. }, Given::FluxDensityAt) => {
                on_axis_per_radiance(shape, inwards, at_m).map(|e| 1.0 / e)
            }
            _ => None,
        }
    }
}

/// Irradiance on the axis at a distance from the centre, per unit of radiance, sr.
fn on_axis_per_radiance(shape: &Shape, inwards: bool, at_m: f64) -> Option<f64> {
    match shape {
        Shape::Rectangle(r) => {
            let (x, y) = (r.half_u.length() / at_m, r.half_v.length() / at_m);
            let (p, q) = (x.hypot(1.0), y.hypot(1.0));
            Some(2.0 * (x / p * (y / p).atan() + y / q * (x / q).atan()))
        }
        Shape::Disc(d) => {
            let within = |radius_m: f64| PI * (radius_m / radius_m.hypot(at_m)).powi(2);
            Some(within(d.radius_m) - within(d.hole_radius_m))
        }
        Shape::Sphere(s) if !inwards => Some(PI * (s.radius_m / at_m).powi(2)),
        _ => None,
    }
}

/// Reads a strength and gives the source's density: the spectrum, as strong as that.
pub(super) fn read_strength(
    value: &Value,
    emission: Emission,
    spectrum: Option<&Density>,
    v_lambda: &Factor,
    problems: &mut Problems,
) -> Option<Density> {
    let fitting: Vec<&(&str, &str, Given, bool)> = FORMS.iter().filter(|form| emission.per_unit(form.2, 1.0).is_some()).collect();
    let names: Vec<&str> = FORMS.iter().map(|form| form.0).collect();
    if matches!(value.node.kind, Kind::Number(_)) {
        let forms: Vec<&str> = fitting.iter().map(|form| form.1).collect();
        value.problem(problems, "a strength needs a unit, not only a number", format!("for {}: {}", emission.name(), forms.join(", ")));
        return None;
    }
    if !names.contains(&value.name()) {
        let allowed: Vec<&str> = fitting.iter().map(|form| form.0).collect();
        value.variant("a strength", &allowed, problems);
        return None;
    }
    let &(name, form, given, luminous) = FORMS.iter().find(|entry| entry.0 == value.name())?;
    if !fitting.iter().any(|entry| entry.0 == name) {
        let forms: Vec<&str> = fitting.iter().map(|entry| entry.1).collect();
        let hint = if given == Given::FluxDensity && emission.per_unit(Given::FluxDensityAt, 1.0).is_some() {
            let at = if luminous { "Illuminance(lux: …, at_m: …)" } else { "Irradiance(watts_per_m2: …, at_m: …)" };
            format!("it depends on the distance: `{at}` gives both; ")
        } else {
            String::new()
        };
        value.problem_at(
            &value.name_span(),
            problems,
            format!("`{name}` does not say how strong {} is", emission.name()),
            format!("{hint}write one of {}", forms.join(", ")),
        );
        return None;
    }
    let (amount, at_m) = read_amount(value, name, form, given, problems)?;
    if let (Emission::Area { shapes: [Shape::Sphere(s)], .. }, Given::FluxDensityAt) = (emission, given)
        && at_m <= s.radius_m
    {
        value.problem(
            problems,
            format!("`at_m: {at_m}` lies within the source, a sphere of radius {} m", s.radius_m),
            "give a distance from the centre that is larger than the radius",
        );
        return None;
    }
    let spectrum = spectrum?;
    let total = if given == Given::Absolute {
        1.0
    } else if luminous {
        K_M_LM_W * spectrum.integral(&[v_lambda])
    } else {
        spectrum.total()
    };
    if !(total > 0.0 && total.is_finite()) {
        let (why, help) = if luminous {
            (
                "the spectrum has no light that the eye sees (V(λ) is zero beyond 360 nm to 830 nm), so no luminous strength can be reached",
                "give the strength in watts, W/sr, W/m² or W/(m² sr), or another spectrum",
            )
        } else {
            ("the spectrum is zero at every wavelength", "give another spectrum")
        };
        value.problem(problems, why, help);
        return None;
    }
    let scale = amount * emission.per_unit(given, at_m)? / total;
    match spectrum.scaled(scale) {
        Ok(density) => Some(density),
        Err(_) => {
            value.problem(problems, "the strength is too large for the numbers of this program", "allowed: spectral densities up to 1e300");
            None
        }
    }
}

/// Notes what is wrong with a strength by itself, for a source whose shape is not known.
pub(super) fn check_strength(value: &Value, problems: &mut Problems) {
    let names = FORMS.map(|form| form.0);
    let Some(name) = value.variant("a strength", &names, problems) else { return };
    if let Some(form) = FORMS.iter().find(|form| form.0 == name) {
        let _ = read_amount(value, form.0, form.1, form.2, problems);
    }
}

/// The number of a strength, and the distance at which it is given (1 m if it has none).
fn read_amount(value: &Value, name: &str, form: &str, given: Given, problems: &mut Problems) -> Option<(f64, f64)> {
    let not_negative = |x: f64| x >= 0.0;
    let keyed = |keys: &[&str], problems: &mut Problems| -> Option<Vec<f64>> {
        let fields = value.fields(&format!("`{name}`"), keys, problems)?;
        let numbers: Vec<Option<f64>> = keys
            .iter()
            .map(|key| {
                let found = fields.require(key, "0.5", problems)?;
                match *key {
                    "at_m" => found.length_m("the distance", 1.0, problems),
                    "efficiency" => {
                        found.number_in("the efficiency", "0 to 1 (40 % is written 0.4)", |x| (0.0..=1.0).contains(&x), problems)
                    }
                    _ => found.number_in(&format!("`{key}`"), "0 and above", not_negative, problems),
                }
            })
            .collect();
        numbers.into_iter().collect()
    };
    match given {
        Given::FluxDensityAt => {
            let key = if name == "Illuminance" { "lux" } else { "watts_per_m2" };
            let numbers = keyed(&[key, "at_m"], problems)?;
            Some((numbers[0], numbers[1]))
        }
        Given::Exitance => {
            let key = if name == "Exitance" { "watts_per_m2" } else { "lumens_per_m2" };
            Some((keyed(&[key], problems)?[0], 1.0))
        }
        Given::Electrical => {
            let numbers = keyed(&["volts", "amperes", "efficiency"], problems)?;
            Some((numbers[0] * numbers[1] * numbers[2], 1.0))
        }
        _ => {
            let item = value.positional(1, form, problems)?.into_iter().next()?;
            Some((item.number_in("the strength", "0 and above", not_negative, problems)?, 1.0))
        }
    }
}
