//! Cases g4h: what must happen where there is no number to compare with. One test a case, and one for its neighbours.

use std::f64::consts::PI;

use etendue::estimate::{EstimateError, Stop, Watch};
use etendue::measurement::Reading;
use etendue::measurement::measure;
use etendue::plan::{Plan, PlanOptions};
use etendue::scene::{MemoryFiles, Scene, read_scene, scene_from_text};
use etendue::sensor::Acceptance;
use etendue::spectrum::Density;
use etendue::study::verify::bench::{self, System, measured};
use etendue::study::verify::families::radiometry;

const UP: [f64; 3] = [0.0, 0.0, 1.0];
const METER: &str = "Sensor(aperture: Point, acceptance: Cosine, channels: [(name: \"E\", responsivity: 1, reads: Irradiance)])";

fn scene(sources: &[String], sensor: &str, place: [f64; 3], facing: [f64; 3]) -> Scene {
    bench::scene(sources, sensor, place, facing).unwrap()
}

/// The reading of a scene that needs neither rays nor samples.
fn exact(scene: &Scene) -> Reading {
    bench::exact(scene).unwrap()
}

fn read_up(sources: &[String], sensor: &str) -> f64 {
    bench::read_up(sources, sensor).unwrap().value
}

fn polygon_seen(corners: &[[f64; 3]], l: f64, sensor: [f64; 3], normal: [f64; 3]) -> f64 {
    radiometry::polygon_seen(corners, l, sensor, normal).unwrap().value
}

fn radiance(l: f64) -> String {
    System::Radiant.radiance(l)
}

fn read_up_of(shape: &str, l: f64) -> f64 {
    read_up(&[format!("shape: {shape}, {}", radiance(l))], METER)
}

/// A scene with a meter at the origin that faces +z.
fn text(rest: &str) -> String {
    format!("Scene({rest}, instruments: [(name: \"meter\", sensor: {METER}, at: (0, 0, 0), facing: (0, 0, 1))])")
}

fn refusal(text: &str) -> String {
    match scene_from_text(text) {
        Ok(_) => panic!("was read without a problem: {text}"),
        Err(problems) => problems.to_string(),
    }
}

fn refused(rest: &str, part: &str) {
    let message = refusal(&text(rest));
    assert!(message.contains(part), "`{part}` is not in:\n{message}");
}

/// Zero with nothing in doubt, and without a ray.
fn assert_dark(scene: &Scene) {
    let reading = exact(scene);
    assert_eq!((reading.value, reading.standard_uncertainty()), (0.0, 0.0));
    assert!(reading.notes.iter().any(|note| note.starts_with("reads zero")), "{:?}", reading.notes);
}

#[test]
fn zero_area_triangles_contribute_nothing() {
    // Identical corners, one of them at the sensor; corners on one line; two corners alike: a polygon says so.
    for corners in
        ["(0, 0, 0), (0, 0, 0), (0, 0, 0)", "(0.1, 0.1, 0.7), (0.2, 0.2, 0.7), (0.3, 0.3, 0.7)", "(0, 0, 1), (0, 0, 1), (1, 0, 1)"]
    {
        refused(&format!("sources: [(name: \"a\", shape: Polygon([{corners}]), {})]", radiance(1.0)), "no area");
    }
    // In a mesh they are left out, and what remains reads as without them.
    let read = |faces: &str| {
        let obj = format!("v 0 0 0\nv 1 0 1\nv 0 1 1\nv -1 -1 1\nv 2 0 1\nv 3 0 1\nf 4 3 2\n{faces}");
        let scene = text(&format!("sources: [(name: \"mesh\", shape: Mesh(\"m.obj\"), {})]", radiance(1.0)));
        exact(&read_scene("s.ron", &MemoryFiles::new().with("s.ron", scene).with("m.obj", obj), None).unwrap_or_else(|p| panic!("{p}")))
            .value
    };
    let alone = read("");
    assert!(alone > 0.1);
    for faces in ["f 1 1 1", "f 2 5 6", "f 2 2 3"] {
        assert!((read(faces) / alone - 1.0).abs() < 1e-6, "{faces}");
    }
}

