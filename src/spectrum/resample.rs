//! A density on another grid, only on request, with the error stated.
//!
//! | rule | value at node k of a grid with step Δ |
//! |---|---|
//! | [`Rule::BinAverages`] | power between the middles to the neighbouring nodes, over that width; the first and the last bin are half as wide |
//! | [`Rule::Points`] | `φ(λₖ)` |
//!
//! The result is linear between the nodes and zero outside, so with bin averages its total is the power between the first and the last
//! node, exactly. Two figures say what was lost:
//!
//! * `largest_change = ∫ |φ′ − φ| dλ / ∫ φ dλ`: no integral against a weight between 0 and 1 changes by more than this share of the total.
//! * `observer_changes`: how much the integrals against x̄, ȳ, z̄ of CIE 1931 change, each relative to itself.

use super::density::steps;
use super::gauss_legendre;
use super::{Continuum, Density, Factor, Line, Outside, SpectrumError, Table, library};

/// How values of the new grid are formed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rule {
    /// Averages over bins about the nodes: the power is kept.
    BinAverages,
    /// The values at the nodes: the shape is kept where it is smooth.
    Points,
}

/// What becomes of lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lines {
    /// They stay lines beside the table.
    Keep,
    /// Their power goes into the bin in which they lie; only with [`Rule::BinAverages`].
    IntoBins,
}

/// A density on another grid, and what that cost.
#[derive(Debug, Clone, PartialEq)]
pub struct Resampled {
    /// The density: the table, and the lines if they were kept.
    pub density: Density,
    /// The rows on the new grid, per nm.
    pub table: Table,
    /// `∫ |φ′ − φ| dλ / ∫ φ dλ` over all wavelengths, to about a hundredth of itself. A line that went into a bin counts twice, where it
    /// was and where it went. Zero for a density that is zero.
    pub largest_change: f64,
    /// Relative change of the integrals against x̄, ȳ, z̄ of CIE 1931; `None` where the integral was zero and is none.
    pub observer_changes: [Option<f64>; 3],
    /// Share of the total that lies outside the new grid and is lost.
    pub lost_outside: f64,
    /// What was done, in words, for whoever asked.
    pub remarks: Vec<String>,
}

/// The density at `from_nm`, `from_nm + step_nm`, … up to and with `to_nm`.
///
/// # Errors
/// If there are fewer than two nodes or too many, if a total is not finite, and if lines are to go into bins that the rule does not have.
///
/// ```
/// use etendue::spectrum::{Density, resample::{Lines, Rule, resample}};
/// let lamp = Density::gaussian(1.0, 546.07, 0.1)?;
/// // A line of 0.24 nm has no place on a grid of 5 nm: its power is kept, its place is not.
/// let coarse = resample(&lamp, 380.0, 780.0, 5.0, Rule::BinAverages, Lines::Keep)?;
/// assert!((coarse.density.total() - 1.0).abs() < 1e-12);
/// assert!(coarse.largest_change > 1.8);
/// # Ok::<(), etendue::spectrum::SpectrumError>(())
/// ```
pub fn resample(density: &Density, from_nm: f64, to_nm: f64, step_nm: f64, rule: Rule, lines: Lines) -> Result<Resampled, SpectrumError> {
    const MOST_NODES: f64 = 1e5;
    let nodes = (to_nm - from_nm) / step_nm;
    if nodes > MOST_NODES {
        return Err(SpectrumError::Parameter { name: "the number of steps", value: nodes, allowed: "at most 100 000" });
    }
    let grid_nm = steps(from_nm, to_nm, step_nm)?;
    let continuum = density.without_lines();
    let old_lines = density.lines();
    if rule == Rule::Points && lines == Lines::IntoBins && !old_lines.is_empty() {
        let allowed = "none: values at points have no bins; take averages over bins, or keep the lines";
        return Err(SpectrumError::Parameter { name: "the number of lines to be put into bins", value: old_lines.len() as f64, allowed });
    }
    let inside = |line: &&Line| grid_nm[0] <= line.wavelength_nm && line.wavelength_nm <= grid_nm[grid_nm.len() - 1];
    let binned = if lines == Lines::IntoBins { density.clone() } else { continuum.clone() };
    let values = match rule {
        Rule::Points => grid_nm.iter().map(|nm| continuum.continuum_at(*nm)).collect(),
        Rule::BinAverages => bin_averages(&binned, &grid_nm)?,
    };
    let table = Table::new(grid_nm.clone(), values, Outside::Zero)?;
    let rows = Density::table(table.clone())?;
    let kept: Vec<Line> = if lines == Lines::Keep { old_lines.clone() } else { Vec::new() };
    let result = rows.plus(&Density::lines_only(&kept)?);

    let total = super::error::finite("the total of the density", density.total())?;
    let band = Factor::band(grid_nm[0], grid_nm[grid_nm.len() - 1], 1.0)?;
    let outside = (binned.total() - binned.integral(&[&band])).max(0.0);
    let moved: f64 = if lines == Lines::IntoBins { old_lines.iter().filter(inside).map(|line| line.power).sum() } else { 0.0 };
    let share = |power: f64| if total > 0.0 { power / total } else { 0.0 };
    let change = difference(&continuum, &table) + moved + outside;
    let observer_changes = ["x_bar", "y_bar", "z_bar"].map(|column| {
        let weight = library::factor(&format!("CIE 1931 2 Degree Standard Observer {column}")).ok()?;
        let (before, after) = (density.integral(&[&weight]), result.integral(&[&weight]));
        (before > 0.0).then(|| after / before - 1.0)
    });
    let mut resampled = Resampled {
        density: result,
        table,
        largest_change: share(change),
        observer_changes,
        lost_outside: share(outside),
        remarks: Vec::new(),
    };
    resampled.remark(rule, lines, old_lines.len(), step_nm);
    Ok(resampled)
}

