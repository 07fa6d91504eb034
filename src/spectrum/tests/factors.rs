//! Laws of factors: bounds, supports, constancy and jumps agree with the values.

use proptest::prelude::*;

use crate::spectrum::{Factor, Outside, Table};

fn any_factor() -> impl Strategy<Value = Factor> {
    let leaf = prop_oneof![
        (-2.0..2.0_f64).prop_map(Factor::Constant),
        (-2e-3..2e-3_f64).prop_map(Factor::Proportional),
        (300.0..600.0_f64, 1.0..200.0_f64, -2.0..2.0_f64).prop_map(|(from, width, value)| Factor::band(from, from + width, value).unwrap()),
        (0.0..2.0_f64, 300.0..800.0_f64, 0.1..100.0_f64).prop_map(|(p, c, s)| Factor::gaussian(p, c, s).unwrap()),
        (prop::collection::vec(-1.0..1.0_f64, 2..8), any::<bool>()).prop_map(|(values, hold)| {
            let wavelengths_nm = (0..values.len()).map(|i| 400.0 + 40.0 * i as f64).collect();
            let outside = if hold { Outside::Hold } else { Outside::Zero };
            Factor::Table(Table::new(wavelengths_nm, values, outside).unwrap())
        }),
    ];
    leaf.prop_recursive(3, 12, 3, |inner| {
        prop_oneof![
            prop::collection::vec(inner.clone(), 0..3).prop_map(Factor::Product),
            prop::collection::vec(inner.clone(), 0..3).prop_map(Factor::Sum),
            (-2.0..2.0_f64, inner).prop_map(|(scale, factor)| factor.scaled(scale)),
        ]
    })
}

proptest! {
    #[test]
    fn range_support_and_constancy_agree_with_values(
        factor in any_factor(), from in 200.0..900.0_f64, width in 0.0..300.0_f64, t in 0.0..=1.0_f64,
    ) {
        let nm = from + t * width;
        let value = factor.at(nm);
        let (least, largest) = factor.range_over(from, from + width);
        prop_assert!(least - 1e-9 <= value && value <= largest + 1e-9);
        prop_assert!(value == 0.0 || factor.support().contains(nm));
        if let Some(constant) = factor.is_constant_over(from, from + width) {
            prop_assert!((value - constant).abs() < 1e-12);
        }
    }

    #[test]
    fn nothing_jumps_where_no_discontinuity_is_listed(factor in any_factor(), nm in 200.0..900.0_f64) {
        let listed = factor.discontinuities();
        for nm in factor.breakpoints().into_iter().chain([nm]).filter(|nm| !listed.contains(nm)) {
            prop_assert!((factor.at(nm.next_down()) - factor.at(nm.next_up())).abs() < 1e-9);
        }
    }
}

#[test]
fn a_line_on_the_edge_of_a_band_passes() {
    let band = Factor::band(500.0, 600.0, 0.5).unwrap();
    assert_eq!([band.at(500.0), band.at(600.0), band.at(500.0_f64.next_down())], [0.5, 0.5, 0.0]);
    assert_eq!(band.is_constant_over(500.0, 600.0), Some(0.5));
    assert_eq!(band.is_constant_over(500.0, 601.0), None);
    assert_eq!(band.is_constant_over(601.0, 700.0), Some(0.0));
}

#[test]
fn parameters_without_a_meaning_are_refused() {
    assert!(Factor::band(500.0, 500.0, 1.0).is_err());
    assert!(Factor::band(f64::NAN, 500.0, 1.0).is_err());
    assert!(Factor::gaussian(1.0, 500.0, 0.0).is_err());
    assert!(Factor::gaussian(f64::INFINITY, 500.0, 1.0).is_err());
}
