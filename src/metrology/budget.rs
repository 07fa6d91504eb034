//! The uncertainty budget: rows, combined standard uncertainty, effective degrees of freedom, coverage.
//!
//! ```text
//! u_c² = Σ u_i²                      GUM 5.1.2, sensitivity coefficients already in u_i
//! ν_eff = u_c⁴ / Σ (u_i⁴ / ν_i)      Welch–Satterthwaite, GUM G.4.1
//! U = k u_c,  k = t_p(ν_eff)         GUM G.3.4
//! ```
//!
//! Rows are taken as independent. **Correlation is out of scope**: effects that share a cause belong into one row.
//!
//! | evaluation | u | ν |
//! |---|---|---|
//! | type A | `s/√R` | R − 1 |
//! | type B, normal | as stated | ∞ |
//! | type B, within ±a | `a/√3` | ∞ |
//! | type B, between 0 and b, value not corrected | `b/√3` | ∞ |
//! | type B, between 0 and b, value moved by b/2 | `b/√12` | ∞ |

use super::distribution::student_t_quantile;

/// Coverage probability when none is asked for.
pub const DEFAULT_COVERAGE_PROBABILITY: f64 = 0.95;

/// How a standard uncertainty was evaluated (GUM 2.3.2, 2.3.3).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum EvaluationKind {
    /// From the spread of repeated observations or independent replicates.
    A,
    /// By other means: a certificate, a bound, a resolution.
    B,
}

impl EvaluationKind {
    /// "A" or "B".
    pub const fn letter(self) -> &'static str {
        match self {
            Self::A => "A",
            Self::B => "B",
        }
    }
}

/// One source of uncertainty.
#[derive(Debug, Clone, PartialEq)]
pub struct BudgetRow {
    /// What causes it, in words, e.g. "sampling".
    pub source: String,
    /// Type A or type B.
    pub kind: EvaluationKind,
    /// Contribution to the standard uncertainty of the result, in the unit of the result, zero or more.
    pub standard_uncertainty: f64,
    /// Degrees of freedom of that contribution, above zero; infinite when it is taken as exactly known.
    pub degrees_of_freedom: f64,
}

impl BudgetRow {
    /// A type A row: `standard_uncertainty` of the mean of replicates with `degrees_of_freedom`.
    pub fn type_a(source: impl Into<String>, standard_uncertainty: f64, degrees_of_freedom: f64) -> Self {
        Self { source: source.into(), kind: EvaluationKind::A, standard_uncertainty: standard_uncertainty.abs(), degrees_of_freedom }
    }

    fn type_b(source: impl Into<String>, standard_uncertainty: f64) -> Self {
        Self {
            source: source.into(),
            kind: EvaluationKind::B,
            standard_uncertainty: standard_uncertainty.abs(),
            degrees_of_freedom: f64::INFINITY,
        }
    }

    /// A type B row whose `standard_uncertainty` is stated, with infinite degrees of freedom (GUM 4.3.3).
    pub fn normal(source: impl Into<String>, standard_uncertainty: f64) -> Self {
        Self::type_b(source, standard_uncertainty)
    }

    /// A type B row for an effect anywhere within ± `half_width`: `a/√3` (GUM 4.3.7).
    pub fn rectangular(source: impl Into<String>, half_width: f64) -> Self {
        Self::type_b(source, half_width / 3f64.sqrt())
    }

    /// A type B row for an effect anywhere between zero and `bound` that the value does **not** account for: `b/√3`,
    /// the root mean square distance of the rectangle from its end (GUM F.2.4.5).
    pub fn one_sided(source: impl Into<String>, bound: f64) -> Self {
        Self::type_b(source, bound / 3f64.sqrt())
    }

    /// A type B row for an effect anywhere between zero and `bound` when the value **has been** moved by `bound / 2`,
    /// the mean of the effect: `b/√12` (GUM 4.3.8).
    pub fn one_sided_corrected(source: impl Into<String>, bound: f64) -> Self {
        Self::type_b(source, bound / 12f64.sqrt())
    }

    /// This row for a result multiplied by `factor`.
    pub fn scaled(&self, factor: f64) -> Self {
        Self { standard_uncertainty: self.standard_uncertainty * factor.abs(), ..self.clone() }
    }
}

