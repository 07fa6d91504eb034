//! Indices of the directional response, by both routes.
//!
//! | receptor | index | computed | measured |
//! |---|---|---|---|
//! | planar | f2 | integrals of the table | straight lines through the readings of the goniometer |
//! | planar | flat field | ∫ R cos θ dω | a uniform hemisphere, sampled by rays |
//! | head | f2,0, f2,z, … | its weight over the sphere | bilinear between a beam from all round |
//! | cone | half-angle, edge | the half-angle, 0 | a beam led across the edge |
//! | cone | surrounding field | 0 | a bright screen with a black middle |

use std::f64::consts::{PI, TAU};

use super::spectral::{is_illuminance, seen_by};
use super::{Absent, Index, SheetError};
use crate::characterization::Figure;
use crate::characterization::bench::Bench;
use crate::characterization::bench::field::Probe;
use crate::characterization::bench::goniometer::Goniogram;
use crate::characterization::bench::sampling::halving_error;
use crate::characterization::bench::sphere::to_local;
use crate::characterization::class_limits::limits;
use crate::characterization::directional_mismatch::{DirectionalError, f2, f2_of_response};
use crate::characterization::head_mismatch::{Head, change_of_f2, f2_of_head};
use crate::sensor::Acceptance;

/// Upper angle of f2, degrees.
pub const LARGEST_ANGLE_DEG: f64 = 80.0;
/// Steps of the goniometer up to that angle.
const STEPS: u32 = 160;
/// Azimuths of a response that depends on them.
const AZIMUTHS: u32 = 8;
/// How far beyond its edge a field is looked at.
const REACH: f64 = 2.0;
const PERCENT: f64 = 100.0;

/// What kind of receptor a sensor has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Receptor {
    /// Meant to follow the cosine.
    Planar,
    /// Sees a cone about its axis.
    Cone {
        /// Half-angle, rad.
        half_angle_rad: f64,
    },
    /// Sees a spot in its plane of focus.
    Spot {
        /// Half the measured field, rad.
        half_angle_rad: f64,
        /// Distance of the plane of focus, m.
        focus_m: f64,
    },
    /// Weighs light from all round.
    Head(Head),
}

impl Receptor {
    fn of(acceptance: &Acceptance) -> Self {
        match (acceptance, acceptance.head()) {
            (_, Some(head)) => Self::Head(Head::of(head)),
            (Acceptance::Cone { half_angle_rad }, None) => Self::Cone { half_angle_rad: *half_angle_rad },
            (Acceptance::Spot(spot), None) => Self::Spot { half_angle_rad: spot.half_angle_rad, focus_m: spot.focus_m },
            _ => Self::Planar,
        }
    }
}

/// What was found about directions.
pub(super) struct Directional {
    pub(super) receptor: Receptor,
    pub(super) indices: Vec<Index>,
    pub(super) absent: Vec<Absent>,
    pub(super) goniogram: Option<Goniogram>,
}

pub(super) fn characterise(bench: &Bench<'_>) -> Result<Directional, SheetError> {
    let receptor = Receptor::of(&bench.sensor().acceptance);
    match receptor {
        Receptor::Planar => planar(bench),
        Receptor::Cone { half_angle_rad } => field(bench, receptor, half_angle_rad, Probe::Beam),
        Receptor::Spot { half_angle_rad, focus_m } => field(bench, receptor, half_angle_rad, Probe::PointAt { focus_m }),
        Receptor::Head(head) => all_round(bench, head),
    }
}

/// Whether the limits of illuminance meters apply.
fn is_lux_meter(bench: &Bench<'_>) -> bool {
    bench.sensor().channels.iter().any(is_illuminance)
}

