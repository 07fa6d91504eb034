//! A data sheet as a page for a person, at most 100 columns wide.

use crate::characterization::Figure;
use crate::characterization::class_limits::{self, Classified};
use crate::characterization::sheet::{Absent, ChannelSheet, DataSheet, Index, Receptor};
use crate::metrology::rounding::{Rounded, format_significant};

/// Widest page, characters.
const PAGE: usize = 100;
/// Below this share of the value an uncertainty is that of arithmetic and is written on its own.
const ARITHMETIC: f64 = 1e-7;

/// The sheet as text.
#[must_use]
pub fn to_text(sheet: &DataSheet) -> String {
    let (readings, rays) = sheet.tally;
    let receptor = match sheet.receptor {
        Receptor::Planar => "planar receptor".to_owned(),
        Receptor::Cone { half_angle_rad } => format!("cone of half-angle {}°", trimmed(half_angle_rad.to_degrees())),
        Receptor::Spot { half_angle_rad, focus_m } => {
            format!("spot of half-angle {}°, focused at {} m", trimmed(half_angle_rad.to_degrees()), trimmed(focus_m))
        }
        Receptor::Head(head) => format!("{} head", head.name()),
    };
    let mut lines = vec![
        sheet.title.clone(),
        format!("  {receptor}"),
        "  every index computed from the curves and measured on a virtual bench".to_owned(),
        format!(
            "  bench: {readings} readings, {rays} rays, seed {}, monochromator in steps of {} nm",
            sheet.options.seed, sheet.options.step_nm
        ),
        "  ± standard uncertainty (k = 1); `in u`: deviation of the two in joint standard uncertainties".to_owned(),
    ];
    lines.extend(section("Directional response", &sheet.directional, &sheet.absent));
    for channel in &sheet.channels {
        lines.extend(channel_lines(channel));
    }
    lines.push(String::new());
    if sheet.channels.iter().any(|channel| channel.class.is_some()) {
        lines.extend(wrapped(
            &format!(
                "Limits of classes: {}. p: probability that the measured index is within the limit of the class. Not judged: f4 display, \
                 f5 fatigue, α temperature, f7 modulated light.",
                class_limits::SOURCE
            ),
            "  ",
        ));
    }
    let definitions =
        "Definitions: ISO/CIE 19476 and DIN 5032-6 as the literature quotes them; the texts of the standards were not at hand.";
    lines.extend(wrapped(definitions, "  "));
    lines.iter().map(|line| format!("{}\n", line.trim_end())).collect()
}

fn channel_lines(channel: &ChannelSheet) -> Vec<String> {
    let title = match channel.reads.unit() {
        "" | "1" => format!("{}: {}, a number", channel.name, channel.reads.name()),
        unit => format!("{}: {} in {unit}", channel.name, channel.reads.name()),
    };
    let mut lines = section(&title, &channel.indices, &channel.absent);
    let unknown = channel.unknown.join(" and ");
    if let Some(class) = &channel.class {
        let missing = if unknown.is_empty() { String::new() } else { format!("; {unknown} is not known") };
        let by = "by these indices and those of the directional response";
        lines.extend(wrapped(&format!("{} {by}{missing}", verdict(class, !unknown.is_empty())), "  "));
    }
    if let Some((total, class)) = &channel.total {
        let without = if unknown.is_empty() { String::new() } else { format!("{unknown}, ") };
        let at_least = if unknown.is_empty() { "" } else { "at least " };
        let note = format!("sum of the indices that have limits; {without}f4, f5, α, f7 and the uncertainty of calibration are not in it");
        lines.extend(wrapped(&format!("total {at_least}{} %, {}: {note}", number(total), verdict(class, !unknown.is_empty())), "  "));
    }
    if !channel.lamps.is_empty() {
        lines.extend(lamp_lines(channel));
    }
    lines
}

/// The class with its probability; `at_best` where an index is not known.
fn verdict(class: &Classified, at_best: bool) -> String {
    let p = probability(class.probability);
    let best = if at_best { " at best" } else { "" };
    class.class.map_or_else(|| format!("no class, p = {p}"), |letter| format!("class {letter}{best}, p = {p}"))
}

/// A probability: one that is not certain is not written as 1.
fn probability(p: f64) -> String {
    if p < 1.0 && p > 0.9995 { ">0.999".to_owned() } else { format!("{p:.3}") }
}