/// An expanded uncertainty with what it rests on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expanded {
    /// Probability that the interval value ± U holds the measurand.
    pub coverage_probability: f64,
    /// Coverage factor `k`, from Student's distribution.
    pub coverage_factor: f64,
    /// Expanded uncertainty `U = k u_c`, in the unit of the result.
    pub expanded_uncertainty: f64,
    /// Effective degrees of freedom `ν_eff` behind `k`.
    pub degrees_of_freedom: f64,
}

/// The rows of an uncertainty budget, in the order in which they were added.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Budget {
    /// The rows.
    pub rows: Vec<BudgetRow>,
}

impl Budget {
    /// A budget without rows.
    pub const fn new() -> Self {
        Self { rows: Vec::new() }
    }

    /// Adds a row.
    pub fn push(&mut self, row: BudgetRow) {
        self.rows.push(row);
    }

    /// Combined standard uncertainty `u_c`, in the unit of the result; zero without rows. Finite whenever it is in
    /// range, also where the squares are not.
    pub fn combined_standard_uncertainty(&self) -> f64 {
        self.root_sum_of_squares(|_| true)
    }

    /// Combined standard uncertainty of the rows of one kind alone.
    pub fn combined_of_kind(&self, kind: EvaluationKind) -> f64 {
        self.root_sum_of_squares(|row| row.kind == kind)
    }

    fn root_sum_of_squares(&self, keep: impl Fn(&BudgetRow) -> bool) -> f64 {
        self.rows.iter().filter(|row| keep(row)).fold(0.0, |sum, row| sum_in_quadrature(sum, row.standard_uncertainty))
    }

    /// Effective degrees of freedom `ν_eff` (Welch–Satterthwaite); infinite without rows.
    ///
    /// When every uncertainty is zero the formula is 0/0, and the smallest degrees of freedom of a row are returned.
    /// NaN when an uncertainty is NaN or infinite.
    pub fn effective_degrees_of_freedom(&self) -> f64 {
        let combined = self.combined_standard_uncertainty();
        if combined == 0.0 {
            return self.rows.iter().map(|row| row.degrees_of_freedom).fold(f64::INFINITY, f64::min);
        }
        let inverse: f64 = self.rows.iter().map(|row| (row.standard_uncertainty / combined).powi(4) / row.degrees_of_freedom).sum();
        1.0 / inverse
    }

    /// Coverage factor `k` for `coverage_probability`, between zero and one: the quantile of Student's distribution at
    /// the effective degrees of freedom. `None` when the probability or the degrees of freedom are out of range.
    pub fn coverage_factor(&self, coverage_probability: f64) -> Option<f64> {
        student_t_quantile(0.5 + 0.5 * coverage_probability, self.effective_degrees_of_freedom())
    }

    /// Expanded uncertainty at 95 %. `None` when no finite `u_c` or no degrees of freedom exist.
    pub fn expanded(&self) -> Option<Expanded> {
        self.expanded_at(DEFAULT_COVERAGE_PROBABILITY)
    }

    /// Expanded uncertainty at `coverage_probability`, between zero and one. `None` as in
    /// [`coverage_factor`](Self::coverage_factor).
    pub fn expanded_at(&self, coverage_probability: f64) -> Option<Expanded> {
        if coverage_probability.is_nan() || coverage_probability <= 0.0 {
            return None;
        }
        let combined = self.combined_standard_uncertainty();
        if !combined.is_finite() {
            return None;
        }
        let coverage_factor = self.coverage_factor(coverage_probability)?;
        Some(Expanded {
            coverage_probability,
            coverage_factor,
            // An uncertainty of zero stays zero even when k is beyond the range of f64.
            expanded_uncertainty: if combined == 0.0 { 0.0 } else { coverage_factor * combined },
            degrees_of_freedom: self.effective_degrees_of_freedom(),
        })
    }

    /// The budget of the result multiplied by `factor`.
    pub fn scaled(&self, factor: f64) -> Self {
        Self { rows: self.rows.iter().map(|row| row.scaled(factor)).collect() }
    }
}

/// `√(a² + b²)` without squares that leave the range; NaN when either is NaN.
fn sum_in_quadrature(a: f64, b: f64) -> f64 {
    // IEEE hypot returns infinity for an infinite and a NaN argument; an unknown row has to stay visible.
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.hypot(b) }
}

#[cfg(test)]
mod tests;
