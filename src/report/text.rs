//! A measurement as a table for a person.
//!
//! Values are rounded to two digits of their uncertainty. The grid of an instrument is summed up and drawn as a small map.

use std::fmt::Write;

use super::ideal::write_ideal;
use crate::estimate::Counters;
use crate::math::DVec3;
use crate::measurement::{Measurement, Reading};
use crate::metrology::rounding::{Rounded, format_significant};
use crate::metrology::{BudgetRow, EvaluationKind};
use crate::scene::Layout;
use crate::sensor::photodiode::Saturation;

/// Below this relative uncertainty a value is exact for a reader, and more digits would only be noise to the eye.
const EXACT: f64 = 1e-9;
/// Rows of a budget below this share of the whole are summed up.
const SMALL: f64 = 0.01;
/// Largest map of a grid.
const MAP: [usize; 2] = [12, 10];
/// Up to so many readings the budget of each is written out.
const BUDGETS: usize = 4;

/// The measurement as text.
#[must_use]
pub fn to_text(measurement: &Measurement) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = write_all(measurement, &mut text);
    text
}

fn write_all(m: &Measurement, out: &mut String) -> std::fmt::Result {
    writeln!(out, "{}\n", m.scene)?;
    let (grids, single): (Vec<&Reading>, Vec<&Reading>) = m.readings.iter().partition(|r| matches!(r.layout, Layout::Grid { .. }));
    if !single.is_empty() {
        write_table(&single, out)?;
    }
    let mut rest = grids.as_slice();
    while let Some(first) = rest.first() {
        let same = |r: &&&Reading| r.instrument == first.instrument;
        let count = rest.iter().take_while(same).count();
        let (mine, others) = rest.split_at(count);
        let mut channels: Vec<&str> = Vec::new();
        for r in mine {
            if !channels.contains(&r.channel.as_str()) {
                channels.push(&r.channel);
            }
        }
        for channel in channels {
            let points: Vec<&Reading> = mine.iter().copied().filter(|r| r.channel == channel).collect();
            write_grid(&points, out)?;
        }
        rest = others;
    }
    write_ideal(m, out)?;
    if single.len() <= BUDGETS {
        for r in &single {
            write_budget(r, out)?;
        }
    } else {
        writeln!(out, "  budgets of these {} readings: --format json\n", single.len())?;
    }
    write_notes(m, out)?;
    write_counters(m, out)
}

/// Value and expanded uncertainty as a person reads them.
fn rounded(value: f64, expanded: f64) -> (String, String) {
    if expanded <= EXACT * value.abs() {
        // Without the zeros that only say how exact it is.
        let text = format_significant(value, 10);
        let text = match (text.contains('.'), text.contains('e')) {
            (true, false) => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
            _ => text,
        };
        return (text, if expanded == 0.0 { "0".to_owned() } else { format_significant(expanded, 2) });
    }
    match Rounded::new(value, expanded) {
        Some(r) => (r.value, r.uncertainty),
        None => (format_significant(value, 10), "unknown".to_owned()),
    }
}

/// Two digits, without a power of ten where a person needs none.
fn two_digits(x: f64) -> String {
    if (100.0..1e6).contains(&x) {
        let unit = 10f64.powi(x.log10().floor() as i32 - 1);
        return format!("{:.0}", (x / unit).round() * unit);
    }
    format_significant(x, 2)
}

fn relative(expanded: f64, value: f64) -> String {
    match (value == 0.0, expanded / value.abs()) {
        (true, _) => "-".to_owned(),
        (_, ratio) if ratio < EXACT => "exact".to_owned(),
        (_, ratio) => format!("{} %", format_significant(100.0 * ratio, 2)),
    }
}

