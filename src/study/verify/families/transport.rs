//! Group g3: what is reflected, shadowed and seen through openings. One function a family.
//!
//! Where no formula serves, a fixed number of samples with a fixed seed is taken, and the reading must agree within what it states of itself.

use std::f64::consts::PI;

use super::{Families, Outcome, stated};
use crate::study::verify::bench::{System, at, found, read_up, sampled, scene, scene_with};
use crate::study::verify::case::{Case, Fault, Found};

pub(super) const FAMILIES: Families = &[
    ("g3a.sphere-closed", sphere_closed),
    ("g3a.sphere-port", sphere_port),
    ("g3a.sphere-port-flux", sphere_port_flux),
    ("g3c.furnace", furnace),
    ("g3d.cube-wall_mean", cube),
    ("g3d.cube-wall_centre", cube),
    ("g3d.cube-bottom_mean", cube),
    ("g3d.cube-bottom_centre", cube),
    ("g3d.cube-top_mean", cube),
    ("g3d.cube-top_centre", cube),
    ("g3e.gap-leak", gap_leak),
    ("g3f.knife", knife),
    ("g3f.knife-var", knife),
    ("g3g.roof-DF", roof),
    ("g3i.reflector", reflector),
    ("g3i.reflector-panel", reflector_behind_panel),
    ("g3j.irc", indirect_mean),
];

/// Samples of a reading, over all replicates.
const SAMPLES: u64 = 1 << 16;
const SEED: u64 = 1;

const DOWN: [f64; 3] = [0.0, 0.0, -1.0];
const UP: [f64; 3] = [0.0, 0.0, 1.0];

fn surface(rho: f64) -> String {
    format!("surfaces: {{ \"paint\": Lambertian({rho:e}), \"black\": Lambertian(0) }},")
}

fn lamp(place: [f64; 3], flux_lm: f64) -> String {
    format!("shape: Point, at: {}, strength: Lumens({flux_lm:e}), spectrum: \"A\"", at(place))
}

/// A sphere with the lamp in its centre, and the wall seen by a meter on it.
fn sphere_closed(c: &Case) -> Outcome {
    let (r, rho) = (c.number("R_m")?, c.number("rho")?);
    let things = format!(
        "{} objects: [(name: \"sphere\", shape: Sphere({r:e}), at: (0, 0, 0), seen_from: Inside, surface: \"paint\")],",
        surface(rho)
    );
    let room = scene_with(&things, &[lamp([0.0; 3], c.number("flux_lm")?)], &System::Luminous.meter(), [r, 0.0, 0.0], [-1.0, 0.0, 0.0])?;
    found(&room)
}

