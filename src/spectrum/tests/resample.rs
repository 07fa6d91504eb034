//! Resampling: power is kept, errors are bounds, lines are where they were asked to be.

use proptest::prelude::*;

use super::*;

fn any_density() -> impl Strategy<Value = Density> {
    let rows = prop::collection::vec((0.5..30.0_f64, 0.0..1.0_f64), 2..40);
    (rows, 0..4_u8, 0.2..60.0_f64).prop_map(|(rows, kind, width)| {
        let mut nm = 400.0;
        let rows: Vec<(f64, f64)> = rows
            .into_iter()
            .map(|(step, value)| {
                nm += step;
                (nm, value)
            })
            .collect();
        let table = Density::table(Table::from_rows(&rows, Outside::Zero).unwrap()).unwrap();
        match kind {
            0 => table,
            1 => Density::gaussian(1.0, 555.3, width).unwrap(),
            2 => table.plus(&Density::flat(450.3, 500.7, 0.3).unwrap()),
            _ => Density::black_body(3000.0).unwrap().filtered(&Factor::band(420.0, 700.0, 1.0).unwrap()),
        }
    })
}

proptest! {
    // A case resamples a black body or a narrow Gaussian over hundreds of bins.
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn bin_averages_keep_the_power_between_the_ends(density in any_density(), step in 0.5..20.0_f64) {
        let found = resample(&density, 400.0, 800.0, step, Rule::BinAverages, Lines::Keep).unwrap();
        let (from, to) = found.table.range_nm();
        let inside = density.integral(&[&Factor::band(from, to, 1.0).unwrap()]);
        prop_assert!((found.density.total() - inside).abs() <= 1e-10 * density.total());
    }

    #[test]
    fn no_weighted_integral_changes_by_more_than_is_stated(
        density in any_density(), step in 0.5..20.0_f64, points: bool, edge in 400.0..700.0_f64, width in 0.1..100.0_f64,
    ) {
        let rule = if points { Rule::Points } else { Rule::BinAverages };
        let found = resample(&density, 400.0, 800.0, step, rule, Lines::Keep).unwrap();
        let total = density.total();
        for weight in [Factor::band(edge, edge + width, 1.0).unwrap(), library::v_lambda(), Factor::gaussian(1.0, edge, width).unwrap()] {
            let change = (found.density.integral(&[&weight]) - density.integral(&[&weight])).abs();
            prop_assert!(change <= (1.02 * found.largest_change + 1e-9) * total, "{} against {}", change / total, found.largest_change);
        }
    }
}

#[test]
fn a_table_on_its_own_grid_is_not_changed_by_points() {
    let rows: Vec<(f64, f64)> = (0..=80).map(|i| (380.0 + 5.0 * f64::from(i), f64::from(i % 7))).collect();
    let density = Density::table(Table::from_rows(&rows, Outside::Zero).unwrap()).unwrap();
    let same = resample(&density, 380.0, 780.0, 5.0, Rule::Points, Lines::Keep).unwrap();
    assert_eq!(same.table.rows().collect::<Vec<_>>(), rows);
    assert!(same.largest_change < 1e-15 && same.lost_outside < 1e-15);
    assert!(same.observer_changes.iter().all(|change| change.unwrap().abs() < 1e-13));
}

#[test]
fn lines_stay_lines_unless_bins_are_asked_for() {
    let lamp = Density::line(546.07, 2.0).unwrap().plus(&Density::flat(400.0, 700.0, 0.01).unwrap());
    let kept = resample(&lamp, 380.0, 780.0, 5.0, Rule::BinAverages, Lines::Keep).unwrap();
    assert_eq!(kept.density.lines(), lamp.lines());
    let binned = resample(&lamp, 380.0, 780.0, 5.0, Rule::BinAverages, Lines::IntoBins).unwrap();
    assert!(binned.density.lines().is_empty());
    assert!((binned.table.at(545.0) - (2.0 / 5.0 + 0.01)).abs() < 1e-12);
    assert!((binned.density.total() - lamp.total()).abs() < 1e-12);
    assert!(binned.largest_change > 2.0 / 5.0 && binned.remarks.iter().any(|remark| remark.contains("1 lines went into the bins")));
    assert!(resample(&lamp, 380.0, 780.0, 5.0, Rule::Points, Lines::IntoBins).is_err());
}

#[test]
fn what_lies_outside_is_stated_and_what_is_no_grid_is_an_error() {
    let flat = Density::flat(400.0, 800.0, 1.0).unwrap();
    let half = resample(&flat, 400.0, 600.0, 1.0, Rule::BinAverages, Lines::Keep).unwrap();
    assert!((half.lost_outside - 0.5).abs() < 1e-12 && (half.largest_change - 0.5).abs() < 1e-12);
    for (from, to, step) in [(400.0, 300.0, 1.0), (400.0, 500.0, 200.0), (400.0, 500.0, 0.0), (400.0, 500.0, f64::NAN)] {
        assert!(resample(&flat, from, to, step, Rule::Points, Lines::Keep).is_err(), "{from} {to} {step}");
    }
}
