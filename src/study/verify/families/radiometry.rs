//! Group g1: closed forms of radiometry and photometry. One function a family.

use std::f64::consts::PI;

use super::{Families, Outcome, stated};
use crate::quantity::photon::{monochromatic_photon_flux, monochromatic_photon_irradiance, photon_energy_j};
use crate::quantity::table::{Irradiance, LuminousIntensity, RadiantFlux};
use crate::study::verify::bench::{System, at, found, read_up, scene, tilted};
use crate::study::verify::case::{Case, Fault};

pub(super) const FAMILIES: Families = &[
    ("g1a.photon-energy", |c| Ok(photon_energy_j(c.number("lambda_vac_nm")?).into())),
    ("g1a.photon-rate", |c| {
        Ok(monochromatic_photon_flux(RadiantFlux::new(c.number("flux_W")?), c.number("lambda_vac_nm")?).value().into())
    }),
    ("g1a.ppfd", |c| {
        Ok(monochromatic_photon_irradiance(Irradiance::new(c.number("E_W_m2")?), c.number("lambda_vac_nm")?).umol_m2_s().into())
    }),
    ("g1a.emitter-flux", emitter_flux),
    ("g1a.isotropic", isotropic),
    ("g1a.lambert", lambert),
    ("g1a.cone-omega", cone_omega),
    ("g1a.cone-E", cone_e),
    ("g1a.tilted-cone", tilted_cone),
    ("g1b.point-E", point_e),
    ("g1b.point-disc-flux", point_disc_flux),
    ("g1b.point-rect-flux", point_rect_flux),
    ("g1c.disc-par", disc_parallel),
    ("g1c.disc-tilt", disc_tilted),
    ("g1c.disc-cut", disc_tilted),
    ("g1d.rect-par", rect_parallel),
    ("g1d.rect-perp", rect_perpendicular),
    ("g1d.area-luminaire", area_luminaire),
    ("g1e.sphere", sphere),
    ("g1f.coax-discs", coaxial_discs),
    ("g1f.par-rects", parallel_rects),
    ("g1f.perp-rects", perpendicular_rects),
    ("g1g.edge-target", edge_target),
    ("g1g.disc-target", disc_target),
    ("g1g.offset-disc", offset_disc),
    ("g1h.point-cyl", |c| point_at_head(c, "Cylindrical")),
    ("g1h.point-sph", |c| point_at_head(c, "Spherical")),
    ("g1h.cap-cyl", |c| cap_over_head(c, "Cylindrical")),
    ("g1h.cap-sph", |c| cap_over_head(c, "Spherical")),
    ("g1h.rect-cyl", |c| rectangle_over_head(c, "Cylindrical")),
    ("g1h.rect-sph", |c| rectangle_over_head(c, "Spherical")),
    ("g1i.polygon", polygon),
    ("g1i.closed-octahedron", octahedron),
];

/// So large a disc that what passes beside it is below the last digit.
const EVERYTHING_M: f64 = 1e20;

fn disc(centre: [f64; 3], facing: [f64; 3], radius_m: f64) -> String {
    format!("shape: Disc({radius_m:e}), at: {}, facing: {}", at(centre), at(facing))
}

fn point_above(case: &Case, height_m: f64) -> Result<String, Fault> {
    Ok(format!("shape: Point, at: {}, {}", at([0.0, 0.0, height_m]), case.system().intensity(case.number("I")?)))
}

/// Exponent 0: half of what a point emits. Exponent 1: a Lambertian disc. Both into a disc that takes in the half space. For other powers
/// there is no source in scenes: they go through the relation of the lecture.
fn emitter_flux(c: &Case) -> Outcome {
    let (i0, exponent, lamp) = (c.number("I0_cd")?, c.number("exponent")?, System::Luminous);
    let source = match c.text("exponent")? {
        "0" => format!("shape: Point, at: (0, 0, 1), {}", lamp.intensity(i0)),
        "1" => format!("{}, {}", disc([0.0, 0.0, 1.0], [0.0, 0.0, -1.0], 0.3), lamp.intensity(i0)),
        _ => return Ok(LuminousIntensity::new(i0).cosine_power_flux(exponent).value().into()),
    };
    read_up(&[source], &lamp.disc_meter(EVERYTHING_M, "Cosine"))
}