/// A title, a table of indices, what they depend on, what there is not.
fn section(title: &str, indices: &[Index], absent: &[Absent]) -> Vec<String> {
    let mut lines = vec![String::new(), title.to_owned()];
    if !indices.is_empty() {
        let head = ["", "", "", "computed", "measured", "in u", "class", "p"].map(str::to_owned);
        let rows = indices.iter().map(|index| {
            let class = index.classified();
            [
                index.symbol.to_owned(),
                index.name.to_owned(),
                index.unit.to_owned(),
                plain(&index.computed),
                number(&Figure { standard_uncertainty: index.standard_uncertainty(), ..index.measured }),
                format!("{:.1}", index.deviation_u()),
                class.map_or("", |c| c.class.map_or("none", |class| class.letter())).to_owned(),
                class.map_or(String::new(), |c| probability(c.probability)),
            ]
        });
        lines.extend(aligned(&std::iter::once(head).chain(rows).collect::<Vec<_>>()));
    }
    lines.extend(indices.iter().flat_map(|index| wrapped(&format!("{}: {}", index.symbol, index.conditions), "    ")));
    lines.extend(absent.iter().flat_map(|one| wrapped(&format!("no {}: {}", one.symbol, one.why), "    ")));
    lines
}

fn lamp_lines(channel: &ChannelSheet) -> Vec<String> {
    let adjusted = channel.target.as_ref().map_or("", |target| target.calibration_name);
    let mut lines = vec![format!("  true = reading × F after adjustment with {adjusted}")];
    let head = ["lamp", "F computed", "F measured", "in u", "reads / %"].map(str::to_owned);
    let rows = channel.lamps.iter().map(|lamp| {
        let off = 100.0 / lamp.measured.value - 100.0;
        let off = if off.abs() < 0.005 { "0.00".to_owned() } else { format!("{off:+.2}").replace('-', "−") };
        let deviation = format!("{:.1}", lamp.computed.deviation_u(&lamp.measured));
        [lamp.name.clone(), format!("{:.5}", lamp.computed.value), number(&lamp.measured), deviation, off]
    });
    lines.extend(aligned(&std::iter::once(head).chain(rows).collect::<Vec<_>>()));
    lines
}

/// A value without its uncertainty.
fn plain(figure: &Figure) -> String {
    match figure.value.abs() {
        size if size <= figure.standard_uncertainty => "0".to_owned(),
        size if size < 1e-4 => format_significant(figure.value, 3),
        _ => format!("{:.4}", figure.value),
    }
}

/// A value with its uncertainty, rounded to two digits of it; one that is only arithmetic does not stretch the value.
pub(in crate::report) fn number(figure: &Figure) -> String {
    let (value, u) = (figure.value, figure.standard_uncertainty);
    if value.abs() <= u && u < ARITHMETIC {
        return format!("0 ± {u:.0e}");
    }
    if u < ARITHMETIC * value.abs().max(ARITHMETIC) {
        return format!("{} ± {u:.0e}", plain(figure));
    }
    Rounded::new(value, u).map_or_else(|| "not a number".to_owned(), |rounded| rounded.to_string())
}

/// A number without zeros at its end.
fn trimmed(x: f64) -> String {
    let text = format!("{x:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Columns aligned with blanks.
pub(in crate::report) fn aligned<const N: usize>(rows: &[[String; N]]) -> Vec<String> {
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..N).map(width).collect();
    let line = |row: &[String; N]| row.iter().zip(&widths).fold(String::new(), |line, (cell, width)| format!("{line}  {cell:width$}"));
    rows.iter().map(line).collect()
}

/// Words of a text on lines that fit the page, each after the indent.
pub(in crate::report) fn wrapped(text: &str, indent: &str) -> Vec<String> {
    let mut lines = vec![indent.to_owned()];
    for word in text.split_whitespace() {
        let last = lines.len() - 1;
        let used = lines[last].chars().count();
        if used > indent.len() + 2 && used + 1 + word.chars().count() > PAGE {
            lines.push(format!("{indent}  {word}"));
        } else {
            let gap = if lines[last].trim().is_empty() { "" } else { " " };
            lines[last].push_str(&format!("{gap}{word}"));
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_texts_are_wrapped_and_no_word_is_lost() {
        let text = "word ".repeat(60);
        let lines = wrapped(&text, "  ");
        assert!(lines.len() > 1 && lines.iter().all(|line| line.chars().count() <= PAGE));
        assert_eq!(lines.iter().map(|line| line.split_whitespace().count()).sum::<usize>(), 60);
    }

    #[test]
    fn numbers_show_two_digits_of_their_uncertainty() {
        let figure = |value, standard_uncertainty| Figure { value, standard_uncertainty };
        assert_eq!(number(&figure(5.45123, 0.0021)), "5.4512 ± 0.0021");
        assert_eq!(number(&figure(0.98765432, 6e-13)), "0.9877 ± 6e-13");
        assert_eq!(number(&figure(1e-14, 8.2e-11)), "0 ± 8e-11");
        assert_eq!(plain(&figure(1e-14, 1e-12)), "0");
        assert_eq!(probability(0.99999), ">0.999");
        assert_eq!(probability(1.0), "1.000");
    }
}
