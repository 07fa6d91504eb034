//! From a [`Chart`] to SVG: layout, lines and areas, then the labels where there is room.

use super::axis;
use super::canvas::{Canvas, Paint, Stroke, gradient};
use super::chart::{Anchor, Axis, Chart, Curve, Dash, Ink, Under};
use super::error::PlotError;
use super::labels::{self, Obstacle, Placed, Request};
use super::layout::{self, KEY_SAMPLE_EM, Layout};
use super::polyline::{Rectangle, is_inside, pieces, polygon_in, thinned};
use super::shade;
use super::style::{Look, Size, Style};
use super::text::{CAP_EM, DESCENT_EM, FAMILY, Ruler, Weight, Written, escaped, number, plain};

/// Most curves that are named at the curve itself; more get a legend.
const MOST_DIRECT_LABELS: usize = 12;

/// Furthest a drawn line may be from the true one, px.
const THINNING_PX: f64 = 0.04;

/// The picture of a chart as an SVG document. Errors if an axis has no range or the picture is too small for its texts.
pub fn svg(chart: &Chart, style: &Style) -> Result<String, PlotError> {
    for axis in [&chart.x, &chart.y].into_iter().chain(&chart.impulse_axis) {
        if !axis::is_range(axis) {
            return Err(PlotError::Range { axis: axis.name(), from: axis.from, to: axis.to });
        }
    }
    let mut look = style.look(chart.proportion);
    let announced = layout::texts(chart);
    let ruler = Ruler::new(announced.iter().map(|(text, weight)| (text.as_str(), *weight)))?;
    let named = chart.curves.iter().filter(|curve| !curve.text().is_empty()).count();
    if named <= MOST_DIRECT_LABELS {
        let layout = layout::layout(chart, &look, &ruler, false)?;
        if let Some(labels) = direct_labels(chart, &look, &ruler, &layout) {
            return document(chart, &look, &layout, &labels);
        }
    }
    let mut layout = layout::layout(chart, &look, &ruler, true);
    // On a page only the width is given: a legend below the plot makes the picture taller.
    for _ in 0..8 {
        if layout.is_ok() || !matches!(style.size, Size::Paper | Size::Column) {
            break;
        }
        look = style.look(Some(1.2 * look.height / look.width));
        layout = layout::layout(chart, &look, &ruler, true);
    }
    let layout = layout?;
    let labels = point_labels(chart, &look, &ruler, &layout);
    document(chart, &look, &layout, &labels)
}

/// Where the frame has a point of the chart, px; far outside rather than infinite.
fn place(chart: &Chart, frame: &Rectangle, point: [f64; 2]) -> [f64; 2] {
    place_on(&chart.x, &chart.y, frame, point)
}

fn place_on(x: &Axis, y: &Axis, frame: &Rectangle, point: [f64; 2]) -> [f64; 2] {
    let far = |place: f64| place.clamp(-1e3, 1e3);
    [frame.left + far(axis::place(x, point[0])) * frame.width(), frame.bottom - far(axis::place(y, point[1])) * frame.height()]
}

fn on_page(chart: &Chart, frame: &Rectangle, points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    points.iter().map(|point| place(chart, frame, *point)).collect()
}

/// The lines of a curve inside the frame.
fn lines_of(chart: &Chart, frame: &Rectangle, points: &[[f64; 2]]) -> Vec<Vec<[f64; 2]>> {
    pieces(&on_page(chart, frame, points), frame).iter().map(|piece| thinned(piece, THINNING_PX)).collect()
}

fn radius_px(look: &Look, radius: f64) -> f64 {
    0.26 * look.text_px * radius
}

/// Axis on which the impulses stand.
fn impulse_axis(chart: &Chart) -> &Axis {
    chart.impulse_axis.as_ref().unwrap_or(&chart.y)
}

/// Foot and head of an impulse, px.
fn impulse_line(chart: &Chart, frame: &Rectangle, x: f64, height: f64) -> Vec<Vec<[f64; 2]>> {
    let [at, head] = place_on(&chart.x, impulse_axis(chart), frame, [x, height]);
    pieces(&[[at, frame.bottom], [at, head]], frame)
}

/// Everything a label has to keep clear of: curves, impulses, points; in this order.
fn obstacles(chart: &Chart, look: &Look, frame: &Rectangle) -> Vec<Obstacle> {
    let curves = chart.curves.iter().map(|c| {
        let lines = if c.ink == Ink::Grid { Vec::new() } else { lines_of(chart, frame, &c.points) };
        Obstacle { lines, half_width: 0.5 * look.line_px * c.width }
    });
    let impulses =
        chart.impulses.iter().map(|i| Obstacle { lines: impulse_line(chart, frame, i.x, i.height), half_width: 0.5 * look.line_px });
    let points = chart.points.iter().map(|p| {
        let at = place(chart, frame, p.at);
        Obstacle { lines: vec![vec![at]], half_width: radius_px(look, p.radius) }
    });
    curves.chain(impulses).chain(points).collect()
}

