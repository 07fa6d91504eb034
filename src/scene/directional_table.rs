//! Tables of the relative directional response of a sensor.
//!
//! ```text
//! # any number of header lines
//! theta_deg,0,90,180,270        or, if it does not depend on φ:   theta_deg,R
//! 0,1,1,1,1
//! 5,0.998,0.997,0.998,0.999
//! ```
//!
//! θ in degrees from the normal, from 0 and rising, at most 90; φ in degrees, from 0 and rising, below 360 or up to 360
//! with the values of 0 once more. The response is zero beyond the last θ.

use super::decode::Value;
use super::diagnostic::{Diagnostic, Problems};
use super::files::LONGEST_CURVE_BYTES;
use super::reading::Reading;
use crate::sensor::DirectionalResponse;

/// A row of text with its number in the file.
struct Row<'t> {
    number: usize,
    text: &'t str,
    cells: Vec<&'t str>,
}

struct Table<'t> {
    file: &'t str,
    problems: &'t mut Problems,
}

impl Table<'_> {
    fn problem(&mut self, row: &Row, message: impl Into<String>, help: &str) {
        self.problems.add(Diagnostic::of_line(self.file, row.number, row.text, message, Some(help.to_string())));
    }

    fn number(&mut self, row: &Row, cell: &str) -> Option<f64> {
        match cell.parse::<f64>() {
            Ok(x) if x.is_finite() => Some(x),
            Ok(x) => {
                self.problem(row, format!("the number is {x}"), "every number must be finite");
                None
            }
            Err(_) => {
                self.problem(
                    row,
                    format!("`{cell}` is not a number"),
                    "write numbers with a decimal point and commas between them: `5,0.998`",
                );
                None
            }
        }
    }
}

/// Reads the table that a value names.
pub(super) fn read_directional(name: &Value, reading: &mut Reading) -> Option<DirectionalResponse> {
    let file = name.text(&mut reading.problems)?;
    let path = reading.path(name, file)?;
    let text = reading.text(name, &path, "directional table", LONGEST_CURVE_BYTES)?;
    parse(&path, &text, &mut reading.problems)
}

fn parse(file: &str, text: &str, problems: &mut Problems) -> Option<DirectionalResponse> {
    let before = problems.count();
    let mut rows = text
        .trim_start_matches('\u{feff}')
        .lines()
        .enumerate()
        .map(|(i, line)| Row { number: i + 1, text: line, cells: line.split(',').map(str::trim).collect() })
        .filter(|row| !row.text.trim().is_empty() && !row.text.trim_start().starts_with('#'));
    let Some(header) = rows.next() else {
        problems.add(Diagnostic::of_file(
            file,
            "the directional table has no rows",
            Some("the first row is `theta_deg,R` or `theta_deg,0,90,180,270`, then one row for each θ".into()),
        ));
        return None;
    };
    let mut table = Table { file, problems };
    if header.cells[0] != "theta_deg" || header.cells.len() < 2 {
        table.problem(
            &header,
            "the first row of a directional table names its columns",
            "write `theta_deg,R`, or `theta_deg,0,90,180,270` with φ in degrees",
        );
        return None;
    }
    let mut phi_deg = if header.cells.len() == 2 && header.cells[1].parse::<f64>().is_err() {
        vec![0.0]
    } else {
        let cells: Vec<Option<f64>> = header.cells[1..].iter().map(|cell| table.number(&header, cell)).collect();
        cells.into_iter().collect::<Option<Vec<f64>>>()?
    };
    if phi_deg[0] != 0.0 || phi_deg.windows(2).any(|w| w[0] >= w[1]) || phi_deg[phi_deg.len() - 1] > 360.0 {
        table.problem(
            &header,
            "the angles φ do not run from 0 upwards to at most 360",
            "write them rising, such as `theta_deg,0,90,180,270`",
        );
        return None;
    }
    let (mut theta_deg, mut values) = (Vec::new(), vec![Vec::new(); phi_deg.len()]);
    for row in rows {
        if row.cells.len() != header.cells.len() {
            table.problem(
                &row,
                format!("the row has {} of {} columns", row.cells.len(), header.cells.len()),
                "give θ and one value for each column of the first row",
            );
            continue;
        }
        let numbers: Vec<Option<f64>> = row.cells.iter().map(|cell| table.number(&row, cell)).collect();
        let Some(numbers) = numbers.into_iter().collect::<Option<Vec<f64>>>() else { continue };
        let theta = numbers[0];
        match theta_deg.last() {
            None if theta != 0.0 => table.problem(&row, format!("the first θ is {theta}°"), "begin at 0°, the direction of the normal"),
            Some(&last) if theta <= last => {
                table.problem(&row, format!("θ = {theta}° follows {last}°"), "write the rows with rising θ, each angle once")
            }
            _ if theta > 90.0 => table.problem(&row, format!("θ is {theta}°"), "allowed: 0° to 90°; light from behind does not enter"),
            _ => {}
        }
        if let Some(value) = numbers[1..].iter().find(|&&v| v < 0.0) {
            table.problem(&row, format!("the response is {value}"), "allowed: 0 and above");
        }
        theta_deg.push(theta);
        for (column, &value) in values.iter_mut().zip(&numbers[1..]) {
            column.push(value);
        }
    }
    if phi_deg.len() > 1 && phi_deg[phi_deg.len() - 1] == 360.0 {
        let last = values.pop();
        phi_deg.pop();
        if last.as_ref() != values.first() {
            table.problem(
                &header,
                "the column of φ = 360° differs from that of φ = 0°, which is the same direction",
                "make them equal, or leave 360 out",
            );
        }
    }
    if problems.count() > before {
        return None;
    }
    let radians = |angles: Vec<f64>| angles.into_iter().map(f64::to_radians).collect();
    match DirectionalResponse::new(radians(theta_deg), radians(phi_deg), values) {
        Ok(response) => Some(response),
        Err(why) => {
            problems.add(Diagnostic::of_file(file, format!("the directional table cannot be used: {why}"), None));
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<DirectionalResponse, String> {
        let mut problems = Problems::default();
        parse("table.csv", text, &mut problems).ok_or_else(|| problems.finish().to_string())
    }

    #[test]
    fn a_table_without_azimuth_holds_for_every_azimuth() {
        let table = read("# a meter\ntheta_deg,R\n0,1\n90,0\n").unwrap();
        assert!((table.at(45f64.to_radians(), 1.0) - 0.5).abs() < 1e-15);
    }

    #[test]
    fn the_column_of_the_full_turn_is_that_of_zero() {
        let table = read("theta_deg,0,180,360\n0,1,1,1\n90,0.5,0.7,0.5").unwrap();
        assert!((table.at(90f64.to_radians(), 270f64.to_radians()) - 0.6).abs() < 1e-12);
        assert!(read("theta_deg,0,180,360\n0,1,1,1\n90,0.5,0.7,0.6").unwrap_err().contains("360"));
    }
}
