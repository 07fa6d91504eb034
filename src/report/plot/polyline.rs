//! Lines in px: cut at the frame, and thinned where the eye would not see the difference.

/// A rectangle in px, y downwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rectangle {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) right: f64,
    pub(super) bottom: f64,
}

impl Rectangle {
    pub(super) fn width(&self) -> f64 {
        self.right - self.left
    }

    pub(super) fn height(&self) -> f64 {
        self.bottom - self.top
    }

    /// Grown on all sides.
    pub(super) fn grown(&self, by: f64) -> Self {
        Self { left: self.left - by, top: self.top - by, right: self.right + by, bottom: self.bottom + by }
    }

    pub(super) fn holds(&self, other: &Self) -> bool {
        self.left <= other.left && self.top <= other.top && self.right >= other.right && self.bottom >= other.bottom
    }

    pub(super) fn overlaps(&self, other: &Self) -> bool {
        self.left < other.right && other.left < self.right && self.top < other.bottom && other.top < self.bottom
    }
}

/// The pieces of a line that lie in a rectangle; a point that is not finite interrupts the line.
pub(super) fn pieces(points: &[[f64; 2]], frame: &Rectangle) -> Vec<Vec<[f64; 2]>> {
    let mut pieces: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut open = false;
    for pair in points.windows(2) {
        let Some((from, to)) = cut(pair[0], pair[1], frame) else {
            open = false;
            continue;
        };
        match pieces.last_mut() {
            Some(piece) if open && piece.last() == Some(&from) => piece.push(to),
            _ => pieces.push(vec![from, to]),
        }
        open = to == pair[1];
    }
    pieces
}

/// The part of a segment in a rectangle (Liang and Barsky 1984).
fn cut(from: [f64; 2], to: [f64; 2], frame: &Rectangle) -> Option<([f64; 2], [f64; 2])> {
    if ![from, to].iter().flatten().all(|c| c.is_finite()) {
        return None;
    }
    let step = [to[0] - from[0], to[1] - from[1]];
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    let sides = [
        (-step[0], from[0] - frame.left),
        (step[0], frame.right - from[0]),
        (-step[1], from[1] - frame.top),
        (step[1], frame.bottom - from[1]),
    ];
    for (towards, room) in sides {
        if towards == 0.0 {
            if room < 0.0 {
                return None;
            }
        } else if towards < 0.0 {
            enter = enter.max(room / towards);
        } else {
            leave = leave.min(room / towards);
        }
    }
    let inside = |x: f64, y: f64| [x.clamp(frame.left, frame.right), y.clamp(frame.top, frame.bottom)];
    let at = |t: f64| match t {
        0.0 => from,
        1.0 => to,
        _ => inside(from[0] + t * step[0], from[1] + t * step[1]),
    };
    (enter <= leave).then(|| (at(enter), at(leave)))
}

/// A polygon cut at a rectangle (Sutherland and Hodgman 1974).
pub(super) fn polygon_in(points: &[[f64; 2]], frame: &Rectangle) -> Vec<[f64; 2]> {
    let mut polygon: Vec<[f64; 2]> = points.iter().copied().filter(|p| p.iter().all(|c| c.is_finite())).collect();
    for (axis, limit, sign) in [(0, frame.left, 1.0), (0, frame.right, -1.0), (1, frame.top, 1.0), (1, frame.bottom, -1.0)] {
        let inside = |p: &[f64; 2]| sign * (p[axis] - limit) >= 0.0;
        let mut kept = Vec::with_capacity(polygon.len() + 4);
        for (index, point) in polygon.iter().enumerate() {
            let before = &polygon[(index + polygon.len() - 1) % polygon.len()];
            if inside(point) != inside(before) {
                let t = (limit - before[axis]) / (point[axis] - before[axis]);
                let mut edge = [before[0] + t * (point[0] - before[0]), before[1] + t * (point[1] - before[1])];
                edge[axis] = limit;
                kept.push(edge);
            }
            if inside(point) {
                kept.push(*point);
            }
        }
        polygon = kept;
    }
    polygon
}

/// Whether a point lies inside a closed polygon (crossings of a ray to the right).
pub(super) fn is_inside(polygon: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let sides = polygon.iter().zip(polygon.iter().cycle().skip(1));
    sides.filter(|(a, b)| (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])).count() % 2 == 1
}

