//! The sweeps of `etendue stability`: a part of each runs and holds, and what is wrong is found.

use etendue::estimate::run::with_threads;
use etendue::report::stability::{csv, json, to_markdown, to_text};
use etendue::study::stability::fits::Expected;
use etendue::study::stability::{Judgement, Point, Reference, SWEEPS, Sweep, SweepResult, run};

fn swept(sweep: &Sweep, keep: impl Fn(&Point) -> bool) -> SweepResult {
    run(sweep, keep, &|| 0.0, &|_| {})
}

/// What takes long or grows with a number stays out.
fn quick(sweep: &Sweep, point: &Point) -> bool {
    match sweep.name {
        "reflectance" => point.series != "paths" || point.parameter >= 1e-3,
        "sources" | "instruments" | "lines" => point.parameter <= 1e3,
        "fit-exposures" => point.parameter <= 80.0,
        "fit-noise" => point.series == "LEDs" || point.series == "broad, 60 nm",
        _ => point.series != "fan" || point.parameter <= 100.0,
    }
}

#[test]
fn no_row_of_any_sweep_is_wrong() {
    for sweep in &SWEEPS {
        let result = swept(sweep, |point| quick(sweep, point));
        let wrong: Vec<_> = result.wrong().collect();
        assert!(wrong.is_empty(), "{}: {wrong:#?}", sweep.name);
        assert!(result.rows.len() >= 5, "{}", sweep.name);
        assert!(
            result
                .rows
                .iter()
                .all(|row| row.judgement != Judgement::Told || row.note.starts_with("error: ") || sweep.name.starts_with("fit-")),
            "{}",
            sweep.name
        );
    }
}

#[test]
fn only_what_has_no_reading_is_told() {
    let told: Vec<(&str, &str, f64)> = SWEEPS
        .iter()
        .filter(|sweep| !sweep.name.starts_with("fit-"))
        .flat_map(|sweep| swept(sweep, |point| quick(sweep, point)).rows.into_iter().map(|row| (sweep.name, row)))
        .filter(|(_, row)| row.judgement == Judgement::Told)
        .map(|(name, row)| (name, row.series, row.parameter))
        .collect();
    let expected = [
        ("reflectance", "no loss", 0.0),
        ("line-width", "on a node", 0.0),
        ("line-width", "between nodes", 0.0),
        ("touching", "contact", 0.0),
    ];
    assert_eq!(told, expected);
}

/// The points of a sweep with what they are held against changed by a share.
fn disturbed(points: fn() -> Vec<Point>, share: f64) -> Vec<Point> {
    let change = |reference: Reference| match reference {
        Reference::Values { values, relative } => {
            Reference::Values { values: values.into_iter().map(|v| v * (1.0 + share)).collect(), relative }
        }
        Reference::Law { scene, factor, relative } => Reference::Law { scene, factor: factor * (1.0 + share), relative },
        other => other,
    };
    points().into_iter().map(|point| Point { reference: change(point.reference.clone()), ..point }).collect()
}

#[test]
fn a_wrong_reference_is_found_in_every_formula() {
    fn scale_off() -> Vec<Point> {
        disturbed(SWEEPS[0].points, 1e-8).into_iter().filter(|p| p.series != "paths").collect()
    }
    fn grazing_off() -> Vec<Point> {
        let formulas = ["point", "parallel light", "sphere"];
        disturbed(SWEEPS[4].points, 1e-11).into_iter().filter(|p| formulas.contains(&p.series)).collect()
    }
    for (sweep, points) in [(SWEEPS[0], scale_off as fn() -> Vec<Point>), (SWEEPS[4], grazing_off)] {
        let result = swept(&Sweep { points, ..sweep }, |_| true);
        assert!(!result.rows.is_empty() && result.rows.iter().all(|row| row.judgement == Judgement::Wrong), "{:#?}", result.rows);
        assert!(result.summary().iter().all(|failing| failing.wrong.is_some()));
    }
}

