//! Heads that see all round: what surrounds them uniformly, the mean over azimuth, motion, scale, samples.

use std::f64::consts::PI;

use etendue::estimate::Watch;
use etendue::math::DVec3;
use etendue::measurement::measure;
use etendue::plan::{Plan, PlanOptions};
use etendue::scene::scene_from_text;
use proptest::prelude::*;

use crate::bench::{METER, Uncertain, apart, assert_agree, at, exact, samples, uncertain};

const HEADS: [&str; 4] = ["Spherical", "Hemispherical", "Cylindrical", "Semicylindrical"];

/// A head of irradiance.
fn head(name: &str) -> String {
    format!(r#"Sensor(aperture: Point, acceptance: {name}, channels: [(name: "E", responsivity: 1, reads: Irradiance)])"#)
}

/// `∫ w dω` over all directions.
fn total(name: &str) -> f64 {
    if name == "Spherical" { 4.0 * PI } else { PI }
}

/// All four heads in one pose.
fn all_heads(sources: &str, place: DVec3, facing: DVec3, up: DVec3) -> String {
    let instruments: Vec<String> = HEADS
        .iter()
        .map(|name| format!(r#"(name: "{name}", sensor: {}, at: {}, facing: {}, up: {})"#, head(name), at(place), at(facing), at(up)))
        .collect();
    format!("Scene(sources: [{sources}], instruments: [{}])", instruments.join(", "))
}

fn vector(length: f64) -> impl Strategy<Value = DVec3> {
    (-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64)
        .prop_map(|(x, y, z)| DVec3::new(x, y, z))
        .prop_filter("no direction", |v| v.length() > 0.05)
        .prop_map(move |v| v * length)
}

/// Facing and up, well apart.
fn directions() -> impl Strategy<Value = (DVec3, DVec3)> {
    (vector(1.0), vector(1.0)).prop_filter("parallel", |(f, u)| f.normalize().cross(u.normalize()).length() > 0.05)
}

/// A flat panel, a disc, a ball and a lamp.
const SHAPES: [&str; 4] = ["Rectangle(1.5, 0.7)", "Disc(0.6)", "Sphere(0.4)", "Polygon"];

fn source(shape: &str, place: DVec3, facing: DVec3) -> String {
    let rest = "strength: Radiance(3), spectrum: Line(555)";
    match shape {
        "Polygon" => {
            let corners = [(-0.5, -0.5), (0.6, -0.4), (0.0, 0.0), (0.5, 0.7), (-0.6, 0.5)];
            let n = facing.normalize();
            let (x, y) = (n.any_orthonormal_vector(), n.cross(n.any_orthonormal_vector()));
            let corners: Vec<String> = corners.iter().map(|(a, b)| at(place + *a * x + *b * y)).collect();
            format!(r#"(name: "s", shape: Polygon([{}]), seen_from: Both, {rest})"#, corners.join(", "))
        }
        "Sphere(0.4)" => format!(r#"(name: "s", shape: {shape}, at: {}, {rest})"#, at(place)),
        _ => format!(r#"(name: "s", shape: {shape}, at: {}, facing: {}, {rest})"#, at(place), at(facing)),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// The six faces of a luminous box, the wall of a luminous sphere and the sky give all that there is, wherever the head is.
    #[test]
    fn what_surrounds_a_head_evenly_gives_its_total((facing, up) in directions(), place in vector(0.45), box_turned in vector(90.0)) {
        let turned = at(box_turned);
        let shine = "strength: Radiance(2), spectrum: Line(555)";
        for shape in [
            format!("shape: Box(size: (2.2, 1.8, 1.7)), turned_deg: {turned}, seen_from: Inside"),
            "shape: Sphere(1), seen_from: Inside".to_owned(),
            "shape: Environment".to_owned(),
        ] {
            let place = if shape.contains("Box") { place + middle(box_turned) } else { place };
            let text = all_heads(&format!(r#"(name: "s", {shape}, {shine})"#), place, facing, up);
            for (found, name) in exact(&text).into_iter().zip(HEADS) {
                prop_assert!(apart(found, 2.0 * total(name)) < 1e-10, "{} {} {}", shape, name, found / total(name));
            }
        }
    }

    /// N planes along the axis: of each direction the mean of max(0, cos) over N azimuths is within π²/(3 N²) of 1/π.
    #[test]
    fn the_mean_of_vertical_illuminances_is_the_cylindrical_one(place in vector(2.0), facing in vector(1.0), which in 0..4usize) {
        let n = 512;
        let s = source(SHAPES[which], place * 1.5, facing);
        let poses: Vec<String> = (0..n)
            .map(|k| 2.0 * PI * f64::from(k) / f64::from(n))
            .map(|phi| format!("(at: (0, 0, 0), facing: {})", at(DVec3::new(phi.cos(), phi.sin(), 0.0))))
            .collect();
        let planes = format!(
            r#"Scene(sources: [{s}], instruments: [(name: "planes", sensor: {METER}, list: [{}])])"#, poses.join(", ")
        );
        let cylinder = format!(
            r#"Scene(sources: [{s}], instruments: [(name: "c", sensor: {}, at: (0, 0, 0), facing: (0, 0, 1))])"#, head("Cylindrical")
        );
        let mean = exact(&planes).iter().sum::<f64>() / f64::from(n);
        let found = exact(&cylinder)[0];
        let allowed = 1.01 * PI * PI / (3.0 * f64::from(n * n));
        prop_assert!(apart(mean, found) <= allowed, "{} {} {}", s, mean, found);
    }

    #[test]
    fn heads_turn_and_grow_with_their_scene(
        place in vector(2.0), facing in vector(1.0), (towards, up) in directions(), axis in vector(1.0), angle in 0.0..6.0f64,
        k in -9.0..9.0f64, which in 0..4usize
    ) {
        let turn = |v: DVec3| {
            // Rodrigues' formula.
            let axis = axis.normalize();
            v * angle.cos() + axis.cross(v) * angle.sin() + axis * axis.dot(v) * (1.0 - angle.cos())
        };
        prop_assume!(place.length() > 0.7);
        let as_it_is = exact(&all_heads(&source(SHAPES[which], place, facing), DVec3::ZERO, towards, up));
        if which != 0 && which != 3 {
            // A disc and a ball are the same however they are turned about their normal.
            let turned = exact(&all_heads(&source(SHAPES[which], turn(place), turn(facing)), DVec3::ZERO, turn(towards), turn(up)));
            for ((a, b), name) in as_it_is.iter().zip(&turned).zip(HEADS) {
                prop_assert!(apart(*a, *b) < 1e-9, "{}: {} {}", name, a, b);
            }
        }
        // A lamp instead: inverse square.
        let lamp = |at_m: DVec3| format!(r#"(name: "s", shape: Point, at: {}, strength: WattsPerSteradian(3), spectrum: Line(555))"#, at(at_m));
        let s = 10f64.powf(k);
        let (near, far) = (exact(&all_heads(&lamp(place), DVec3::ZERO, towards, up)), exact(&all_heads(&lamp(place * s), DVec3::ZERO, towards, up)));
        for ((a, b), name) in near.iter().zip(&far).zip(HEADS) {
            prop_assert!(apart(*a, *b * s * s) < 1e-9, "{}: {} {}", name, a, b);
        }
        // Spherical: the sum over a plane receptor's two sides is never more.
        let both: f64 = exact(&format!(
            r#"Scene(sources: [{}], instruments: [(name: "a", sensor: {METER}, at: (0, 0, 0), facing: {}), (name: "b", sensor: {METER}, at: (0, 0, 0), facing: {})])"#,
            source(SHAPES[which], place, facing), at(towards), at(-towards)
        )).iter().sum();
        prop_assert!(both <= as_it_is[0] * (1.0 + 1e-12), "{} {}", both, as_it_is[0]);
    }

    /// A rectangle is the sum of its parts, and two sources are the sum of either.
    #[test]
    fn heads_add_up(place in vector(2.0), share in 0.05..0.95f64, (towards, up) in directions()) {
        prop_assume!(place.z.abs() > 0.05);
        let quad = |x0: f64, x1: f64| format!(
            r#"(name: "q{x0}", shape: Quad(corner: {}, u: {}, v: (0, 1.3, 0)), seen_from: Both, strength: Radiance(3), spectrum: Line(555))"#,
            at(place + DVec3::X * x0), at(DVec3::X * (x1 - x0))
        );
        let read = |sources: &str| exact(&all_heads(sources, DVec3::ZERO, towards, up));
        let whole = read(&quad(0.0, 1.0));
        let parts = read(&format!("{}, {}", quad(0.0, share), quad(share, 1.0)));
        for ((a, b), name) in whole.iter().zip(&parts).zip(HEADS) {
            prop_assert!(apart(*a, *b) < 1e-9, "{}: {} {}", name, a, b);
        }
    }
}

/// Where the middle of the box of the test above is: its corner is at its place.
fn middle(turned_deg: DVec3) -> DVec3 {
    let [(sx, cx), (sy, cy), (sz, cz)] = [turned_deg.x, turned_deg.y, turned_deg.z].map(|a| a.to_radians().sin_cos());
    let v = DVec3::new(1.1, 0.9, 0.85);
    let v = DVec3::new(v.x, cx * v.y - sx * v.z, sx * v.y + cx * v.z);
    let v = DVec3::new(cy * v.x + sy * v.z, v.y, cy * v.z - sy * v.x);
    DVec3::new(cz * v.x - sz * v.y, sz * v.x + cz * v.y, v.z)
}

/// Each head planned and naive, by the same number of samples.
fn planned_and_naive(law: &str, text: &str, number: u64) -> Vec<u64> {
    let scene = scene_from_text(text).unwrap_or_else(|problems| panic!("{problems}\n{text}"));
    let read = |naive: bool, seed: u64| {
        let plan = Plan::new(&scene, &PlanOptions { naive, ..PlanOptions::default() }).unwrap();
        measure(&scene, &plan, &samples(number), seed, &Watch { now: &|| 0.0, progress: &|_| {} }).unwrap().readings
    };
    let (planned, naive) = (read(false, 5), read(true, 6));
    for (p, n) in planned.iter().zip(&naive) {
        let [p, n] = [p, n].map(|r| Uncertain { value: r.value, u: r.standard_uncertainty() });
        assert_agree(law, n, p);
    }
    planned.iter().map(|r| r.samples).collect()
}

#[test]
fn formulas_and_samples_agree_at_heads() {
    let (towards, up) = (DVec3::new(0.3, -0.4, 0.8), DVec3::new(0.2, 1.0, 0.1));
    for shape in [
        "shape: Rectangle(2, 1), at: (0.5, 0, 1), facing: (0.1, 0, -1)",
        "shape: Disc(0.7), at: (0.5, 0, -1), facing: (0.1, 0, 1)",
        "shape: Annulus(0.3, 0.7), at: (0.5, 0, 1), facing: (0.1, 0, -1)",
        "shape: Sphere(0.7), at: (0.5, 0, -1)",
        "shape: Sphere(2), at: (0.5, 0, 1), seen_from: Inside",
        "shape: Box(size: (1, 1, 0.5)), at: (0, 0, 0.5), turned_deg: (10, 20, 30)",
        "shape: Polygon([(1, -1, -1), (1, 1, -1), (1, 1, 1), (1, 0, 0.25), (1, -1, 1)]), seen_from: Both",
    ] {
        let text = all_heads(&format!(r#"(name: "s", {shape}, strength: Radiance(3), spectrum: Line(555))"#), DVec3::ZERO, towards, up);
        let taken = planned_and_naive(shape, &text, 1 << 14);
        assert!(taken.iter().all(|&n| n == 0), "{shape}: {taken:?} samples instead of a formula");
    }
}

/// What stands below a plane receptor hides and reflects.
#[test]
fn planned_and_naive_readings_of_heads_in_a_room_agree() {
    let instruments: Vec<String> = HEADS
        .iter()
        .map(|name| format!(r#"(name: "{name}", sensor: {}, at: (-0.25, 0.5, 1), facing: (0.2, -0.1, 1), up: (0, 1, 0))"#, head(name)))
        .collect();
    let text = format!(
        r#"Scene(
            surfaces: {{ "paint": Lambertian(0.4) }},
            objects: [
                (name: "walls", shape: Box(size: (2, 3, 2.5)), at: (-1, -1.5, 0), surface: "paint", seen_from: Inside),
                (name: "plate", shape: Disc(0.3), at: (0, 0.25, 0.5), facing: (0.1, 0.2, 1), surface: "paint"),
            ],
            sources: [
                (name: "panel", shape: Rectangle(0.5, 0.75), at: (0, 0.25, 2.25), facing: (0, 0, -1), strength: Radiance(1), spectrum: Line(555)),
                (name: "below", shape: Disc(0.3), at: (0.2, 0, 0.1), facing: (0, 0, 1), strength: Radiance(1), spectrum: Line(555)),
                (name: "lamp", shape: Point, at: (0.5, -0.75, 0.75), strength: WattsPerSteradian(0.1), spectrum: Line(555)),
            ],
            instruments: [{}],
        )"#,
        instruments.join(", ")
    );
    planned_and_naive("room", &text, 1 << 14);
}

/// A black floor takes away half of the sky: 2π L of a sphere, and of the others half of what they weigh about the horizontal plane.
#[test]
fn a_black_floor_takes_half_the_sky() {
    let sky = r#"(name: "sky", shape: Environment, strength: Radiance(1), spectrum: Line(555))"#;
    let wide = 1e4;
    let text = all_heads(sky, DVec3::new(0.0, 0.0, 0.5), DVec3::Z, DVec3::Y)
        .replace("Scene(", &format!(r#"Scene(objects: [(name: "floor", shape: Disc({wide}), surface: Black)], "#));
    // Spherical 2π; hemispherical (2π + π)/4; cylindrical π/2; semicylindrical (π²/2 + π)/π for a front that looks up.
    let expected = [2.0 * PI, 0.75 * PI, 0.5 * PI, 0.5 * PI + 1.0];
    for ((found, expected), name) in uncertain(&text, &samples(1 << 14), 7).into_iter().zip(expected).zip(HEADS) {
        assert_agree(name, found, Uncertain::exactly(expected));
    }
}

/// Over a floor of reflectance ρ under a uniform sky, the lower half of the directions shows ρ L.
#[test]
fn a_floor_that_reflects_gives_its_share_back() {
    let (rho, sky) = (0.3, r#"(name: "sky", shape: Environment, strength: Radiance(1), spectrum: Line(555))"#);
    let text = all_heads(sky, DVec3::new(0.0, 0.0, 0.5), DVec3::X, DVec3::Z).replace(
        "Scene(",
        &format!(r#"Scene(surfaces: {{ "floor": Lambertian({rho}) }}, objects: [(name: "floor", shape: Disc(10000), surface: "floor")], "#),
    );
    // Facing along the floor, every head weighs both halves alike.
    for (found, name) in uncertain(&text, &samples(1 << 14), 7).into_iter().zip(HEADS) {
        assert_agree(name, found, Uncertain::exactly(0.5 * total(name) * (1.0 + rho)));
    }
}
