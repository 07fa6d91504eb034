//! The colour chart: patch signals against direct integration of reflectance × lamp × sensitivity.

use std::f64::consts::PI;
use std::fs;
use std::path::PathBuf;

use etendue::estimate::closed_form::polygon::polygon;
use etendue::geometry::shape::{Shape, Side};
use etendue::math::DVec3;
use etendue::plan::camera::FirstReflection;
use etendue::scene::{FileProblem, Files, Region, Scene, read_scene};
use etendue::source::Emitter;
use etendue::spectrum::Factor;

use crate::{measured, planned};

struct Repository;

impl Files for Repository {
    fn read(&self, path: &str, _most_bytes: u64) -> Result<Vec<u8>, FileProblem> {
        fs::read(PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(path)).map_err(|_| FileProblem::Missing)
    }
}

fn chart() -> Scene {
    read_scene("scenes/colour-chart.ron", &Repository, None).unwrap_or_else(|problems| panic!("{problems}"))
}

/// Irradiance of both panels per unit of their density, times the étendue of a pixel, averaged over a region by midpoints. The pixels of a
/// channel lie `aside` pixels to the right of the middle of their tiles and as many below.
fn geometry(scene: &Scene, region: &Region, aside: f64) -> f64 {
    const NODES: usize = 6;
    let camera = &scene.cameras[0].camera;
    let (v, radius) = (0.016 / (1.0 - 0.016), 0.002);
    let mut sum = 0.0;
    for k in 0..NODES * NODES {
        let at = |k: usize, from: usize, length: usize| from as f64 + (k as f64 + 0.5) / NODES as f64 * length as f64 + aside;
        let (column, row) = (at(k % NODES, region.x, region.width), at(k / NODES, region.y, region.height));
        let (a, b) = ((column - 600.0) * camera.pitch_m, (420.0 - row) * camera.pitch_m);
        let point = DVec3::new(a / v, 0.0, b / v);
        let irradiance: f64 = scene
            .sources
            .iter()
            .map(|source| {
                let Emitter::Area { elements } = &source.emitter else { panic!("a panel") };
                let [(element, Side::Front)] = elements.as_slice() else { panic!("one side") };
                let Shape::Rectangle(r) = &scene.elements[*element].shape else { panic!("a rectangle") };
                polygon(&r.corners().map(|c| c - point), DVec3::NEG_Y)
            })
            .sum();
        // ∫ v²/d⁴ over the pupil by rings, to the fourth order of its radius.
        let d2 = |x: f64, y: f64| v * v + (a + x).powi(2) + (b + y).powi(2);
        let rings = 12;
        let pupil: f64 = (0..rings * rings)
            .map(|k| {
                let r = radius * ((k / rings) as f64 + 0.5).sqrt() / (rings as f64).sqrt();
                let (sin, cos) = (2.0 * PI * (k % rings) as f64 / rings as f64).sin_cos();
                v * v / d2(r * cos, r * sin).powi(2)
            })
            .sum::<f64>()
            / (rings * rings) as f64
            * PI
            * radius
            * radius;
        sum += irradiance / PI * pupil;
    }
    sum / (NODES * NODES) as f64
}

#[test]
fn patch_signals_are_reflectance_times_lamp_times_sensitivity() {
    let scene = chart();
    let plan = planned(&scene, false);
    assert!(plan.cameras[0].first.iter().all(|f| *f == FirstReflection::Formula) && !plan.cameras[0].interreflection);
    let measured = measured(&scene, 16, 1);
    let placed = &scene.cameras[0];
    assert_eq!((placed.regions.len(), measured.readings.len()), (24, 96));
    let mut largest = 0.0f64;
    for region in &placed.regions {
        let element = scene.elements.iter().find(|e| e.owner == format!("patch {}", region.name)).unwrap();
        let reflectance = &scene.surfaces[element.front].reflectance;
        let lamp = &scene.sources[0].density;
        for (c, channel) in placed.camera.channels.iter().enumerate() {
            // RGGB: red at the upper left of a tile, blue at the lower right, green in the middle of both.
            let geometry = geometry(&scene, region, [-0.5, 0.0, 0.5][c]);
            let expected = placed.camera.collection_m2_s() * geometry * lamp.integral(&[&placed.camera.responsivity(c), reflectance]);
            let name = format!("camera: {}", region.name);
            let r = measured.readings.iter().find(|r| r.instrument == name && r.channel == channel.name).unwrap();
            let u = r.standard_uncertainty();
            largest = largest.max((r.value - expected).abs() / u);
            // The grid of this test is good to 2e-5; 72 comparisons.
            assert!(
                (r.value - expected).abs() <= 4.5 * u + 2e-5 * expected,
                "{name} {}: {} ± {u} instead of {expected}",
                channel.name,
                r.value
            );
            assert!(u < 1e-3 * r.value, "{name}: {u} of {}", r.value);
        }
        let luminance = Factor::Product(vec![etendue::spectrum::library::v_lambda(), Factor::Constant(683.002)]);
        let r = measured.readings.iter().find(|r| r.instrument == format!("camera: {}", region.name) && r.channel == "L_v").unwrap();
        assert!(r.value > 0.0 && r.value < lamp.integral(&[&luminance]), "{}", r.value);
    }
    println!("largest deviation: {largest:.2} u");
}
