//! Runs a sweep: every point read as a user would read it, and judged.

use super::{Point, Reference, Sweep};
use crate::estimate::{Stop, Watch};
use crate::measurement::{Measurement, measure};
use crate::plan::{Plan, PlanOptions};
use crate::scene::{MemoryFiles, read_scene};

/// Seconds from which a row is called costly.
pub const COSTLY_SECONDS: f64 = 1.0;
/// Expanded uncertainties by which a reading may differ from a closed form.
const MOST_EXPANDED: f64 = 2.0;
/// The seed of all sweeps.
const SEED: u64 = 1;

/// What a row shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Judgement {
    /// The reading agrees with the reference.
    Holds,
    /// There is no reading, and the program said why.
    Told,
    /// The reading is off by more than it admits, or there is one where there should be none.
    Wrong,
}

impl Judgement {
    /// One word.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Judgement::Holds => "holds",
            Judgement::Told => "told",
            Judgement::Wrong => "WRONG",
        }
    }
}

/// One point, read. With several readings it is the one that is furthest off.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Series of the sweep.
    pub series: &'static str,
    /// Value of the parameter.
    pub parameter: f64,
    /// The reading, in `unit`; `None` if there is none.
    pub reading: Option<f64>,
    /// Unit of the reading.
    pub unit: String,
    /// What it is held against.
    pub reference: Option<f64>,
    /// |S − S₀| / |S₀|; |S − S₀| where the reference is zero.
    pub deviation: Option<f64>,
    /// |S − S₀| / u_c; `None` without a reading. Infinite if off although u_c is zero.
    pub deviation_u: Option<f64>,
    /// U / |S₀|.
    pub expanded: Option<f64>,
    /// Share of a curve's nodes that are within their 99 % bands; `None` for scenes.
    pub inside: Option<f64>,
    /// Samples; zero where formulas served. Sets of readings, where curves were fitted.
    pub samples: u64,
    /// Seconds to read the scene file, to plan and to measure.
    pub seconds: f64,
    /// Holds, told, or wrong.
    pub judgement: Judgement,
    /// What the user is told: error text, or notes at the reading.
    pub note: String,
}

/// Where a series starts to fail or to cost.
#[derive(Clone, Debug, PartialEq)]
pub struct Failing {
    /// Series.
    pub series: &'static str,
    /// Range of the parameter that was run.
    pub from: f64,
    /// Its other end, the extreme one.
    pub to: f64,
    /// Largest relative deviation where it holds.
    pub largest_deviation: f64,
    /// Largest deviation in standard uncertainties where it holds.
    pub largest_deviation_u: f64,
    /// Parameter of the first row without a reading, and what the user is told.
    pub told: Option<(f64, String)>,
    /// Parameter of the first row that is wrong.
    pub wrong: Option<f64>,
    /// Parameter of the first row of [`COSTLY_SECONDS`] or more, and its seconds.
    pub costly: Option<(f64, f64)>,
}

/// A sweep that was run.
#[derive(Clone, Debug)]
pub struct SweepResult {
    /// Which.
    pub sweep: Sweep,
    /// Its rows.
    pub rows: Vec<Row>,
}

impl SweepResult {
    /// Where each series starts to fail, in the order of the series.
    #[must_use]
    pub fn summary(&self) -> Vec<Failing> {
        let mut names: Vec<&'static str> = Vec::new();
        for row in &self.rows {
            if !names.contains(&row.series) {
                names.push(row.series);
            }
        }
        names.into_iter().map(|name| self.failing(name)).collect()
    }