#[test]
fn a_wrong_reference_of_a_sampled_reading_is_found() {
    fn off() -> Vec<Point> {
        disturbed(SWEEPS[2].points, 0.05).into_iter().filter(|p| p.series == "half hidden").collect()
    }
    let result = swept(&Sweep { points: off, ..SWEEPS[2] }, |_| true);
    assert!(!result.rows.is_empty() && result.rows.iter().all(|row| row.judgement == Judgement::Wrong), "{:#?}", result.rows);
}

#[test]
fn a_reading_where_there_should_be_none_is_wrong() {
    fn readable() -> Vec<Point> {
        let first = (SWEEPS[0].points)().into_iter().next();
        first.map(|point| Point { reference: Reference::Refused, ..point }).into_iter().collect()
    }
    let result = swept(&Sweep { points: readable, ..SWEEPS[0] }, |_| true);
    assert_eq!(result.rows.iter().map(|row| row.judgement).collect::<Vec<_>>(), [Judgement::Wrong]);
}

#[test]
fn rows_do_not_depend_on_the_number_of_threads() {
    let sweep = SWEEPS.iter().find(|sweep| sweep.name == "penumbra").expect("there is one");
    let rows = |threads| with_threads(Some(threads), || swept(sweep, |point| point.parameter >= 1e-3).rows);
    assert_eq!(rows(1), rows(3));
}

#[test]
fn every_form_has_every_row() {
    let results: Vec<SweepResult> = SWEEPS[9..11].iter().map(|sweep| swept(sweep, |point| point.parameter <= 0.1)).collect();
    let rows: usize = results.iter().map(|result| result.rows.len()).sum();
    assert!(rows > 20);
    assert_eq!(csv::to_csv(&results).lines().count(), rows + 1);
    let parsed: serde_json::Value = serde_json::from_str(&json::to_json(&results)).expect("JSON");
    let counted = parsed["sweeps"].as_array().expect("sweeps").iter().map(|s| s["rows"].as_array().map_or(0, Vec::len)).sum::<usize>();
    assert_eq!(counted, rows);
    for text in [to_text(&results), to_markdown(&results)] {
        assert!(text.contains("penumbra") && text.contains(&format!("{rows} rows")), "{text}");
    }
}

#[cfg(feature = "plot")]
#[test]
fn deviation_and_time_are_drawn() {
    use etendue::report::plot::{Size, Style, Theme, svg};
    use etendue::report::stability::chart::{deviations, times};
    for name in ["penumbra", "grazing", "radiance"] {
        let sweep = SWEEPS.iter().find(|sweep| sweep.name == name).expect("there is one");
        let result = swept(sweep, |point| quick(sweep, point));
        for chart in [deviations(&result), times(&result)] {
            let chart = chart.expect("more than one row");
            let drawn = svg(&chart, &Style { theme: Theme::Light, size: Size::Paper }).expect("a picture");
            assert!(result.summary().iter().all(|failing| drawn.contains(failing.series)), "{name}");
        }
    }
    let one = swept(&SWEEPS[0], |point| point.parameter == 1.0);
    assert!(deviations(&one).is_none() && times(&one).is_none());
}

/// The condition that is stated for a row of sources is that of their weights, by singular values.
#[test]
fn the_condition_of_the_exposures_is_the_stated_one() {
    let sweep = SWEEPS.iter().find(|sweep| sweep.name == "fit-condition").expect("there is one");
    for point in (sweep.points)().into_iter().filter(|p| p.series == "noise 0" && p.parameter <= 1e11) {
        let Reference::Fit(problem) = &point.reference else { panic!("a fit") };
        let rows: Vec<Vec<f64>> = (0..problem.exposures.len()).map(|i| problem.exposures.row(i)).collect();
        let s = nalgebra::DMatrix::from_fn(rows.len(), rows[0].len(), |i, k| rows[i][k]).singular_values();
        let found = s.max() / s.min();
        assert!((0.3..3.0).contains(&(found / point.parameter)), "{:e}: {found:e}", point.parameter);
    }
}