/// The half spaces above and below a point.
fn isotropic(c: &Case) -> Outcome {
    let above = format!("shape: Point, at: (0, 0, 1), {}", System::Luminous.intensity(c.number("I_cd")?));
    Ok(read_up(&[above], &System::Luminous.disc_meter(EVERYTHING_M, "Cosine"))?.times(2.0))
}

fn lambert(c: &Case) -> Outcome {
    let source = format!("{}, {}", disc([0.0, 0.0, 1.0], [0.0, 0.0, -1.0], c.number("R_m")?), c.system().radiance(c.number("L")?));
    read_up(&[source], &c.system().disc_meter(EVERYTHING_M, "Cosine"))
}

/// The flux of one W/sr through a disc that spans the cone is its solid angle.
fn cone_omega(c: &Case) -> Outcome {
    let half = c.number("half_angle_deg")?;
    let radius_m = if half >= 90.0 { EVERYTHING_M } else { half.to_radians().tan() };
    let source = format!("shape: Point, at: (0, 0, 1), {}", System::Radiant.intensity(1.0));
    read_up(&[source], &System::Radiant.disc_meter(radius_m, "Cosine"))
}

fn cone_e(c: &Case) -> Outcome {
    let sky = format!("shape: Environment, {}", c.system().radiance(c.number("L")?));
    read_up(&[sky], &c.system().cone_meter(c.number("half_angle_deg")?))
}

/// What a tilted cone accepts of a uniform field is what a sphere that just fills the cone gives.
fn tilted_cone(c: &Case) -> Outcome {
    let sine = c.number("half_angle_deg")?.to_radians().sin();
    let source = format!("shape: Sphere({sine:e}), at: {}, {}", at([0.0, 0.0, 1.0]), c.system().radiance(c.number("L")?));
    found(&scene(&[source], &c.system().meter(), [0.0; 3], tilted(c.number("tilt_deg")?))?)
}

fn point_e(c: &Case) -> Outcome {
    let source = format!("shape: Point, at: {}, {}", at(c.vector("source")?), c.system().intensity(c.number("I")?));
    found(&scene(&[source], &c.system().meter(), c.vector("sensor")?, c.vector("normal_unnormalised")?)?)
}

pub(super) fn point_disc_flux(c: &Case) -> Outcome {
    read_up(&[point_above(c, c.number("h_m")?)?], &c.system().disc_meter(c.number("R_m")?, "Cosine"))
}

fn point_rect_flux(c: &Case) -> Outcome {
    read_up(&[point_above(c, c.number("h_m")?)?], &c.system().rectangle_meter(c.number("a_m")?, c.number("b_m")?, "Cosine"))
}

pub(super) fn disc_parallel(c: &Case) -> Outcome {
    let centre = [c.number("lateral_m")?, 0.0, c.number("H_m")?];
    let source = format!("{}, {}", disc(centre, [0.0, 0.0, -1.0], c.number("R_m")?), c.system().radiance(c.number("L")?));
    read_up(&[source], &c.system().meter())
}

fn disc_tilted(c: &Case) -> Outcome {
    let place = disc(c.vector("disc_centre_m")?, c.vector("disc_normal")?, c.number("R_m")?);
    let source = format!("{place}, {}", c.system().radiance(c.number("L")?));
    found(&scene(&[source], &c.system().meter(), c.vector("sensor")?, tilted(c.number("t_deg")?))?)
}

