//! Where everything stands: frame of the plot, texts around it, legend. All in px.
//!
//! From the top: title, subtitle, name of the y axis, frame, strip, tick labels, name of the x axis. No text is rotated.

use super::axis::{self, Tick};
use super::chart::{Anchor, Axis, Chart, Scale, Under};
use super::error::PlotError;
use super::polyline::Rectangle;
use super::style::Look;
use super::text::{CAP_EM, Ruler, Weight, Written};

/// Places of the fixed parts of a picture.
#[derive(Debug, Clone)]
pub(super) struct Layout {
    /// The area between the axes.
    pub(super) frame: Rectangle,
    pub(super) x_ticks: Vec<Tick>,
    pub(super) y_ticks: Vec<Tick>,
    /// The band of colours below the frame.
    pub(super) strip: Option<Rectangle>,
    /// Texts around the frame.
    pub(super) texts: Vec<Written>,
    /// Name and sample of each curve, if they are not written at the curves.
    pub(super) legend: Vec<LegendRow>,
    /// Samples of the kinds of lines, each with its left end; their texts are among the others.
    pub(super) keys: Vec<[f64; 2]>,
}

/// A row of the legend.
#[derive(Debug, Clone)]
pub(super) struct LegendRow {
    /// Which curve.
    pub(super) curve: usize,
    /// Left end of the sample of its line.
    pub(super) sample: [f64; 2],
    pub(super) sample_px: f64,
    pub(super) text: Written,
}

/// Every text of a chart, to be measured.
pub(super) fn texts(chart: &Chart) -> Vec<(String, Weight)> {
    let words = |text: &str| text.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    let mut texts: Vec<(String, Weight)> = words(&chart.title).into_iter().map(|word| (word, Weight::Medium)).collect();
    let mut regular = words(&chart.subtitle);
    for axis in [&chart.x, &chart.y].into_iter().chain(&chart.impulse_axis) {
        regular.push(axis.name());
        // More ticks than will stand there: their number is chosen when there is room.
        for wanted in 2..=MOST_TICKS {
            regular.extend(axis::ticks(axis, wanted).into_iter().map(|tick| tick.label));
        }
    }
    regular.extend(chart.keys.iter().map(|key| key.text.clone()));
    regular.extend(chart.notes.iter().map(|note| note.text.clone()));
    texts.extend(regular.into_iter().map(|text| (text, Weight::Regular)));
    let labels = chart.curves.iter().flat_map(|c| [&c.label].into_iter().chain(&c.written)).chain(chart.impulses.iter().map(|i| &i.label));
    let labels = labels.chain(chart.points.iter().map(|p| &p.label)).chain(chart.spans.iter().map(|s| &s.label));
    texts.extend(labels.map(|label| (label.clone(), Weight::Regular)));
    texts
}

const MOST_TICKS: usize = 12;

/// Length of the sample of a line in a key, in sizes of the text.
pub(super) const KEY_SAMPLE_EM: f64 = 2.4;

/// Whether the strip is drawn: not where the colours already fill what is below a curve.
fn has_strip(chart: &Chart) -> bool {
    !chart.strip.is_empty() && chart.curves.iter().all(|curve| curve.under != Under::Spectral)
}

/// Size of tick labels and axis names, of that of the text.
const SMALL: f64 = 0.94;

struct Page<'a> {
    look: &'a Look,
    ruler: &'a Ruler,
    texts: Vec<Written>,
}

impl Page<'_> {
    /// Small text around the frame.
    fn write(&mut self, text: &str, [x, baseline]: [f64; 2], anchor: Anchor, colour: [u8; 3]) {
        let size_px = SMALL * self.look.text_px;
        self.texts.push(Written { text: text.to_owned(), x, baseline, size_px, weight: Weight::Regular, anchor, colour });
    }

    /// Lines of running text from the left margin; the new lower end.
    fn paragraph(&mut self, text: &str, below: f64, size_px: f64, weight: Weight, colour: [u8; 3], margin: f64) -> f64 {
        let mut below = below;
        for line in self.ruler.lines(text, weight, size_px, self.look.width - 2.0 * margin) {
            below += 1.25 * size_px;
            self.texts.push(Written {
                text: line,
                x: margin,
                baseline: below - 0.3 * size_px,
                size_px,
                weight,
                anchor: Anchor::Start,
                colour,
            });
        }
        below
    }
}

