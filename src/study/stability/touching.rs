//! An aperture that comes to touch an emitter, at an edge or at a corner: 1/r² has no bound there, its integral has.
//!
//! ```text
//! floor x, y ∈ (0, 1) m emits; the aperture stands in the plane x = 0:   E = [K(1, 1, g + h) − K(1, 1, g)] / h
//! ```
//!
//! | series | what is read | reference |
//! |---|---|---|
//! | formula | an aperture of 1 m × h above the edge, h = 1 m / aspect, by formula | the above |
//! | divided | the same with a black screen across the middle, sampled | twice K of half the length |
//! | corner | an aperture of 0.1 m × 0.1 m beside the floor's corner, by formula | sums of K |
//! | corner, divided | the same, which sees the near half of the floor only, sampled | sums of K |
//! | coplanar | an aperture in the plane of the floor, beside it and half on it | 0 |
//! | contact | an aperture that looks down on to the floor and lies half on it | no reading |
//! | reflected | a strip of 1 m × h on the floor emits and is read, beside a grey wall, by paths | (ρL/πh) ∫ G² dA over the wall |
//! | line | the same strip and wall, read from 1 m, by paths | (ρL/π) ∫ G cos²θ / r² dA, and the strip itself |
//!
//! K is the etendue of perpendicular rectangles with a common edge of length l (Howell, A Catalog of Radiation Heat Transfer Configuration
//! Factors, C-14), G the projected solid angle of the strip at a point of the wall (B-5). None of them is a formula of the program.

use std::f64::consts::PI;

use super::reference::gauss;
use super::text::{METER, at};
use super::{Point, Reference, Sweep};

/// The sweep.
pub const SWEEP: Sweep = Sweep {
    name: "touching",
    parameter: "gap between aperture and emitter, in heights of the aperture",
    unit: "1",
    law: "perpendicular rectangles with a common edge",
    points,
};

const RHO: f64 = 0.5;

fn points() -> Vec<Point> {
    let mut points = Vec::new();
    let each = |points: &mut Vec<Point>, series: [&'static str; 3], point: &dyn Fn(&'static str, f64, f64) -> Point| {
        for (name, aspect) in series.into_iter().zip([1.0, 100.0, 1e4]) {
            points.extend(gaps(aspect).into_iter().map(|gap| Point { parameter: gap, ..point(name, 1.0 / aspect, gap / aspect) }));
        }
    };
    each(&mut points, ["formula 1:1", "formula 1:100", "formula 1:10000"], &|name, h, g| edge(name, h, g, false));
    each(&mut points, ["divided 1:1", "divided 1:100", "divided 1:10000"], &|name, h, g| edge(name, h, g, true));
    each(&mut points, ["reflected 1:1", "reflected 1:100", "reflected 1:10000"], &reflected);
    each(&mut points, ["line 1:1", "line 1:100", "line 1:10000"], &line);
    for gap in gaps(10.0) {
        points.push(Point { parameter: gap, ..corner("corner", 0.1 * gap, false) });
    }
    for gap in gaps(10.0) {
        points.push(Point { parameter: gap, ..corner("corner, divided", 0.1 * gap, true) });
    }
    for gap in [1.0, 1e-3, 0.0, -0.5] {
        points.push(Point { parameter: gap, ..coplanar(0.1 * gap) });
    }
    let onto = scene("", FLOOR, &receptor(0.1, 0.1), at(-0.01, 0.5, 0.0), "facing: (0, 0, -1), up: (1, 0, 0)");
    points.push(Point::new("contact", 0.0, onto, Reference::Refused));
    points
}

/// From 1 m to nothing, in heights of an aperture of 1 m / `aspect`.
fn gaps(aspect: f64) -> Vec<f64> {
    let mut gaps = vec![aspect, 1.0, 0.1, 1e-3, 1e-6, 0.0];
    gaps.dedup();
    gaps
}

