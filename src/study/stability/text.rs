//! Scene files from numbers, every digit kept.

use crate::math::DVec3;

/// A meter of irradiance without extent.
pub(super) const METER: &str =
    r#"Sensor(aperture: Point, acceptance: Cosine, channels: [(name: "E", responsivity: 1, reads: Irradiance)])"#;

/// A vector.
pub(super) fn vector(v: DVec3) -> String {
    format!("({:e}, {:e}, {:e})", v.x, v.y, v.z)
}

/// A vector by its components.
pub(super) fn at(x: f64, y: f64, z: f64) -> String {
    vector(DVec3::new(x, y, z))
}

/// A scene of one meter at the origin that faces upwards; `sources` and `objects` are items of its lists.
pub(super) fn upwards(objects: &str, sources: &str) -> String {
    upwards_with(METER, objects, sources)
}

/// The same with a sensor of its own.
pub(super) fn upwards_with(sensor: &str, objects: &str, sources: &str) -> String {
    format!(
        "Scene(surfaces: {{ \"black\": Lambertian(0) }}, objects: [{objects}], sources: [{sources}],
            instruments: [(name: \"meter\", sensor: {sensor}, at: (0, 0, 0), facing: (0, 0, 1))])"
    )
}

/// A meter of radiance without extent, by the half-angle of its cone.
pub(super) fn radiance_meter(half_angle_deg: f64) -> String {
    format!(
        "Sensor(aperture: Point, acceptance: Cone(half_angle_deg: {half_angle_deg:e}), \
         channels: [(name: \"L\", responsivity: 1, reads: Radiance)])"
    )
}
