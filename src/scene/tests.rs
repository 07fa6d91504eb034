//! Scenes that are read, against closed forms.

mod observers;
mod syntax;

use std::f64::consts::PI;

use super::*;
use crate::geometry::shape::Side;
use crate::math::DVec3;
use crate::quantity::constants::K_M_LM_W;
use crate::quantity::measurand::Measurand;
use crate::sensor::{Acceptance, Aperture};
use crate::source::Emitter;
use crate::spectrum::library::v_lambda;

const METER: &str = r#"Sensor(
    title: "Ideal illuminance meter",
    aperture: Point,
    acceptance: Cosine,
    channels: [(name: "E_v", responsivity: "V", reads: Illuminance)],
)"#;

fn bench(source: &str) -> Result<Scene, Diagnostics> {
    let text = format!(
        "Scene(sources: [(name: \"lamp\", {source})],
        instruments: [(name: \"meter\", sensor: \"../sensors/meter.ron\", at: (0, 0, 0), facing: (0, 0, 1))])"
    );
    read_scene("scenes/bench.ron", &MemoryFiles::new().with("scenes/bench.ron", text).with("sensors/meter.ron", METER), None)
}

fn luminous(scene: &Scene) -> f64 {
    K_M_LM_W * scene.sources[0].density.integral(&[&v_lambda()])
}

fn assert_close(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-12 * expected.abs(), "{found} is not {expected}");
}

#[test]
fn a_lux_meter_on_a_photometric_bench() {
    let scene = bench(r#"shape: Point, at: (0, 0, 2), strength: Candela(100), spectrum: "A""#).unwrap();
    assert_eq!(scene.title, "bench.ron");
    assert_eq!(scene.sources[0].emitter, Emitter::Point { at: DVec3::new(0.0, 0.0, 2.0) });
    assert_close(luminous(&scene), 100.0);
    let instrument = &scene.instruments[0];
    assert_eq!(instrument.poses, [Pose { at: DVec3::ZERO, normal: DVec3::Z, x_axis: DVec3::X }]);
    assert_eq!((instrument.sensor.aperture, &instrument.sensor.acceptance), (Aperture::Point, &Acceptance::Cosine));
    assert_eq!(instrument.sensor.channels[0].reads, Measurand::Illuminance);
    assert_eq!(instrument.sensor.channels[0].scale, K_M_LM_W);
    assert_ne!(scene.hash, 0);
}

#[test]
fn strengths_follow_their_closed_forms() {
    let line = "spectrum: Line(555)";
    let radiant = |source: &str| bench(&format!("{source}, {line}")).unwrap().sources[0].density.total();
    assert_close(radiant("shape: Point, at: (0, 0, 2), strength: Watts(1)"), 1.0 / (4.0 * PI));
    assert_close(radiant("shape: Point, at: (0, 0, 2), strength: Irradiance(watts_per_m2: 3, at_m: 2)"), 12.0);
    assert_close(radiant("shape: Point, at: (0, 0, 2), strength: Electrical(volts: 10, amperes: 2, efficiency: 0.5)"), 10.0 / (4.0 * PI));
    assert_close(radiant("shape: Directional, facing: (0, 0, -1), strength: WattsPerSquareMetre(7)"), 7.0);
    assert_close(radiant("shape: Environment, strength: WattsPerSquareMetre(7)"), 7.0 / PI);
    assert_close(radiant("shape: Disc(2), at: (0, 0, 2), facing: (0, 0, -1), strength: Watts(1)"), 1.0 / (PI * PI * 4.0));
    assert_close(radiant("shape: Disc(2), at: (0, 0, 2), seen_from: Both, strength: Watts(1)"), 0.5 / (PI * PI * 4.0));
    assert_close(radiant("shape: Sphere(2), at: (0, 0, 9), strength: WattsPerSteradian(1)"), 1.0 / (PI * 4.0));
    assert_close(radiant("shape: Sphere(2), at: (0, 0, 9), strength: Irradiance(watts_per_m2: 1, at_m: 4)"), 4.0 / PI);
    assert_close(radiant("shape: Disc(3), at: (0, 0, 9), strength: Irradiance(watts_per_m2: 1, at_m: 4)"), 25.0 / (9.0 * PI));
    assert_close(radiant("shape: Rectangle(2, 3), at: (0, 0, 9), strength: Exitance(watts_per_m2: 1)"), 1.0 / PI);
    assert_close(radiant("shape: Rectangle(2, 3), at: (0, 0, 9), strength: Radiance(1)"), 1.0);
    // From afar a rectangle is a point of intensity L A; close to it, it fills the half-space: E = πL.
    let far = radiant("shape: Rectangle(2, 3), at: (0, 0, 9), strength: Irradiance(watts_per_m2: 1, at_m: 1e6)");
    assert!((far * 6e-12 - 1.0).abs() < 1e-11);
    let near = radiant("shape: Rectangle(2, 3), at: (0, 0, 9), strength: Irradiance(watts_per_m2: 1, at_m: 1e-9)");
    assert!((near * PI - 1.0).abs() < 1e-8);
}

#[test]
fn the_irradiance_on_the_axis_of_a_rectangle_is_the_integral_over_its_area() {
    // Midpoint rule over 400 × 400 cells of L cos²θ / r².
    let (w, h, r, n) = (2.0, 3.0, 1.5, 400);
    let mut e = 0.0;
    for i in 0..n {
        for j in 0..n {
            let (x, y) = (w * ((f64::from(i) + 0.5) / f64::from(n) - 0.5), h * ((f64::from(j) + 0.5) / f64::from(n) - 0.5));
            e += r * r / (x * x + y * y + r * r).powi(2) * w * h / f64::from(n * n);
        }
    }
    let scene =
        bench("shape: Rectangle(2, 3), at: (0, 0, 9), strength: Irradiance(watts_per_m2: 1, at_m: 1.5), spectrum: Line(555)").unwrap();
    assert!((scene.sources[0].density.total() * e - 1.0).abs() < 1e-5);
}

#[test]
fn seen_from_says_which_side_carries_what() {
    let scene = scene_from_text(
        r#"Scene(
            surfaces: { "paint": Lambertian(0.8) },
            objects: [
                (name: "room", shape: Box(size: (4, 3, 2)), seen_from: Inside, surface: "paint"),
                (name: "screen", shape: Rectangle(1, 1), at: (1, 1, 1), facing: (1, 0, 0), surface: "paint"),
            ],
            sources: [(name: "lamp", shape: Sphere(0.1), at: (2, 2, 1), seen_from: Inside, strength: Radiance(1), spectrum: "E", surface: "paint")],
            instruments: [(name: "m", sensor: Sensor(aperture: Disc(radius_mm: 5), acceptance: Cone(half_angle_deg: 90),
                channels: [(name: "Phi", responsivity: 1, reads: RadiantFlux)]), at: (0.5, 0.5, 0.5), facing: (0, 0, 1))],
        )"#,
    )
    .unwrap();
    let paint = scene.surfaces.iter().position(|s| s.name == "paint").unwrap();
    assert_eq!(scene.elements.len(), 8);
    for side in &scene.elements[..6] {
        assert!(scene.surfaces[side.front].is_black() && side.back == paint, "the room is painted inside");
    }
    assert_eq!((scene.elements[6].front, scene.elements[6].back), (paint, paint));
    assert_eq!(scene.sources[0].emitter, Emitter::Area { elements: vec![(7, Side::Back)] });
}

#[test]
fn a_grid_runs_column_by_column_then_row_by_row() {
    let text = format!(
        "Scene(instruments: [(name: \"plane\", sensor: {METER}, grid: (from: (0, 1, 0.8), to: (4, 3, 0.8), points: (5, 3)), facing: (0, 0, 1)),
        (name: \"line\", sensor: {METER}, grid: (from: (0, 0, 0), to: (1, 1, 1), points: (3, 1), along: (1, 1, 1)), facing: (0, 0, 1))])"
    );
    let scene = scene_from_text(&text).unwrap();
    let plane = &scene.instruments[0];
    assert_eq!(plane.layout, Layout::Grid { columns: 5, rows: 3 });
    assert_eq!(plane.poses[7].at, DVec3::new(2.0, 2.0, 0.8));
    assert!((scene.instruments[1].poses[1].at - DVec3::splat(0.5)).length() < 1e-15);
}

#[test]
fn a_meter_indicates_what_it_was_adjusted_to() {
    let sensor = r#"Sensor(aperture: Point, acceptance: Cosine, channels: [
        (name: "E_v", responsivity: Gaussian(peak: 0.3, centre_nm: 560, fwhm_nm: 100), reads: Illuminance(adjusted_with: "A")),
        (name: "PPFD", responsivity: Band(from_nm: 400, to_nm: 700), reads: PhotonIrradiance),
    ])"#;
    let scene =
        scene_from_text(&format!("Scene(instruments: [(name: \"m\", sensor: {sensor}, at: (0, 0, 0), facing: (0, 0, 1))])")).unwrap();
    let [channel, photons] = scene.instruments[0].sensor.channels.as_slice() else { panic!("two channels") };
    let a = crate::spectrum::Density::illuminant_a();
    assert_close(channel.scale * a.integral(&[&channel.responsivity]), K_M_LM_W * a.integral(&[&v_lambda()]));
    // One watt at 550 nm in air: λ_vac / (h c N_A), 4.599 µmol/s.
    let watt = crate::spectrum::Density::line(550.0, 1.0).unwrap();
    let vacuum_nm = crate::quantity::air::wavelength_in_vacuum_nm(550.0);
    let expected = 1e6 * crate::quantity::photon::photons_per_joule(vacuum_nm) / crate::quantity::constants::AVOGADRO_PER_MOL;
    assert!((photons.scale * watt.integral(&[&photons.responsivity]) / expected - 1.0).abs() < 1e-9);
}