/// Boxes of notes and names of spans, which stay where they are.
fn fixed_texts(chart: &Chart, look: &Look, frame: &Rectangle) -> Vec<Written> {
    let em = look.text_px;
    let size = 0.94 * em;
    let notes = chart.notes.iter().map(|note| {
        let [x, y] = place(chart, frame, note.at);
        Written {
            text: note.text.clone(),
            x: x + note.shift_em[0] * size,
            baseline: y - note.shift_em[1] * size + 0.5 * CAP_EM * size,
            size_px: size,
            weight: Weight::Regular,
            anchor: note.anchor,
            colour: look.colour(note.ink),
        }
    });
    let spans = chart.spans.iter().filter(|span| !span.label.is_empty()).map(|span| {
        let [x, _] = place(chart, frame, [span.from, chart.y.to]);
        let [end, _] = place(chart, frame, [span.to, chart.y.to]);
        let middle = 0.5 * (x.clamp(frame.left, frame.right) + end.clamp(frame.left, frame.right));
        let colour = look.muted;
        Written {
            text: span.label.clone(),
            x: middle,
            baseline: frame.top + 1.3 * size,
            size_px: size,
            weight: Weight::Regular,
            anchor: Anchor::Middle,
            colour,
        }
    });
    notes.chain(spans).collect()
}

/// Box of a written line.
fn box_of(written: &Written, ruler: &Ruler) -> Rectangle {
    let width = ruler.width(&written.text, written.weight, written.size_px);
    let left = match written.anchor {
        Anchor::Start => written.x,
        Anchor::Middle => written.x - 0.5 * width,
        Anchor::End => written.x - width,
    };
    let (top, bottom) = (written.baseline - CAP_EM * written.size_px, written.baseline + DESCENT_EM * written.size_px);
    Rectangle { left, top, right: left + width, bottom }
}

/// Names beside what they name, and the lines that lead to those further away.
#[derive(Debug, Default)]
struct Labels {
    texts: Vec<Written>,
    leaders: Vec<([[f64; 2]; 2], [u8; 3])>,
}

struct Wanted {
    text: String,
    ink: Ink,
    request: Request,
    /// Whether a picture without this label would be wrong.
    needed: bool,
}

fn wanted(chart: &Chart, look: &Look, ruler: &Ruler, obstacles: &[Obstacle], curves: bool) -> Vec<Wanted> {
    let em = look.text_px;
    let size = |text: &str| [ruler.width(text, Weight::Regular, em), (CAP_EM + DESCENT_EM) * em];
    let mut wanted = Vec::new();
    for (own, curve) in chart.curves.iter().enumerate() {
        if curves && !curve.text().is_empty() && !obstacles[own].lines.is_empty() {
            let request = Request { size: size(curve.text()), lines: obstacles[own].lines.clone(), own, clear: 0.45 * em, may_cross: true };
            wanted.push(Wanted { text: curve.text().to_owned(), ink: look.readable(curve.ink), request, needed: true });
        }
    }
    for (index, impulse) in chart.impulses.iter().enumerate() {
        let own = chart.curves.len() + index;
        // Only the head: a name half-way up would be taken for a place on the wavelength axis.
        let head = obstacles[own].lines.iter().flatten().copied().min_by(|a, b| a[1].total_cmp(&b[1]));
        if let (false, Some(head)) = (impulse.label.is_empty(), head) {
            let request = Request { size: size(&impulse.label), lines: vec![vec![head]], own, clear: 0.45 * em, may_cross: false };
            // The colour of one spectrum among several names it; the colour of a wavelength does not.
            let ink = if matches!(impulse.ink, Ink::Palette(_)) { impulse.ink } else { Ink::Text };
            wanted.push(Wanted { text: impulse.label.clone(), ink, request, needed: false });
        }
    }
    for (index, point) in chart.points.iter().enumerate() {
        let own = chart.curves.len() + chart.impulses.len() + index;
        if point.written && !point.label.is_empty() {
            let clear = radius_px(look, point.radius) + 0.3 * em;
            let request = Request { size: size(&point.label), lines: obstacles[own].lines.clone(), own, clear, may_cross: false };
            wanted.push(Wanted { text: point.label.clone(), ink: Ink::Text, request, needed: false });
        }
    }
    wanted
}

/// Labels of curves, impulses and points; `None` if a curve's finds no room.
fn direct_labels(chart: &Chart, look: &Look, ruler: &Ruler, layout: &Layout) -> Option<Labels> {
    labels_of(chart, look, ruler, layout, true)
}