fn rect_parallel(c: &Case) -> Outcome {
    let (a, b, d) = (c.number("a_m")?, c.number("b_m")?, c.number("d_m")?);
    let quad = format!("shape: Quad(corner: {}, u: {}, v: {})", at([0.0, 0.0, d]), at([0.0, b, 0.0]), at([a, 0.0, 0.0]));
    read_up(&[format!("{quad}, {}", c.system().radiance(c.number("L")?))], &c.system().meter())
}

fn rect_perpendicular(c: &Case) -> Outcome {
    let (a, b, d) = (c.number("a_m")?, c.number("b_m")?, c.number("d_m")?);
    let quad = format!("shape: Quad(corner: {}, u: {}, v: {})", at([0.0, d, 0.0]), at([a, 0.0, 0.0]), at([0.0, 0.0, b]));
    read_up(&[format!("{quad}, {}", c.system().radiance(c.number("L")?))], &c.system().meter())
}

fn area_luminaire(c: &Case) -> Outcome {
    stated(c, "corners", "x,y=+-0.5, z=3, facing -z")?;
    let source = format!("shape: Rectangle(1, 1), at: (0, 0, 3), facing: (0, 0, -1), {}", c.system().exitance(c.number("M")?));
    found(&scene(&[source], &c.system().meter(), c.vector("sensor")?, c.vector("normal")?)?)
}

/// The sphere is on the z axis, so that its distance is exact, and the element is turned.
pub(super) fn sphere(c: &Case) -> Outcome {
    let centre = at([0.0, 0.0, c.number("d_m")?]);
    let source = format!("shape: Sphere({:e}), at: {centre}, {}", c.number("R_m")?, c.system().radiance(c.number("L")?));
    found(&scene(&[source], &c.system().meter(), [0.0; 3], tilted(c.number("t_deg")?))?)
}

fn coaxial_discs(c: &Case) -> Outcome {
    let place = disc([0.0, 0.0, c.number("H_m")?], [0.0, 0.0, -1.0], c.number("R1_m")?);
    read_up(&[format!("{place}, {}", c.system().radiance(c.number("L")?))], &c.system().disc_meter(c.number("R2_m")?, "Cosine"))
}

/// F₁₂ = Φ / (π L A₁).
fn parallel_rects(c: &Case) -> Outcome {
    let (a, b) = (c.number("a_m")?, c.number("b_m")?);
    let rectangle = format!("shape: Rectangle({a:e}, {b:e}), at: {}, facing: (0, 0, -1)", at([0.0, 0.0, c.number("c_m")?]));
    let flux = read_up(&[format!("{rectangle}, {}", System::Radiant.radiance(1.0))], &System::Radiant.rectangle_meter(a, b, "Cosine"))?;
    Ok(flux.times(1.0 / (PI * a * b)))
}

/// The emitter lies in the plane z = 0, the receiver stands on its edge x = 0.
fn perpendicular_rects(c: &Case) -> Outcome {
    let (w, h, l) = (c.number("W_m")?, c.number("H_m")?, c.number("L_m")?);
    let quad =
        format!("shape: Quad(corner: (0, 0, 0), u: {}, v: {}), {}", at([w, 0.0, 0.0]), at([0.0, l, 0.0]), System::Radiant.radiance(1.0));
    let standing = scene(&[quad], &System::Radiant.rectangle_meter(l, h, "Cosine"), [0.0, 0.5 * l, 0.5 * h], [1.0, 0.0, 0.0])?;
    Ok(found(&standing)?.times(1.0 / (PI * w * l)))
}

/// A target that fills the half plane beyond the edge, as far as the field reaches and further.
fn edge_target(c: &Case) -> Outcome {
    let (edge, far) = (c.number("p_deg")?.to_radians().tan(), 3.0 * c.number("b_deg")?.to_radians().tan());
    let quad = format!("shape: Quad(corner: {}, u: (0, {:e}, 0), v: ({far:e}, 0, 0))", at([edge, -far, 1.0]), 2.0 * far);
    read_up(&[format!("{quad}, {}", System::Luminous.radiance(1.0))], &System::Luminous.radiance_meter(c.number("b_deg")?))
}

