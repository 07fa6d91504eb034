//! Laws of the budget, and an example of the GUM.

use super::*;
use proptest::prelude::*;

fn budget(rows: &[(f64, f64)]) -> Budget {
    let rows = rows.iter().map(|&(u, nu)| BudgetRow::type_a("row", u, nu)).collect();
    Budget { rows }
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-12 * a.abs().max(b.abs())
}

#[test]
fn the_end_gauge_of_the_gum_has_sixteen_degrees_of_freedom() {
    // GUM H.1.6, table H.1: u_i in nm and ν_i; the text truncates ν_eff = 16.7 and finds U_99 = 93 nm.
    let b = budget(&[(25.0, 18.0), (5.8, 24.0), (3.9, 5.0), (6.7, 8.0), (2.9, 50.0), (16.6, 2.0)]);
    assert_eq!(b.combined_standard_uncertainty().round(), 32.0);
    let nu = b.effective_degrees_of_freedom();
    assert!((nu - 16.7).abs() < 0.15, "{nu}");
    let expanded = b.expanded_at(0.99).unwrap();
    assert!((expanded.expanded_uncertainty - 93.0).abs() < 1.5);
}

#[test]
fn rows_carry_the_divisor_of_their_distribution() {
    let third = 3f64.sqrt();
    assert_eq!(BudgetRow::rectangular("resolution", 0.6).standard_uncertainty, 0.6 / third);
    assert_eq!(BudgetRow::one_sided("omitted", -0.6).standard_uncertainty, 0.6 / third);
    let corrected = BudgetRow::one_sided_corrected("omitted", 0.6).standard_uncertainty;
    assert!(close(corrected, 0.3 / third));
    assert_eq!(BudgetRow::normal("certificate", 0.6).degrees_of_freedom, f64::INFINITY);
}

#[test]
fn an_exactly_known_budget_has_the_normal_coverage_factor() {
    let mut b = Budget::new();
    b.push(BudgetRow::normal("certificate", 3.0));
    b.push(BudgetRow::normal("ageing", 4.0));
    let expanded = b.expanded().unwrap();
    assert_eq!(b.combined_standard_uncertainty(), 5.0);
    assert!((expanded.coverage_factor - 1.959_963_985).abs() < 1e-9);
    assert!(close(expanded.expanded_uncertainty, 5.0 * expanded.coverage_factor));
}

#[test]
fn sixteen_replicates_have_the_coverage_factor_2_131() {
    let k = budget(&[(0.2, 15.0)]).coverage_factor(0.95).unwrap();
    assert!((k - 2.131_45).abs() < 5e-6);
}

#[test]
fn a_budget_without_uncertainty_has_the_expanded_uncertainty_zero() {
    assert_eq!(Budget::new().expanded().map(|e| e.expanded_uncertainty), Some(0.0));
    assert_eq!(Budget::new().effective_degrees_of_freedom(), f64::INFINITY);
    let zero = budget(&[(0.0, 15.0), (0.0, 3.0)]);
    assert_eq!(zero.effective_degrees_of_freedom(), 3.0);
    assert_eq!(zero.expanded().map(|e| e.expanded_uncertainty), Some(0.0));
}

#[test]
fn what_is_not_a_number_is_never_covered() {
    for (u, nu) in [(f64::NAN, 15.0), (f64::INFINITY, 15.0), (1.0, 0.0), (1.0, -3.0), (1.0, f64::NAN)] {
        assert_eq!(budget(&[(1.0, 5.0), (u, nu)]).expanded(), None, "{u} {nu}");
    }
    for p in [0.0, 1.0, -0.5, 2.0, f64::NAN] {
        assert_eq!(budget(&[(1.0, 5.0)]).expanded_at(p), None);
    }
    assert_eq!(budget(&[(f64::MAX, 5.0), (f64::MAX, 5.0)]).expanded(), None);
    let unknown = budget(&[(f64::INFINITY, 5.0), (f64::NAN, 5.0)]);
    assert!(unknown.combined_standard_uncertainty().is_nan());
}

#[test]
fn squares_beyond_the_range_do_not_matter() {
    for unit in [1e300, 1e-300] {
        let expanded = budget(&[(3.0 * unit, 15.0), (4.0 * unit, 15.0)]).expanded().unwrap();
        let plain = budget(&[(3.0, 15.0), (4.0, 15.0)]).expanded().unwrap();
        assert!(close(expanded.expanded_uncertainty / unit, plain.expanded_uncertainty));
    }
}

fn rows() -> impl Strategy<Value = Vec<(f64, f64)>> {
    prop::collection::vec((1e-6..1e3f64, 1.0..1e6f64), 1..8)
}

proptest! {
    #[test]
    fn the_combined_uncertainty_scales_with_the_result(rows in rows(), factor in -1e9..1e9f64) {
        let b = budget(&rows);
        let scaled = b.scaled(factor);
        prop_assert!(close(
            scaled.combined_standard_uncertainty(),
            factor.abs() * b.combined_standard_uncertainty()
        ));
        prop_assume!(factor.abs() > 1e-9);
        prop_assert!(close(
            scaled.effective_degrees_of_freedom(),
            b.effective_degrees_of_freedom()
        ));
    }

    #[test]
    fn effective_degrees_of_freedom_lie_between_the_smallest_and_the_sum(rows in rows()) {
        let nu = budget(&rows).effective_degrees_of_freedom();
        let smallest = rows.iter().map(|r| r.1).fold(f64::INFINITY, f64::min);
        let sum: f64 = rows.iter().map(|r| r.1).sum();
        prop_assert!(nu >= smallest * (1.0 - 1e-12) && nu <= sum * (1.0 + 1e-12));
    }

    #[test]
    fn the_order_of_rows_does_not_matter(rows in rows()) {
        let mut reversed = rows.clone();
        reversed.reverse();
        let (a, b) = (budget(&rows), budget(&reversed));
        prop_assert!(close(a.combined_standard_uncertainty(), b.combined_standard_uncertainty()));
        let (a, b) = (a.expanded().unwrap(), b.expanded().unwrap());
        prop_assert!(close(a.expanded_uncertainty, b.expanded_uncertainty));
    }

    #[test]
    fn every_row_adds_and_the_kinds_add_in_quadrature(rows in rows(), bound in 1e-6..1e3f64) {
        let mut b = budget(&rows);
        let before = b.combined_standard_uncertainty();
        b.push(BudgetRow::rectangular("bound", bound));
        let after = b.combined_standard_uncertainty();
        prop_assert!(after >= before);
        let of_kinds = b.combined_of_kind(EvaluationKind::A).hypot(b.combined_of_kind(EvaluationKind::B));
        prop_assert!(close(after, of_kinds));
    }

    #[test]
    fn the_coverage_factor_falls_with_the_degrees_of_freedom(nu in 0.5..1e5f64, more in 1.01..10.0f64, p in 0.5..0.999f64) {
        let few = budget(&[(1.0, nu)]).coverage_factor(p).unwrap();
        let many = budget(&[(1.0, nu * more)]).coverage_factor(p).unwrap();
        let exact = Budget::new().coverage_factor(p).unwrap();
        prop_assert!(few > many && many > exact);
    }
}