#[test]
fn coincident_emitters_are_refused_and_back_to_back_ones_are_two() {
    let square = "(-1, 1, 2), (1, 1, 2), (1, -1, 2), (-1, -1, 2)";
    let reversed = "(-1, -1, 2), (1, -1, 2), (1, 1, 2), (-1, 1, 2)";
    let two = |first: &str, second: &str| {
        format!("sources: [(name: \"ten\", shape: {first}, {}), (name: \"twenty\", shape: {second}, {})]", radiance(10.0), radiance(20.0))
    };
    let polygon = |corners: &str| format!("Polygon([{corners}])");
    refused(&two(&polygon(square), &polygon(square)), "\"ten\" and \"twenty\" emit from the same surface");
    refused(&two(&polygon(square), "Rectangle(2, 2), at: (0, 0, 2), facing: (0, 0, -1)"), "emit from the same surface");
    // Opposite winding: each is seen from its own side.
    let back_to_back = scene_from_text(&text(&two(&polygon(square), &polygon(reversed)))).unwrap();
    let alone = read_up_of(&polygon(square), 10.0);
    assert!(alone > 1.0);
    for seed in 0..4 {
        let reading = measured(&back_to_back, &Stop::default(), seed).unwrap().readings.remove(0);
        assert!((reading.value / alone - 1.0).abs() < 1e-12, "{reading:?}");
    }
}

#[test]
fn a_sensor_on_an_emitter_is_refused_if_it_looks_into_it_and_dark_if_it_looks_away() {
    let into = ["Rectangle(2, 2), facing: (0, 0, -1)", "Disc(1), facing: (0, 0, -1)", "Polygon([(-1, 1, 0), (1, 1, 0), (0, -1, 0)])"];
    for shape in into {
        refused(&format!("sources: [(name: \"panel\", shape: {shape}, {})]", radiance(1.0)), "looks into it");
    }
    for shape in ["Rectangle(2, 2)", "Disc(1)", "Polygon([(0, -1, 0), (1, 1, 0), (-1, 1, 0)])"] {
        assert_dark(&scene(&[format!("shape: {shape}, {}", radiance(1.0))], METER, [0.0; 3], UP));
    }
    // The limit of a small gap is π L.
    for shape in ["Rectangle(2, 2), at: (0, 0, 1e-7), facing: (0, 0, -1)", "Disc(1), at: (0, 0, 1e-7), facing: (0, 0, -1)"] {
        assert!((read_up_of(shape, 1.0) / PI - 1.0).abs() < 1e-6);
    }
}

#[test]
fn lights_below_the_horizon_give_exactly_nothing() {
    let below = [
        "shape: Point, at: (1, 2, -0.001), strength: Watts(5), spectrum: \"A\"".to_owned(),
        format!("shape: Sphere(0.5), at: (0, 1, -0.5), {}", radiance(3.0)),
        format!("shape: Polygon([(1, 0, -1), (0, 1, -1), (-1, -1, -2)]), seen_from: Both, {}", radiance(3.0)),
        format!("shape: Disc(0.5), at: (0, 1, -0.5), facing: (0, 0, 1), {}", radiance(3.0)),
        "shape: Directional, facing: (1, 0, 1), strength: WattsPerSquareMetre(5), spectrum: \"A\"".to_owned(),
    ];
    for source in &below {
        assert_dark(&scene(std::slice::from_ref(source), METER, [0.0; 3], UP));
    }
    assert_dark(&scene(&below, METER, [0.0; 3], UP));
}

#[test]
fn scenes_without_light_or_without_geometry_are_recognised_without_tracing() {
    let room = "surfaces: { \"paint\": Lambertian(0.8) }, objects: [(name: \"room\", shape: Box(size: (4, 4, 3)), at: (-2, -2, -1), surface: \"paint\", seen_from: Inside)]";
    assert_dark(&scene_from_text(&text(room)).unwrap());
    assert_dark(&scene(&[], METER, [0.0; 3], UP));
    // An emitter and nothing else: the reading is the emitter's, exactly.
    assert_eq!(read_up(&["shape: Point, at: (0, 0, 2), strength: WattsPerSteradian(8), spectrum: Line(555)".to_owned()], METER), 2.0);
}

