//! What the checks let pass and what they do not.

use crate::scene::{Diagnostics, Scene, scene_from_text};

/// A scene with a meter at (0.3, 0, 0) that looks along z, and what else is given.
fn scene(surfaces: &str, objects: &str, sources: &str) -> Result<Scene, Diagnostics> {
    scene_with("Point", surfaces, objects, sources)
}

fn scene_with(aperture: &str, surfaces: &str, objects: &str, sources: &str) -> Result<Scene, Diagnostics> {
    let acceptance = r#"acceptance: Cosine, channels: [(name: "E", responsivity: 1, reads: Irradiance)])"#;
    scene_from_text(&format!(
        "Scene(surfaces: {{ {surfaces} }}, objects: [{objects}], sources: [{sources}],
        instruments: [(name: \"meter\", sensor: Sensor(aperture: {aperture}, {acceptance}, at: (0.3, 0, 0), facing: (0, 0, 1))])"
    ))
}

fn refused(result: Result<Scene, Diagnostics>, part: &str) -> bool {
    match result {
        Ok(_) => false,
        Err(problems) => {
            assert!(problems.0.len() == 1 && problems.0[0].message.contains(part), "{problems}");
            true
        }
    }
}

const LAMP: &str = r#"(name: "lamp", shape: Point, at: (0, 0, 1), strength: Watts(1), spectrum: Line(550))"#;

#[test]
fn a_perfect_container_is_refused_only_if_nothing_in_it_absorbs() {
    let perfect = r#""perfect": Lambertian(1), "green": Lambertian(Band(from_nm: 500, to_nm: 600)), "grey": Lambertian(0.5)"#;
    let refused = |objects: &str, source: &str| refused(scene(perfect, objects, source), "no finite value");
    let sphere = r#"(name: "sphere", shape: Sphere(2), seen_from: Inside, surface: "perfect")"#;
    let room = r#"(name: "room", shape: Box(size: (4, 4, 4)), at: (-2, -2, -2), turned_deg: (0, 0, 0), surface: "perfect")"#;
    assert!(refused(sphere, LAMP));
    assert!(refused(room, LAMP));
    assert!(refused(&sphere.replace("perfect", "green"), LAMP), "a line in the band where all is reflected");
    assert!(refused(&format!(r#"{sphere}, (name: "plate", shape: Disc(0.2), at: (0, 1, 0), surface: "perfect")"#), LAMP));
    assert!(refused(&format!(r#"{sphere}, (name: "far away", shape: Disc(0.2), at: (0, 9, 0), surface: "grey")"#), LAMP));
    assert!(refused(&format!(r#"{sphere}, (name: "around", shape: Sphere(5), surface: "grey")"#), LAMP));
    assert!(refused(sphere, r#"(name: "lamp", shape: Disc(0.1), at: (0, 0, 1), surface: "perfect", strength: Watts(1), spectrum: "A")"#));
    assert!(refused("", r#"(name: "lamp", shape: Sphere(2), seen_from: Inside, surface: "perfect", strength: Watts(1), spectrum: "A")"#));
    // Something absorbs, or no light gets in.
    assert!(!refused(&sphere.replace("\"perfect\"", "\"grey\""), LAMP));
    assert!(!refused(&sphere.replace("perfect", "green"), &LAMP.replace("550", "650")));
    assert!(!refused(&sphere.replace("Inside", "Outside"), LAMP));
    assert!(!refused(&format!(r#"{sphere}, (name: "plate", shape: Disc(0.2), at: (0, 1, 0), surface: "grey")"#), LAMP));
    assert!(!refused(&format!(r#"{sphere}, (name: "plate", shape: Rectangle(9, 9), at: (0, 1, -1), surface: "grey")"#), LAMP));
    assert!(!refused(
        &format!(r#"{sphere}, (name: "ball", shape: Sphere(0.2), at: (0, 1, 0), seen_from: Inside, surface: "perfect")"#),
        LAMP
    ));
    assert!(!refused(sphere, &LAMP.replace("(0, 0, 1)", "(0, 0, 3)")));
    assert!(!refused(sphere, r#"(name: "lamp", shape: Disc(0.1), at: (0, 0, 1), strength: Watts(1), spectrum: "A")"#));
    assert!(!refused(sphere, r#"(name: "sky", shape: Environment, strength: Radiance(1), spectrum: "A")"#));
}

#[test]
fn emitters_are_refused_only_if_they_overlap_on_the_same_side() {
    let two = |first: &str, second: &str| {
        let source = |name: &str, rest: &str| format!(r#"(name: "{name}", {rest}, strength: Watts(1), spectrum: "A")"#);
        refused(scene("", "", &format!("{}, {}", source("one", first), source("two", second))), "emit from the same surface")
    };
    let panel = "shape: Rectangle(2, 1), at: (0, 0, 3), facing: (0, 0, -1)";
    assert!(two(panel, panel));
    assert!(two(panel, "shape: Rectangle(2, 1), at: (1.2, 0.7, 3), facing: (0, 0, -1), up: (1, 1, 0)"));
    assert!(two(panel, "shape: Disc(0.5), at: (1.4, 0, 3), facing: (0, 0, -1)"));
    assert!(two("shape: Disc(0.5), at: (0, 0, 3)", "shape: Disc(0.5), at: (0.9, 0, 3)"));
    assert!(two("shape: Sphere(1), at: (0, 0, 3)", "shape: Sphere(1), at: (0, 0, 3), seen_from: Both"));
    assert!(two("shape: Box(size: (1, 1, 1)), at: (1, 1, 1)", "shape: Rectangle(1, 1), at: (1.5, 1.5, 2)"));
    let arrow = |x: f64| format!("shape: Polygon([({}, 1, 3), ({}, 0, 3), ({}, -1, 3), ({x}, 0, 3)])", x - 1.0, x + 1.0, x - 1.0);
    assert!(two(panel, &arrow(1.0)));
    assert!(two(&arrow(0.0), &arrow(0.5)));
    assert!(two("shape: Disc(0.5), at: (0.4, 0, 3), facing: (0, 0, -1)", &arrow(0.0)));
    assert!(!two(panel, &arrow(2.0)), "only the ends of the arrow are beside the panel");
    assert!(!two(&arrow(0.0), &arrow(1.0)), "the tip of the one is in the notch of the other");
    assert!(!two("shape: Disc(0.5), at: (-0.8, 0, 3), facing: (0, 0, -1)", &arrow(0.0)), "it is in the notch");
    assert!(!two(panel, "shape: Polygon([(-1, -1, 3), (1, -1, 3), (0, 1, 3)])"), "back to back");
    assert!(!two(panel, "shape: Rectangle(2, 1), at: (2, 0, 3), facing: (0, 0, -1)"), "they touch");
    assert!(!two(panel, "shape: Rectangle(2, 1), at: (0, 0, 3), facing: (0, 0, 1)"), "back to back");
    assert!(!two(panel, "shape: Rectangle(2, 1), at: (0, 0, 3.001), facing: (0, 0, -1)"), "one above the other");
    assert!(!two(panel, "shape: Rectangle(2, 1), at: (0, 0, 3), facing: (0, 1, -9)"), "they cross");
    assert!(!two(panel, "shape: Disc(0.5), at: (1.5, 0, 3), facing: (0, 0, -1)"), "they touch");
    assert!(!two(panel, "shape: Disc(0.5), at: (1.4, 0.9, 3), facing: (0, 0, -1)"), "the corner is out of reach");
    assert!(!two("shape: Sphere(1), at: (0, 0, 3)", "shape: Sphere(1.5), at: (0, 0, 3)"));
}

#[test]
fn a_sensor_on_an_emitter_is_refused_only_if_it_looks_into_it() {
    let on = |rest: &str| refused(scene("", "", &format!(r#"(name: "lamp", {rest}, strength: Watts(1), spectrum: "A")"#)), "looks into it");
    assert!(on("shape: Rectangle(2, 1), facing: (0, 0, -1)"));
    assert!(on("shape: Rectangle(2, 1), facing: (0, 0, 1), seen_from: Inside"));
    assert!(on("shape: Disc(1), facing: (0, 1, -1)"));
    assert!(on("shape: Polygon([(0, 1, 0), (1, -1, 0), (-1, -1, 0)])"));
    assert!(on("shape: Sphere(1), at: (0.3, 0, 1)"));
    assert!(on("shape: Sphere(1), at: (0.3, 0, -1), seen_from: Inside"));
    assert!(!on("shape: Rectangle(2, 1), facing: (0, 0, 1)"), "the sensor looks the other way");
    assert!(!on("shape: Rectangle(2, 1), at: (0, 0, 0.001), facing: (0, 0, -1)"), "there is a gap");
    assert!(!on("shape: Rectangle(0.5, 1), facing: (0, 0, -1)"), "it is beside it");
    assert!(!on("shape: Disc(0.2), facing: (0, 0, -1)"), "it is beside it");
    assert!(!on("shape: Polygon([(0, 1, 0), (0.2, -1, 0), (-1, -1, 0)])"), "it is beside it");
    assert!(!on("shape: Polygon([(-1, -1, 0), (1, -1, 0), (0, 1, 0)])"), "the sensor looks the other way");
    assert!(!on("shape: Sphere(1), at: (0.3, 0, 1), seen_from: Inside"), "the outside does not emit");
}

#[test]
fn an_aperture_that_lies_on_a_part_of_an_emitter_is_refused() {
    let lamp = |x: f64| {
        format!(r#"(name: "lamp", shape: Rectangle(2, 1), at: ({x}, 0, 0), facing: (0, 0, -1), strength: Watts(1), spectrum: "A")"#)
    };
    let with = |aperture: &str, x: f64| refused(scene_with(aperture, "", "", &lamp(x)), "looks into it");
    for aperture in ["Rectangle(width_m: 0.2, height_m: 0.2)", "Disc(radius_m: 0.1)"] {
        assert!(with(aperture, 1.39), "{aperture}");
        assert!(!with(aperture, 1.4), "{aperture} touches");
    }
    assert!(!with("Point", 1.39));
}
