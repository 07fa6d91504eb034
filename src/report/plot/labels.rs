//! Names of curves and points, written beside what they name.
//!
//! Every label has candidates: boxes around places of its curve. A candidate that touches any line, text or edge is out. What remains is
//! rated: near its own curve, far from others, near the peak or an end. Labels are set one after the other, those with the fewest
//! candidates first, and then each is tried again while the others stay.

use super::polyline::{Rectangle, pieces, walked};

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
    /// Whether a leader may cross other lines.
    pub(super) may_cross: bool,
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

/// Where a label stands, and the line that leads to it if it stands far from what it names.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Placed {
    pub(super) area: Rectangle,
    pub(super) leader: Option<[[f64; 2]; 2]>,
}

/// Places every label, or says `None` for those that find no room. `em` is the size of the text.
pub(super) fn place(requests: &[Request], obstacles: &[Obstacle], texts: &[Rectangle], frame: &Rectangle, em: f64) -> Vec<Option<Placed>> {
    let cell = 0.15 * em;
    let size = [frame.right + em, frame.bottom + em];
    let all = Cover::new(&obstacles.iter().collect::<Vec<_>>(), cell, size);
    let candidates: Vec<Vec<Candidate>> = requests
        .iter()
        .map(|request| {
            let others: Vec<&Obstacle> = obstacles.iter().enumerate().filter(|(i, _)| *i != request.own).map(|(_, o)| o).collect();
            let site = Site { request, all: &all, others: &Cover::new(&others, cell, size), texts, frame, em };
            site.candidates()
        })
        .collect();

    let mut order: Vec<usize> = (0..requests.len()).collect();
    order.sort_by_key(|i| candidates[*i].len());
    let mut placed: Vec<Option<Placed>> = vec![None; requests.len()];
    for _ in 0..4 {
        for index in &order {
            let free = |candidate: &Candidate| {
                let apart = candidate.placed.area.grown(0.45 * em);
                let leads = candidate.placed.leader;
                placed.iter().enumerate().filter(|(other, _)| other != index).filter_map(|(_, taken)| *taken).all(|taken| {
                    !taken.area.overlaps(&apart)
                        && leads.is_none_or(|line| !crosses(&line, &taken.area))
                        && taken.leader.is_none_or(|line| !crosses(&line, &apart))
                })
            };
            let best = candidates[*index].iter().find(|candidate| free(candidate)).map(|candidate| candidate.placed);
            placed[*index] = best;
        }
    }
    placed
}

/// Whether a straight line meets a box.
fn crosses(line: &[[f64; 2]; 2], area: &Rectangle) -> bool {
    !pieces(line, area).is_empty()
}

/// A place and how bad it is.
struct Candidate {
    cost: f64,
    placed: Placed,
}

/// What the places of one label are judged by.
struct Site<'a> {
    request: &'a Request,
    all: &'a Cover,
    others: &'a Cover,
    texts: &'a [Rectangle],
    frame: &'a Rectangle,
    em: f64,
}

/// What a place costs where lines run together and a label could be any one's.
const SHARED: f64 = 2.0;

impl Site<'_> {
    /// Where a label may stand, best first; places with a leader cost more than those without.
    fn candidates(&self) -> Vec<Candidate> {
        let mut found = Vec::new();
        for far in [false, true] {
            for line in &self.request.lines {
                let walk = walked(line, 2.0 * self.all.cell);
                let Some(peak) = walk.iter().copied().min_by(|a, b| a[1].total_cmp(&b[1])) else { continue };
                let ends = [(walk[walk.len() - 1], 0.05), (walk[0], 0.1)];
                for anchor in &walk {
                    let from = |place: [f64; 2]| (anchor[0] - place[0]).hypot(anchor[1] - place[1]) / self.frame.width();
                    let by_end = ends.iter().map(|(place, extra)| from(*place) + extra).fold(f64::INFINITY, f64::min);
                    self.around(*anchor, [from(peak), by_end], far, &mut found);
                }
            }
        }
        found.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        found
    }

    /// Places around one point of the line, near or at the end of a leader. The point is so far from the peak of the line and from its
    /// ends, in widths of the frame.
    fn around(&self, anchor: [f64; 2], [by_peak, by_end]: [f64; 2], far: bool, found: &mut Vec<Candidate>) {
        let (em, [width, height]) = (self.em, self.request.size);
        let alone = Rectangle { left: anchor[0], top: anchor[1], right: anchor[0], bottom: anchor[1] }.grown(0.4 * em);
        let shared = self.others.within(&alone) > 0;
        if far && shared {
            return;
        }
        // Where all lines run together at an end, a label says nothing; near the peak it at least says where.
        let favour = if shared { SHARED + by_peak } else { by_peak.min(by_end) };
        let gaps: &[f64] = if far { &[1.6, 2.4, 3.4, 4.6] } else { &[0.0, 0.25, 0.55, 0.95] };
        for (ring, gap) in gaps.iter().enumerate() {
            let gap = self.request.clear + gap * em;
            for (dx, dy) in [(1.0, 0.0), (-1.0, 0.0), (0.0, -1.0), (0.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
                // Of a diagonal only the corner is near, so it moves in.
                let reach = if dx != 0.0 && dy != 0.0 { 0.6 * gap } else { gap };
                let left = anchor[0] + dx * reach + width * (0.5 * dx - 0.5);
                let top = anchor[1] + dy * reach + height * (0.5 * dy - 0.5);
                let area = Rectangle { left, top, right: left + width, bottom: top + height };
                if !self.frame.grown(-0.2 * em).holds(&area)
                    || self.all.within(&area.grown(0.14 * em)) > 0
                    || self.texts.iter().any(|text| text.overlaps(&area.grown(0.3 * em)))
                {
                    continue;
                }
                let near = f64::from(self.others.within(&area.grown(0.45 * em)).min(40)) / 40.0;
                let around = f64::from(self.others.within(&area.grown(1.1 * em)).min(80)) / 80.0;
                let below = if dy > 0.0 { 0.06 } else { 0.0 };
                let mut cost = favour + 0.12 * ring as f64 + 0.9 * near + 0.5 * around + below;
                let leader = far.then(|| {
                    // From the line to the side of the box, with a little air at the text.
                    let end = |d: f64| reach - if d == 0.0 { 0.0 } else { 0.25 * em };
                    [anchor, [anchor[0] + dx * end(dx), anchor[1] + dy * end(dy)]]
                });
                if let Some(line) = leader {
                    let met = walked(&line, self.all.cell).iter().filter(|p| self.others.within(&point_box(p)) > 0).count();
                    cost += 0.8 + 0.1 * met as f64;
                    if (met > 0 && !self.request.may_cross) || self.texts.iter().any(|text| crosses(&line, text)) {
                        continue;
                    }
                }
                found.push(Candidate { cost, placed: Placed { area, leader } });
            }
        }
    }
}

fn point_box(point: &[f64; 2]) -> Rectangle {
    Rectangle { left: point[0], top: point[1], right: point[0], bottom: point[1] }
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
                Request { size: [curve.3, 10.0], lines: vec![lines[own].clone()], own, clear: 4.0, may_cross: true }
            }).collect();
            let placed = place(&requests, &obstacles, &[], &FRAME, 12.0);
            for (index, area) in placed.iter().enumerate() {
                let Some(Placed { area, .. }) = area else { continue };
                prop_assert!(FRAME.holds(area));
                prop_assert!(lines.iter().all(|line| !touches(line, area)));
                prop_assert!(placed.iter().skip(index + 1).flatten().all(|other| !other.area.overlaps(area)));
            }
        }
    }
}
