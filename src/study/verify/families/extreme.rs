//! Group g4: scales, offsets, tiny and grazing sources, huge and tiny numbers. One function a family.

use std::f64::consts::PI;
use std::sync::Arc;

use super::radiometry::{disc_parallel, point_disc_flux, polygon_seen, sphere};
use super::{Families, Outcome};
use crate::math::DVec3;
use crate::quantity::Measurand;
use crate::quantity::constants::K_M_LM_W;
use crate::scene::{Instrument, Layout, Pose, Scene};
use crate::sensor::{Acceptance, Aperture, Channel, Sensor};
use crate::source::{Emitter, Source};
use crate::spectrum::black_body::{ln_spectral_radiance, spectral_radiance};
use crate::spectrum::{Density, Factor, Line, library};

use crate::study::verify::bench::{at, found, read, read_up, scene, tilted};
use crate::study::verify::case::{Case, Fault};

pub(super) const FAMILIES: Families = &[
    ("g4a.scale-disc", scaled_disc),
    ("g4a.scale-tri", scaled_triangle),
    ("g4b.offset-tri", triangle_far_from_the_origin),
    ("g4b.offset-dec", triangle_far_from_the_origin),
    ("g4c.tiny-source", tiny_source),
    ("g4c.tiny-accept", tiny_acceptance),
    ("g4c.grazing", grazing_point),
    ("g4c.grazing-disc", disc_parallel),
    ("g4c.touching-sphere", sphere),
    ("g4d.area", area_in_a_uniform_field),
    ("g4d.near-point", point_disc_flux),
    ("g4e.radiance", dome),
    ("g4e.hdr-sum", hdr_sum),
    ("g4e.planck", |c| Ok(ln_spectral_radiance(c.number("lambda_nm")?, c.number("T_K")?).into())),
    ("g4g.sliver", sliver),
    ("g4i.ir-leak", infrared_leak),
    ("g4i.laser-leak", laser_leak),
];

fn scaled_disc(c: &Case) -> Outcome {
    let s = c.number("scale_s_m")?;
    let place = format!("shape: Disc({:e}), at: {}, facing: (0, 0, -1)", 0.5 * s, at([0.25 * s, 0.0, s]));
    read_up(&[format!("{place}, {}", c.system().radiance(c.number("L")?))], &c.system().meter())
}

fn scaled_triangle(c: &Case) -> Outcome {
    let s = c.number("scale")?;
    let corners: Vec<[f64; 3]> = c.vectors("vertices_times_scale")?.iter().map(|v| v.map(|x| x * s)).collect();
    polygon_seen(&corners, c.number("L")?, c.vector("sensor")?, c.vector("normal_unnormalised")?)
}

fn triangle_far_from_the_origin(c: &Case) -> Outcome {
    let offset = c.number("offset_each_axis_m")?;
    let corners: Vec<[f64; 3]> = c.vectors("vertices_before_offset")?.iter().map(|v| v.map(|x| x + offset)).collect();
    polygon_seen(&corners, c.number("L")?, c.vector("sensor")?, c.vector("normal_unnormalised")?)
}

/// A sphere of solid angle Ω: sin²α = (Ω/π)(1 − Ω/4π).
fn tiny_source(c: &Case) -> Outcome {
    let omega = c.number("solid_angle_sr")?;
    let sine = (omega / PI * (1.0 - omega / (4.0 * PI))).sqrt();
    let source = format!("shape: Sphere({sine:e}), at: (0, 0, 1), {}", c.system().radiance(c.number("L")?));
    found(&scene(&[source], &c.system().meter(), [0.0; 3], tilted(c.number("t_deg")?))?)
}

fn tiny_acceptance(c: &Case) -> Outcome {
    let sky = format!("shape: Environment, {}", c.system().radiance(c.number("L")?));
    read_up(&[sky], &c.system().cone_meter(c.number("half_angle_deg")?))
}

fn grazing_point(c: &Case) -> Outcome {
    let source = format!("shape: Point, at: {}, {}", at([0.0, 0.0, c.number("r_m")?]), c.system().intensity(c.number("I")?));
    found(&scene(&[source], &c.system().meter(), [0.0; 3], tilted(c.number("t_deg")?))?)
}