fn write_table(readings: &[&Reading], out: &mut String) -> std::fmt::Result {
    // Where the poses of a list are is worth a column, a single one is known by its name.
    let listed = readings.iter().any(|r| r.layout == Layout::List);
    let mut rows = vec![
        ["instrument", if listed { "at" } else { "" }, "quantity", "reading", "", "U (95 %)", "k", "U/reading", "samples"]
            .map(str::to_owned),
    ];
    for r in readings {
        let (value, expanded) = rounded(r.value, r.expanded.expanded_uncertainty);
        let name = match r.layout {
            Layout::Single => r.instrument.clone(),
            _ => format!("{} [{}]", r.instrument, r.index),
        };
        let alone = readings.iter().filter(|o| o.instrument == r.instrument && o.index == r.index).count() == 1;
        let quantity = if alone { r.measurand.name().to_owned() } else { format!("{} ({})", r.measurand.name(), r.channel) };
        let [value, interval, share] = match r.saturation() {
            None => [value, format!("± {expanded}"), relative(r.expanded.expanded_uncertainty, r.value)],
            // Of a saturated reading one side is known.
            Some(Saturation::Whole) => [format!("≥ {value}"), "saturated".to_owned(), "no bound".to_owned()],
            Some(Saturation::Crests) => [value, "saturated".to_owned(), "too high".to_owned()],
        };
        rows.push([
            name,
            if listed { place(r) } else { String::new() },
            quantity,
            value,
            r.measurand.unit().to_owned(),
            interval,
            format!("{:.2}", r.expanded.coverage_factor),
            share,
            r.samples.to_string(),
        ]);
    }
    // The reading and the number of samples are numbers and end in one column.
    let right = [false, false, false, true, false, false, false, true, true];
    let shown: Vec<usize> = (0..9).filter(|&c| c != 1 || listed).collect();
    let width: Vec<usize> = (0..9).map(|c| rows.iter().map(|row| row[c].chars().count()).max().unwrap_or(0)).collect();
    for (k, row) in rows.iter().enumerate() {
        let mut line = String::from(" ");
        for &c in &shown {
            let pad = " ".repeat(width[c] - row[c].chars().count());
            let (before, after) = if right[c] { (pad.as_str(), "") } else { ("", pad.as_str()) };
            write!(line, " {before}{}{after} ", row[c])?;
        }
        writeln!(out, "{}", line.trim_end())?;
        if k == 0 {
            writeln!(out, "  {}", "─".repeat(shown.iter().map(|&c| width[c] + 2).sum::<usize>() - 2))?;
        }
    }
    let exact = readings.iter().any(|r| relative(r.expanded.expanded_uncertainty, r.value) == "exact");
    let exact = if exact { format!("; exact: U below {EXACT:.0e} of the reading") } else { String::new() };
    writeln!(out, "\n  U = k u_c at 95 %{exact}\n")
}

fn write_grid(points: &[&Reading], out: &mut String) -> std::fmt::Result {
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return Ok(()) };
    let Layout::Grid { columns, rows } = first.layout else { return Ok(()) };
    let unit = first.measurand.unit();
    writeln!(
        out,
        "  {}: {} in {unit}, {columns} × {rows} points from {} to {}",
        first.instrument,
        first.measurand.name(),
        place(first),
        place(last)
    )?;
    let n = points.len() as f64;
    let mean = points.iter().map(|r| r.value / n).sum::<f64>();
    // Samples are independent from point to point; what is bounded rather than sampled may be common to all.
    let sampled = points.iter().map(|r| r.budget.combined_of_kind(EvaluationKind::A) / n).fold(0.0, f64::hypot);
    let common = points.iter().map(|r| r.budget.combined_of_kind(EvaluationKind::B) / n).sum::<f64>();
    let by_value = |a: &&&Reading, b: &&&Reading| a.value.total_cmp(&b.value);
    let (Some(lowest), Some(highest)) = (points.iter().min_by(by_value), points.iter().max_by(by_value)) else { return Ok(()) };
    let of = |value: f64, expanded: f64| {
        let (v, u) = rounded(value, expanded);
        format!("{v} ± {u} {unit}")
    };
    let mean_expanded = 1.96 * sampled.hypot(common);
    writeln!(out, "    mean        {}   (k = 1.96)", of(mean, mean_expanded))?;
    writeln!(out, "    lowest      {}   at {}", of(lowest.value, lowest.expanded.expanded_uncertainty), place(lowest))?;
    writeln!(out, "    highest     {}   at {}", of(highest.value, highest.expanded.expanded_uncertainty), place(highest))?;
    if mean > 0.0 {
        let low = (lowest.value, lowest.expanded.expanded_uncertainty);
        writeln!(
            out,
            "    uniformity  {} lowest/mean, {} lowest/highest   (± U)",
            ratio(low, (mean, mean_expanded)),
            ratio(low, (highest.value, highest.expanded.expanded_uncertainty))
        )?;
    }
    let worst = points.iter().map(|r| r.expanded.expanded_uncertainty / r.value.abs()).filter(|u| u.is_finite()).fold(0.0, f64::max);
    writeln!(out, "    U/reading   at most {}, {} samples in all\n", relative(worst, 1.0), points.iter().map(|r| r.samples).sum::<u64>())?;

    let step = [columns.div_ceil(MAP[0]), rows.div_ceil(MAP[1])];
    let cells: Vec<Vec<String>> = (0..rows)
        .step_by(step[1])
        .map(|row| (0..columns).step_by(step[0]).map(|c| format_significant(points[row * columns + c].value, 3)).collect())
        .collect();
    let width = cells.iter().flatten().map(|c| c.chars().count()).max().unwrap_or(0);
    // The second axis points upwards, as on a plan.
    for row in cells.iter().rev() {
        let line: Vec<String> = row.iter().map(|c| format!("{c:>width$}")).collect();
        writeln!(out, "    {}", line.join("  "))?;
    }
    let along = |index: usize| points.get(index).map_or(DVec3::ZERO, |r| r.at - first.at);
    let right = if columns > 1 { Some(format!("{} to the right", direction(along(columns - 1)))) } else { None };
    let up = if rows > 1 { Some(format!("{} upwards", direction(along((rows - 1) * columns)))) } else { None };
    let thinned = (step != [1, 1]).then(|| format!("every {} point of a row, every {} row", ordinal(step[0]), ordinal(step[1])));
    let legend: Vec<String> = [right, up, thinned].into_iter().flatten().collect();
    if !legend.is_empty() {
        writeln!(out, "    ({})", legend.join(", "))?;
    }
    writeln!(out)
}