const FLOOR: &str =
    r#"(name: "floor", shape: Quad(corner: (0, 0, 0), u: (1, 0, 0), v: (0, 1, 0)), strength: Radiance(1), spectrum: Line(555))"#;
const SCREEN: &str = r#"(name: "screen", shape: Quad(corner: (0, 0.5, 0), u: (1, 0, 0), v: (0, 0, 3)), surface: "black")"#;
const WALL: &str = r#"(name: "wall", shape: Quad(corner: (0, 0, 0), u: (0, 1, 0), v: (0, 0, 1)), surface: "grey")"#;

fn scene(objects: &str, source: &str, sensor: &str, place: String, facing: &str) -> String {
    format!(
        "Scene(surfaces: {{ \"black\": Lambertian(0), \"grey\": Lambertian({RHO}) }}, objects: [{objects}], sources: [{source}],
            instruments: [(name: \"meter\", sensor: {sensor}, at: {place}, {facing})])"
    )
}

/// A cosine receptor of so many metres.
fn receptor(width: f64, height: f64) -> String {
    format!(
        "Sensor(aperture: Rectangle(width_m: {width:e}, height_m: {height:e}), acceptance: Cosine, \
         channels: [(name: \"E\", responsivity: 1, reads: Irradiance)])"
    )
}

const SIDEWAYS: &str = "facing: (1, 0, 0), up: (0, 0, 1)";
const UPWARDS: &str = "facing: (0, 0, 1), up: (1, 0, 0)";

fn close_to(value: f64, relative: f64) -> Reference {
    Reference::Values { values: vec![value], relative }
}

fn edge(series: &'static str, h: f64, gap: f64, divided: bool) -> Point {
    let place = at(0.0, 0.5, gap + 0.5 * h);
    let scene = scene(if divided { SCREEN } else { "" }, FLOOR, &receptor(1.0, h), place, SIDEWAYS);
    let (parts, l) = if divided { (2.0, 0.5) } else { (1.0, 1.0) };
    // The difference of two heights, and the height of the centre as it is written down, are rounded.
    let closed = parts * (etendue(l, 1.0, gap + h) - etendue(l, 1.0, gap)) / h;
    let point = Point::new(series, 0.0, scene, close_to(closed, 1e-10));
    if divided { point.sampled(1 << 14) } else { point }
}

fn corner(series: &'static str, gap: f64, divided: bool) -> Point {
    let s = 0.1;
    let place = at(0.0, 1.0 + gap + 0.5 * s, 0.5 * s);
    let scene = scene(if divided { SCREEN } else { "" }, FLOOR, &receptor(s, s), place, SIDEWAYS);
    let k = |l: f64| etendue(l, 1.0, s);
    let l = if divided { 0.5 } else { 1.0 };
    // Rectangles beside each other, from those that share all of their edge.
    let closed = 0.5 * (k(l + gap + s) - k(l + gap) - k(gap + s) + k(gap)) / (s * s);
    let point = Point::new(series, 0.0, scene, close_to(closed, 1e-10));
    if divided { point.sampled(1 << 14) } else { point }
}

fn coplanar(gap: f64) -> Point {
    let scene = scene(SCREEN, FLOOR, &receptor(0.1, 0.1), at(-gap - 0.05, 0.25, 0.0), UPWARDS);
    Point::new("coplanar", 0.0, scene, Reference::exactly(0.0)).sampled(1 << 12)
}

/// A strip of the floor, `gap` from the wall.
fn strip(h: f64, gap: f64) -> String {
    format!(
        "(name: \"strip\", shape: Quad(corner: {}, u: {}, v: (0, 1, 0)), strength: Radiance(1), spectrum: Line(555))",
        at(gap, 0.0, 0.0),
        at(h, 0.0, 0.0)
    )
}

fn reflected(series: &'static str, h: f64, gap: f64) -> Point {
    let scene = scene(WALL, &strip(h, gap), &receptor(1.0, h), at(gap + 0.5 * h, 0.5, 0.0), UPWARDS);
    let closed = RHO / (PI * h) * over_wall(&|y, z| projected(y, z, gap, h).powi(2));
    Point::new(series, 0.0, scene, close_to(closed, 1e-6)).sampled(1 << 14)
}

fn line(series: &'static str, h: f64, gap: f64) -> Point {
    let scene = scene(WALL, &strip(h, gap), METER, at(1.0 + gap + h, 0.5, 0.5), "facing: (-1, 0, 0)");
    let away = 1.0 + gap + h;
    let kernel = |y: f64, z: f64| projected(y, z, gap, h) * (away / (away * away + (y - 0.5).powi(2) + (z - 0.5).powi(2))).powi(2);
    let closed = RHO / PI * over_wall(&kernel) + projected(0.5, 0.5, 1.0, h);
    Point::new(series, 0.0, scene, close_to(closed, 1e-6)).sampled(1 << 14)
}

/// Etendue of perpendicular rectangles with a common edge, m² sr; `l` is the length of the edge, `w` and `h` the other sides, m.
fn etendue(l: f64, w: f64, h: f64) -> f64 {
    if h == 0.0 || w == 0.0 || l == 0.0 {
        return 0.0;
    }
    let (w, h) = (w / l, h / l);
    let (w2, h2) = (w * w, h * h);
    let s = (w2 + h2).sqrt();
    let logs = (w2.ln_1p() + h2.ln_1p() - (w2 + h2).ln_1p())
        + w2 * (w2.ln() + (w2 + h2).ln_1p() - w2.ln_1p() - (w2 + h2).ln())
        + h2 * (h2.ln() + (w2 + h2).ln_1p() - h2.ln_1p() - (w2 + h2).ln());
    l * l * (w * (1.0 / w).atan() + h * (1.0 / h).atan() - s * (1.0 / s).atan() + 0.25 * logs)
}

/// Projected solid angle, sr, of the strip x ∈ (gap, gap + h), y ∈ (0, 1) of the floor at the point (y, z) of the wall.
fn projected(y: f64, z: f64, gap: f64, h: f64) -> f64 {
    let to = |depth: f64, side: f64| {
        let r = z.hypot(depth);
        -z / r * (side / r).atan()
    };
    let side = |l: f64| 0.5 * (to(gap + h, l) - to(gap, l));
    side(y) + side(1.0 - y)
}

/// ∫ f(y, z) over the wall, symmetric about y = ½ m: Gauss, decade by decade towards the edges.
fn over_wall(f: &dyn Fn(f64, f64) -> f64) -> f64 {
    let nodes = gauss(16);
    let along = |length: f64| {
        let mut ends: Vec<f64> = (0..10).map(|n| length * super::power_of_ten(-n)).collect();
        ends.push(0.0);
        ends.windows(2)
            .flat_map(|e| nodes.iter().map(|&(s, w)| (e[1] + s * (e[0] - e[1]), w * (e[0] - e[1]))).collect::<Vec<_>>())
            .collect::<Vec<_>>()
    };
    let (ys, zs) = (along(0.5), along(1.0));
    ys.iter().map(|&(y, wy)| 2.0 * wy * zs.iter().map(|&(z, wz)| wz * f(y, z)).sum::<f64>()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cube_has_its_known_factor_and_reciprocity() {
        // F of two faces of a cube that share an edge.
        assert!((etendue(1.0, 1.0, 1.0) / PI - 0.200_043_776).abs() < 1e-8);
        assert!((etendue(2.0, 0.3, 1e-3) / etendue(2.0, 1e-3, 0.3) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_strip_as_the_wall_sees_it_adds_up_to_the_etendue() {
        for (h, gap) in [(1.0, 0.0), (0.01, 0.0), (0.01, 0.3)] {
            let whole = over_wall(&|y, z| projected(y, z, gap, h));
            let closed = etendue(1.0, gap + h, 1.0) - etendue(1.0, gap, 1.0);
            assert!((whole / closed - 1.0).abs() < 1e-7, "{whole} {closed}");
        }
    }
}