/// Fewer points, none of the line further than `tolerance` from where it was (Douglas and Peucker 1973). Ends stay.
pub(super) fn thinned(points: &[[f64; 2]], tolerance: f64) -> Vec<[f64; 2]> {
    let mut keep = vec![false; points.len()];
    let mut open = Vec::new();
    if let Some(last) = points.len().checked_sub(1) {
        keep[0] = true;
        keep[last] = true;
        open.push((0, last));
    }
    while let Some((first, last)) = open.pop() {
        let furthest = (first + 1..last).map(|i| (distance(points[i], points[first], points[last]), i)).max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((far, index)) = furthest
            && far > tolerance
        {
            keep[index] = true;
            open.extend([(first, index), (index, last)]);
        }
    }
    points.iter().zip(keep).filter(|(_, keep)| *keep).map(|(point, _)| *point).collect()
}

/// Distance of a point from a segment.
fn distance(point: [f64; 2], from: [f64; 2], to: [f64; 2]) -> f64 {
    let (along, offset) = ([to[0] - from[0], to[1] - from[1]], [point[0] - from[0], point[1] - from[1]]);
    let length2 = along[0] * along[0] + along[1] * along[1];
    let t = if length2 > 0.0 { ((offset[0] * along[0] + offset[1] * along[1]) / length2).clamp(0.0, 1.0) } else { 0.0 };
    (offset[0] - t * along[0]).hypot(offset[1] - t * along[1])
}

/// Points along a line, no two neighbours further apart than `step`.
pub(super) fn walked(points: &[[f64; 2]], step: f64) -> Vec<[f64; 2]> {
    let mut walk: Vec<[f64; 2]> = points.first().copied().into_iter().collect();
    for pair in points.windows(2) {
        let along = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
        let steps = (along[0].hypot(along[1]) / step).ceil().clamp(1.0, 1e4) as usize;
        walk.extend((1..=steps).map(|i| {
            let t = i as f64 / steps as f64;
            [pair[0][0] + t * along[0], pair[0][1] + t * along[1]]
        }));
    }
    walk
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const FRAME: Rectangle = Rectangle { left: 0.0, top: 0.0, right: 10.0, bottom: 10.0 };

    #[test]
    fn a_line_that_leaves_the_frame_comes_back_as_another_piece() {
        let line = [[1.0, 5.0], [5.0, 15.0], [9.0, 5.0], [f64::NAN, 0.0], [2.0, 2.0], [3.0, 3.0]];
        assert_eq!(pieces(&line, &FRAME), [vec![[1.0, 5.0], [3.0, 10.0]], vec![[7.0, 10.0], [9.0, 5.0]], vec![[2.0, 2.0], [3.0, 3.0]]]);
    }

    #[test]
    fn a_polygon_is_cut_at_the_frame() {
        let area = |p: &[[f64; 2]]| -> f64 {
            (0..p.len())
                .map(|i| {
                    let (a, b) = (p[i], p[(i + 1) % p.len()]);
                    0.5 * (a[0] * b[1] - b[0] * a[1])
                })
                .sum::<f64>()
                .abs()
        };
        let diamond = [[5.0, -5.0], [15.0, 5.0], [5.0, 15.0], [-5.0, 5.0]];
        assert!((area(&polygon_in(&diamond, &FRAME)) - 100.0).abs() < 1e-9);
        let half = [[-5.0, 2.0], [5.0, 2.0], [5.0, 4.0], [-5.0, 4.0]];
        assert!((area(&polygon_in(&half, &FRAME)) - 10.0).abs() < 1e-9);
    }

    proptest! {
        #[test]
        fn pieces_stay_in_the_frame_and_thinning_keeps_to_the_line(
            points in proptest::collection::vec([-20.0..30.0_f64, -20.0..30.0_f64], 2..40),
        ) {
            for piece in pieces(&points, &FRAME) {
                let inside = piece.iter().all(|p| FRAME.grown(1e-9).holds(&Rectangle { left: p[0], right: p[0], top: p[1], bottom: p[1] }));
                prop_assert!(inside);
                let thin = thinned(&piece, 0.1);
                for point in &piece {
                    let nearest = thin.windows(2).map(|pair| distance(*point, pair[0], pair[1])).fold(f64::INFINITY, f64::min);
                    prop_assert!(nearest <= 0.1 + 1e-12);
                }
            }
        }
    }
}
