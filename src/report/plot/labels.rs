//! Names of curves and points, written beside what they name.
//!
//! Every label has candidates: boxes around places of its curve. A candidate that touches any line, text or edge is out. What remains is
//! rated: near its own curve, far from others, near the peak or an end. Labels are set one after the other, those with the fewest
//! candidates first, and then each is tried again while the others stay.

use super::polyline::{Rectangle, walked};

/// What a label is for, and where it may stand.
#[derive(Debug, Clone)]
pub(super) struct Request {
    /// Size of its box, px.
    pub(super) size: [f64; 2],
    /// Lines of what it names, px; a single point for a point.
    pub(super) lines: Vec<Vec<[f64; 2]>>,
    /// Which obstacle is its own.
    pub(super) own: usize,
    /// How far its box keeps from what it names, px.
    pub(super) clear: f64,
}

/// Something no label may cover, px.
#[derive(Debug, Clone)]
pub(super) struct Obstacle {
    pub(super) lines: Vec<Vec<[f64; 2]>>,
    /// Half the width of the line.
    pub(super) half_width: f64,
}

/// How much of each cell of the picture an obstacle covers, as sums from the corner.
struct Cover {
    across: usize,
    cell: f64,
    sums: Vec<u32>,
}

impl Cover {
    fn new(obstacles: &[&Obstacle], cell: f64, size: [f64; 2]) -> Self {
        let (across, down) = ((size[0] / cell).ceil() as usize + 1, (size[1] / cell).ceil() as usize + 1);
        let mut sums = vec![0u32; (across + 1) * (down + 1)];
        for obstacle in obstacles {
            let reach = (obstacle.half_width / cell).floor() as i64;
            for point in obstacle.lines.iter().flat_map(|line| walked(line, 0.5 * cell)) {
                let (x, y) = ((point[0] / cell) as i64, (point[1] / cell) as i64);
                for (x, y) in (x - reach..=x + reach).flat_map(|x| (y - reach..=y + reach).map(move |y| (x, y))) {
                    if (0..across as i64).contains(&x) && (0..down as i64).contains(&y) {
                        sums[(y as usize + 1) * (across + 1) + x as usize + 1] = 1;
                    }
                }
            }
        }
        for y in 1..=down {
            for x in 1..=across {
                let at = y * (across + 1) + x;
                // The row's own sum so far, plus the rows above: as a difference of sums it never goes below zero.
                sums[at] = sums[at] + sums[at - 1] + sums[at - across - 1] - sums[at - across - 2];
            }
        }
        Self { across, cell, sums }
    }

    /// Number of covered cells a box touches.
    fn within(&self, area: &Rectangle) -> u32 {
        let down = self.sums.len() / (self.across + 1) - 1;
        let low = |v: f64, most: usize| ((v / self.cell).floor().max(0.0) as usize).min(most);
        let high = |v: f64, most: usize| (((v / self.cell).floor() + 1.0).max(0.0) as usize).min(most);
        let (left, right) = (low(area.left, self.across), high(area.right, self.across));
        let (top, bottom) = (low(area.top, down), high(area.bottom, down));
        let sum = |x: usize, y: usize| self.sums[y * (self.across + 1) + x];
        (sum(right, bottom) + sum(left, top)).saturating_sub(sum(left, bottom) + sum(right, top))
    }
}

/// Places every label, or says `None` for those that find no room. `em` is the size of the text.
pub(super) fn place(
    requests: &[Request],
    obstacles: &[Obstacle],
    texts: &[Rectangle],
    frame: &Rectangle,
    em: f64,
) -> Vec<Option<Rectangle>> {
    let cell = 0.15 * em;
    let size = [frame.right + em, frame.bottom + em];
    let all = Cover::new(&obstacles.iter().collect::<Vec<_>>(), cell, size);
    let candidates: Vec<Vec<(f64, Rectangle)>> = requests
        .iter()
        .map(|request| {
            let others: Vec<&Obstacle> = obstacles.iter().enumerate().filter(|(i, _)| *i != request.own).map(|(_, o)| o).collect();
            candidates(request, &all, &Cover::new(&others, cell, size), texts, frame, em)
        })
        .collect();

    let mut order: Vec<usize> = (0..requests.len()).collect();
    order.sort_by_key(|i| candidates[*i].len());
    let mut placed: Vec<Option<Rectangle>> = vec![None; requests.len()];
    for _ in 0..4 {
        for index in &order {
            let free = |area: &Rectangle| {
                let apart = area.grown(0.45 * em);
                placed.iter().enumerate().all(|(other, taken)| other == *index || taken.is_none_or(|taken| !taken.overlaps(&apart)))
            };
            let best = candidates[*index].iter().find(|(_, area)| free(area)).map(|(_, area)| *area);
            placed[*index] = best;
        }
    }
    placed
}

