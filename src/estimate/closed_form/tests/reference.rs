//! The public reference cases of uniform sources, at their own tolerances.

use super::super::polygon_in_cone::polygon_in_cone;
use super::super::{cone, disc, exchange, point, polygon, sphere};
use crate::math::DVec3;
use serde_json::Value;
use std::f64::consts::PI;

struct Case(Value);

impl Case {
    fn id(&self) -> &str {
        self.0["id"].as_str().unwrap()
    }

    fn number(&self, name: &str) -> f64 {
        decimal(&self.0["inputs"][name])
    }

    fn radians(&self, name: &str) -> f64 {
        self.number(name).to_radians()
    }

    fn vector(&self, name: &str) -> DVec3 {
        vector(&self.0["inputs"][name])
    }

    fn vectors(&self, name: &str) -> Vec<DVec3> {
        self.0["inputs"][name].as_array().unwrap().iter().map(vector).collect()
    }

    fn check(&self, value: f64) {
        let reference = decimal(&self.0["reference"]);
        let tolerance = (self.0["rel_tol"].as_f64().unwrap() * reference.abs()).max(self.0["abs_tol"].as_f64().unwrap_or(0.0));
        let deviation = (value - reference).abs();
        assert!(deviation <= tolerance, "{}: {value:e} instead of {reference:e}, relative {:e}", self.id(), deviation / reference);
    }
}

fn decimal(value: &Value) -> f64 {
    value.as_str().unwrap().parse().unwrap()
}

fn vector(value: &Value) -> DVec3 {
    DVec3::new(decimal(&value[0]), decimal(&value[1]), decimal(&value[2]))
}

/// Cases whose id starts with `prefix`; a prefix without cases is a mistake of the test.
fn cases(prefix: &str) -> Vec<Case> {
    let files =
        [include_str!("../../../study/verify/cases/g1_radiometry.json"), include_str!("../../../study/verify/cases/g4_extreme.json")];
    let found: Vec<Case> = files
        .iter()
        .flat_map(|text| serde_json::from_str::<Value>(text).unwrap()["cases"].as_array().unwrap().clone())
        .map(Case)
        .filter(|case| case.id().starts_with(prefix))
        .collect();
    assert!(!found.is_empty(), "no case {prefix}");
    found
}

#[test]
fn cones_of_acceptance() {
    for case in cases("g1a.cone-omega") {
        case.check(cone::solid_angle(case.radians("half_angle_deg")));
    }
    for prefix in ["g1a.cone-E", "g4c.tiny-accept"] {
        for case in cases(prefix) {
            case.check(case.number("L") * cone::projected_solid_angle(case.radians("half_angle_deg")));
        }
    }
    for case in cases("g4d.area") {
        case.check(case.number("A_m2") * case.number("L") * cone::projected_solid_angle(case.radians("half_angle_deg")));
    }
    for case in cases("g1a.tilted-cone") {
        case.check(case.number("L") * cone::tilted_projected_solid_angle(case.radians("half_angle_deg"), case.radians("tilt_deg")));
    }
}

#[test]
fn point_sources() {
    for case in cases("g1b.point-E") {
        let source = case.vector("source") - case.vector("sensor");
        case.check(case.number("I") * point::irradiance_factor(source, case.vector("normal_unnormalised")));
    }
    for prefix in ["g1b.point-disc-flux", "g4d.near-point"] {
        for case in cases(prefix) {
            case.check(case.number("I") * point::disc_solid_angle(case.number("R_m"), case.number("h_m"), 0.0));
        }
    }
    for case in cases("g1b.point-rect-flux") {
        // a and b are full sides, h the distance of the point.
        let (a, b, h) = (case.number("a_m"), case.number("b_m"), case.number("h_m"));
        let corner = DVec3::new(-0.5 * a, -0.5 * b, h);
        case.check(case.number("I") * point::parallelogram_solid_angle(corner, DVec3::X * a, DVec3::Y * b));
    }
    for case in cases("g4c.grazing-").into_iter().filter(|case| !case.id().contains("disc")) {
        let (sin, cos) = case.radians("t_deg").sin_cos();
        let source = DVec3::new(sin, 0.0, cos) * case.number("r_m");
        case.check(case.number("I") * point::irradiance_factor(source, DVec3::Z));
    }
}