impl Resampled {
    fn remark(&mut self, rule: Rule, lines: Lines, number: usize, step_nm: f64) {
        let (from_nm, to_nm) = self.table.range_nm();
        let values = if rule == Rule::BinAverages { "averages over bins about the nodes" } else { "values at the nodes" };
        self.remarks.push(format!("resampled from {from_nm} nm to {to_nm} nm in steps of {step_nm} nm: {values}"));
        if number > 0 {
            let what = if lines == Lines::IntoBins { "went into the bins in which they lie" } else { "stay lines beside the table" };
            self.remarks.push(format!("{number} lines {what}"));
        }
        let percent = 100.0 * self.largest_change;
        self.remarks.push(format!("no integral against a weight between 0 and 1 changes by more than {percent:.3} % of the total"));
        if self.lost_outside > 0.0 {
            self.remarks.push(format!("{:.3} % of the total lies outside and is lost", 100.0 * self.lost_outside));
        }
    }
}

/// Power in the bin about each node over the width of the bin.
fn bin_averages(density: &Density, grid_nm: &[f64]) -> Result<Vec<f64>, SpectrumError> {
    let last = grid_nm.len() - 1;
    let middle = |k: usize| 0.5 * (grid_nm[k] + grid_nm[k + 1]);
    let (continuum, old_lines) = (density.without_lines(), density.lines());
    let (scale, shape, _) = continuum.parts();
    (0..=last)
        .map(|k| {
            let from_nm = if k == 0 { grid_nm[0] } else { middle(k - 1) };
            let to_nm = if k == last { grid_nm[last] } else { middle(k) };
            // A line on the border of two bins belongs to the upper one.
            let upper = if k == last { to_nm } else { to_nm.next_down() };
            let power = match shape {
                Continuum::Table(table) => scale * area(table, from_nm, to_nm),
                _ => continuum.integral(&[&Factor::band(from_nm, to_nm, 1.0)?]),
            };
            let lines = old_lines.iter().filter(|line| from_nm <= line.wavelength_nm && line.wavelength_nm <= upper);
            Ok((power + lines.map(|line| line.power).sum::<f64>()) / (to_nm - from_nm))
        })
        .collect()
}

/// `∫ table dλ` over an interval, from the rows within it alone: a walk along the whole table for every bin would take time as the product.
fn area(table: &Table, from_nm: f64, to_nm: f64) -> f64 {
    let (first_nm, last_nm) = table.range_nm();
    let (from_nm, to_nm) = (from_nm.max(first_nm), to_nm.min(last_nm));
    if from_nm >= to_nm {
        return 0.0;
    }
    let inner = table.breakpoints_within(from_nm, to_nm).iter().copied().filter(|nm| from_nm < *nm && *nm < to_nm);
    let edges: Vec<f64> = std::iter::once(from_nm).chain(inner).chain([to_nm]).collect();
    edges.windows(2).map(|pair| (pair[1] - pair[0]) * (0.5 * table.at(pair[0]) + 0.5 * table.at(pair[1]))).sum()
}

/// `∫ |φ − table| dλ` between the first and the last row.
fn difference(continuum: &Density, table: &Table) -> f64 {
    const PARTS: usize = 4;
    const NODES: usize = 8;
    let (from_nm, to_nm) = table.range_nm();
    let (_, shape, _) = continuum.parts();
    let mut cuts = table.wavelengths_nm().to_vec();
    push_breakpoints(shape, from_nm, to_nm, &mut cuts);
    cuts.sort_by(f64::total_cmp);
    cuts.dedup();
    let piece = |from: f64, to: f64| {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let at = |nm: f64| (continuum.continuum_at(nm) - table.at(nm)).abs();
        gauss_legendre::rule(NODES).iter().map(|(x, weight)| weight * half * at(middle + half * x)).sum::<f64>()
    };
    let parts = |pair: &[f64]| {
        let part = (pair[1] - pair[0]) / PARTS as f64;
        (0..PARTS).map(|i| piece(pair[0] + part * i as f64, pair[0] + part * (i + 1) as f64)).sum::<f64>()
    };
    cuts.windows(2).map(parts).sum()
}

/// The breakpoints of a continuum strictly inside an interval, in no order.
fn push_breakpoints(continuum: &Continuum, from_nm: f64, to_nm: f64, out: &mut Vec<f64>) {
    match continuum {
        Continuum::Table(table) => out.extend_from_slice(table.breakpoints_within(from_nm, to_nm)),
        Continuum::Flat { from_nm: from, to_nm: to, .. } => out.extend([*from, *to].into_iter().filter(|nm| from_nm < *nm && *nm < to_nm)),
        Continuum::BlackBody { .. } => {}
        Continuum::Gaussian { centre_nm, sigma_nm } => {
            Factor::Gaussian { peak: 1.0, centre_nm: *centre_nm, sigma_nm: *sigma_nm }.push_breakpoints(from_nm, to_nm, out);
        }
        Continuum::Scaled(_, inner) => push_breakpoints(inner, from_nm, to_nm, out),
        Continuum::Filtered(inner, factor) => {
            push_breakpoints(inner, from_nm, to_nm, out);
            factor.push_breakpoints(from_nm, to_nm, out);
        }
        Continuum::Sum(parts) => parts.iter().for_each(|part| push_breakpoints(part, from_nm, to_nm, out)),
    }
}

#[cfg(test)]
#[path = "tests/resample.rs"]
mod tests;
