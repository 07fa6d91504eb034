//! What each rule saves, as tables for a terminal.

use super::SavingsReport;
use super::cells::{LEGEND, PLAN_HEAD, RULE_HEAD, chance, method, plan_rows, rule_rows};
use crate::study::savings::summary;

/// The report as text: every plan of every scene, then the rules.
#[must_use]
pub fn to_text(report: &SavingsReport) -> String {
    let mut text = format!("What leaving out is worth\n\n{}\n\n", method(report));
    let asked = report.options.error;
    let head = || std::iter::once(PLAN_HEAD.map(str::to_owned).to_vec());
    text += &aligned(&head().chain(report.scenes.iter().flat_map(|scene| plan_rows(scene, asked))).collect::<Vec<_>>());
    text += "\nThe rules, over these scenes\n\n";
    let summary = summary(&report.scenes);
    let rows = rule_rows(&summary, report.scenes.len(), asked);
    text += &aligned(&std::iter::once(RULE_HEAD.map(str::to_owned).to_vec()).chain(rows).collect::<Vec<_>>());
    text += &format!("\n  {}\n\n", chance(&summary));
    for (mark, meaning) in LEGEND {
        text += &format!("  {mark}  {meaning}\n");
    }
    for (scene, why) in &report.failed {
        text += &format!("\n  not studied: {scene}: {why}\n");
    }
    text
}

/// Columns aligned with blanks.
fn aligned(rows: &[Vec<String>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut text = String::new();
    for row in rows {
        let cells = row.iter().zip(&widths).map(|(cell, &width)| format!(" {cell:width$} ")).collect::<String>();
        text += &format!(" {}\n", cells.trim_end());
    }
    text
}