/// Lays a chart out; `legend` says whether the names of the curves stand in a legend.
pub(super) fn layout(chart: &Chart, look: &Look, ruler: &Ruler, legend: bool) -> Result<Layout, PlotError> {
    let em = look.text_px;
    let (small, margin) = (SMALL * em, 1.3 * em);
    let mut page = Page { look, ruler, texts: Vec::new() };
    let mut top = page.paragraph(&chart.title, 0.7 * em, look.title_px, Weight::Medium, look.text, margin);
    top = page.paragraph(&chart.subtitle, top + 0.1 * em, em, Weight::Regular, look.muted, margin) + 0.5 * em;
    let named = |axis: &Axis| axis.visible;
    let name_baseline = top + 1.1 * em;
    if named(&chart.y) || chart.impulse_axis.is_some() {
        top += 2.05 * em;
    }
    // Keys stand at the right, in the line of the name of the y axis if there is room, else in a line of their own.
    let key_sample_px = KEY_SAMPLE_EM * em;
    let key_width = |text: &str| key_sample_px + 0.5 * em + ruler.width(text, Weight::Regular, small);
    let keys_width = chart.keys.iter().map(|key| key_width(&key.text) + 1.4 * em).sum::<f64>() - 1.4 * em;
    let names = [Some(&chart.y), chart.impulse_axis.as_ref()].into_iter().flatten();
    let names_width: f64 = names.map(|axis| ruler.width(&axis.name(), Weight::Regular, small) + 2.0 * em).sum();
    let mut keys_baseline = name_baseline;
    if !chart.keys.is_empty() && names_width + keys_width > look.width - 2.0 * margin {
        keys_baseline = name_baseline + 1.5 * em;
        top += 1.5 * em;
    }
    let mut keys = Vec::new();
    let mut key_left = look.width - margin - keys_width;
    if key_left < 0.0 {
        return Err(PlotError::TooSmall { width_px: look.width, height_px: look.height });
    }
    for key in &chart.keys {
        keys.push([key_left, keys_baseline - 0.5 * CAP_EM * small]);
        page.write(&key.text, [key_left + key_sample_px + 0.5 * em, keys_baseline], Anchor::Start, look.text);
        key_left += key_width(&key.text) + 1.4 * em;
    }

    let mut bottom = look.height - 0.9 * em;
    if named(&chart.x) {
        let strip = if has_strip(chart) { 0.95 * em } else { 0.0 };
        bottom -= 1.5 * small + 1.45 * small + 0.4 * em + strip;
    }

    // The legend at the right if it leaves most of the width, else below.
    let rows: Vec<usize> = (0..chart.curves.len()).filter(|i| legend && !chart.curves[*i].text().is_empty()).collect();
    let sample_px = 1.6 * em;
    let widest = rows.iter().map(|i| ruler.width(&chart.curves[*i].label, Weight::Regular, small)).fold(0.0, f64::max);
    let (cell_width, cell_height) = (widest + sample_px + 1.6 * em, 1.32 * small);
    let in_column = (((bottom - top) / cell_height).floor().max(1.0)) as usize;
    let columns = rows.len().div_ceil(in_column);
    let beside = columns as f64 * cell_width <= 0.42 * (look.width - 2.0 * margin);
    let mut legend_at = (look.width - margin - columns as f64 * cell_width + 1.2 * em, top);
    let (mut across, mut down) = (columns.max(1), in_column.min(rows.len().div_ceil(columns.max(1))));
    let mut right = look.width - margin;
    if !rows.is_empty() {
        if beside {
            right = legend_at.0 - 1.2 * em;
        } else {
            across = (((look.width - 2.0 * margin) / cell_width).floor().max(1.0)) as usize;
            down = rows.len().div_ceil(across);
            let block = down as f64 * cell_height + 0.4 * em;
            bottom -= block;
            legend_at = (margin, look.height - 0.6 * em - block + 0.4 * em);
        }
    }

    // Ticks: as many as the height takes, then their widest label gives the left end of the frame.
    let y_ticks = if named(&chart.y) { some_ticks(&chart.y, bottom - top, 3.4 * em) } else { Vec::new() };
    let widest_y = y_ticks.iter().map(|tick| ruler.width(&tick.label, Weight::Regular, small)).fold(0.0, f64::max);
    let mut left = margin + if y_ticks.is_empty() { 0.0 } else { widest_y + 0.6 * em };
    let power_ticks = chart.impulse_axis.as_ref().map(|axis| some_ticks(axis, bottom - top, 3.4 * em)).unwrap_or_default();
    let widest_power = power_ticks.iter().map(|tick| ruler.width(&tick.label, Weight::Regular, small)).fold(0.0, f64::max);
    if !power_ticks.is_empty() {
        right -= widest_power + 0.6 * em;
    }
    if right - left < 8.0 * em || bottom - top < 6.0 * em {
        return Err(PlotError::TooSmall { width_px: look.width, height_px: look.height });
    }
    if chart.equal_scale {
        let span = (chart.x.to - chart.x.from, chart.y.to - chart.y.from);
        let scale = ((right - left) / span.0).min((bottom - top) / span.1);
        let spare = right - left - scale * span.0;
        left += 0.5 * spare;
        right -= 0.5 * spare;
        bottom = top + scale * span.1;
    }
    let frame = Rectangle { left, top, right, bottom };

    let x_ticks = if named(&chart.x) { fitting_x_ticks(&chart.x, &frame, ruler, small, em) } else { Vec::new() };
    let mut below = bottom;
    let strip = has_strip(chart).then(|| {
        below += 0.95 * em;
        Rectangle { left, top: bottom + 0.35 * em, right, bottom: bottom + 0.95 * em }
    });
    for tick in &x_ticks {
        let (width, at) = (ruler.width(&tick.label, Weight::Regular, small), left + axis::place(&chart.x, tick.value) * frame.width());
        // A label at the very end moves in as far as the edge of the picture demands.
        let at = at.clamp(0.3 * em + 0.5 * width, look.width - 0.3 * em - 0.5 * width);
        page.write(&tick.label, [at, below + 0.5 * em + CAP_EM * small], Anchor::Middle, look.muted);
    }
    if named(&chart.x) {
        let baseline = below + 0.4 * em + 1.5 * small + 1.05 * small;
        let half = 0.5 * ruler.width(&chart.x.name(), Weight::Regular, small);
        let middle = (0.5 * (left + right)).clamp(half + 0.5 * margin, (look.width - half - 0.5 * margin).max(half + 0.5 * margin));
        page.write(&chart.x.name(), [middle, baseline], Anchor::Middle, look.text);
    }
    for tick in &y_ticks {
        let at = bottom - axis::place(&chart.y, tick.value) * frame.height();
        page.write(&tick.label, [left - 0.6 * em, at + 0.5 * CAP_EM * small], Anchor::End, look.muted);
    }
    if named(&chart.y) {
        page.write(&chart.y.name(), [margin, name_baseline], Anchor::Start, look.text);
    }
    if let Some(power) = &chart.impulse_axis {
        for tick in &power_ticks {
            let at = bottom - axis::place(power, tick.value) * frame.height();
            page.write(&tick.label, [right + 0.6 * em, at + 0.5 * CAP_EM * small], Anchor::Start, look.muted);
        }
        let end = look.width - margin;
        page.write(&power.name(), [end, name_baseline], Anchor::End, look.text);
    }

    let legend = rows.iter().enumerate().map(|(row, curve)| {
        // Column by column at the side, so that neighbours in the list are neighbours on the page.
        let (column, line) = (row / down.max(1), row % down.max(1));
        debug_assert!(column < across.max(1));
        let (x, y) = (legend_at.0 + column as f64 * cell_width, legend_at.1 + (line as f64 + 0.5) * cell_height);
        let text = Written {
            text: chart.curves[*curve].label.clone(),
            x: x + sample_px + 0.5 * em,
            baseline: y + 0.5 * CAP_EM * small,
            size_px: small,
            weight: Weight::Regular,
            anchor: Anchor::Start,
            colour: look.text,
        };
        LegendRow { curve: *curve, sample: [x, y], sample_px, text }
    });
    Ok(Layout { frame, x_ticks, y_ticks, strip, legend: legend.collect(), keys, texts: page.texts })
}

/// Ticks no closer than `room` px.
fn some_ticks(axis: &Axis, length: f64, room: f64) -> Vec<Tick> {
    axis::ticks(axis, ((length / room).floor() as usize).clamp(2, MOST_TICKS))
}

/// The most ticks whose labels leave room between them.
fn fitting_x_ticks(x: &Axis, frame: &Rectangle, ruler: &Ruler, size_px: f64, em: f64) -> Vec<Tick> {
    let mut found = Vec::new();
    for wanted in (2..=if x.scale == Scale::Log { MOST_TICKS } else { 10 }).rev() {
        found = axis::ticks(x, wanted);
        let ends = |tick: &Tick| {
            let (middle, half) = (axis::place(x, tick.value) * frame.width(), 0.5 * ruler.width(&tick.label, Weight::Regular, size_px));
            (middle - half, middle + half)
        };
        if found.windows(2).all(|pair| ends(&pair[0]).1 + 0.9 * em <= ends(&pair[1]).0) {
            break;
        }
    }
    found
}