/// Labels of impulses and points where there is room.
fn point_labels(chart: &Chart, look: &Look, ruler: &Ruler, layout: &Layout) -> Labels {
    labels_of(chart, look, ruler, layout, false).unwrap_or_default()
}

fn labels_of(chart: &Chart, look: &Look, ruler: &Ruler, layout: &Layout, curves: bool) -> Option<Labels> {
    let em = look.text_px;
    let obstacles = obstacles(chart, look, &layout.frame);
    let wanted = wanted(chart, look, ruler, &obstacles, curves);
    let fixed: Vec<Rectangle> = fixed_texts(chart, look, &layout.frame).iter().map(|written| box_of(written, ruler)).collect();
    let requests: Vec<Request> = wanted.iter().map(|wanted| wanted.request.clone()).collect();
    let placed = labels::place(&requests, &obstacles, &fixed, &layout.frame, em);
    let mut labels = Labels::default();
    let shade = chart.shade.as_ref().map(|shade| on_page(chart, &layout.frame, &shade.outline));
    for (wanted, area) in wanted.iter().zip(placed) {
        let Some(Placed { area, leader }) = area else {
            if wanted.needed {
                return None;
            }
            continue;
        };
        let baseline = area.bottom - DESCENT_EM * em;
        let middle = [0.5 * (area.left + area.right), 0.5 * (area.top + area.bottom)];
        let on_shade = wanted.ink == Ink::Text && shade.as_ref().is_some_and(|outline| is_inside(outline, middle));
        let colour = look.colour(if on_shade { Ink::OnShade } else { wanted.ink });
        if let Some(line) = leader {
            labels.leaders.push((line, colour));
        }
        labels.texts.push(Written {
            text: wanted.text.clone(),
            x: area.left,
            baseline,
            size_px: em,
            weight: Weight::Regular,
            anchor: Anchor::Start,
            colour,
        });
    }
    Some(labels)
}

/// A name for the gradient that no other picture on the same page bears.
fn gradient_name(chart: &Chart) -> String {
    let bytes = chart.title.bytes().chain(chart.subtitle.bytes()).chain(chart.strip.iter().flat_map(|stop| stop.colour));
    let bytes = bytes.chain(chart.x.from.to_bits().to_le_bytes()).chain(chart.x.to.to_bits().to_le_bytes());
    // Fowler, Noll and Vo's hash, 64 bit.
    let hash = bytes.fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3));
    format!("strip-{:08x}", hash as u32)
}

