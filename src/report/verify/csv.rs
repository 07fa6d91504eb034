//! A verification as CSV: a header row, then a row a case. Numbers keep all their digits; what there is none of is empty.

use crate::study::verify::Verification;

const COLUMNS: [&str; 15] = [
    "id",
    "group",
    "title",
    "quantity",
    "unit",
    "verdict",
    "reference",
    "reading",
    "standard_uncertainty",
    "samples",
    "relative_deviation",
    "deviation_in_u",
    "deviation_in_limits",
    "seconds",
    "reason",
];

/// The verification as CSV text.
#[must_use]
pub fn to_csv(of: &Verification) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let number = |x: Option<f64>| x.map_or_else(String::new, |x| x.to_string());
    // A vector takes whatever is written to it.
    let _ = writer.write_record(COLUMNS);
    for check in &of.checks {
        let found = check.found();
        let words = [&check.id, &check.group, &check.title, &check.quantity, &check.unit].map(String::clone);
        let numbers = [
            check.word().to_owned(),
            number(check.reference),
            number(found.map(|found| found.value)),
            number(found.and_then(|found| found.standard_uncertainty)),
            found.map_or_else(String::new, |found| found.samples.to_string()),
            number(check.relative_deviation()),
            number(check.deviation_in_u()),
            number(check.deviation_in_limits()),
            check.seconds.to_string(),
            check.reason().unwrap_or_default().to_owned(),
        ];
        let _ = writer.write_record(words.iter().chain(&numbers));
    }
    writer.into_inner().ok().and_then(|bytes| String::from_utf8(bytes).ok()).unwrap_or_default()
}
