//! Where a density is largest, and how wide its peak is.
//!
//! | quantity | definition |
//! |---|---|
//! | peak wavelength λ_p | where the continuum is largest, the shortest such wavelength; of lines alone, the strongest |
//! | half width Δλ_0.5 | distance between the two wavelengths beside the peak at which the continuum falls to half (CIE S 017, 17-28-035) |
//!
//! A continuum and a line have no common scale, so a density of both has the peak of its continuum: what a line is beside it depends on the
//! bandwidth of whoever looks.

use super::{Continuum, Density, Factor, black_body};

/// The largest value of a density.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// Peak wavelength, nm.
    pub wavelength_nm: f64,
    /// Full width at half maximum, nm; none for lines, where the spectrum ends before it has fallen to half, and where it rises above half again.
    pub fwhm_nm: Option<f64>,
}

/// Steps of the search between two breakpoints: curved pieces have at most one maximum in each.
const STEPS: usize = 8;
/// Halvings of a bracket: more than the digits of an `f64`.
const HALVINGS: usize = 200;

impl Density {
    /// The peak of the density; `None` if it is zero.
    pub fn peak(&self) -> Option<Peak> {
        let (scale, continuum, lines) = self.parts();
        if scale == 0.0 {
            return None;
        }
        let Some((from_nm, to_nm)) = continuum.support().hull() else {
            let strongest = lines.iter().max_by(|a, b| a.power.total_cmp(&b.power))?;
            return Some(Peak { wavelength_nm: strongest.wavelength_nm, fwhm_nm: None });
        };
        let mut cuts_nm = vec![from_nm, to_nm];
        push_breakpoints(continuum, &mut cuts_nm);
        cuts_nm.retain(|nm| nm.is_finite() && *nm > 0.0 && (from_nm..=to_nm).contains(nm));
        cuts_nm.sort_by(f64::total_cmp);
        cuts_nm.dedup();
        let places_nm: Vec<f64> = cuts_nm.windows(2).flat_map(|pair| between(pair[0], pair[1])).chain(cuts_nm.last().copied()).collect();
        let values: Vec<f64> = places_nm.iter().map(|nm| continuum.at(*nm)).collect();
        let best = (0..values.len()).rev().max_by(|&i, &j| values[i].total_cmp(&values[j]))?;
        let neighbour = |i: usize| places_nm.get(i).copied().unwrap_or(places_nm[best]);
        let (wavelength_nm, height) = summit(continuum, neighbour(best.wrapping_sub(1)), places_nm[best], neighbour(best + 1));
        if height.is_nan() || height <= 0.0 {
            return None;
        }
        Some(Peak { wavelength_nm, fwhm_nm: half_width_nm(continuum, &places_nm, &values, (wavelength_nm, height), lines.is_empty()) })
    }
}

/// The lower of two breakpoints and places evenly between them.
fn between(low_nm: f64, high_nm: f64) -> impl Iterator<Item = f64> {
    (0..STEPS).map(move |i| low_nm + (high_nm - low_nm) * i as f64 / STEPS as f64)
}

fn push_breakpoints(continuum: &Continuum, out: &mut Vec<f64>) {
    match continuum {
        Continuum::Table(table) => out.extend_from_slice(table.wavelengths_nm()),
        Continuum::Flat { from_nm, to_nm, .. } => out.extend([*from_nm, *to_nm]),
        Continuum::BlackBody { temperature_k } => {
            let peak_nm = black_body::peak_wavelength_nm(*temperature_k);
            out.extend((-10..=20).map(|octave| peak_nm * 2f64.powi(octave)));
        }
        Continuum::Gaussian { centre_nm, sigma_nm } => {
            let bell = Factor::Gaussian { peak: 1.0, centre_nm: *centre_nm, sigma_nm: *sigma_nm };
            out.extend(bell.breakpoints());
        }
        Continuum::Scaled(_, inner) => push_breakpoints(inner, out),
        Continuum::Filtered(inner, factor) => {
            push_breakpoints(inner, out);
            out.extend(factor.breakpoints());
        }
        Continuum::Sum(parts) => parts.iter().for_each(|part| push_breakpoints(part, out)),
    }
}