    fn failing(&self, series: &'static str) -> Failing {
        let rows: Vec<&Row> = self.rows.iter().filter(|row| row.series == series).collect();
        let largest =
            |of: fn(&Row) -> Option<f64>| rows.iter().filter(|r| r.judgement == Judgement::Holds).filter_map(|r| of(r)).fold(0.0, f64::max);
        Failing {
            series,
            from: rows.first().map_or(f64::NAN, |r| r.parameter),
            to: rows.last().map_or(f64::NAN, |r| r.parameter),
            largest_deviation: largest(|r| r.deviation),
            largest_deviation_u: largest(|r| r.deviation_u),
            told: rows.iter().find(|r| r.judgement == Judgement::Told).map(|r| (r.parameter, r.note.clone())),
            wrong: rows.iter().find(|r| r.judgement == Judgement::Wrong).map(|r| r.parameter),
            costly: rows.iter().find(|r| r.seconds >= COSTLY_SECONDS).map(|r| (r.parameter, r.seconds)),
        }
    }

    /// Rows that are wrong without a word.
    pub fn wrong(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(|r| r.judgement == Judgement::Wrong)
    }
}

/// Reads the points that `keep` wants, one after the other. `now` is a clock in seconds since any fixed moment; `progress` is told the
/// share of the points that are done.
pub fn run(sweep: &Sweep, keep: impl Fn(&Point) -> bool, now: &(dyn Fn() -> f64 + Sync), progress: &dyn Fn(f64)) -> SweepResult {
    let points: Vec<Point> = (sweep.points)().into_iter().filter(keep).collect();
    // The scene that a law refers to is the same for many points.
    let mut known: Vec<(String, Option<u64>, Result<Measurement, String>)> = Vec::new();
    let mut rows = Vec::with_capacity(points.len());
    for (i, point) in points.iter().enumerate() {
        if let Reference::Law { scene, .. } = &point.reference
            && !known.iter().any(|(text, samples, _)| text == scene && *samples == point.samples)
        {
            known.push((scene.clone(), point.samples, read(scene, point, now)));
        }
        if let Reference::Fit(problem) = &point.reference {
            rows.push(super::fits::row(point, problem, now));
            progress((i + 1) as f64 / points.len() as f64);
            continue;
        }
        let start = now();
        let found = read(&point.scene, point, now);
        let seconds = now() - start;
        let base = match &point.reference {
            Reference::Law { scene, .. } => {
                known.iter().find(|(text, samples, _)| text == scene && *samples == point.samples).map(|(_, _, found)| found)
            }
            _ => None,
        };
        rows.push(row(point, found, base, seconds));
        progress((i + 1) as f64 / points.len() as f64);
    }
    SweepResult { sweep: *sweep, rows }
}

/// A scene read, planned and measured; what a user would see in place of readings.
fn read(scene: &str, point: &Point, now: &(dyn Fn() -> f64 + Sync)) -> Result<Measurement, String> {
    let mut files = MemoryFiles::new().with("scene.ron", scene.as_bytes());
    for (path, bytes) in &point.files {
        files = files.with(path, bytes.clone());
    }
    let scene = read_scene("scene.ron", &files, None).map_err(|problems| problems.to_string())?;
    let options = PlanOptions { naive: false, without: point.without.iter().map(ToString::to_string).collect() };
    let plan = Plan::new(&scene, &options).map_err(|e| e.to_string())?;
    let stop = match point.samples {
        Some(samples) => Stop { target: None, budget_seconds: None, samples: Some(samples) },
        None => Stop::default(),
    };
    measure(&scene, &plan, &stop, SEED, &Watch { now, progress: &|_| {} }).map_err(|e| e.to_string())
}

/// A reading against its reference.
#[derive(Clone, Copy)]
struct Compared {
    index: usize,
    reference: f64,
    /// |S − S₀|.
    deviation: f64,
    /// u_c, joint with that of the reference.
    u: f64,
    expanded: f64,
    allowed: f64,
}

impl Compared {
    fn holds(&self) -> bool {
        self.deviation <= self.allowed
    }
}

impl Row {
    /// A row without a reading.
    pub(super) fn empty(point: &Point, seconds: f64) -> Row {
        Row {
            series: point.series,
            parameter: point.parameter,
            reading: None,
            unit: String::new(),
            reference: None,
            deviation: None,
            deviation_u: None,
            expanded: None,
            inside: None,
            samples: 0,
            seconds,
            judgement: Judgement::Told,
            note: String::new(),
        }
    }
}