fn document(chart: &Chart, look: &Look, layout: &Layout, labels: &Labels) -> Result<String, PlotError> {
    let frame = &layout.frame;
    let mut canvas = Canvas::new(look.width, look.height);
    let strip_name = gradient_name(chart);
    canvas.rectangle(&Rectangle { left: 0.0, top: 0.0, right: look.width, bottom: look.height }, Paint::Plain(look.background), 1.0)?;
    behind(chart, look, layout, &mut canvas)?;
    if let Some(shade) = &chart.shade {
        canvas.elements += &shade::svg(shade, &strip_name, look.shade, frame, |point| place(chart, frame, point));
    }
    for area in &chart.areas {
        let polygon = polygon_in(&on_page(chart, frame, &area.points), frame);
        canvas.area(&thinned(&polygon, THINNING_PX), Paint::Plain(look.colour(area.ink)), area.opacity)?;
    }
    for curve in &chart.curves {
        let (paint, opacity) = match curve.under {
            Under::Nothing => continue,
            Under::Tint => (Paint::Plain(look.colour(curve.ink)), look.tint),
            Under::Spectral if chart.strip.is_empty() => (Paint::Plain(look.colour(curve.ink)), look.tint),
            Under::Spectral => (Paint::Gradient(&strip_name), 0.85),
        };
        for piece in lines_of(chart, frame, &curve.points) {
            let ends = [piece.last(), piece.first()].map(|end| end.map(|end| [end[0], frame.bottom]));
            canvas.area(&[piece.as_slice(), &ends.into_iter().flatten().collect::<Vec<_>>()].concat(), paint, opacity)?;
        }
    }
    for band in &chart.bands {
        let upper = band.points.iter().map(|p| [p[0], p[2]]);
        let outline: Vec<[f64; 2]> = upper.chain(band.points.iter().rev().map(|p| [p[0], p[1]])).collect();
        let polygon = polygon_in(&on_page(chart, frame, &outline), frame);
        canvas.area(&thinned(&polygon, THINNING_PX), Paint::Plain(look.colour(band.ink)), 1.4 * look.tint)?;
    }
    if let Some(strip) = &layout.strip {
        canvas.rectangle(strip, Paint::Gradient(&strip_name), 1.0)?;
    }
    for (key, at) in chart.keys.iter().zip(&layout.keys) {
        let line = vec![*at, [at[0] + KEY_SAMPLE_EM * look.text_px, at[1]]];
        canvas.lines(&[line], Stroke { colour: look.text, width_px: look.line_px * key.width, dash: key.dash })?;
    }
    // What is muted stands behind.
    for muted in [true, false] {
        for curve in chart.curves.iter().filter(|curve| matches!(curve.ink, Ink::Muted | Ink::Grid) == muted) {
            let lines = lines_of(chart, frame, &curve.points);
            stroke(&mut canvas, look, &lines, curve, look.line_px * curve.width)?;
        }
    }
    for impulse in &chart.impulses {
        let stroke = Stroke { colour: look.colour(impulse.ink), width_px: look.line_px, dash: Dash::Solid };
        canvas.lines(&impulse_line(chart, frame, impulse.x, impulse.height), stroke)?;
    }
    for (line, colour) in &labels.leaders {
        canvas.hairs(&[line.to_vec()], *colour, look.hair_px)?;
    }
    for point in &chart.points {
        let at = place(chart, frame, point.at);
        if frame.grown(1.0).holds(&Rectangle { left: at[0], right: at[0], top: at[1], bottom: at[1] }) {
            let rim = if chart.shade.is_some() { [255, 255, 255] } else { look.background };
            canvas.disc(at, radius_px(look, point.radius) + 0.1 * look.text_px, rim)?;
            canvas.disc(at, radius_px(look, point.radius), look.colour(point.ink))?;
        }
    }
    for row in &layout.legend {
        let curve = &chart.curves[row.curve];
        let line = vec![row.sample, [row.sample[0] + row.sample_px, row.sample[1]]];
        stroke(&mut canvas, look, &[line], curve, 1.2 * look.line_px * curve.width)?;
    }

    let (width, height) = &look.stated;
    let view = format!("{} {}", number(look.width), number(look.height));
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {view}\" role=\"img\" font-family=\"{FAMILY}\">\n\
         <title>{}</title>\n<desc>{}</desc>\n",
        escaped(&plain(&chart.title)),
        escaped(&plain(&description(chart))),
    );
    if !chart.strip.is_empty() {
        let stops: Vec<_> = chart.strip.iter().map(|stop| (axis::place(&chart.x, stop.x), stop.colour, stop.opacity)).collect();
        out += &format!("<defs>\n{}</defs>\n", gradient(&strip_name, frame.left, frame.right, &stops));
    }
    out += &canvas.elements;
    let legend = layout.legend.iter().map(|row| &row.text);
    let fixed = fixed_texts(chart, look, frame);
    for written in layout.texts.iter().chain(legend).chain(&fixed).chain(&labels.texts) {
        out += &written.svg();
    }
    Ok(out + "</svg>\n")
}

/// The lines of a curve; one that hardly differs from the background gets a dark rim.
fn stroke(canvas: &mut Canvas, look: &Look, lines: &[Vec<[f64; 2]>], curve: &Curve, width_px: f64) -> Result<(), PlotError> {
    if look.is_faint(curve.ink) {
        canvas.lines(lines, Stroke { colour: look.muted, width_px: width_px + 1.2 * look.hair_px, dash: Dash::Solid })?;
    }
    canvas.lines(lines, Stroke { colour: look.colour(curve.ink), width_px, dash: curve.dash })
}

/// Axes and curves in words, for those who do not see the picture.
fn description(chart: &Chart) -> String {
    let names: Vec<&str> = chart.curves.iter().map(|curve| curve.label.as_str()).filter(|label| !label.is_empty()).collect();
    format!("{}. {} against {}. {}", chart.subtitle, chart.y.name(), chart.x.name(), names.join("; "))
}

/// Spans and grid.
fn behind(chart: &Chart, look: &Look, layout: &Layout, canvas: &mut Canvas) -> Result<(), PlotError> {
    let frame = &layout.frame;
    for span in &chart.spans {
        let corners = [[span.from, chart.y.from], [span.to, chart.y.from], [span.to, chart.y.to], [span.from, chart.y.to]];
        canvas.area(&polygon_in(&on_page(chart, frame, &corners), frame), Paint::Plain(look.span), 1.0)?;
    }
    let upright = layout.x_ticks.iter().map(|tick| frame.left + axis::place(&chart.x, tick.value) * frame.width());
    let mut grid: Vec<Vec<[f64; 2]>> = upright.map(|x| vec![[x, frame.top], [x, frame.bottom]]).collect();
    let level = layout.y_ticks.iter().map(|tick| frame.bottom - axis::place(&chart.y, tick.value) * frame.height());
    grid.extend(level.map(|y| vec![[frame.left, y], [frame.right, y]]));
    canvas.hairs(&grid, look.grid, look.hair_px)
}