fn disc_target(c: &Case) -> Outcome {
    let place = disc([0.0, 0.0, 1.0], [0.0, 0.0, -1.0], c.number("target_half_angle_deg")?.to_radians().tan());
    read_up(&[format!("{place}, {}", c.system().radiance(c.number("L")?))], &c.system().radiance_meter(c.number("b_deg")?))
}

fn offset_disc(c: &Case) -> Outcome {
    let place = disc([c.number("shift_m")?, 0.0, c.number("distance_m")?], [0.0, 0.0, -1.0], c.number("R_m")?);
    read_up(&[format!("{place}, {}", System::Luminous.radiance(1.0))], &System::Luminous.radiance_meter(c.number("b_deg")?))
}

/// The axis of a cylinder is vertical.
fn point_at_head(c: &Case, head: &str) -> Outcome {
    let source = format!("shape: Point, at: {}, {}", at(c.vector("source")?), c.system().intensity(c.number("I")?));
    found(&scene(&[source], &c.system().head_meter(head), c.vector("sensor")?, [0.0, 0.0, 1.0])?)
}

/// A cap about the zenith: a sphere that fills it; everything for the whole sphere, of which the half space above counts half.
fn cap_over_head(c: &Case, head: &str) -> Outcome {
    let half_deg = c.number("a_deg")?;
    let (place, share) = match half_deg {
        _ if half_deg < 90.0 => (format!("shape: Sphere({:e}), at: (0, 0, 1)", half_deg.to_radians().sin()), 1.0),
        90.0 => ("shape: Environment".to_owned(), 0.5),
        180.0 => ("shape: Environment".to_owned(), 1.0),
        _ => return Err(Fault::wrong(format!("no source fills a cap of {half_deg}°"))),
    };
    Ok(read_up(&[format!("{place}, {}", c.system().radiance(c.number("L")?))], &c.system().head_meter(head))?.times(share))
}

fn rectangle_over_head(c: &Case, head: &str) -> Outcome {
    let centre = at([c.number("x_m")?, c.number("y_m")?, c.number("z_m")?]);
    let place = format!("shape: Rectangle({:e}, {:e}), at: {centre}, facing: (0, 0, -1)", c.number("a_m")?, c.number("b_m")?);
    read_up(&[format!("{place}, {}", c.system().radiance(c.number("L")?))], &c.system().head_meter(head))
}

/// A polygon that emits to both sides.
pub(super) fn two_sided(corners: &[[f64; 3]]) -> String {
    let corners: Vec<String> = corners.iter().map(|&corner| at(corner)).collect();
    format!("shape: Polygon([{}]), seen_from: Both", corners.join(", "))
}

/// A two-sided polygon, seen by an element.
pub fn polygon_seen(corners: &[[f64; 3]], l: f64, sensor: [f64; 3], normal: [f64; 3]) -> Outcome {
    let source = format!("{}, {}", two_sided(corners), System::Radiant.radiance(l));
    found(&scene(&[source], &System::Radiant.meter(), sensor, normal)?)
}

fn polygon(c: &Case) -> Outcome {
    polygon_seen(&c.vectors("vertices")?, c.number("L")?, c.vector("sensor")?, c.vector("normal_unnormalised")?)
}

fn octahedron(c: &Case) -> Outcome {
    let signs = [1.0, -1.0];
    let mut faces = Vec::new();
    for x in signs {
        for y in signs {
            for z in signs {
                let face = two_sided(&[[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]]);
                faces.push(format!("{face}, {}", System::Radiant.radiance(c.number("L")?)));
            }
        }
    }
    found(&scene(&faces, &System::Radiant.meter(), c.vector("sensor")?, c.vector("normal_unnormalised")?)?)
}