/// A fit whose reference is off by a tenth is wrong, and readings that should be refused are.
#[test]
fn a_wrong_curve_is_found() {
    fn off() -> Vec<Point> {
        let sweep = SWEEPS.iter().find(|sweep| sweep.name == "fit-condition").expect("there is one");
        let points = (sweep.points)().into_iter().filter(|p| p.series == "noise 1e-3" && p.parameter <= 1e4);
        let wrong = |point: Point| {
            let Reference::Fit(mut problem) = point.reference.clone() else { panic!("a fit") };
            let Expected::Curves(truths) = &mut problem.expected else { panic!("curves") };
            truths.iter_mut().flatten().for_each(|s| *s *= 1.1);
            Point { reference: Reference::Fit(problem), ..point }
        };
        points.map(wrong).collect()
    }
    let result = swept(&Sweep { points: off, ..SWEEPS[14] }, |_| true);
    assert!(!result.rows.is_empty() && result.rows.iter().all(|row| row.judgement == Judgement::Wrong), "{:#?}", result.rows);
}

/// Error and bands of a fit against condition and noise: the table of `docs/calibration.md`, and its pictures.
#[test]
fn the_documentation_has_the_table_of_stiffness() {
    let sweep = SWEEPS.iter().find(|sweep| sweep.name == "fit-condition").expect("there is one");
    let start = std::time::Instant::now();
    let result = run(sweep, |_| true, &|| start.elapsed().as_secs_f64(), &|_| {});
    let series: Vec<&str> = result.summary().iter().map(|failing| failing.series).collect();
    let conditions: Vec<f64> = result.rows.iter().filter(|row| row.series == series[0]).map(|row| row.parameter).collect();
    assert!(conditions.len() == 16 && result.wrong().next().is_none());
    let mut table = format!("| κ | {} | a fit, ms |\n|---|{}---|\n", series.join(" | "), "---|".repeat(series.len()));
    for condition in &conditions {
        let of_condition: Vec<_> = result.rows.iter().filter(|row| row.parameter == *condition).collect();
        let cell = |row: &&etendue::study::stability::Row| {
            let percent = |share: Option<f64>| share.map_or("–".to_owned(), |x| format!("{:.1} %", 100.0 * x));
            format!("{:.1e}, {:.2} u, {}", row.deviation.unwrap_or(f64::NAN), row.deviation_u.unwrap_or(f64::NAN), percent(row.inside))
        };
        let cells: Vec<String> = of_condition.iter().map(cell).collect();
        let seconds = of_condition.iter().map(|row| row.seconds).sum::<f64>() / of_condition.len() as f64;
        table += &format!("| {condition:.0e} | {} | {:.0} |\n", cells.join(" | "), 1e3 * seconds);
    }
    let docs = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    let path = docs.join("calibration.md");
    let (begin, end) = ("<!-- stiffness -->\n", "<!-- end of stiffness -->");
    let text = std::fs::read_to_string(&path).expect("docs/calibration.md");
    let (before, rest) = text.split_once(begin).expect("the mark of the table");
    let (written, after) = rest.split_once(end).expect("the end of the table");
    if std::env::var_os("ETENDUE_REWRITE_EXPECTED").is_some() {
        std::fs::write(&path, format!("{before}{begin}{table}{end}{after}")).expect("written");
        #[cfg(feature = "plot")]
        draw(&result, &docs);
        return;
    }
    for condition in conditions {
        assert!(written.contains(&format!("| {condition:.0e} |")), "no row for {condition:e}: set ETENDUE_REWRITE_EXPECTED=1");
    }
}

#[cfg(feature = "plot")]
fn draw(result: &SweepResult, folder: &std::path::Path) {
    use etendue::report::plot::{Size, Style, Theme, svg};
    use etendue::report::stability::chart::{deviations, in_bands, times};
    for (name, chart) in [("error", deviations(result)), ("bands", in_bands(result)), ("fit-time", times(result))] {
        let drawn = svg(&chart.expect("rows"), &Style { theme: Theme::Light, size: Size::Paper }).expect("a picture");
        std::fs::write(folder.join(format!("calibration-stiffness-{name}.svg")), drawn).expect("written");
    }
}
