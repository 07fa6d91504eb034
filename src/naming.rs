//! Which of the allowed names was probably meant.
//!
//! Names are compared without regard to case and separators by the Damerau–Levenshtein distance (optimal string
//! alignment): a letter too many, too few or wrong is one mistake, two neighbours that changed places half of one.

/// Halves of a mistake for a letter too many, too few or wrong.
const WRONG_LETTER: usize = 2;
/// Halves of a mistake for two neighbours that changed places.
const EXCHANGED: usize = 1;

fn plain(name: &str) -> Vec<char> {
    name.chars().filter(|c| c.is_alphanumeric()).take(64).flat_map(char::to_lowercase).collect()
}

/// Whether two names are the same but for case and separators.
pub fn same(a: &str, b: &str) -> bool {
    plain(a) == plain(b)
}

/// Halves of mistakes between two texts. The work is the product of their lengths.
pub(crate) fn distance(a: &[char], b: &[char]) -> usize {
    let mut before: Vec<usize> = Vec::new();
    let mut row: Vec<usize> = (0..=b.len()).map(|j| j * WRONG_LETTER).collect();
    for (i, from) in a.iter().enumerate() {
        let mut next = vec![(i + 1) * WRONG_LETTER];
        for (j, to) in b.iter().enumerate() {
            let replaced = row[j] + if from == to { 0 } else { WRONG_LETTER };
            let mut least = replaced.min(row[j + 1] + WRONG_LETTER).min(next[j] + WRONG_LETTER);
            if i > 0 && j > 0 && *from == b[j - 1] && a[i - 1] == *to {
                least = least.min(before[j - 1] + EXCHANGED);
            }
            next.push(least);
        }
        before = std::mem::replace(&mut row, next);
    }
    row[b.len()]
}

/// The allowed name that is close enough to `found` to be offered, if any.
pub fn nearest<'a>(found: &str, allowed: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let wanted = plain(found);
    let mut best: Option<(usize, &str)> = None;
    for name in allowed {
        let candidate = plain(name);
        let shorter = wanted.len().min(candidate.len());
        // A name that was cut short is closer than its length says.
        let begins = shorter >= 3 && wanted[..shorter] == candidate[..shorter];
        let far = if begins { WRONG_LETTER } else { distance(&wanted, &candidate) };
        if (begins || far <= WRONG_LETTER * (1 + wanted.len() / 4))
            && far < WRONG_LETTER * candidate.len().max(1)
            && best.is_none_or(|(least, _)| far < least)
        {
            best = Some((far, name));
        }
    }
    best.map(|(_, name)| name)
}

/// The names that are nearest to `found`, nearest first, at most `most` of them, and how many more there are.
pub fn by_distance<'a>(found: &str, names: impl IntoIterator<Item = &'a str>, most: usize) -> (Vec<&'a str>, usize) {
    let wanted = plain(found);
    let mut all: Vec<(usize, &str)> = names.into_iter().map(|name| (distance(&wanted, &plain(name)), name)).collect();
    all.sort_unstable();
    let more = all.len().saturating_sub(most);
    (all.into_iter().take(most).map(|(_, name)| name).collect(), more)
}

/// `did you mean …? allowed: …`
pub fn suggestion(found: &str, allowed: &[&str]) -> String {
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
    fn letters_that_changed_places_are_nearer_than_wrong_ones() {
        let halves = |a: &str, b: &str| distance(&a.chars().collect::<Vec<_>>(), &b.chars().collect::<Vec<_>>());
        assert_eq!([halves("d56", "d65"), halves("d56", "d50"), halves("", "abc"), halves("abc", "abc")], [1, 2, 6, 0]);
        assert_eq!([halves("scotpic", "scotopic"), halves("kitten", "sitting"), halves("ab", "ba")], [2, 6, 1]);
    }

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