#[test]
fn a_laser_line_in_the_gap_of_a_responsivity_is_not_seen() {
    let gap = "Sum([Band(from_nm: 300, to_nm: 620), Band(from_nm: 640, to_nm: 1100)])";
    let sensor = format!("Sensor(aperture: Point, acceptance: Cosine, channels: [(name: \"x\", responsivity: {gap}, reads: Irradiance)])");
    let laser = |nm: f64| format!("shape: Directional, facing: (0, 0, -1), strength: WattsPerSquareMetre(2.5), spectrum: Line({nm})");
    assert_dark(&scene(&[laser(633.0)], &sensor, [0.0; 3], UP));
    for nm in [641.0, 619.0] {
        assert_eq!(read_up(&[laser(nm)], &sensor), 2.5);
    }
    // A responsivity of 1 everywhere but in (620, 640), as a table with steps, gives the same.
    let table = "wavelength_nm,value\n300,1\n620,1\n620.0000001,0\n639.9999999,0\n640,1\n1100,1\n";
    let scene = text(&format!("sources: [(name: \"laser\", {})]", laser(633.0))).replace("responsivity: 1", "responsivity: \"gap.csv\"");
    assert_dark(
        &read_scene("s.ron", &MemoryFiles::new().with("s.ron", scene).with("gap.csv", table), None).unwrap_or_else(|p| panic!("{p}")),
    );
}

#[test]
fn an_acceptance_of_zero_is_refused_and_collects_nothing() {
    for (aperture, reads) in [("Point", "Luminance"), ("Point", "Radiance"), ("Disc(radius_mm: 5)", "RadiantFlux"), ("Point", "Irradiance")]
    {
        let sensor = format!(
            "Sensor(aperture: {aperture}, acceptance: Cone(half_angle_deg: 0), channels: [(name: \"x\", responsivity: \"V\", reads: {reads})])"
        );
        let message = refusal(&format!(
            "Scene(sources: [(name: \"sky\", shape: Environment, {})], instruments: [(name: \"m\", sensor: {sensor}, at: (0, 0, 0), facing: (0, 0, 1))])",
            radiance(1.0)
        ));
        assert!(message.contains("an acceptance of zero collects nothing"), "{message}");
    }
    // A scene made in memory passes no reader: the flux is zero.
    let sky = format!("shape: Environment, {}", radiance(1.0));
    let mut made = scene(&[sky], &System::Radiant.disc_meter(0.01, "Cone(half_angle_deg: 1)"), [0.0; 3], UP);
    let mut sensor = (*made.instruments[0].sensor).clone();
    sensor.acceptance = Acceptance::Cone { half_angle_rad: 0.0 };
    made.instruments[0].sensor = std::sync::Arc::new(sensor);
    let reading = exact(&made);
    assert_eq!((reading.value, reading.standard_uncertainty()), (0.0, 0.0));
}

#[test]
fn input_that_is_not_physical_is_rejected_with_the_name_of_the_field() {
    let lamp = |rest: &str| format!("sources: [(name: \"lamp\", {rest})]");
    for bad in ["NaN", "inf", "-inf"] {
        refused(&lamp(&format!("shape: Polygon([(0, 0, 1), ({bad}, 0, 1), (0, 1, 1)]), {}", radiance(1.0))), "sources[0].shape");
        refused(&lamp(&format!("shape: Sphere({bad}), at: (0, 0, 3), {}", radiance(1.0))), "sources[0].shape");
        refused(&lamp(&format!("shape: Point, at: (0, {bad}, 1), {}", System::Radiant.intensity(1.0))), "sources[0].at");
        refused(&lamp(&format!("shape: Environment, strength: Radiance({bad}), spectrum: \"A\"")), "sources[0].strength");
    }
    refused(&lamp("shape: Environment, strength: Radiance(-1), spectrum: \"A\""), "sources[0].strength");
    refused("surfaces: { \"paint\": Lambertian(1.2) }", "surfaces");
    let curve = |rows: &str| {
        let scene = text(&lamp("shape: Environment, strength: Radiance(1), spectrum: \"lamp.csv\""));
        match read_scene("s.ron", &MemoryFiles::new().with("s.ron", scene).with("lamp.csv", format!("wavelength_nm,value\n{rows}")), None) {
            Ok(_) => panic!("{rows}"),
            Err(problems) => problems.to_string(),
        }
    };
    for rows in ["400,1\n500,2\n450,1\n", "400,1\n500,2\n500,3\n500,4\n600,1\n", "400,1\n500,NaN\n600,1\n"] {
        assert!(curve(rows).contains("lamp.csv"), "{}", curve(rows));
    }
    let obj = "v 0 0 1\nv nan 0 1\nv 0 1 1\nf 1 2 3\n";
    let mesh = text(&lamp(&format!("shape: Mesh(\"m.obj\"), {}", radiance(1.0))));
    let problems = read_scene("s.ron", &MemoryFiles::new().with("s.ron", mesh).with("m.obj", obj), None).unwrap_err().to_string();
    assert!(problems.contains("m.obj"), "{problems}");
    // What is made in memory is checked where it is made.
    assert!(Density::line(f64::NAN, 1.0).is_err() && Density::line(555.0, -1.0).is_err());
}