/// A quotient of two readings, each a value and its U, with the U of the quotient: U² = (U_a/b)² + (a U_b/b²)², for independent
/// readings. What two readings have in common cancels in their quotient, so U is not too small for it.
fn ratio(a: (f64, f64), b: (f64, f64)) -> String {
    let value = a.0 / b.0;
    let expanded = (a.1 / b.0).hypot(value * b.1 / b.0);
    if expanded <= EXACT * value.abs() {
        return format_significant(value, 3);
    }
    let (value, expanded) = rounded(value, expanded);
    format!("{value} ± {expanded}")
}

/// A direction: the name of the axis that it runs along, else its unit vector.
fn direction(along: DVec3) -> String {
    let unit = along.normalize_or_zero();
    let named = [("x", DVec3::X), ("y", DVec3::Y), ("z", DVec3::Z)].into_iter().find_map(|(name, axis)| {
        let other = (unit - axis * unit.dot(axis)).length();
        (unit != DVec3::ZERO && other < 1e-9).then(|| if unit.dot(axis) > 0.0 { name.to_owned() } else { format!("−{name}") })
    });
    named.unwrap_or_else(|| {
        let part = |x: f64| format_significant(x, 3);
        format!("({}, {}, {})", part(unit.x), part(unit.y), part(unit.z))
    })
}

fn ordinal(n: usize) -> String {
    match n {
        1 => "single".to_owned(),
        2 => "2nd".to_owned(),
        3 => "3rd".to_owned(),
        n => format!("{n}th"),
    }
}

fn place(r: &Reading) -> String {
    let short = |x: f64| {
        let text = format_significant(x, 4);
        if text.contains('.') && !text.contains('e') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    };
    format!("({}, {}, {}) m", short(r.at.x), short(r.at.y), short(r.at.z))
}

fn write_budget(r: &Reading, out: &mut String) -> std::fmt::Result {
    if r.budget.rows.is_empty() {
        return Ok(());
    }
    let index = if r.layout == Layout::Single { String::new() } else { format!(" [{}]", r.index) };
    writeln!(out, "  uncertainty of {}{index}, {}, in {}", r.instrument, r.measurand.name(), r.measurand.unit())?;
    let combined = r.standard_uncertainty();
    let (large, small): (Vec<&BudgetRow>, Vec<&BudgetRow>) =
        r.budget.rows.iter().partition(|row| row.standard_uncertainty >= SMALL * combined && row.standard_uncertainty > 0.0);
    for row in large {
        let freedom = if row.degrees_of_freedom.is_finite() { format!("ν = {:.0}", row.degrees_of_freedom) } else { String::new() };
        writeln!(out, "    {}  {:>9}  {:<7} {}", row.kind.letter(), two_digits(row.standard_uncertainty), freedom, row.source)?;
    }
    let rest = small.iter().map(|row| row.standard_uncertainty).fold(0.0, f64::hypot);
    if rest > 0.0 {
        let rows = if small.len() == 1 { "one row".to_owned() } else { format!("{} rows", small.len()) };
        writeln!(out, "       {:>9}          {rows} below 1 % of the whole", two_digits(rest))?;
    }
    writeln!(out, "       {:>9}          combined standard uncertainty\n", two_digits(combined))
}

fn write_notes(m: &Measurement, out: &mut String) -> std::fmt::Result {
    let mut seen: Vec<(&str, &str, usize)> = Vec::new();
    for r in &m.readings {
        for note in &r.notes {
            match seen.iter_mut().find(|(i, n, _)| *i == r.instrument && *n == note.as_str()) {
                Some((_, _, count)) => *count += 1,
                None => seen.push((&r.instrument, note, 1)),
            }
        }
    }
    for (instrument, note, count) in seen {
        let times = if count > 1 { format!(" ({count} readings)") } else { String::new() };
        writeln!(out, "  note: `{instrument}` {note}{times}")?;
    }
    Ok(())
}

fn write_counters(m: &Measurement, out: &mut String) -> std::fmt::Result {
    let Counters { rays, samples, bvh_nodes, spectral_nodes, .. } = m.counters;
    writeln!(
        out,
        "  {samples} samples, {rays} rays, {bvh_nodes} BVH nodes, {spectral_nodes} spectral nodes; seed {}; {} s",
        m.provenance.seed,
        format_significant(m.wall_seconds, 2)
    )
}
