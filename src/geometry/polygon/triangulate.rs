//! Simple polygons → triangles, by cutting ears: a corner whose triangle holds no other corner is cut off, until three are left.
//!
//! Meisters, *Polygons have ears*, American Mathematical Monthly 82 (1975) 648. A convex polygon falls into a fan.

/// Twice the area of a triangle, positive if counter-clockwise.
fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Two edges, by the corners that they start from, that meet elsewhere than in a common corner.
pub(super) fn edges_that_meet(p: &[[f64; 2]]) -> Option<(usize, usize)> {
    let n = p.len();
    let edge = |i: usize| (p[i], p[(i + 1) % n]);
    let dot = |o: [f64; 2], a: [f64; 2], b: [f64; 2]| (a[0] - o[0]) * (b[0] - o[0]) + (a[1] - o[1]) * (b[1] - o[1]);
    for i in 0..n {
        let (a, b) = edge(i);
        let next = edge((i + 1) % n).1;
        // Repeated corners, and edges that run back over the one before.
        if a == b || (turn(a, b, next) == 0.0 && dot(b, a, next) > 0.0) {
            return Some((i, (i + 1) % n));
        }
    }
    for i in 0..n {
        let (a, b) = edge(i);
        for j in i + 2..n {
            if i == 0 && j == n - 1 {
                continue;
            }
            let (c, d) = edge(j);
            let apart = |k: usize| a[k].max(b[k]) < c[k].min(d[k]) || c[k].max(d[k]) < a[k].min(b[k]);
            let straddles = |a, b, c, d| turn(a, b, c) * turn(a, b, d) <= 0.0;
            if !apart(0) && !apart(1) && straddles(a, b, c, d) && straddles(c, d, a, b) {
                return Some((i, j));
            }
        }
    }
    None
}

/// Triangles of a simple polygon whose corners run counter-clockwise, as triples of corners.
pub(super) fn triangles(p: &[[f64; 2]]) -> Vec<[u16; 3]> {
    let mut left: Vec<usize> = (0..p.len()).collect();
    let mut found = Vec::with_capacity(p.len() - 2);
    let mut at = 0;
    let mut refused = 0;
    while left.len() > 3 {
        let n = left.len();
        let [a, b, c] = [left[at % n], left[(at + 1) % n], left[(at + 2) % n]];
        let within = |q: [f64; 2]| turn(p[a], p[b], q) >= 0.0 && turn(p[b], p[c], q) >= 0.0 && turn(p[c], p[a], q) >= 0.0;
        let free = || left.iter().filter(|&&i| i != a && i != b && i != c).all(|&i| !within(p[i]));
        let bend = turn(p[a], p[b], p[c]);
        // A simple polygon has an ear; if rounding hides them all, the next corner is cut off nevertheless.
        if (bend > 0.0 && free()) || bend == 0.0 || refused > n {
            found.push([a as u16, b as u16, c as u16]);
            left.remove((at + 1) % n);
            at %= n - 1;
            refused = 0;
        } else {
            at = (at + 1) % n;
            refused += 1;
        }
    }
    found.push([left[0] as u16, left[1] as u16, left[2] as u16]);
    found
}