#[test]
fn a_closed_box_that_absorbs_nothing_is_refused() {
    let lamp = "sources: [(name: \"lamp\", shape: Point, at: (0, 0, 1), strength: Watts(1), spectrum: \"A\")]";
    let room = |rho: &str| {
        format!(
            "surfaces: {{ \"paint\": Lambertian({rho}) }}, objects: [(name: \"room\", shape: Box(size: (4, 4, 4)), at: (-2, -2, -1), surface: \"paint\")], {lamp}"
        )
    };
    refused(&room("1"), "no finite value");
    // Six polygons are closed as well, but that is found out on the way only: the run stops with an error, not with a number.
    let corner = |x: i32, y: i32, z: i32| format!("({}, {}, {})", 4 * x - 2, 4 * y - 2, 4 * z - 1);
    let sides: Vec<String> = (0..3)
        .flat_map(|axis| [0, 1].map(|end| (axis, end)))
        .map(|(axis, end)| {
            let corners = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(a, b)| match axis {
                0 => corner(end, a, b),
                1 => corner(a, end, b),
                _ => corner(a, b, end),
            });
            format!("(name: \"side {axis} {end}\", shape: Polygon([{}]), surface: \"paint\")", corners.join(", "))
        })
        .collect();
    let scene =
        scene_from_text(&text(&format!("surfaces: {{ \"paint\": Lambertian(1) }}, objects: [{}], {lamp}", sides.join(", ")))).unwrap();
    let plan = Plan::new(&scene, &PlanOptions::default()).unwrap();
    let stop = Stop { target: None, budget_seconds: None, samples: Some(16) };
    let found = measure(&scene, &plan, &stop, 1, &Watch { now: &|| 0.0, progress: &|_| {} });
    assert!(matches!(found, Err(EstimateError::Endless { .. })), "{found:?}");
}

#[test]
fn readings_of_opposite_normals_differ_by_the_projection_of_the_flux_vector() {
    let corners = [[0.6, -0.75, 0.5], [0.9, 1.1, -0.4], [0.4, 0.8, 1.2]];
    let read = |n: [f64; 3]| {
        let value = polygon_seen(&corners, 2.0, [0.0; 3], n);
        assert!(value >= 0.0);
        value
    };
    let flipped = |n: [f64; 3]| n.map(|x| -x);
    let projection = |n: [f64; 3]| read(n) - read(flipped(n));
    // A polygon above the horizon of one side and below that of the other along its own directions: the vector from three axes.
    let vector = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(projection);
    for n in [[0.3, -0.2, 0.9], [-0.5, 0.8, 0.1], [0.0, 0.6, 0.8], [1.0, -1.0, 1.0]] {
        let length = n.iter().map(|x| x * x).sum::<f64>().sqrt();
        let along = n.iter().zip(vector).map(|(a, b)| a * b).sum::<f64>() / length;
        assert!((projection(n) - along).abs() < 1e-12, "{n:?}: {} and {along}", projection(n));
    }
    assert!(vector[0] > 0.1 && read(flipped([1.0, 0.0, 0.0])) == 0.0);
}
