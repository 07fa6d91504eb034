//! What each rule saves, as a page of documentation.

use super::SavingsReport;
use super::cells::{LEGEND, PLAN_HEAD, RULE_HEAD, chance, factor_row, method, plan_rows, rule_rows};
use crate::study::savings::{rule_sentences, summary};

/// The report as Markdown: the rules, then the scenes, then every plan.
#[must_use]
pub fn to_markdown(report: &SavingsReport) -> String {
    let mut text = format!(
        "# What leaving out is worth\n\n\
         Written by `etendue rules --markdown docs/rules.md`; times are those of the machine that wrote it.\n\n{}\n\n",
        method(report)
    );
    text += "## Rules\n\nThe names are those of `etendue explain` and `--without`.\n\n";
    text += &table(
        &["rule", "what it observes"],
        rule_sentences().into_iter().map(|(rule, sentence)| vec![format!("`{rule}`"), sentence.to_owned()]),
    );
    let asked = report.options.error;
    let scenes = report.scenes.len();
    text += &format!(
        "\n## What each saves\n\n\
         *Acts in*: of {scenes} scenes, those where the rule left something out or made it cheaper; *alone in*: those where no other rule does the\n\
         same when it is gone. *Time*: processor time without the rule over that with all rules, in these; *rays saved*: the share of the rays\n\
         without the rule that all rules together do not trace. *Adds to planning*: in the scene where that is most; it is in the times.\n\n"
    );
    let summary = summary(&report.scenes);
    text += &table(&RULE_HEAD, rule_rows(&summary, scenes, asked).into_iter());
    text += &format!("\n{}\n", chance(&summary));
    text += "\n## Scene by scene\n\n*All rules* is a time, the others are factors to it; *again* is the same plan once more.\n\n";
    for (mark, meaning) in LEGEND {
        text += &format!("* {mark} {meaning}\n");
    }
    text.push('\n');
    let mut head = vec!["scene", "readings", "all rules", "again", "naive"];
    head.extend(rule_sentences().iter().map(|(rule, _)| *rule));
    text += &table(&head, report.scenes.iter().map(|scene| factor_row(scene, asked)));
    text += "\n## Every plan\n\n*Terms*: how many the rule left out or made cheaper.\n\n";
    text += &table(&PLAN_HEAD, report.scenes.iter().flat_map(|scene| plan_rows(scene, asked)));
    if !report.failed.is_empty() {
        text += "\n## Not studied\n\n";
        text += &table(&["scene", "why"], report.failed.iter().map(|(scene, why)| vec![scene.clone(), why.clone()]));
    }
    text
}

fn table(head: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let mut text = format!("| {} |\n|{}\n", head.join(" | "), "---|".repeat(head.len()));
    for row in rows {
        let cells: Vec<String> = row.iter().map(|cell| cell.replace('|', "\\|")).collect();
        text += &format!("| {} |\n", cells.join(" | "));
    }
    text
}