fn row(point: &Point, found: Result<Measurement, String>, base: Option<&Result<Measurement, String>>, seconds: f64) -> Row {
    let mut row = Row::empty(point, seconds);
    let measured = match found {
        Ok(measured) => measured,
        Err(message) => {
            row.note = one_line(&message);
            return row;
        }
    };
    let compared: Vec<Compared> = match compared(point, &measured, base) {
        Ok(compared) => compared,
        Err(why) => {
            row.reading = measured.readings.first().map(|r| r.value);
            row.judgement = Judgement::Wrong;
            row.note = why;
            return row;
        }
    };
    row.samples = measured.readings.iter().map(|r| r.samples).sum();
    row.judgement = if compared.iter().all(Compared::holds) { Judgement::Holds } else { Judgement::Wrong };
    let excess = |c: &Compared| if c.deviation == 0.0 { 0.0 } else { c.deviation / c.allowed };
    let Some(worst) = compared.iter().max_by(|a, b| excess(a).total_cmp(&excess(b))) else { return row };
    let reading = &measured.readings[worst.index];
    let relative = |x: f64| if worst.reference == 0.0 { x } else { x / worst.reference.abs() };
    row.reading = Some(reading.value);
    row.unit = reading.measurand.unit().to_string();
    row.reference = Some(worst.reference);
    row.deviation = Some(relative(worst.deviation));
    row.deviation_u = Some(if worst.deviation == 0.0 { 0.0 } else { worst.deviation / worst.u });
    row.expanded = Some(relative(worst.expanded));
    row.note = reading.notes.join("; ");
    row
}

/// Every reading beside its reference, or why there is nothing to compare.
fn compared(point: &Point, measured: &Measurement, base: Option<&Result<Measurement, String>>) -> Result<Vec<Compared>, String> {
    let readings = measured.readings.iter().enumerate();
    let own = |r: &crate::measurement::Reading| (r.standard_uncertainty(), r.expanded.expanded_uncertainty);
    match &point.reference {
        Reference::Fit(_) | Reference::Refused => Err("a reading is given where there is none".to_owned()),
        Reference::Values { values, relative } => {
            if values.is_empty() || values.len() > 1 && values.len() != measured.readings.len() {
                return Err(format!("{} references for {} readings", values.len(), measured.readings.len()));
            }
            Ok(readings
                .map(|(index, r)| {
                    let reference = values[index.min(values.len() - 1)];
                    let (u, expanded) = own(r);
                    let allowed = MOST_EXPANDED * expanded + relative * reference.abs();
                    Compared { index, reference, deviation: (r.value - reference).abs(), u, expanded, allowed }
                })
                .collect())
        }
        Reference::Law { factor, relative, .. } => {
            let base = match base {
                Some(Ok(base)) if base.readings.len() == measured.readings.len() => base,
                Some(Err(message)) => return Err(format!("the scene of reference has no reading: {}", one_line(message))),
                _ => return Err("the scene of reference has other instruments".to_owned()),
            };
            Ok(readings
                .zip(&base.readings)
                .map(|((index, r), b)| {
                    let reference = factor * b.value;
                    let ((u, expanded), (u_b, expanded_b)) = (own(r), own(b));
                    let joint = expanded.hypot(factor * expanded_b);
                    let allowed = relative.map_or(MOST_EXPANDED * joint, |share| share * reference.abs());
                    Compared { index, reference, deviation: (r.value - reference).abs(), u: u.hypot(factor * u_b), expanded, allowed }
                })
                .collect())
        }
    }
}

/// A message on one line: places and pictures of the scene text are left out, which the reader of a table has not written.
fn one_line(message: &str) -> String {
    let lines = message.lines().map(str::trim);
    let kept: Vec<&str> = lines
        .filter(|l| !l.is_empty() && !l.starts_with("-->") && !l.contains(" | ") && !l.starts_with('|') && !l.ends_with('|'))
        .map(|l| l.trim_start_matches("= "))
        .collect();
    kept.join("; ")
}
