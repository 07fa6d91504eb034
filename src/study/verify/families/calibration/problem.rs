//! A problem by its name: exposures, readings, and the curves that are to be found.
//!
//! | name | exposures |
//! |---|---|
//! | `mono_CURVE_bwFWHM_stepSTEP` | a monochromator scan, triangular passbands of unit area |
//! | `broad_CURVE_condκ_noiseSHARE` | broad sources, given as weights on the nodes; κ is the condition of the weights |
//! | `camera_CAMERA_LAMPS_noiseSHARE` | the patches of a chart under each lamp, three channels |

use std::ops::RangeInclusive;

use super::data::TABLES;
use crate::calibration::{Exposures, PriorKind, Readings};
use crate::spectrum::{Density, Outside, SpectrumError, Table};
use crate::study::verify::case::Fault;

/// What is to be fitted, and what must come out.
pub(super) struct Problem {
    pub(super) exposures: Exposures,
    pub(super) readings: Vec<Readings>,
    /// A channel each, on the nodes.
    pub(super) truths: Vec<Vec<f64>>,
    /// Nodes that count, nm: beyond a scan nothing is asked.
    pub(super) evaluated_nm: RangeInclusive<f64>,
    pub(super) prior: PriorKind,
}

/// Where a monochromator scan is asked for its curve, nm.
const SCANNED_NM: RangeInclusive<f64> = 390.0..=770.0;
/// All nodes.
const EVERYWHERE_NM: RangeInclusive<f64> = 0.0..=f64::INFINITY;
/// Width that a reading of the camera sums over, nm.
const CAMERA_STEP_NM: f64 = 5.0;
/// Folder of the camera.
const CAMERA: &str = "camera_nikon";

/// A table: heads and rows of cells.
struct Sheet {
    name: String,
    heads: Vec<&'static str>,
    rows: Vec<Vec<&'static str>>,
}

impl Sheet {
    fn new(folder: &str, file: &str) -> Result<Sheet, Fault> {
        let name = format!("{folder}/{file}");
        let text = TABLES.iter().find(|(path, _)| *path == name).map(|(_, text)| *text);
        let text = text.ok_or_else(|| Fault::NoTable(name.clone()))?;
        let mut rows = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
        Ok(Sheet { name, heads: rows.next().unwrap_or_default(), rows: rows.collect() })
    }

    fn number(&self, row: &[&str], column: usize) -> Result<f64, Fault> {
        let cell = row.get(column).copied().unwrap_or_default();
        cell.parse().map_err(|_| Fault::wrong(format!("{}: `{cell}` is no number", self.name)))
    }

    fn column(&self, column: usize) -> Result<Vec<f64>, Fault> {
        self.rows.iter().map(|row| self.number(row, column)).collect()
    }

    /// Readings and their uncertainties in two columns.
    fn readings(&self, channel: &str, values: usize, uncertainties: usize) -> Result<Readings, Fault> {
        Ok(Readings { channel: channel.to_owned(), values: self.column(values)?, standard_uncertainties: self.column(uncertainties)? })
    }
}

impl Problem {
    /// The problem of this name.
    pub(super) fn new(id: &str) -> Result<Problem, Fault> {
        let (design, noise) = id.rsplit_once("_noise").unwrap_or((id, ""));
        if let Some(lamps) = design.strip_prefix(CAMERA) {
            camera(&format!("readings{lamps}_noise{noise}.csv"))
        } else if design.starts_with("broad") {
            broad(design, &format!("readings_noise{noise}.csv"))
        } else {
            scan(design)
        }
    }
}

fn triangle(centre_nm: f64, fwhm_nm: f64) -> Result<Density, SpectrumError> {
    let rows = [(centre_nm - fwhm_nm, 0.0), (centre_nm, 1.0 / fwhm_nm), (centre_nm + fwhm_nm, 0.0)];
    Density::table(Table::from_rows(&rows, Outside::Zero)?)
}

fn scan(folder: &str) -> Result<Problem, Fault> {
    let (truth, measured) = (Sheet::new(folder, "truth.csv")?, Sheet::new(folder, "measurements.csv")?);
    let settings = measured.column(0)?.into_iter().zip(measured.column(1)?);
    let spectra = settings.map(|(nm, fwhm_nm)| Ok((format!("{nm} nm"), triangle(nm, fwhm_nm)?))).collect::<Result<Vec<_>, Fault>>()?;
    Ok(Problem {
        exposures: Exposures::new(&truth.column(0)?, &spectra)?,
        readings: vec![measured.readings("R", 2, 3)?],
        truths: vec![truth.column(1)?],
        evaluated_nm: SCANNED_NM,
        prior: PriorKind::Smooth,
    })
}

fn broad(folder: &str, readings: &str) -> Result<Problem, Fault> {
    let (truth, weights) = (Sheet::new(folder, "truth.csv")?, Sheet::new(folder, "matrix.csv")?);
    let rows = weights.rows.iter().map(|row| (1..row.len()).map(|k| weights.number(row, k)).collect());
    let rows = rows.collect::<Result<Vec<Vec<f64>>, Fault>>()?;
    let rows: Vec<&[f64]> = rows.iter().map(Vec::as_slice).collect();
    let labels = weights.column(0)?.iter().map(|nm| format!("source at {nm} nm")).collect();
    Ok(Problem {
        exposures: Exposures::from_weights(&truth.column(0)?, labels, &rows),
        readings: vec![Sheet::new(folder, readings)?.readings("R", 0, 1)?],
        truths: vec![truth.column(1)?],
        evaluated_nm: EVERYWHERE_NM,
        prior: PriorKind::Smooth,
    })
}

fn camera(readings: &str) -> Result<Problem, Fault> {
    let sheets = ["illuminants.csv", "reflectances.csv", "truth.csv", readings].map(|file| Sheet::new(CAMERA, file));
    let [lamps, patches, truth, measured] = sheets;
    let (lamps, patches, truth, measured) = (lamps?, patches?, truth?, measured?);
    let nodes = truth.column(0)?;
    let light = |row: &Vec<&'static str>| -> Result<(String, Vec<f64>), Fault> {
        let at = |sheet: &Sheet, head: &str| {
            let column = sheet.heads.iter().position(|h| *h == head);
            column.ok_or_else(|| Fault::wrong(format!("{} has no column `{head}`", sheet.name))).and_then(|c| sheet.column(c))
        };
        let (lamp, patch) = (at(&lamps, row[0])?, at(&patches, &format!("p{}", row[1]))?);
        let weights = lamp.iter().zip(&patch).map(|(s, r)| CAMERA_STEP_NM * s * r).collect();
        Ok((format!("patch {} under {}", row[1], row[0]), weights))
    };
    let (labels, rows): (Vec<String>, Vec<Vec<f64>>) =
        measured.rows.iter().map(light).collect::<Result<Vec<_>, Fault>>()?.into_iter().unzip();
    let rows: Vec<&[f64]> = rows.iter().map(Vec::as_slice).collect();
    let channels = ["R", "G", "B"].into_iter().enumerate();
    Ok(Problem {
        exposures: Exposures::from_weights(&nodes, labels, &rows),
        readings: channels.map(|(c, name)| measured.readings(name, 2 + c, 5)).collect::<Result<_, _>>()?,
        truths: (1..=3).map(|c| truth.column(c)).collect::<Result<_, _>>()?,
        evaluated_nm: EVERYWHERE_NM,
        prior: PriorKind::camera(&nodes)?,
    })
}
