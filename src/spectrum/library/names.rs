//! What is compared of a name, and which names are near one that was not found.

use super::Entry;

/// How many nearest names are offered.
const OFFERED: usize = 3;

/// Longest part of a name that is compared letter by letter, so that the work is bounded.
const COMPARED: usize = 80;

/// What is compared: letters and digits, in lower case, with signs spelt out and the word "and" left out.
pub(in crate::spectrum) fn key(name: &str) -> String {
    let (mut key, mut word) = (String::new(), String::new());
    for character in name.chars() {
        match character {
            'λ' => word.push_str("lambda"),
            'α' => word.push_str("alpha"),
            '\'' | '′' | '’' => word.push_str("prime"),
            '\u{304}' | '\u{305}' => word.push_str("bar"),
            'ȳ' => word.push_str("ybar"),
            'ḡ' => word.push_str("gbar"),
            '₀'..='₉' => word.extend(char::from_digit(u32::from(character) - u32::from('₀'), 10)),
            _ if character.is_alphanumeric() => word.extend(character.to_lowercase()),
            _ => {
                key.push_str(&spelling(&word));
                word.clear();
                key.push_str(if character == '°' { "deg" } else { "" });
            }
        }
    }
    key + &spelling(&word)
}

/// One spelling for words that have several, nothing for "and".
fn spelling(word: &str) -> String {
    let degrees = ["degrees", "degree"].iter().find_map(|ending| word.strip_suffix(ending));
    match degrees {
        Some(count) if count.chars().all(|digit| digit.is_ascii_digit()) => format!("{count}deg"),
        _ if word == "and" => String::new(),
        _ => word.replace("colour", "color"),
    }
}

/// Official names and aliases close to `name`, best first, one for each entry.
///
/// A name that contains what was asked for counts as one with two letters exchanged, others by their edit distance.
pub(super) fn nearest(name: &str, entries: impl Iterator<Item = &'static Entry>) -> Vec<String> {
    let wanted: Vec<char> = key(name).chars().take(COMPARED).collect();
    let wanted_text: String = wanted.iter().collect();
    let mistakes = |candidate: &str| {
        let distance = edit_distance(&wanted, &candidate.chars().take(COMPARED).collect::<Vec<_>>());
        if wanted.len() >= 3 && candidate.contains(&wanted_text) { distance.min(1) } else { distance }
    };
    let best_of = |entry: &'static Entry| {
        let ranked = entry.names().map(|name| {
            let candidate = key(name);
            (mistakes(&candidate), !candidate.starts_with(&wanted_text), candidate.len(), name)
        });
        ranked.min()
    };
    let mut ranked: Vec<_> = entries.filter_map(best_of).collect();
    ranked.sort_unstable();
    ranked.into_iter().take(OFFERED).map(|(.., name)| name.to_owned()).collect()
}

/// What one letter too many, too few or wrong costs; two neighbours that changed places cost half of it.
const WRONG_LETTER: usize = 2;

/// Optimal string alignment distance.
fn edit_distance(a: &[char], b: &[char]) -> usize {
    let mut before: Vec<usize> = Vec::new();
    let mut row: Vec<usize> = (0..=b.len()).map(|j| j * WRONG_LETTER).collect();
    for (i, from) in a.iter().enumerate() {
        let mut next = vec![(i + 1) * WRONG_LETTER];
        for (j, to) in b.iter().enumerate() {
            let replaced = row[j] + if from == to { 0 } else { WRONG_LETTER };
            let mut least = replaced.min(row[j + 1] + WRONG_LETTER).min(next[j] + WRONG_LETTER);
            if i > 0 && j > 0 && *from == b[j - 1] && a[i - 1] == *to {
                least = least.min(before[j - 1] + WRONG_LETTER / 2);
            }
            next.push(least);
        }
        before = std::mem::replace(&mut row, next);
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn distance(a: &str, b: &str) -> usize {
        edit_distance(&a.chars().collect::<Vec<_>>(), &b.chars().collect::<Vec<_>>())
    }

    #[test]
    fn letters_that_changed_places_are_nearer_than_wrong_ones() {
        assert_eq!([distance("d56", "d65"), distance("d56", "d50"), distance("", "abc"), distance("abc", "abc")], [1, 2, 6, 0]);
        assert_eq!([distance("scotpic", "scotopic"), distance("kitten", "sitting"), distance("ab", "ba")], [2, 6, 1]);
    }

    #[test]
    fn keys_keep_primes_and_greek_letters_and_drop_the_rest() {
        for (name, expected) in [
            ("LED-B3", "ledb3"),
            ("V'(λ)", "vprimelambda"),
            ("x̄₁₀", "xbar10"),
            ("Stockman & Sharpe 2°", "stockmansharpe2deg"),
            ("Stockman and Sharpe 2 degrees", "stockmansharpe2deg"),
            ("10-degree observer", "10degobserver"),
            ("Colour Checker", "colorchecker"),
            ("α-opic", "alphaopic"),
            ("sand", "sand"),
        ] {
            assert_eq!(key(name), expected);
        }
    }
}
