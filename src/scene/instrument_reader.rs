//! Instruments of a scene file: a sensor with one pose, a list of poses, or a grid of them.
//!
//! | key | meaning |
//! |---|---|
//! | `at`, `facing`, `up` | one pose |
//! | `list: [(at: …, facing: …), …]` | poses one after the other |
//! | `grid: (from: …, to: …, points: (columns, rows), along: …)`, `facing`, `up` | a grid from corner to corner |
//!
//! A grid whose corners differ in one coordinate is a line with `points: (n, 1)`; in two, columns run along the axis that
//! comes first (x before y before z); otherwise `along` gives the direction of the columns, and the rows run along the rest.

use super::decode::{Fields, Value};
use super::document::{Body, Kind};
use super::placement::{Placement, read_facing};
use super::reading::Reading;
use super::sensor_reader::read_sensor;
use super::{Instrument, Layout, Pose};
use crate::math::DVec3;

/// Poses that a scene may have, all instruments together.
pub const MOST_POSES: usize = 4_000_000;

const KEYS: [&str; 7] = ["name", "sensor", "at", "facing", "up", "list", "grid"];

/// Reads an instrument; `poses_left` is how many poses the scene may still have.
pub(super) fn read_instrument(value: &Value, name: Option<&str>, poses_left: &mut usize, reading: &mut Reading) -> Option<Instrument> {
    let fields = value.fields("an instrument", &KEYS, &mut reading.problems)?;
    let sensor = fields
        .require("sensor", "\"../sensors/ideal-illuminance-meter.ron\"", &mut reading.problems)
        .and_then(|v| read_sensor(&v, reading));
    let arranged = match (fields.get("list"), fields.get("grid")) {
        (Some(_), Some(grid)) => {
            grid.problem_at(&fields.key_span("grid"), &mut reading.problems, "both `list` and `grid` are given", "keep one of them");
            None
        }
        (Some(list), None) => {
            fields.refuse(&["at", "facing", "up"], "each pose of the list has its own", &mut reading.problems);
            read_list(&list, reading)
        }
        (None, Some(grid)) => {
            fields.refuse(&["at"], "the grid says where it is", &mut reading.problems);
            read_grid(&grid, &fields, *poses_left, reading)
        }
        (None, None) => {
            let at = fields.require("at", "(0, 0, 0)", &mut reading.problems).and_then(|v| v.point_m(&mut reading.problems));
            read_frame(&fields, reading).zip(at).map(|(frame, at)| (Layout::Single, vec![pose(at, frame)]))
        }
    };
    let (name, sensor, (layout, poses)) = (name?, sensor?, arranged?);
    if poses.len() > *poses_left {
        value.problem(
            &mut reading.problems,
            format!("the scene has more than {MOST_POSES} poses"),
            "use fewer instruments or coarser grids",
        );
        return None;
    }
    *poses_left -= poses.len();
    Some(Instrument { name: name.into(), sensor, layout, poses })
}

/// The directions of a sensor. Unlike for objects, `facing` must be said.
fn read_frame(fields: &Fields, reading: &mut Reading) -> Option<Placement> {
    fields.require("facing", "(0, 0, 1)", &mut reading.problems)?;
    read_facing(fields, DVec3::ZERO, &mut reading.problems)
}

fn pose(at: DVec3, frame: Placement) -> Pose {
    Pose { at, normal: frame.z, x_axis: frame.x }
}

fn read_list(list: &Value, reading: &mut Reading) -> Option<(Layout, Vec<Pose>)> {
    let items = list.list("poses", &mut reading.problems)?;
    if items.is_empty() {
        list.problem(&mut reading.problems, "the list has no poses", "add `(at: (0, 0, 0), facing: (0, 0, 1))`");
        return None;
    }
    let poses: Vec<Option<Pose>> = items
        .iter()
        .map(|item| {
            let fields = item.fields("a pose", &["at", "facing", "up"], &mut reading.problems)?;
            let at = fields.require("at", "(0, 0, 0)", &mut reading.problems).and_then(|v| v.point_m(&mut reading.problems));
            let frame = read_frame(&fields, reading);
            Some(pose(at?, frame?))
        })
        .collect();
    Some((Layout::List, poses.into_iter().collect::<Option<Vec<Pose>>>()?))
}