/// Where a label may stand, best first.
fn candidates(request: &Request, all: &Cover, others: &Cover, texts: &[Rectangle], frame: &Rectangle, em: f64) -> Vec<(f64, Rectangle)> {
    let [width, height] = request.size;
    let mut found = Vec::new();
    for line in &request.lines {
        let walk = walked(line, 2.0 * all.cell);
        let Some(peak) = walk.iter().copied().min_by(|a, b| a[1].total_cmp(&b[1])) else { continue };
        let (first, last) = (walk[0], walk[walk.len() - 1]);
        for anchor in &walk {
            let from = |place: [f64; 2]| (anchor[0] - place[0]).hypot(anchor[1] - place[1]) / frame.width();
            // Where lines run together a label could be any one's.
            let alone = Rectangle { left: anchor[0], top: anchor[1], right: anchor[0], bottom: anchor[1] }.grown(0.4 * em);
            let shared = if others.within(&alone) > 0 { 2.0 } else { 0.0 };
            let favour = shared + from(peak).min(from(last) + 0.05).min(from(first) + 0.1);
            for (ring, gap) in [0.0, 0.25, 0.55, 0.95].into_iter().enumerate() {
                let gap = request.clear + gap * em;
                for (dx, dy) in [(1.0, 0.0), (-1.0, 0.0), (0.0, -1.0), (0.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
                    // Of a diagonal only the corner is near, so it moves in.
                    let reach = if dx != 0.0 && dy != 0.0 { 0.6 * gap } else { gap };
                    let left = anchor[0] + dx * reach + width * (0.5 * dx - 0.5);
                    let top = anchor[1] + dy * reach + height * (0.5 * dy - 0.5);
                    let area = Rectangle { left, top, right: left + width, bottom: top + height };
                    let clear = area.grown(0.14 * em);
                    if !frame.grown(-0.2 * em).holds(&area)
                        || all.within(&clear) > 0
                        || texts.iter().any(|text| text.overlaps(&area.grown(0.3 * em)))
                    {
                        continue;
                    }
                    let near = f64::from(others.within(&area.grown(0.45 * em)).min(40)) / 40.0;
                    let around = f64::from(others.within(&area.grown(1.1 * em)).min(80)) / 80.0;
                    let below = if dy > 0.0 { 0.06 } else { 0.0 };
                    found.push((favour + 0.12 * ring as f64 + 0.9 * near + 0.5 * around + below, area));
                }
            }
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const FRAME: Rectangle = Rectangle { left: 0.0, top: 0.0, right: 400.0, bottom: 300.0 };

    fn touches(line: &[[f64; 2]], area: &Rectangle) -> bool {
        walked(line, 0.2).iter().any(|p| area.overlaps(&Rectangle { left: p[0], right: p[0] + 1e-9, top: p[1], bottom: p[1] + 1e-9 }))
    }

    proptest! {
        #[test]
        fn labels_cover_neither_lines_nor_each_other(
            curves in proptest::collection::vec((50.0..350.0_f64, 10.0..80.0_f64, 20.0..280.0_f64, 20.0..90.0_f64), 1..6),
        ) {
            let lines: Vec<Vec<[f64; 2]>> = curves.iter().map(|(centre, width, height, _)| {
                (0..=400).map(|x| [f64::from(x), 299.0 - height * (-((f64::from(x) - centre) / width).powi(2)).exp()]).collect()
            }).collect();
            let obstacles: Vec<Obstacle> = lines.iter().map(|line| Obstacle { lines: vec![line.clone()], half_width: 1.0 }).collect();
            let requests: Vec<Request> = curves.iter().enumerate().map(|(own, curve)| {
                Request { size: [curve.3, 10.0], lines: vec![lines[own].clone()], own, clear: 4.0 }
            }).collect();
            let placed = place(&requests, &obstacles, &[], &FRAME, 12.0);
            for (index, area) in placed.iter().enumerate() {
                let Some(area) = area else { continue };
                prop_assert!(FRAME.holds(area));
                prop_assert!(lines.iter().all(|line| !touches(line, area)));
                prop_assert!(placed.iter().skip(index + 1).flatten().all(|other| !other.overlaps(area)));
            }
        }
    }
}