/// The largest value between `low_nm` and `high_nm`, given that it lies near `best_nm`: golden section on either side, which for a corner of
/// a table ends at the corner itself.
fn summit(continuum: &Continuum, low_nm: f64, best_nm: f64, high_nm: f64) -> (f64, f64) {
    let mut best = (best_nm, continuum.at(best_nm));
    let inverse_golden = 0.5 * (5f64.sqrt() - 1.0);
    let (mut low, mut high) = (low_nm, high_nm);
    for _ in 0..HALVINGS {
        let step = inverse_golden * (high - low);
        let (a, b) = (high - step, low + step);
        if !(low < a && a < b && b < high) {
            break;
        }
        let (at_a, at_b) = (continuum.at(a), continuum.at(b));
        for found in [(a, at_a), (b, at_b)] {
            if found.1 > best.1 {
                best = found;
            }
        }
        if at_a >= at_b {
            high = b;
        } else {
            low = a;
        }
    }
    best
}

fn half_width_nm(continuum: &Continuum, places_nm: &[f64], values: &[f64], peak: (f64, f64), no_lines: bool) -> Option<f64> {
    let half = 0.5 * peak.1;
    let above: Vec<usize> = (0..values.len()).filter(|&i| values[i] > half).collect();
    let (first, last) = (*above.first()?, *above.last()?);
    // One piece above half, with something below half on both of its sides.
    if !no_lines || above.len() != last - first + 1 || first == 0 || last + 1 == values.len() {
        return None;
    }
    let crossing = |mut below_nm: f64, mut above_nm: f64| {
        for _ in 0..HALVINGS {
            let middle = 0.5 * (below_nm + above_nm);
            if middle == below_nm || middle == above_nm {
                break;
            }
            if continuum.at(middle) > half {
                above_nm = middle;
            } else {
                below_nm = middle;
            }
        }
        0.5 * (below_nm + above_nm)
    };
    Some(crossing(places_nm[last + 1], places_nm[last]) - crossing(places_nm[first - 1], places_nm[first]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::{Line, Outside, Table, library};
    use proptest::prelude::*;

    #[test]
    fn a_black_body_peaks_where_wien_says() {
        for kelvin in [300.0, 2856.0, 6504.0] {
            let found = Density::black_body(kelvin).unwrap().peak().unwrap();
            assert!((found.wavelength_nm / black_body::peak_wavelength_nm(kelvin) - 1.0).abs() < 1e-7);
            assert!(found.fwhm_nm.is_some());
        }
    }

    #[test]
    fn a_rectangle_is_as_wide_as_it_is_and_a_line_has_no_width() {
        let line = Density::line(546.07, 2.0).unwrap();
        assert_eq!(line.peak(), Some(Peak { wavelength_nm: 546.07, fwhm_nm: None }));
        assert_eq!(Density::zero().peak(), None);
        let rows = [(400.0, 0.0), (410.0, 1.0), (430.0, 1.0), (440.0, 0.0)];
        let table = Density::table(Table::from_rows(&rows, Outside::Zero).unwrap()).unwrap();
        assert!((table.peak().unwrap().fwhm_nm.unwrap() - 30.0).abs() < 1e-9);
    }

    #[test]
    fn a_spectrum_cut_off_above_half_and_one_of_two_lobes_have_no_half_width() {
        assert_eq!(library::density("A").unwrap().peak().unwrap().fwhm_nm, None);
        let lobes = Density::gaussian(1.0, 450.0, 5.0).unwrap().plus(&Density::gaussian(1.2, 650.0, 5.0).unwrap());
        let peak = lobes.peak().unwrap();
        assert!((peak.wavelength_nm - 650.0).abs() < 1e-5 && peak.fwhm_nm.is_none());
        let with_line = Density::gaussian(1.0, 450.0, 5.0).unwrap().plus(&Density::line(500.0, 1.0).unwrap());
        assert!(with_line.peak().unwrap().fwhm_nm.is_none());
        assert!(Density::new(Continuum::Sum(vec![]), &[Line { wavelength_nm: 1.0, power: 0.0 }]).unwrap().peak().is_none());
    }

    proptest! {
        #[test]
        fn a_narrow_bell_on_a_wide_one_is_found(centre_nm in 400.0..2000.0_f64, ln_sigma in -7.0..2.0_f64) {
            let sigma_nm = ln_sigma.exp();
            let bell = Density::gaussian(1.0, centre_nm, sigma_nm).unwrap();
            let sum = bell.plus(&Density::flat(300.0, 2300.0, 1e-3 / sigma_nm).unwrap());
            let found = sum.peak().unwrap();
            prop_assert!((found.wavelength_nm - centre_nm).abs() < 1e-6 * sigma_nm.max(1e-6 * centre_nm));
            let width = bell.peak().unwrap().fwhm_nm.unwrap();
            prop_assert!((width / (sigma_nm * (8.0 * std::f64::consts::LN_2).sqrt()) - 1.0).abs() < 1e-6);
        }
    }
}
