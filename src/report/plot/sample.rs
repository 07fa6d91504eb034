//! Points of a function, close enough for a smooth line, and none outside its table.

use crate::spectrum::{Density, Factor};

use super::PlotError;
use super::chart::{Ink, Stop};
use super::wavelength_colour;

/// Finest step at which a spectrum is drawn, nm.
const FINEST_NM: f64 = 1.0 / 64.0;
/// Largest deviation of what is drawn from the spectrum, of its integral.
const DRAWN_AREA: f64 = 2e-3;

/// Points from `from` to `to`, no further apart than `step`, both ends included.
pub(super) fn every(from: f64, to: f64, step: f64) -> Vec<f64> {
    let steps = ((to - from) / step - 1e-9).ceil().clamp(1.0, 1e6) as usize;
    (0..=steps).map(|i| if i == steps { to } else { from + (to - from) * i as f64 / steps as f64 }).collect()
}

/// Points of `f` on whole nm from `from_nm` to `to_nm`.
pub(super) fn on_whole_nm<E>(from_nm: f64, to_nm: f64, f: impl Fn(f64) -> Result<f64, E>) -> Result<Vec<[f64; 2]>, E> {
    every(from_nm, to_nm, 1.0).into_iter().map(|nm| Ok([nm, f(nm)?])).collect()
}

/// The rows of a table from `from_nm` to `to_nm`; other factors every nm and at their breakpoints. Nothing outside a table.
pub(super) fn of_factor(factor: &Factor, from_nm: f64, to_nm: f64) -> Vec<[f64; 2]> {
    if let Factor::Table(table) = factor {
        return table.rows().filter(|(nm, _)| (from_nm..=to_nm).contains(nm)).map(|(nm, value)| [nm, value]).collect();
    }
    let mut nm = every(from_nm, to_nm, 1.0);
    nm.extend(factor.breakpoints().into_iter().filter(|nm| (from_nm..=to_nm).contains(nm)));
    nm.sort_by(f64::total_cmp);
    nm.dedup();
    nm.into_iter().map(|nm| [nm, factor.at(nm)]).collect()
}

/// The continuum of a density from `from_nm` to `to_nm` where it is not zero, per nm; empty if it has none there. The step is refined
/// until the area under what is drawn is that of the spectrum; errors if there are structures narrower than the finest step.
pub(super) fn of_density(density: &Density, name: &str, from_nm: f64, to_nm: f64) -> Result<Vec<[f64; 2]>, PlotError> {
    let intervals: Vec<(f64, f64)> = density.support().intervals().iter().copied().filter(|(low, high)| high > low).collect();
    let (Some(first), Some(last)) = (intervals.first(), intervals.last()) else { return Ok(Vec::new()) };
    let (from, to) = (from_nm.max(first.0), to_nm.min(last.1));
    if from >= to {
        return Ok(Vec::new());
    }
    let band = Factor::Band { from_nm: from, to_nm: to, value: 1.0 };
    let lines: f64 = density.lines().iter().filter(|line| (from..=to).contains(&line.wavelength_nm)).map(|line| line.power).sum();
    let exact = density.integral(&[&band]) - lines;
    let mut step = 1.0_f64.min((to - from) / 200.0);
    loop {
        let mut nm: Vec<f64> = every(from, to, step);
        nm.extend(intervals.iter().flat_map(|(low, high)| [*low, *high]).filter(|nm| (from..=to).contains(nm)));
        nm.sort_by(f64::total_cmp);
        nm.dedup();
        let points: Vec<[f64; 2]> = nm.into_iter().map(|nm| [nm, density.continuum_at(nm)]).collect();
        let drawn: f64 = points.windows(2).map(|pair| 0.5 * (pair[0][1] + pair[1][1]) * (pair[1][0] - pair[0][0])).sum();
        // The sum of lines is subtracted from a sum that holds them: what rounding leaves of it is no continuum.
        if (drawn - exact).abs() <= DRAWN_AREA * exact.abs() + 1e-9 * lines {
            return Ok(points);
        }
        if step <= FINEST_NM {
            let what = format!("`{name}` has structures narrower than {FINEST_NM} nm, which a picture would not show; give them as lines");
            return Err(PlotError::Request { what });
        }
        step *= 0.25;
    }
}

