//! `etendue verify`: every reference case, computed on this machine.

#[cfg(feature = "plot")]
use std::path::{Path, PathBuf};
use std::time::Instant;

use etendue::report::verify as report;
use etendue::study::verify::{Selection, Suite, Tables};

#[cfg(feature = "plot")]
use crate::complain;
use crate::{Failure, disk, print};

/// Largest file of cases that is read.
const MOST_BYTES: u64 = 1 << 26;

/// The folder of the sources with tables that cases name and that are not shipped.
const TABLES: &str = "tests/reference/data";

/// Compute every closed-form and reference case on this machine; exit code 1 when one fails.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Only this group (g2), part (g2a) or family (g2a.bb-x); may be given several times.
    #[arg(long)]
    group: Vec<String>,
    /// Only this case, e.g. g1c.disc-par-3; may be given several times.
    #[arg(long)]
    case: Vec<String>,
    /// Cases of a file of one's own in place of the built-in ones: the same JSON, families as they are.
    #[arg(long, value_name = "FILE")]
    cases: Option<String>,
    /// How it is written.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Write a page with plots that needs nothing beside it.
    #[cfg(feature = "plot")]
    #[arg(long, value_name = "FILE.html")]
    report: Option<PathBuf>,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum Format {
    /// For a person.
    Text,
    /// Everything, for programs; numbers keep all their digits.
    Json,
    /// A row a case, for spreadsheets.
    Csv,
}

fn problems(all: &[String]) -> Failure {
    Failure::Input(all.iter().map(|problem| format!("error: {problem}\n")).collect())
}

fn suite(arguments: &Arguments) -> Result<Suite, Failure> {
    let tables: Tables = disk::shelf(TABLES)
        .unwrap_or_default()
        .into_iter()
        .map(|(path, text)| (path.rsplit('/').next().unwrap_or_default().to_owned(), text))
        .collect();
    let suite = match &arguments.cases {
        None => Suite::built_in(tables),
        Some(path) => Suite::from_files(&[(path.as_str(), &disk::text(path, MOST_BYTES)?)], tables),
    };
    suite.map_err(|all| problems(&all))
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let suite = suite(arguments)?;
    #[cfg(feature = "plot")]
    if let Some(folder) = arguments.report.as_deref().and_then(Path::parent).filter(|folder| *folder != Path::new("") && !folder.is_dir()) {
        return Err(Failure::Input(format!("error: --report: there is no folder {}", folder.display())));
    }
    let selection = Selection { groups: arguments.group.clone(), cases: arguments.case.clone() };
    let start = Instant::now();
    let found = suite.run(&selection, &|| start.elapsed().as_secs_f64()).map_err(|all| problems(&all))?;
    #[cfg(feature = "plot")]
    if let Some(path) = &arguments.report {
        let page = report::html::page(&found, &about()).map_err(|error| Failure::Run(format!("error: {error}")))?;
        disk::save(path, page.as_bytes())
            .map_err(|error| disk::unwritable(path, &error, "--report takes a file in a folder that can be written"))?;
        complain(&format!("wrote {}", path.display()));
    }
    print(&match arguments.format {
        Format::Text => report::text(&found),
        Format::Json => report::json::to_json(&found),
        Format::Csv => report::csv::to_csv(&found),
    })?;
    if found.passed() {
        return Ok(());
    }
    Err(Failure::Run(format!("{}error: {}", report::failures(&found), report::sentence(&found))))
}

/// Version and machine.
#[cfg(feature = "plot")]
fn about() -> Vec<(String, String)> {
    let threads = std::thread::available_parallelism().map_or_else(|_| "unknown".to_owned(), |n| n.to_string());
    let machine = format!("{} {}, {threads} threads", std::env::consts::OS, std::env::consts::ARCH);
    vec![("version".to_owned(), format!("etendue {}", env!("CARGO_PKG_VERSION"))), ("machine".to_owned(), machine)]
}
