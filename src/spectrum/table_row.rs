//! One row of a curve file: separators, fields and where they stand.

/// What stands between the columns of a curve file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Separator {
    Comma,
    Semicolon,
    Tab,
    Blank,
}

impl Separator {
    /// The separator of a row. A semicolon or a tab decides; a comma does unless what it separates still has blanks inside,
    /// as in `380,5 0,12`, where the comma is a decimal one.
    pub(super) fn of(row: &str) -> Self {
        if row.contains(';') {
            return Self::Semicolon;
        }
        if row.contains('\t') {
            return Self::Tab;
        }
        let starts_with_digit = row.starts_with(|first: char| first.is_ascii_digit());
        let blanks_inside = || row.split(',').any(|part| part.trim().contains(char::is_whitespace));
        if row.contains(',') && !(starts_with_digit && blanks_inside()) { Self::Comma } else { Self::Blank }
    }
}

/// A field of a row, without the blanks and quotation marks around it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Field<'a> {
    pub(super) text: &'a str,
    /// Column of its first character, counted from 1.
    pub(super) column: usize,
}

impl Field<'_> {
    /// Whether it can only be the name of a column: it has a letter and is no number, and is none with a decimal comma.
    pub(super) fn is_a_name(&self) -> bool {
        let starts_as_number = self.text.starts_with(|first: char| first.is_ascii_digit() || "+-.".contains(first));
        self.text.parse::<f64>().is_err() && !starts_as_number && !self.text.is_empty()
    }

    /// Whether it looks like a number with a comma in it.
    pub(super) fn has_comma_number(&self) -> bool {
        let starts_as_number = self.text.starts_with(|first: char| first.is_ascii_digit() || "+-.,".contains(first));
        starts_as_number && self.text.contains(',')
    }

    /// The finite number that the field holds, or a message and what to do about it.
    pub(super) fn number(&self) -> Result<f64, (String, String)> {
        match self.text.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            Ok(_) => {
                let help = "leave the row out, or give a finite value".to_owned();
                Err((format!("`{}` is not a finite number", self.shown()), help))
            }
            Err(_) => {
                let help = match self.with_decimal_point() {
                    Some(corrected) => {
                        format!("this looks like a decimal comma; write `{corrected}`")
                    }
                    None if self.text.is_empty() => "give a value, or leave the row out".to_owned(),
                    None => "give a number such as `0.42` or `4.2e-1`".to_owned(),
                };
                Err((format!("`{}` is not a number", self.shown()), help))
            }
        }
    }

    /// The text with a decimal point, if that makes it a number.
    fn with_decimal_point(&self) -> Option<String> {
        let corrected = self.text.replacen(',', ".", 1);
        (corrected != self.text && corrected.parse::<f64>().is_ok()).then_some(corrected)
    }

    /// The text for a message, cut after 40 characters.
    fn shown(&self) -> String {
        let mut shown: String = self.text.chars().take(40).collect();
        if shown.len() < self.text.len() {
            shown.push('…');
        }
        shown
    }
}

/// Whether a row names the columns. A first field with digits before nothing but numbers is a row with a mistake in it, as `4OO,1.5`,
/// and not to be dropped as a name.
pub(super) fn are_names(fields: &[Field<'_>]) -> bool {
    let Some((first, others)) = fields.split_first() else { return false };
    let before_numbers =
        !others.is_empty() && others.iter().all(|field| field.number().is_ok() || !field.text.contains(char::is_alphabetic));
    first.is_a_name() && !(before_numbers && first.text.contains(char::is_numeric))
}

/// The fields of a row. A separator at the very end of the row opens no further field.
pub(super) fn split(row: &str, separator: Separator) -> Vec<Field<'_>> {
    let mut fields = Vec::new();
    let mut push = |from: usize, to: usize| {
        let raw = &row[from..to];
        let text = raw.trim().trim_matches('"').trim();
        // The offset of a sub-slice; for an empty field the place where it begins.
        let offset = if text.is_empty() { from } else { from + raw.find(text).unwrap_or(0) };
        fields.push(Field { text, column: row[..offset].chars().count() + 1 });
    };
    let is_separator = |character: char| match separator {
        Separator::Comma => character == ',',
        Separator::Semicolon => character == ';',
        Separator::Tab => character == '\t',
        Separator::Blank => character.is_whitespace(),
    };
    let mut from = 0;
    for (position, character) in row.char_indices().filter(|(_, character)| is_separator(*character)) {
        if separator != Separator::Blank || position > from {
            push(from, position);
        }
        from = position + character.len_utf8();
    }
    if !row[from..].trim().is_empty() {
        push(from, row.len());
    }
    fields
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(row: &str) -> Vec<&str> {
        split(row, Separator::of(row.trim())).into_iter().map(|field| field.text).collect()
    }

    #[test]
    fn all_four_separators_are_recognised() {
        for row in ["380,0.5", "380, 0.5", "380;0.5", "380\t0.5", "380   0.5", " 380 0.5 ", "380,0.5,", "\"380\",\"0.5\""] {
            assert_eq!(texts(row), ["380", "0.5"], "{row}");
        }
        assert_eq!(texts("380,5 0,12"), ["380,5", "0,12"]);
        assert_eq!(texts("380,5;0,12"), ["380,5", "0,12"]);
        assert_eq!(texts("380,,0.5"), ["380", "", "0.5"]);
    }

    #[test]
    fn columns_are_counted_in_characters() {
        let fields = split("µm; 0.5", Separator::Semicolon);
        assert_eq!(fields[1], Field { text: "0.5", column: 5 });
    }
}
