//! Observers by name: compared without case and separators, but V′ is not V.

use super::ObserverError;

/// Letters and digits in lower case; primes as words.
fn key(name: &str) -> String {
    let mut key = String::new();
    for character in name.chars() {
        match character {
            'λ' => key.push_str("lambda"),
            '\'' | '′' | '’' => key.push_str("prime"),
            'α' => key.push_str("alpha"),
            '°' => key.push_str("degree"),
            _ => key.extend(character.to_lowercase().filter(|letter| letter.is_alphanumeric())),
        }
    }
    key
}

/// The one of `all` that has this name among its `names`, of which the first is offered where there is none.
pub(super) fn find<T: Copy>(
    what: &'static str,
    name: &str,
    all: &[T],
    names: impl Fn(T) -> &'static [&'static str],
) -> Result<T, ObserverError> {
    let wanted = key(name);
    all.iter().copied().find(|&one| names(one).iter().any(|known| key(known) == wanted)).ok_or_else(|| ObserverError::Unknown {
        what,
        name: name.chars().take(80).collect(),
        allowed: all.iter().filter_map(|&one| names(one).first().copied()).collect(),
    })
}
