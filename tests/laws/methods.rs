//! Methods: the formula that a plan chooses and the samples of the naive plan are two routes to the same reading, for every shape.

use etendue::estimate::Watch;
use etendue::measurement::measure;
use etendue::plan::{Plan, PlanOptions};
use etendue::scene::{MemoryFiles, Scene, read_scene};

use crate::bench::{METER, Uncertain, assert_agree, samples};

/// An L of two rectangles in one plane, a tent of two triangles, and a room without a lid.
const L_SHAPE: &str = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4\nf 1 4 5 6\n";
const TENT: &str = "v -1 0 1\nv 1 0 1\nv 0 1 1\nv 0 -1 0.5\nf 1 2 3\nf 2 1 4\n";
const TUB: &str =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nf 1 2 3 4\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";
/// A plate high above a smaller one: one hides the other from some places.
const TWO_PLATES: &str =
    "v -1 -1 1\nv -1 1 1\nv 1 1 1\nv 1 -1 1\nv -0.3 -0.3 0.5\nv -0.3 0.3 0.5\nv 0.3 0.3 0.5\nv 0.3 -0.3 0.5\nf 1 2 3 4\nf 5 6 7 8\n";

fn scene(source: &str) -> Scene {
    let text = format!(
        r#"Scene(sources: [(name: "s", {source}, strength: Radiance(3), spectrum: Line(555))],
            instruments: [(name: "m", sensor: {METER}, at: (0.1, -0.2, 0), facing: (0.3, 0.2, 1))])"#
    );
    let files = [("l.obj", L_SHAPE), ("tent.obj", TENT), ("tub.obj", TUB), ("plates.obj", TWO_PLATES)];
    let files = files.into_iter().fold(MemoryFiles::new().with("s.ron", text), |files, (name, mesh)| files.with(name, mesh));
    read_scene("s.ron", &files, None).unwrap_or_else(|problems| panic!("{problems}"))
}

/// The reading of a plan, and how many samples it took.
fn read(scene: &Scene, naive: bool) -> (Uncertain, u64) {
    let plan = Plan::new(scene, &PlanOptions { naive, ..PlanOptions::default() }).unwrap();
    let found = measure(scene, &plan, &samples(1 << 14), 3, &Watch { now: &|| 0.0, progress: &|_| {} }).unwrap();
    (Uncertain { value: found.readings[0].value, u: found.readings[0].standard_uncertainty() }, found.counters.samples)
}

#[test]
fn formulas_and_samples_agree_for_every_shape() {
    let shapes = [
        "shape: Rectangle(2, 1), at: (0.5, 0, 1), facing: (0.1, 0, -1)",
        "shape: Disc(0.7), at: (0.5, 0, 1), facing: (0.1, 0, -1)",
        "shape: Annulus(0.3, 0.7), at: (0.5, 0, 1), facing: (0.1, 0, -1)",
        "shape: Sphere(0.7), at: (0.5, 0, 1)",
        "shape: Sphere(2), at: (0.5, 0, 1), seen_from: Inside",
        "shape: Box(size: (1, 1, 0.5)), at: (0, 0, 0.5), turned_deg: (10, 20, 30)",
        // Part of it is below the horizon, and one corner is re-entrant.
        "shape: Polygon([(-1, -1, 1), (1, -1, 1), (0, 0, 1), (1, 1, 1), (-1, 1, 1)]), seen_from: Both",
        "shape: Polygon([(1, -1, -1), (1, 1, -1), (1, 1, 1), (1, 0, 0.25), (1, -1, 1)]), seen_from: Both",
        // Meshes: in one plane; a convex dent seen from inside; a room that has the meter in it.
        "shape: Mesh(\"l.obj\"), at: (-0.5, -0.5, 1), seen_from: Both",
        "shape: Mesh(\"tent.obj\"), seen_from: Both",
        "shape: Mesh(\"tub.obj\"), at: (-0.5, -0.6, -0.5), seen_from: Both",
    ];
    for shape in shapes {
        let scene = scene(shape);
        let ((planned, none), (naive, some)) = (read(&scene, false), read(&scene, true));
        assert!(none == 0 && some > 0, "{shape}: {none} samples instead of a formula");
        assert_agree(shape, naive, planned);
    }
}

#[test]
fn a_mesh_that_hides_a_part_of_itself_is_sampled() {
    let plates = scene("shape: Mesh(\"plates.obj\")");
    let ((planned, some), (naive, _)) = (read(&plates, false), read(&plates, true));
    assert!(some > 0);
    assert_agree("plates one above the other", naive, planned);
    // Each plate alone shows all of itself; together the lower one hides a part of the upper one.
    let plate = |shape: &str| read(&scene(&format!("shape: {shape}, facing: (0, 0, -1)")), false).0.value;
    let without_shadow = plate("Rectangle(2, 2), at: (0, 0, 1)") + plate("Rectangle(0.6, 0.6), at: (0, 0, 0.5)");
    assert!(planned.value < 0.95 * without_shadow, "{planned:?} {without_shadow}");
}

#[test]
fn what_a_polygon_hides_is_what_its_triangles_hide() {
    let kite = [(-0.5, 0.0), (0.0, -0.25), (0.5, 0.0), (0.0, -0.1)];
    let lamp =
        r#"(name: "sky panel", shape: Rectangle(3, 3), at: (0, 0, 2), facing: (0, 0, -1), strength: Radiance(3), spectrum: Line(555))"#;
    let polygon: Vec<String> = kite.iter().map(|(x, y)| format!("({x}, {y}, 0.5)")).collect();
    let obj: String = kite.iter().map(|(x, y)| format!("v {x} {y} 0.5\n")).collect::<String>() + "f 1 2 4\nf 2 3 4\n";
    let read = |shape: &str, seed: u64| {
        let text = format!(
            r#"Scene(objects: [(name: "kite", shape: {shape}, surface: Black)], sources: [{lamp}],
                instruments: [(name: "m", sensor: {METER}, at: (0, -0.1, 0), facing: (0, 0, 1))])"#
        );
        let scene = read_scene("s.ron", &MemoryFiles::new().with("s.ron", text).with("kite.obj", obj.as_str()), None)
            .unwrap_or_else(|p| panic!("{p}"));
        let plan = Plan::new(&scene, &PlanOptions::default()).unwrap();
        let found = measure(&scene, &plan, &samples(1 << 15), seed, &Watch { now: &|| 0.0, progress: &|_| {} }).unwrap();
        Uncertain { value: found.readings[0].value, u: found.readings[0].standard_uncertainty() }
    };
    assert_agree("shadow of a kite", read(&format!("Polygon([{}])", polygon.join(", ")), 1), read("Mesh(\"kite.obj\")", 2));
}