fn area_in_a_uniform_field(c: &Case) -> Outcome {
    let (area, acceptance) = (c.number("A_m2")?, format!("Cone(half_angle_deg: {})", c.text("half_angle_deg")?));
    let sky = format!("shape: Environment, {}", c.system().radiance(c.number("L")?));
    let square = read_up(std::slice::from_ref(&sky), &c.system().rectangle_meter(area.sqrt(), area.sqrt(), &acceptance))?;
    let disc = read_up(&[sky], &c.system().disc_meter((area / PI).sqrt(), &acceptance))?;
    if (square.value / disc.value - 1.0).abs() >= 1e-14 {
        return Err(Fault::wrong(format!("a square reads {} and a disc of the same area {}", square.value, disc.value)));
    }
    Ok(square)
}

fn dome(c: &Case) -> Outcome {
    let side = c.number("A_m2")?.sqrt();
    let sky = format!("shape: Environment, {}", c.system().radiance(c.number("L")?));
    read_up(&[sky], &c.system().rectangle_meter(side, side, "Cosine"))
}

/// A million small sources and a big one, less the big one alone. The scene is made in memory.
fn hdr_sum(c: &Case) -> Outcome {
    let v = library::v_lambda();
    let channel = Channel::new("E_v", v.clone(), Measurand::Illuminance, K_M_LM_W);
    let sensor = Sensor::new("meter", Aperture::Point, Acceptance::Cosine, vec![channel]);
    let pose = Pose { at: DVec3::ZERO, normal: DVec3::Z, x_axis: DVec3::X };
    let instrument = Instrument { name: "meter".into(), sensor: Arc::new(sensor), layout: Layout::Single, poses: vec![pose] };
    let candela = |i: f64| Density::line(555.0, i / (K_M_LM_W * v.at(555.0)));
    let at = DVec3::new(0.0, 0.0, c.number("r_m")?);
    let source =
        |i: usize, density: &Density| Source { name: format!("source {i}"), emitter: Emitter::Point { at }, density: density.clone() };
    let (small, big) = (candela(c.number("I_small")?)?, candela(c.number("I_big")?)?);
    let count = c.number("N")? as usize;
    let all = (0..count).map(|i| source(i, &small)).chain([source(count, &big)]).collect();
    let scene = |sources: Vec<Source>| Scene { sources, instruments: vec![instrument.clone()], ..Scene::default() };
    Ok(found(&scene(all))?.minus(found(&scene(vec![source(0, &big)]))?))
}

fn sliver(c: &Case) -> Outcome {
    polygon_seen(&c.vectors("vertices")?, c.number("L")?, c.vector("sensor")?, c.vector("normal")?)
}

/// The convention of the case: sums over integer nodes, 1 nm apart, which is what lines at these nodes give.
fn infrared_leak(c: &Case) -> Outcome {
    let (t, k, hi) = (c.number("T_K")?, c.number("k")?, c.number("hi_nm")?);
    // Relative to a power that keeps the numbers of an 800 K emitter away from zero.
    let lines: Vec<Line> = (360..=hi as u32).map(f64::from).map(|nm| Line { wavelength_nm: nm, power: spectral_radiance(nm, t) }).collect();
    let density = Density::lines_only(&lines)?;
    let leak = Factor::band(780.5, hi + 0.5, k)?;
    Ok((density.integral(&[&leak]) / density.integral(&[&library::v_lambda()])).into())
}

fn laser_leak(c: &Case) -> Outcome {
    let text = format!(
        "Scene(sources: [(name: \"laser\", shape: Directional, facing: (0, 0, -1), strength: WattsPerSquareMetre({}), spectrum: Line({}))],
        instruments: [(name: \"meter\", at: (0, 0, 0), facing: (0, 0, 1), sensor: Sensor(aperture: Point, acceptance: Cosine, channels: [
            (name: \"E_v\", responsivity: Sum([\"V\", Band(from_nm: 781, to_nm: 1100, value: {})]), reads: Illuminance)]))])",
        c.text("E_W_m2")?,
        c.text("lambda_nm")?,
        c.text("k")?,
    );
    found(&read(&text)?)
}
