//! Classes of illuminance meters: the limits of each quality index, and how sure the class of a measured index is.
//!
//! ```text
//! class of x:  the best one with x ≤ limit            p = Φ((limit − x) / u):  probability that the index is within that limit
//! ```
//!
//! | parameter | meaning | unit |
//! |---|---|---|
//! | x, u | index and its standard uncertainty, taken as normal | that of the limit |
//! | limit | largest value in the class | % |
//!
//! The limits are those of `data/limits/din_5032_7.csv`: DIN 5032-7 as a manufacturer's manual reprints it, **not checked against the
//! standard**. That the uncertainty of the index enters a classification is the idea of CIE 231:2019, whose own limits are not here.
//!
//! ```
//! use etendue::characterization::class_limits::{Class, limits};
//!
//! let f1_prime = limits("f1_prime").ok_or("no such index")?;
//! let found = f1_prime.classify(5.8, 0.2);
//! assert_eq!(found.class, Some(Class::B));
//! assert!((found.probability - 0.841).abs() < 1e-3);
//! # Ok::<(), &str>(())
//! ```

use std::fmt;
use std::sync::OnceLock;

use crate::metrology::distribution::normal_cumulative;

const TABLE: &str = include_str!("../../data/limits/din_5032_7.csv");

/// Where the limits come from, for reports.
pub const SOURCE: &str = "DIN 5032-7 as a manufacturer's manual reprints it; not checked against the standard";

/// A class of illuminance meters, the best first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// Laboratory.
    L,
    /// High accuracy.
    A,
    /// Medium accuracy.
    B,
    /// Low accuracy.
    C,
}

impl Class {
    /// All classes, the best first.
    pub const ALL: [Self; 4] = [Self::L, Self::A, Self::B, Self::C];

    /// The letter.
    #[must_use]
    pub const fn letter(self) -> &'static str {
        match self {
            Self::L => "L",
            Self::A => "A",
            Self::B => "B",
            Self::C => "C",
        }
    }
}

impl fmt::Display for Class {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.letter())
    }
}

/// The limits of one index.
#[derive(Debug, Clone, PartialEq)]
pub struct Limits {
    /// Symbol in the file, such as `f1_prime`.
    pub symbol: String,
    /// What it is, in words.
    pub what: String,
    /// Unit of the limits: `%`, or `%/K`.
    pub unit: String,
    /// Largest value in class L, A, B, C. An index without a limit for class L has that of class A.
    pub largest: [f64; 4],
}

/// The class of an index, or of a meter as a whole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Classified {
    /// The class; `None` where the index is beyond that of the last class.
    pub class: Option<Class>,
    /// Probability that the index is within the limit of that class; without a class, that it is beyond the last limit.
    pub probability: f64,
}

impl Limits {
    /// The class of an index `value` with standard uncertainty `u`, both in the unit of the limits.
    #[must_use]
    pub fn classify(&self, value: f64, standard_uncertainty: f64) -> Classified {
        let found = Class::ALL.into_iter().zip(self.largest).find(|(_, limit)| value <= *limit);
        match found {
            Some((class, limit)) => Classified { class: Some(class), probability: within(limit, value, standard_uncertainty) },
            None => Classified { class: None, probability: 1.0 - within(self.largest[3], value, standard_uncertainty) },
        }
    }
}

/// The class of a meter: the worst of its indices; the probability that all are within the limits of that class, for independent indices.
/// `None` without indices.
#[must_use]
pub fn worst(indices: &[(&Limits, f64, f64)]) -> Option<Classified> {
    let classes = indices.iter().map(|(limits, value, u)| limits.classify(*value, *u));
    // No class at all is the worst.
    let rank = |c: &Classified| c.class.map_or(Class::ALL.len(), |class| class as usize);
    let worst = classes.max_by_key(rank)?;
    let Some(class) = worst.class else {
        let all_within: f64 = indices.iter().map(|(limits, value, u)| within(limits.largest[3], *value, *u)).product();
        return Some(Classified { class: None, probability: 1.0 - all_within });
    };
    let probability = indices.iter().map(|(limits, value, u)| within(limits.largest[class as usize], *value, *u)).product();
    Some(Classified { class: Some(class), probability })
}

/// Probability that an index is within a limit.
fn within(limit: f64, value: f64, standard_uncertainty: f64) -> f64 {
    let z = (limit - value) / standard_uncertainty;
    // 0/0: exactly on the limit, which belongs to the class.
    if z.is_nan() { 1.0 } else { normal_cumulative(z) }
}

/// All limits, in the order of the file.
pub fn all() -> &'static [Limits] {
    static ALL: OnceLock<Vec<Limits>> = OnceLock::new();
    ALL.get_or_init(|| TABLE.lines().filter(|line| !line.starts_with('#')).skip(1).filter_map(row).collect())
}

/// The limits of an index by its symbol in the file.
#[must_use]
pub fn limits(symbol: &str) -> Option<&'static Limits> {
    all().iter().find(|limits| limits.symbol == symbol)
}

fn row(line: &str) -> Option<Limits> {
    let cells: Vec<&str> = line.split(',').collect();
    let [symbol, what, unit, l, a, b, c] = cells[..] else { return None };
    let number = |cell: &str| cell.parse::<f64>().ok();
    let a = number(a)?;
    // The footnote of class L: other than at normal incidence, the limits of class A apply.
    let largest = [number(l).unwrap_or(a), a, number(b)?, number(c)?];
    Some(Limits { symbol: symbol.to_owned(), what: what.to_owned(), unit: unit.to_owned(), largest })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_of_the_file_is_read_and_limits_rise() {
        let rows = TABLE.lines().filter(|line| !line.starts_with('#')).count() - 1;
        assert_eq!((all().len(), rows), (14, 14));
        assert!(all().iter().all(|limits| limits.largest.windows(2).all(|pair| pair[0] <= pair[1])));
        assert_eq!(limits("f2").unwrap().largest, [1.5, 1.5, 3.0, 6.0]);
    }

    #[test]
    fn a_limit_belongs_to_its_class_and_is_as_likely_as_not() {
        let f1 = limits("f1_prime").unwrap();
        assert_eq!(f1.classify(6.0, 0.0), Classified { class: Some(Class::B), probability: 1.0 });
        let open = f1.classify(6.0, 0.3);
        assert_eq!(open.class, Some(Class::B));
        assert!((open.probability - 0.5).abs() < 1e-12);
        assert_eq!(f1.classify(9.1, 0.0), Classified { class: None, probability: 1.0 });
        assert_eq!(f1.classify(0.0, 0.0).class, Some(Class::L));
    }

    #[test]
    fn a_meter_is_as_good_as_its_worst_index() {
        let (f1, f2) = (limits("f1_prime").unwrap(), limits("f2").unwrap());
        let meter = worst(&[(f1, 2.0, 0.0), (f2, 2.9, 0.1)]).unwrap();
        assert_eq!(meter.class, Some(Class::B));
        assert!((meter.probability - normal_cumulative(1.0)).abs() < 1e-12);
        assert_eq!(worst(&[(f1, 20.0, 0.1), (f2, 0.0, 0.0)]).unwrap().class, None);
        assert_eq!(worst(&[]), None);
    }
}