/// The open port is a black disc across its rim: whatever passes the rim does not come back. Radius and height of the rim.
fn port(c: &Case) -> Result<(String, f64, f64), Fault> {
    let (r, half) = (c.number("R_m")?, c.number("port_half_angle_deg")?.to_radians());
    let (radius, height) = (r * half.sin(), r * half.cos());
    let things = format!(
        "{} objects: [(name: \"sphere\", shape: Sphere({r:e}), at: (0, 0, 0), seen_from: Inside, surface: \"paint\"),
         (name: \"port\", shape: Disc({radius:e}), at: {}, facing: (0, 0, -1), surface: \"black\")],",
        surface(c.number("rho")?),
        at([0.0, 0.0, height])
    );
    Ok((things, radius, height))
}

fn sphere_port(c: &Case) -> Outcome {
    stated(c, "port", "black (open)")?;
    let (things, ..) = port(c)?;
    // On the axis, opposite the port.
    let place = [0.0, 0.0, -c.number("R_m")?];
    let room = scene_with(&things, &[lamp([0.0; 3], c.number("flux_lm")?)], &System::Luminous.meter(), place, UP)?;
    sampled(&room, SAMPLES, SEED)
}

fn sphere_port_flux(c: &Case) -> Outcome {
    let (things, radius, height) = port(c)?;
    let meter = System::Luminous.disc_meter(radius, "Cosine");
    let room = scene_with(&things, &[lamp([0.0; 3], c.number("flux_lm")?)], &meter, [0.0, 0.0, height], DOWN)?;
    sampled(&room, SAMPLES, SEED)
}

fn closed_box(size: [f64; 3], rho: f64) -> String {
    format!(
        "{} objects: [(name: \"room\", shape: Box(size: {}), at: (0, 0, 0), seen_from: Inside, surface: \"paint\")],",
        surface(rho),
        at(size)
    )
}

fn quad(corner: [f64; 3], u: [f64; 3], v: [f64; 3]) -> String {
    format!("shape: Quad(corner: {}, u: {}, v: {})", at(corner), at(u), at(v))
}

/// Faces of a box from the origin, the floor first; u × v looks into it.
fn faces(size: [f64; 3]) -> [String; 6] {
    let (o, x, y, z) = ([0.0; 3], [size[0], 0.0, 0.0], [0.0, size[1], 0.0], [0.0, 0.0, size[2]]);
    [quad(o, x, y), quad(z, y, x), quad(o, y, z), quad(x, z, y), quad(o, z, x), quad(y, x, z)]
}

/// Every face of a box emits and reflects.
fn furnace(c: &Case) -> Outcome {
    stated(c, "self_exitance", "(1-rho)*100")?;
    let rho = c.number("rho")?;
    let glow = System::Luminous.exitance(100.0 * (1.0 - rho));
    let walls = faces([1.0, 2.0, 3.0]).map(|face| format!("{face}, surface: \"paint\", {glow}"));
    sampled(&scene_with(&surface(rho), &walls, &System::Luminous.meter(), [0.3, 0.6, 1.1], [0.3, -0.5, 0.7])?, SAMPLES, SEED)
}

/// The floor of a cube emits and reflects, the other faces reflect.
fn cube(c: &Case) -> Outcome {
    let (side, system) = (c.number("side_m")?, System::Radiant);
    let [floor, others @ ..] = faces([side; 3]);
    let floor = format!("{floor}, surface: \"paint\", {}", system.exitance(c.number("M_floor")?));
    let objects: String = others.iter().enumerate().map(|(i, face)| format!("(name: \"face {i}\", {face}, surface: \"paint\"),")).collect();
    let things = format!("{} objects: [{objects}],", surface(c.number("rho")?));
    let (place, mean) = c.text("where")?.split_once('_').ok_or_else(|| Fault::wrong("`where` names no place"))?;
    let half = 0.5 * side;
    let (place, facing) = match place {
        "bottom" => ([half, half, 0.0], UP),
        "top" => ([half, half, side], DOWN),
        "wall" => ([0.0, half, half], [1.0, 0.0, 0.0]),
        other => return Err(Fault::wrong(format!("no place `{other}`; allowed: bottom, top, wall"))),
    };
    let room = |meter: &str| scene_with(&things, std::slice::from_ref(&floor), meter, place, facing);
    match mean {
        "centre" => sampled(&room(&system.meter())?, SAMPLES, SEED),
        "mean" => Ok(sampled(&room(&system.rectangle_meter(side, side, "Cosine"))?, SAMPLES, SEED)?.times(1.0 / (side * side))),
        other => Err(Fault::wrong(format!("no place `{other}`; allowed: centre, mean"))),
    }
}

/// 1 − F of two parallel squares. F comes with an error near the last digit, of which even the narrowest gap leaves enough.
fn gap_leak(c: &Case) -> Outcome {
    let (a, gap) = (c.number("side_m")?, c.number("gap_m")?);
    let square =
        format!("shape: Rectangle({a:e}, {a:e}), at: {}, facing: (0, 0, -1), {}", at([0.0, 0.0, gap]), System::Radiant.radiance(1.0));
    let share = read_up(&[square], &System::Radiant.rectangle_meter(a, a, "Cosine"))?.times(1.0 / (PI * a * a));
    Ok(Found { value: 1.0 - share.value, ..share })
}

/// A disc behind the edge of a half plane, which is a square far larger than what it shades.
fn knife(c: &Case) -> Outcome {
    stated(c, "occluder", "x>0")?;
    let (r, xs) = (c.number("R_m")?, c.number("xs_m")?);
    let far = 10.0 * (r + xs.abs());
    let things = format!(
        "{} objects: [(name: \"edge\", shape: Quad(corner: {}, u: {}, v: {}), surface: \"black\")],",
        surface(0.0),
        at([0.0, -far, c.number("z_edge_m")?]),
        at([far, 0.0, 0.0]),
        at([0.0, 2.0 * far, 0.0])
    );
    let disc = format!(
        "shape: Disc({r:e}), at: {}, facing: (0, 0, -1), {}",
        at([0.0, 0.0, c.number("H_m")?]),
        c.system().radiance(c.number("L")?)
    );
    sampled(&scene_with(&things, &[disc], &c.system().meter(), [xs, 0.0, 0.0], UP)?, SAMPLES, SEED)
}

/// A uniform sky through an opening in a black roof is a luminous rectangle. Percent of π L.
fn roof(c: &Case) -> Outcome {
    stated(c, "sky", "uniform")?;
    stated(c, "definition", "100*E/E_h,exterior")?;
    let pair = |key: &str| -> Result<[f64; 2], Fault> {
        let list: Vec<f64> = c.numbers(key)?;
        list.try_into().map_err(|_| Fault::wrong(format!("`{key}` is no pair")))
    };
    let ([a, b], [x, y], height) = (pair("opening_m")?, pair("sensor_offset_m")?, c.number("height_m")?);
    let opening = format!("shape: Rectangle({a:e}, {b:e}), at: {}, facing: (0, 0, -1), up: (0, 1, 0)", at([-x, -y, height]));
    Ok(read_up(&[format!("{opening}, {}", System::Luminous.radiance(1.0))], &System::Luminous.meter())?.times(100.0 / PI))
}

/// The lit patch emits what it reflects.
fn patch(c: &Case) -> Result<String, Fault> {
    let e = c.text("E_lx")?.split(' ').next().and_then(|text| text.parse::<f64>().ok());
    let e = e.ok_or_else(|| Fault::wrong("`E_lx` does not begin with a number"))?;
    let floor = quad([0.0, -2.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]);
    Ok(format!("{floor}, {}", System::Luminous.exitance(e * c.number("rho")?)))
}

fn reflector(c: &Case) -> Outcome {
    found(&scene(&[patch(c)?], &System::Luminous.meter(), c.vector("sensor")?, c.vector("normal_unnormalised")?)?)
}

fn reflector_behind_panel(c: &Case) -> Outcome {
    let panel = c.input("panel")?;
    let number = |value: Option<&serde_json::Value>| {
        value.and_then(|v| v.as_str()?.parse::<f64>().ok()).ok_or_else(|| Fault::wrong("`panel` needs x, y (two numbers) and h as text"))
    };
    let (x, h) = (number(panel.get("x"))?, number(panel.get("h"))?);
    let y = panel.get("y").ok_or_else(|| Fault::wrong("`panel` has no `y`"))?;
    let (from, to) = (number(y.get(0))?, number(y.get(1))?);
    let things = format!(
        "{} objects: [(name: \"panel\", shape: Quad(corner: {}, u: {}, v: {}), surface: \"black\")],",
        surface(0.0),
        at([x, from, 0.0]),
        at([0.0, to - from, 0.0]),
        at([0.0, 0.0, h])
    );
    let room = scene_with(&things, &[patch(c)?], &System::Luminous.meter(), c.vector("sensor")?, c.vector("normal_unnormalised")?)?;
    sampled(&room, SAMPLES, SEED)
}

/// A cube with the lamp in its centre: the mean over one wall is the mean over all. What comes directly is taken off.
fn indirect_mean(c: &Case) -> Outcome {
    let size = c.vector("room_m")?;
    let (side, flux) = (size[0], c.number("flux_lm")?);
    if size != [side; 3] {
        return Err(Fault::wrong("`room_m` is no cube"));
    }
    let half = 0.5 * side;
    let meter = System::Luminous.rectangle_meter(side, side, "Cosine");
    let room = scene_with(&closed_box(size, c.number("rho")?), &[lamp([half; 3], flux)], &meter, [0.0, half, half], [1.0, 0.0, 0.0])?;
    let mean = sampled(&room, SAMPLES, SEED)?.times(1.0 / (side * side));
    Ok(Found { value: mean.value - flux / (6.0 * side * side), ..mean })
}