fn all_round(bench: &Bench<'_>, head: Head) -> Result<Directional, SheetError> {
    let sensor = bench.sensor();
    let sphere = bench.sphere(0, &seen_by(&sensor.channels[0])?, head)?;
    let computed = f2_of_head(head, &|theta, phi| sensor.acceptance.weight(to_local(head, theta, phi)))?;
    let between = f2_of_head(head, &|theta, phi| sphere.at(theta, phi, false))?;
    let (theta, phi) = head.reference_rad();
    let reference = sphere.at(theta, phi, false);
    let apart = change_of_f2(head, reference, &|theta, phi| sphere.at(theta, phi, false) - sphere.at(theta, phi, true))?;
    let read = change_of_f2(head, reference, &|_, _| sphere.standard_uncertainty())?;
    let u = (apart / 3f64.sqrt()).hypot(read).hypot(between.standard_uncertainty);
    let (symbol, name) = match head {
        Head::Planar => ("f2", "directional response"),
        Head::Spherical => ("f2,0", "directional response, spherical head"),
        Head::Hemispherical => ("f2,h", "directional response, hemispherical head"),
        Head::Cylindrical => ("f2,z", "directional response, cylindrical head"),
        Head::Semicylindrical => ("f2,zh", "directional response, semicylindrical head"),
    };
    let index = Index {
        symbol,
        name,
        unit: "%",
        computed: Figure { standard_uncertainty: computed.standard_uncertainty.max(1e-12), ..computed }.scaled(PERCENT),
        measured: Figure { value: between.value, standard_uncertainty: u }.scaled(PERCENT),
        stated_u: 0.0,
        limits: if is_lux_meter(bench) { head.symbol().and_then(limits) } else { None },
        conditions: "weighted with the ideal of the head over the whole sphere".to_owned(),
    };
    Ok(Directional { receptor: Receptor::Head(head), indices: vec![index], absent: Vec::new(), goniogram: None })
}

fn planar(bench: &Bench<'_>) -> Result<Directional, SheetError> {
    let sensor = bench.sensor();
    let acceptance = &sensor.acceptance;
    let symmetric = !matches!(acceptance, Acceptance::Directional(table) if table.rotationally_symmetric().is_none());
    let azimuths = if symmetric { 1 } else { AZIMUTHS };
    let upper = LARGEST_ANGLE_DEG.to_radians();
    let spectrum = seen_by(&sensor.channels[0])?;
    let goniogram = bench.goniogram(0, &spectrum, upper, STEPS, azimuths)?;
    let mut computed = 0.0;
    for k in 0..azimuths {
        computed += f2(acceptance, TAU * f64::from(k) / f64::from(azimuths), upper)? / f64::from(azimuths);
    }
    let measured = measured_f2(&goniogram, upper)?;
    let planes = if symmetric { String::new() } else { format!(", mean of {azimuths} azimuths") };
    let f2 = Index {
        symbol: "f2",
        name: "directional response",
        unit: "%",
        computed: Figure::exact(computed, 1.0).scaled(PERCENT),
        measured: measured.scaled(PERCENT),
        stated_u: 0.0,
        limits: if is_lux_meter(bench) { limits("f2") } else { None },
        conditions: format!("ε up to {LARGEST_ANGLE_DEG}°{planes}"),
    };
    let along_normal = acceptance.at(1.0, 0.0, 0.0);
    let flat = |sr: f64| sr / PI - 1.0;
    let sampled = bench.flat_field_sr(0, &spectrum)?;
    let flat_field = Index {
        symbol: "f_flat",
        name: "reading of a uniform hemisphere",
        unit: "%",
        computed: Figure::exact(flat(acceptance.projected_solid_angle_sr() / along_normal), 1.0).scaled(PERCENT),
        measured: Figure { value: flat(sampled.value), standard_uncertainty: sampled.standard_uncertainty / PI }.scaled(PERCENT),
        stated_u: 0.0,
        limits: None,
        conditions: "∫ R cos θ dω / (π R(0)) − 1, by rays".to_owned(),
    };
    Ok(Directional { receptor: Receptor::Planar, indices: vec![f2, flat_field], absent: Vec::new(), goniogram: Some(goniogram) })
}

