//! Which of the allowed names was probably meant.
//!
//! Names are compared without regard to case and separators by the Damerau–Levenshtein distance (optimal string
//! alignment: insertions, deletions, substitutions, swaps of neighbours).

fn plain(name: &str) -> Vec<char> {
    name.chars().filter(|c| c.is_alphanumeric()).take(64).flat_map(char::to_lowercase).collect()
}

/// Whether two names are the same but for case and separators.
pub(super) fn same(a: &str, b: &str) -> bool {
    plain(a) == plain(b)
}

fn distance(a: &[char], b: &[char]) -> usize {
    let mut rows = vec![vec![0usize; b.len() + 1]; a.len() + 1];
    for (i, row) in rows.iter_mut().enumerate() {
        row[0] = i;
    }
    for (j, cell) in rows[0].iter_mut().enumerate() {
        *cell = j;
    }
    for i in 1..=a.len() {
        for j in 1..=b.len() {
            let substituted = rows[i - 1][j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut best = substituted.min(rows[i - 1][j] + 1).min(rows[i][j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                best = best.min(rows[i - 2][j - 2] + 1);
            }
            rows[i][j] = best;
        }
    }
    rows[a.len()][b.len()]
}

/// The allowed name that is close enough to `found` to be offered, if any.
pub(crate) fn nearest<'a>(found: &str, allowed: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let wanted = plain(found);
    let mut best: Option<(usize, &str)> = None;
    for name in allowed {
        let candidate = plain(name);
        let shorter = wanted.len().min(candidate.len());
        // A name that was cut short is closer than its length says.
        let begins = shorter >= 3 && wanted[..shorter] == candidate[..shorter];
        let far = if begins { 1 } else { distance(&wanted, &candidate) };
        if (begins || far <= 1 + wanted.len() / 4) && far < candidate.len().max(1) && best.is_none_or(|(least, _)| far < least) {
            best = Some((far, name));
        }
    }
    best.map(|(_, name)| name)
}

/// The names that are nearest to `found`, nearest first, at most `most` of them, and how many more there are.
pub(crate) fn by_distance<'a>(found: &str, names: impl IntoIterator<Item = &'a str>, most: usize) -> (Vec<&'a str>, usize) {
    let wanted = plain(found);
    let mut all: Vec<(usize, &str)> = names.into_iter().map(|name| (distance(&wanted, &plain(name)), name)).collect();
    all.sort_unstable();
    let more = all.len().saturating_sub(most);
    (all.into_iter().take(most).map(|(_, name)| name).collect(), more)
}

/// `did you mean …? allowed: …`
pub(crate) fn suggestion(found: &str, allowed: &[&str]) -> String {
    let list = allowed.join(", ");
    match nearest(found, allowed.iter().copied()) {
        Some(name) => format!("did you mean `{name}`? allowed: {list}"),
        None => format!("allowed: {list}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_of_the_finger_are_recognised() {
        let allowed = ["half_angle_deg", "radius_m", "Lambertian", "Candela"];
        for (found, meant) in
            [("halfangle", "half_angle_deg"), ("half_angle_rad", "half_angle_deg"), ("lambertain", "Lambertian"), ("candella", "Candela")]
        {
            assert_eq!(nearest(found, allowed), Some(meant), "{found}");
        }
        assert_eq!(nearest("wavelength", allowed), None);
        assert_eq!(nearest("", allowed), None);
    }
}
