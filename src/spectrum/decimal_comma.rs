//! Whether the commas in the numbers of a curve file are decimal commas.
//!
//! Only asked where commas do not separate the columns. A comma is a decimal one if at least one number of the file cannot be read with
//! separators of thousands (`0,12`, `380,5`), and none has both kinds or a point. `1,234` alone may be 1.234 or 1234: nobody can know.

use super::table_row::{Field, Separator, split};

/// What the commas in numbers are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Commas {
    /// Decimal commas.
    Decimal,
    /// A problem: line, column, message, help.
    Unclear(usize, usize, String, String),
}

/// Looks at all numbers of a file whose columns are separated by `separator`, which is not the comma.
pub(super) fn decide(text: &str, separator: Separator) -> Commas {
    let mut groups = None;
    let mut point = None;
    let mut decimal = None;
    for (index, line) in text.split('\n').enumerate() {
        if line.trim().is_empty() || line.trim_start().starts_with('#') {
            continue;
        }
        let line = line.strip_suffix('\r').unwrap_or(line);
        for field in split(line, separator) {
            let place = || Some((index + 1, field.column, field.text.chars().take(40).collect::<String>()));
            match kind(&field) {
                Kind::Other => {}
                Kind::Point => point = point.or_else(place),
                Kind::Group => groups = groups.or_else(place),
                Kind::Decimal => decimal = decimal.or_else(place),
                Kind::Both => {
                    let (line, column, number) = (index + 1, field.column, field.text.chars().take(40).collect::<String>());
                    let help = "write numbers without separators of thousands, with a decimal point: `1234.5`";
                    return Commas::Unclear(line, column, format!("`{number}` has separators of thousands"), help.into());
                }
            }
        }
    }
    let with_comma = decimal.clone().or(groups.clone());
    if let (Some((line, column, number)), Some((at, _, other))) = (with_comma, point) {
        let message = format!("`{number}` has a comma where `{other}` in line {at} has a point");
        return Commas::Unclear(line, column, message, "write all numbers with decimal points".into());
    }
    match (decimal, groups) {
        (None, Some((line, column, number))) => {
            let (as_decimal, as_thousands) = (number.replacen(',', ".", 1), number.replacen(',', "", 1));
            let message = format!("`{number}` may be {as_decimal} or {as_thousands}");
            let help = format!("write `{as_decimal}` or `{as_thousands}`; if all commas are decimal ones, add the line `# decimal: comma`");
            Commas::Unclear(line, column, message, help)
        }
        _ => Commas::Decimal,
    }
}

/// Commas that may be decimal ones or separators of thousands in a table whose columns a semicolon or a tab separates: line, column, message, help.
pub(crate) fn unclear(text: &str, separator: char) -> Option<(usize, usize, String, String)> {
    let separator = if separator == ';' { Separator::Semicolon } else { Separator::Tab };
    match decide(text, separator) {
        Commas::Decimal => None,
        Commas::Unclear(line, column, message, help) => Some((line, column, message, help)),
    }
}

enum Kind {
    /// A number without comma or point, or no number.
    Other,
    Point,
    /// One comma with one to three digits before it and three behind it.
    Group,
    Decimal,
    /// Several commas, or a comma and a point.
    Both,
}

fn kind(field: &Field<'_>) -> Kind {
    let text = field.text;
    if !text.starts_with(|first: char| first.is_ascii_digit() || "+-.,".contains(first)) {
        return Kind::Other;
    }
    if !text.contains(',') {
        return if text.contains('.') && text.parse::<f64>().is_ok() { Kind::Point } else { Kind::Other };
    }
    if text.replace(',', "").parse::<f64>().is_err() {
        return Kind::Other;
    }
    if text.contains('.') || text.matches(',').count() > 1 {
        return Kind::Both;
    }
    let (before, behind) = text.trim_start_matches(['+', '-']).split_once(',').unwrap_or_default();
    let grouped = (1..=3).contains(&before.len()) && !before.starts_with('0') && behind.len() == 3;
    if grouped && behind.chars().all(|c| c.is_ascii_digit()) { Kind::Group } else { Kind::Decimal }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(text: &str) -> (usize, usize, String) {
        match decide(text, Separator::Semicolon) {
            Commas::Decimal => (0, 0, String::new()),
            Commas::Unclear(line, column, message, help) => (line, column, format!("{message}; {help}")),
        }
    }

    #[test]
    fn one_number_that_is_no_group_of_thousands_decides() {
        for text in ["380;0,123\n390;1,234\n", "380,5;1,234\n", "380;1,2345\n", "380;1,234e-3\n", "# 1.5\n380;,5\n"] {
            assert_eq!(decide(text, Separator::Semicolon), Commas::Decimal, "{text}");
        }
    }

    #[test]
    fn what_could_be_either_is_refused_with_both_readings() {
        let (line, column, words) = told("380;1,234\n390;2,345\n");
        assert_eq!((line, column), (1, 5));
        assert!(words.contains("1.234 or 1234") && words.contains("# decimal: comma"), "{words}");
        assert!(told("380;1,234.5\n").2.contains("thousands"));
        assert!(told("380;1,234,567\n").2.contains("thousands"));
        let (line, _, words) = told("380;0.5\n390;0,6\n");
        assert!(line == 2 && words.contains("line 1 has a point"), "{words}");
    }
}