/// f2 of straight lines through the readings; the uncertainty is that between the angles and that of the readings.
fn measured_f2(goniogram: &Goniogram, upper: f64) -> Result<Figure, DirectionalError> {
    let theta = &goniogram.theta_rad;
    let planes = goniogram.phi_rad.len();
    let mut mean = Figure { value: 0.0, standard_uncertainty: 0.0 };
    for plane in 0..planes {
        let response = goniogram.response(plane);
        let values: Vec<f64> = response.iter().map(|figure| figure.value).collect();
        let straight = |of: &[f64], angle: f64| {
            let k = theta.partition_point(|node| *node <= angle).clamp(1, theta.len() - 1);
            of[k - 1] + (of[k] - of[k - 1]) * ((angle - theta[k - 1]) / (theta[k] - theta[k - 1]))
        };
        let value = f2_of_response(&|angle| straight(&values, angle), theta, upper)?;
        let errors = halving_error(theta, &values);
        // Trapezoids are enough for an uncertainty.
        let integral = |of: &dyn Fn(usize) -> f64| -> f64 {
            (1..theta.len())
                .map(|k| {
                    let at = |k: usize| of(k) * (2.0 * theta[k]).sin();
                    0.5 * (theta[k] - theta[k - 1]) * (at(k - 1) + at(k))
                })
                .sum()
        };
        let u = (integral(&|k| errors[k]) / 3f64.sqrt()).hypot(integral(&|k| response[k].standard_uncertainty));
        mean.value += value / planes as f64;
        // The planes share what errs in them.
        mean.standard_uncertainty += u / planes as f64;
    }
    Ok(mean)
}

fn field(bench: &Bench<'_>, receptor: Receptor, half_angle_rad: f64, probe: Probe) -> Result<Directional, SheetError> {
    let why = format!("the sensor sees {:.3}° about its axis and is not meant to follow the cosine", half_angle_rad.to_degrees());
    let mut absent = vec![Absent { symbol: "f2", why }];
    let spectrum = seen_by(&bench.sensor().channels[0])?;
    let reach = REACH * half_angle_rad;
    // An edge near 90° cannot be told from the horizon.
    if reach >= 0.99 * std::f64::consts::FRAC_PI_2 {
        absent.push(Absent { symbol: "α₅₀", why: "the cone is too wide for a beam to be led across its edge".to_owned() });
        return Ok(Directional { receptor, indices: Vec::new(), absent, goniogram: None });
    }
    let field = bench.field(0, &spectrum, reach, probe)?;
    let degree = 180.0 / PI;
    // Linear over a share of the radius in the plane of focus: 90 % and 10 % are 0.8 of it apart.
    let edge_rad = match &bench.sensor().acceptance {
        Acceptance::Spot(spot) => {
            [0.4, -0.4].map(|k| ((1.0 + k * spot.edge) * half_angle_rad.tan()).atan()).into_iter().fold(0.0, |a, b| (a - b).abs())
        }
        _ => 0.0,
    };
    let index = |symbol, name, unit, computed: Figure, measured: Figure, conditions: &str| Index {
        symbol,
        name,
        unit,
        computed,
        measured,
        stated_u: 0.0,
        limits: None,
        conditions: conditions.to_owned(),
    };
    let indices = vec![
        index(
            "α₅₀",
            "half-angle of the measuring field",
            "°",
            Figure::exact(half_angle_rad, half_angle_rad).scaled(degree),
            field.half_angle_rad.scaled(degree),
            "where the response falls to one half",
        ),
        index(
            "α₁₀ − α₉₀",
            "edge of the measuring field",
            "°",
            Figure::exact(edge_rad, half_angle_rad).scaled(degree),
            field.edge_rad.scaled(degree),
            "from 90 % to 10 % of the response",
        ),
        index(
            "f_s",
            "surrounding field",
            "%",
            Figure::exact(0.0, 1.0).scaled(PERCENT),
            field.surround.scaled(PERCENT),
            "bright screen with a black middle 1.1 times the field, over the screen without it",
        ),
    ];
    Ok(Directional { receptor, indices, absent, goniogram: None })
}
