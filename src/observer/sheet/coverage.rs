//! What of the weighting functions lies beyond the wavelengths that a spectrum was given for.

use super::functional::{Functional, Functionals, OBSERVERS, PHOTOSYNTHETIC_NM};
use crate::metrology::rounding::format_significant;
use crate::observer::{AlphaOpic, Efficiency, Matching};
use crate::spectrum::{Density, Factor};

/// Shares of the area below this are not worth a word: they are beyond the digits that are printed.
const WORTH_A_WORD: f64 = 1e-6;

/// One sentence, or none if nothing that is seen lies outside.
pub(super) fn remark((from_nm, to_nm): (f64, f64), functionals: &Functionals) -> Option<String> {
    let mut named: Vec<(String, Functional)> = Vec::new();
    for efficiency in [Efficiency::Photopic1924, Efficiency::Scotopic1951] {
        named.push((efficiency.symbol().to_owned(), Functional::Luminous(efficiency)));
    }
    named.extend(AlphaOpic::ALL.map(|receptor| (format!("s_{}(λ)", receptor.index()), Functional::AlphaOpic(receptor))));
    for observer in OBSERVERS.into_iter().filter(|observer| *observer == Matching::Cie1931) {
        let names = observer.names();
        named.extend((0..3).map(|i| (format!("{}(λ)", names[i]), Functional::Matching(observer, i))));
    }
    let mut shares: Vec<(String, f64)> = named
        .into_iter()
        .filter_map(|(name, functional)| Some((name, share_outside(functionals.weight(functional)?, from_nm, to_nm)?)))
        .collect();
    let (low, high) = PHOTOSYNTHETIC_NM;
    let missing = (from_nm.min(high) - low).max(0.0) + (high - to_nm.max(low)).max(0.0);
    shares.push(("the photosynthetic range".into(), missing / (high - low)));
    let told: Vec<String> =
        shares.iter().filter(|(_, share)| *share > WORTH_A_WORD).map(|(name, share)| format!("{} of {name}", percent(*share))).collect();
    (!told.is_empty()).then(|| {
        format!("the spectrum is given from {from_nm} nm to {to_nm} nm and counts as zero beyond, where there is {}", told.join(", "))
    })
}

/// A share in per cent, two digits; "nearly all" where two digits would be 100.
fn percent(share: f64) -> String {
    if share == 1.0 {
        "all".to_owned()
    } else if share > 0.995 {
        "nearly all".to_owned()
    } else {
        format!("{} %", format_significant(100.0 * share, 2))
    }
}

/// Share of the area under a function that lies outside `from_nm`..`to_nm`.
fn share_outside(weight: &Factor, from_nm: f64, to_nm: f64) -> Option<f64> {
    let (first_nm, last_nm) = weight.support().hull()?;
    let area = |low: f64, high: f64| Density::flat(low, high, 1.0).map_or(0.0, |flat| flat.integral(&[weight]));
    let (whole, below, above) = (area(first_nm, last_nm), area(first_nm, from_nm.min(last_nm)), area(to_nm.max(first_nm), last_nm));
    (whole > 0.0).then(|| (below + above) / whole)
}