fn read_grid(grid: &Value, owner: &Fields, poses_left: usize, reading: &mut Reading) -> Option<(Layout, Vec<Pose>)> {
    let frame = read_frame(owner, reading);
    let fields = grid.fields("a grid", &["from", "to", "points", "along"], &mut reading.problems)?;
    let mut corner = |key: &str| fields.require(key, "(0, 0, 0.8)", &mut reading.problems).and_then(|v| v.point_m(&mut reading.problems));
    let (from, to) = (corner("from"), corner("to"));
    let points = fields.require("points", "(10, 8)", &mut reading.problems);
    let counts = points.as_ref().and_then(|v| read_counts(v, poses_left, reading));
    let along = match fields.get("along") {
        Some(along) => Some(along.direction(&mut reading.problems)?),
        None => None,
    };
    let (frame, from, to, (columns, rows), points) = (frame?, from?, to?, counts?, points?);
    let (u, v) = edges(from, to, along).or_else(|| {
        let help = "add `along: (1, 1, 0)`, the direction of the columns, or let the corners differ in two coordinates only";
        grid.problem(&mut reading.problems, "the corners of the grid differ in three coordinates, so its axes are not known", help);
        None
    })?;
    for (edge, count, axis) in [(u, columns, "first"), (v, rows, "second")] {
        if (edge == DVec3::ZERO) != (count == 1) {
            let (message, help) = if count == 1 {
                (
                    format!("the grid has an extent along its {axis} axis but one point"),
                    "give at least 2 points, or let the corners agree in that coordinate",
                )
            } else {
                (
                    format!("the grid has {count} points along its {axis} axis but no extent there"),
                    "let `from` and `to` differ along that axis, or give 1 point",
                )
            };
            points.problem(&mut reading.problems, message, help);
            return None;
        }
    }
    let share = |i: usize, n: usize| if n == 1 { 0.0 } else { i as f64 / (n - 1) as f64 };
    let poses = (0..rows)
        .flat_map(|row| (0..columns).map(move |column| from + u * share(column, columns) + v * share(row, rows)))
        .map(|at| pose(at, frame));
    Some((Layout::Grid { columns, rows }, poses.collect()))
}

/// The two edges of a grid; none if the corners do not say which they are.
fn edges(from: DVec3, to: DVec3, along: Option<DVec3>) -> Option<(DVec3, DVec3)> {
    let diagonal = to - from;
    if let Some(along) = along {
        // An edge that is nothing but rounding is none.
        let exact = |edge: DVec3| if edge.length() <= 1e-12 * diagonal.length() { DVec3::ZERO } else { edge };
        let u = exact(along * along.dot(diagonal));
        return Some((u, exact(diagonal - u)));
    }
    let axes: Vec<DVec3> = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().filter(|axis| axis.dot(diagonal) != 0.0).collect();
    let edge = |i: usize| axes.get(i).map_or(DVec3::ZERO, |axis| *axis * axis.dot(diagonal));
    (axes.len() < 3).then(|| (edge(0), edge(1)))
}

fn read_counts(points: &Value, poses_left: usize, reading: &mut Reading) -> Option<(usize, usize)> {
    if let Kind::Struct { body: Body::Positional(items), name } = &points.node.kind
        && items.len() == 2
        && name.is_empty()
    {
        let mut counts = items.iter().enumerate().map(|(i, node)| {
            let whole = |x: f64| x >= 1.0 && x.fract() == 0.0 && x <= MOST_POSES as f64;
            let count = points.child(node, &format!("[{i}]")).number_in(
                "the number of points",
                &format!("whole numbers from 1 to {MOST_POSES}"),
                whole,
                &mut reading.problems,
            );
            count.map(|x| x as usize)
        });
        let (columns, rows) = (counts.next()?, counts.next()?);
        let (columns, rows) = (columns?, rows?);
        if columns.saturating_mul(rows) > poses_left {
            points.problem(
                &mut reading.problems,
                format!("the grid has {} points", columns.saturating_mul(rows)),
                format!("a scene may have {MOST_POSES} poses in all"),
            );
            return None;
        }
        return Some((columns, rows));
    }
    let found = points.described();
    points.problem(
        &mut reading.problems,
        format!("the points of a grid are two numbers, not {found}"),
        "write `(columns, rows)`, such as `(10, 8)`",
    );
    None
}
