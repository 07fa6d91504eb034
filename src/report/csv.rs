//! A measurement as CSV: a header row, then a row a reading.
//!
//! | columns | |
//! |---|---|
//! | `instrument`, `index` | its name; which of its poses, from 0 |
//! | `column`, `row` | place in a grid, from 0; empty for what is no grid |
//! | `x_m`, `y_m`, `z_m` | centre of the aperture, m |
//! | `channel`, `quantity`, `unit` | name of the channel, what it reads, in which unit the next columns are |
//! | `value`, `standard_uncertainty` | the reading and `u_c` |
//! | `degrees_of_freedom` | effective, of `u_c`; `inf` without samples |
//! | `coverage_factor`, `expanded_uncertainty` | `k` and `U = k u_c` of the 95 % interval |
//! | `samples`, `target_met` | samples taken; whether `U` is as small as was asked; `false` where the readout is saturated |
//! | `seed` | of the random numbers; the same in each row |
//! | `notes` | what is to be known about the reading, joined by `; ` |
//! | `ideal_value`, `ideal_standard_uncertainty` | what an ideal instrument would indicate; empty where the instrument is one |
//! | `spectral_mismatch` to `electronics` | parts of `value` minus `ideal_value`, in the unit |

use crate::measurement::{Cause, Measurement, Reading};
use crate::report::json::grid_index;

/// The columns.
const COLUMNS: [&str; 26] = [
    "instrument",
    "index",
    "column",
    "row",
    "x_m",
    "y_m",
    "z_m",
    "channel",
    "quantity",
    "unit",
    "value",
    "standard_uncertainty",
    "degrees_of_freedom",
    "coverage_factor",
    "expanded_uncertainty",
    "samples",
    "target_met",
    "seed",
    "notes",
    "ideal_value",
    "ideal_standard_uncertainty",
    "spectral_mismatch",
    "temperature",
    "directional_response",
    "area_averaging",
    "electronics",
];

/// The columns of the ideal reading, empty where there is none.
fn of_ideal(reading: &Reading) -> [String; 7] {
    let Some(ideal) = &reading.ideal else { return Default::default() };
    let part = |cause: Cause| ideal.parts.iter().find(|p| p.cause == cause).map_or(String::new(), |p| p.value.to_string());
    let [spectral, temperature, directional, area, electronics] = Cause::ALL.map(part);
    [ideal.value.to_string(), ideal.standard_uncertainty.to_string(), spectral, temperature, directional, area, electronics]
}

/// The measurement as CSV text.
#[must_use]
pub fn to_csv(measurement: &Measurement) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut rows: Vec<Vec<String>> = vec![COLUMNS.map(str::to_owned).to_vec()];
    rows.extend(measurement.readings.iter().map(|r| {
        let place = grid_index(r);
        let part = |k: usize| place.map_or(String::new(), |p| p[k].to_string());
        vec![
            r.instrument.clone(),
            r.index.to_string(),
            part(0),
            part(1),
            r.at.x.to_string(),
            r.at.y.to_string(),
            r.at.z.to_string(),
            r.channel.clone(),
            r.measurand.name().to_owned(),
            r.measurand.unit().to_owned(),
            r.value.to_string(),
            r.standard_uncertainty().to_string(),
            r.expanded.degrees_of_freedom.to_string(),
            r.expanded.coverage_factor.to_string(),
            r.expanded.expanded_uncertainty.to_string(),
            r.samples.to_string(),
            r.target_met.to_string(),
            measurement.provenance.seed.to_string(),
            r.notes.join("; "),
        ]
        .into_iter()
        .chain(of_ideal(r))
        .collect()
    }));
    for row in rows {
        // A vector takes whatever is written to it.
        let _ = writer.write_record(&row);
    }
    writer.into_inner().ok().and_then(|bytes| String::from_utf8(bytes).ok()).unwrap_or_default()
}