/// Between these wavelengths the colours stand as they are; beyond them they fade.
const BRIGHT_NM: (f64, f64) = (430.0, 640.0);

/// The colours of wavelengths along an axis in nm; nothing outside the visible.
pub(super) fn strip(from_nm: f64, to_nm: f64) -> Vec<Stop> {
    let (first, last) = (from_nm.max(380.0), to_nm.min(780.0));
    if first >= last {
        return Vec::new();
    }
    // Towards its ends a dark colour is a bright one that lets the background through, so that they fade on light and dark alike.
    let brightest = |nm: f64| wavelength_colour::colour(nm).into_iter().max().map_or(1.0, f64::from).max(1.0);
    let stop = |nm: f64, share: f64| {
        let opacity = (brightest(nm) / brightest(nm.clamp(BRIGHT_NM.0, BRIGHT_NM.1))).min(1.0);
        let colour = wavelength_colour::colour(nm).map(|part| (f64::from(part) / opacity).round().min(255.0) as u8);
        Stop { x: nm, colour, opacity: share * opacity }
    };
    let mut stops: Vec<Stop> = every(first, last, 5.0).into_iter().map(|nm| stop(nm, 1.0)).collect();
    if from_nm < first {
        stops.insert(0, stop(first, 0.0));
    }
    if to_nm > last {
        stops.push(stop(last, 0.0));
    }
    stops
}

/// The colour of a wavelength, muted where it is not visible.
pub(super) fn wavelength_ink(nm: f64) -> Ink {
    if (380.0..=780.0).contains(&nm) { Ink::Fixed(wavelength_colour::colour(nm)) } else { Ink::Muted }
}

/// `V_F,10(λ)` with its subscript marked as such.
pub(super) fn subscripted(symbol: &str) -> String {
    let Some((base, rest)) = symbol.split_once('_') else { return symbol.to_owned() };
    let end = rest.find(|c: char| !(c.is_alphanumeric() || c == ',')).unwrap_or(rest.len());
    format!("{base}_{{{}}}{}", &rest[..end], &rest[end..])
}

/// "a", "a and b", "a, b and c".
pub(super) fn listed(names: &[String]) -> String {
    match names {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::Line;

    #[test]
    fn narrow_peaks_are_drawn_and_narrower_ones_refused() {
        let narrow = Density::gaussian(1.0, 500.3, 0.1).unwrap();
        let points = of_density(&narrow.plus(&Density::flat(400.0, 700.0, 1e-3).unwrap()), "peak", 380.0, 780.0).unwrap();
        let largest = points.iter().map(|p| p[1]).fold(0.0, f64::max);
        assert!((largest / 3.99 - 1.0).abs() < 0.01, "{largest}");
        let needle = Density::gaussian(1.0, 500.3, 1e-4).unwrap().plus(&Density::flat(400.0, 700.0, 1e-3).unwrap());
        assert!(of_density(&needle, "needle", 380.0, 780.0).unwrap_err().to_string().contains("give them as lines"));
    }

    #[test]
    fn lines_are_no_continuum() {
        let lines = [Line { wavelength_nm: 436.0, power: 1.0 }, Line { wavelength_nm: 546.07, power: 3.0 }];
        assert!(of_density(&Density::lines_only(&lines).unwrap(), "Hg", 380.0, 780.0).unwrap().is_empty());
    }

    #[test]
    fn subscripts_are_marked() {
        assert_eq!(["V_F,10(λ)", "V(λ)", "x̄_F"].map(subscripted), ["V_{F,10}(λ)", "V(λ)", "x̄_{F}"]);
    }
}