#[test]
fn disc_sources() {
    for prefix in ["g1c.disc-par", "g4c.grazing-disc"] {
        for case in cases(prefix) {
            let (height, lateral) = (case.number("H_m"), case.number("lateral_m"));
            case.check(case.number("L") * disc::parallel_disc(height, lateral, case.number("R_m")));
        }
    }
    for prefix in ["g1c.disc-tilt", "g1c.disc-cut"] {
        for case in cases(prefix) {
            let (sin, cos) = case.radians("t_deg").sin_cos();
            let centre = case.vector("disc_centre_m") - case.vector("sensor");
            let normal = DVec3::new(sin, 0.0, cos);
            case.check(case.number("L") * disc::disc(centre, case.vector("disc_normal"), case.number("R_m"), normal));
        }
    }
    for case in cases("g4a.scale-disc") {
        let s = case.number("scale_s_m");
        case.check(case.number("L") * disc::disc(DVec3::new(0.25 * s, 0.0, s), -DVec3::Z, 0.5 * s, DVec3::Z));
    }
}

#[test]
fn polygon_sources() {
    for case in cases("g1d.rect-par") {
        let (a, b, d) = (case.number("a_m"), case.number("b_m"), case.number("d_m"));
        let corners = [(0.0, 0.0), (a, 0.0), (a, b), (0.0, b)].map(|(x, y)| DVec3::new(x, y, d));
        case.check(case.number("L") * polygon::polygon_two_sided(&corners, DVec3::Z));
    }
    for case in cases("g1d.rect-perp") {
        let (a, b, d) = (case.number("a_m"), case.number("b_m"), case.number("d_m"));
        let corners = [(0.0, 0.0), (a, 0.0), (a, b), (0.0, b)].map(|(x, z)| DVec3::new(x, d, z));
        case.check(case.number("L") * polygon::polygon_two_sided(&corners, DVec3::Z));
    }
    for case in cases("g1d.area-luminaire") {
        let sensor = case.vector("sensor");
        let corners = [(-0.5, -0.5), (-0.5, 0.5), (0.5, 0.5), (0.5, -0.5)].map(|(x, y)| DVec3::new(x, y, 3.0) - sensor);
        case.check(case.number("M") / PI * polygon::polygon(&corners, case.vector("normal")));
    }
    for (prefix, normal) in [("g1i.polygon", "normal_unnormalised"), ("g4g.sliver", "normal")] {
        for case in cases(prefix) {
            let sensor = case.vector("sensor");
            let corners: Vec<DVec3> = case.vectors("vertices").into_iter().map(|v| v - sensor).collect();
            case.check(case.number("L") * polygon::polygon_two_sided(&corners, case.vector(normal)));
        }
    }
    for case in cases("g4a.scale-tri") {
        let s = case.number("scale");
        let corners: Vec<DVec3> = case.vectors("vertices_times_scale").into_iter().map(|v| v * s).collect();
        case.check(polygon::polygon_two_sided(&corners, case.vector("normal_unnormalised")));
    }
    for case in cases("g4b.offset") {
        let (offset, sensor) = (DVec3::splat(case.number("offset_each_axis_m")), case.vector("sensor"));
        let corners: Vec<DVec3> = case.vectors("vertices_before_offset").into_iter().map(|v| (v + offset) - sensor).collect();
        case.check(polygon::polygon_two_sided(&corners, case.vector("normal_unnormalised")));
    }
}

#[test]
fn a_closed_octahedron_gives_pi() {
    for case in cases("g1i.closed-octahedron") {
        let sensor = case.vector("sensor");
        let mut sum = 0.0;
        for octant in 0..8 {
            let sign = |bit: u32| if octant >> bit & 1 == 1 { -1.0 } else { 1.0 };
            let corners = [DVec3::X * sign(0), DVec3::Y * sign(1), DVec3::Z * sign(2)].map(|v| v - sensor);
            sum += polygon::polygon_two_sided(&corners, case.vector("normal_unnormalised"));
        }
        case.check(case.number("L") * sum);
    }
}

