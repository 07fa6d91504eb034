//! The data sheet of a camera as a page for a person, at most 100 columns wide.

use crate::characterization::Figure;
use crate::characterization::sheet::camera::{CameraChannelSheet, CameraSheet, Comparison, F_NUMBER, LEVELS, SIDE, STACK};
use crate::metrology::rounding::format_significant;
use crate::report::datasheet::text::{aligned, number, wrapped};

/// The sheet as text.
#[must_use]
pub fn sheet_to_text(sheet: &CameraSheet) -> String {
    let (readings, rays) = sheet.tally;
    let mut lines = vec![
        sheet.title.clone(),
        "  every figure of EMVA 1288 computed from the parameters and measured on a virtual flat field".to_owned(),
        format!(
            "  bench: port at f/{F_NUMBER}, no lens; {readings} readings, {rays} rays, {} frames, seed {}",
            sheet.frames, sheet.options.seed
        ),
        format!("  frames of {SIDE} × {SIDE} pixels: {LEVELS} levels, stacks of {STACK}; sensor at {} °C", sheet.temperature_c),
        "  ± standard uncertainty (k = 1); `in u`: deviation of the two in joint standard uncertainties".to_owned(),
    ];
    lines.extend(sheet.channels.iter().flat_map(channel_lines));
    lines.push(String::new());
    let definitions = "Definitions: EMVA 1288 release 4.0 linear, as the package emva1288 1.0.2 computes it; the text of the standard was not \
                       at hand. η counts photons on the whole pixel. The linear camera model has no linearity error; its \
                       saturation is that of a single pixel, and the largest of noisy variances is read off about one u below it on average.";
    lines.extend(wrapped(definitions, "  "));
    lines.iter().map(|line| format!("{}\n", line.trim_end())).collect()
}

fn channel_lines(channel: &CameraChannelSheet) -> Vec<String> {
    let mut lines = vec![
        String::new(),
        format!(
            "{}: {} nm, {} photons/s on a pixel, exposures up to {} s",
            channel.name,
            channel.wavelength_nm,
            format_significant(channel.photons_per_s.value, 5),
            format_significant(channel.longest_s, 4)
        ),
    ];
    let head = ["", "", "", "computed", "measured", "in u"].map(str::to_owned);
    let rows = channel.comparisons.iter().map(|c| {
        let Comparison { symbol, name, unit, computed, measured, .. } = c;
        let deviation = format!("{:.1}", c.deviation_u());
        [(*symbol).to_owned(), (*name).to_owned(), (*unit).to_owned(), exact(computed), number(measured), deviation]
    });
    lines.extend(aligned(&std::iter::once(head).chain(rows).collect::<Vec<_>>()));
    let mut notes: Vec<(&str, Vec<&str>)> = Vec::new();
    for (note, symbol) in channel.comparisons.iter().filter_map(|c| Some((c.note?, c.symbol))) {
        match notes.iter_mut().find(|(known, _)| *known == note) {
            Some((_, symbols)) => symbols.push(symbol),
            None => notes.push((note, vec![symbol])),
        }
    }
    lines.extend(notes.iter().flat_map(|(note, symbols)| wrapped(&format!("{}: {note}", symbols.join(", ")), "    ")));
    lines
}

/// A value from the parameters, without zeros at its end.
fn exact(figure: &Figure) -> String {
    let text = if figure.value == 0.0 { "0".to_owned() } else { format_significant(figure.value, 6) };
    if text.contains('.') && !text.contains('e') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}
