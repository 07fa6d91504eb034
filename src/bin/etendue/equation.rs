//! `etendue equation`: the equations of the lecture, computed one at a time, and the table of quantities and systems.

use etendue::lecture::{self, Problem};
use etendue::report::lecture as report;

use crate::{Failure, complain, disk, print};

/// Equations of the lecture: list them, or compute one from its inputs.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The equation, e.g. `photon-energy`; without it all are listed.
    name: Option<String>,
    /// Its inputs, e.g. `wavelength_nm=555`; units are in the keys.
    #[arg(value_name = "KEY=VALUE")]
    inputs: Vec<String>,
    /// The table of quantities and systems, with units.
    #[arg(long, conflicts_with = "name")]
    table: bool,
    /// How it is written.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum Format {
    /// For a person.
    Text,
    /// For programs; numbers keep all their digits.
    Json,
}

/// Every problem, each with what to type instead, and what the equation wants.
fn message(name: &str, problems: &[Problem]) -> String {
    let mut text = String::new();
    for problem in problems {
        text.push_str(&format!("error: {}\n  = help: {}\n", problem.message, problem.help));
    }
    if let Some(equation) = lecture::equations().find(|equation| equation.name == name) {
        text.push_str(&format!("\n{}", report::inputs(equation)));
    }
    text
}

/// Splits `key=value`; what has no `=` is a problem of its own.
fn assignments(inputs: &[String]) -> (Vec<(&str, &str)>, Vec<Problem>) {
    let (mut pairs, mut problems) = (Vec::new(), Vec::new());
    for input in inputs {
        match input.split_once('=') {
            Some((key, value)) => pairs.push((key.trim(), value.trim())),
            None => problems.push(Problem {
                message: format!("`{}` is no input", input.chars().take(60).collect::<String>().escape_debug()),
                help: "write KEY=VALUE without spaces around `=`, such as wavelength_nm=555".into(),
            }),
        }
    }
    (pairs, problems)
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let json = matches!(arguments.format, Format::Json);
    if arguments.table {
        return print(&if json { report::json::table() } else { report::table() });
    }
    let Some(name) = &arguments.name else {
        return print(&if json { report::json::list() } else { report::list() });
    };
    let (pairs, mut problems) = assignments(&arguments.inputs);
    let answer = match lecture::answer(name, &pairs, &disk::Anywhere) {
        Ok(answer) if problems.is_empty() => answer,
        Ok(_) => return Err(Failure::Input(message(name, &problems))),
        Err(more) => {
            problems.extend(more);
            return Err(Failure::Input(message(name, &problems)));
        }
    };
    for remark in &answer.remarks {
        complain(&format!("remark: {remark}"));
    }
    print(&if json { report::json::answer(&answer) } else { report::answer(&answer) })
}