#[test]
fn sphere_sources() {
    for prefix in ["g1e.sphere", "g4c.touching-sphere"] {
        for case in cases(prefix) {
            let (sin, cos) = case.radians("t_deg").sin_cos();
            let centre = DVec3::new(sin, 0.0, cos) * case.number("d_m");
            let value = case.number("L") * sphere::sphere(centre, case.number("R_m"), DVec3::Z);
            case.check(value);
        }
    }
    for case in cases("g4c.tiny-source") {
        let half_angle = 2.0 * (case.number("solid_angle_sr") / (4.0 * PI)).sqrt().asin();
        case.check(case.number("L") * sphere::cap(half_angle, case.radians("t_deg")));
    }
}

#[test]
fn luminance_meters() {
    for case in cases("g1g.edge-target") {
        let (beta, p) = (case.radians("b_deg"), case.radians("p_deg"));
        let whole = cone::projected_solid_angle(beta);
        // Bright where the direction is beyond the edge, x cos p > z sin p.
        case.check(cone::half_space_in_cone(DVec3::new(p.cos(), 0.0, -p.sin()), DVec3::Z, beta) / whole);
        // The same with a rectangle that overfills the field.
        let corners = [(p.tan(), -10.0), (10.0, -10.0), (10.0, 10.0), (p.tan(), 10.0)].map(|(x, y)| DVec3::new(x, y, 1.0));
        case.check(polygon_in_cone(&corners, DVec3::Z, beta) / whole);
    }
    for case in cases("g1g.disc-target") {
        let (beta, target) = (case.radians("b_deg"), case.radians("target_half_angle_deg"));
        let seen = disc::disc_in_cone(DVec3::Z, -DVec3::Z, target.tan(), DVec3::Z, beta);
        case.check(case.number("L") * seen / cone::projected_solid_angle(beta));
        let seen = sphere::cap_in_cone(target, 0.0, beta);
        case.check(case.number("L") * seen / cone::projected_solid_angle(beta));
    }
    for case in cases("g1g.offset-disc") {
        let beta = case.radians("b_deg");
        let centre = DVec3::new(case.number("shift_m"), 0.0, case.number("distance_m"));
        let seen = disc::disc_in_cone(centre, -DVec3::Z, case.number("R_m"), DVec3::Z, beta);
        case.check(seen / cone::projected_solid_angle(beta));
    }
}

#[test]
fn pairs_of_surfaces() {
    for case in cases("g1f.coax-discs") {
        let etendue = exchange::coaxial_discs(case.number("R1_m"), case.number("R2_m"), case.number("H_m"));
        case.check(case.number("L") * etendue);
    }
    for case in cases("g1f.par-rects") {
        let (a, b, c) = (case.number("a_m"), case.number("b_m"), case.number("c_m"));
        let rectangle = |z: f64| [(0.0, 0.0), (a, 0.0), (a, b), (0.0, b)].map(|(x, y)| DVec3::new(x, y, z));
        let etendue = exchange::polygons(&rectangle(0.0), &rectangle(c), 1e-10).unwrap();
        case.check(etendue.value / (PI * a * b));
    }
    for case in cases("g1f.perp-rects") {
        let (w, h, l) = (case.number("W_m"), case.number("H_m"), case.number("L_m"));
        let floor = [(0.0, 0.0), (w, 0.0), (w, l), (0.0, l)].map(|(x, y)| DVec3::new(x, y, 0.0));
        let wall = [(0.0, 0.0), (h, 0.0), (h, l), (0.0, l)].map(|(z, y)| DVec3::new(0.0, y, z));
        let etendue = exchange::polygons(&floor, &wall, 1e-10).unwrap();
        case.check(etendue.value / (PI * w * l));
    }
}
