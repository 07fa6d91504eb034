//! The command line: arguments, files and screens around the library.
//!
//! | file | what |
//! |---|---|
//! | `main.rs` | arguments, exit codes |
//! | `disk.rs` | files on disk for the library, which opens none itself |
//! | `checkpoint.rs`, `output.rs` | the files that runs write |
//! | `processor_time.rs` | the clock that the standard library lacks |
//! | every other file | a subcommand |
//!
//! Exit codes: 0 done, 1 failed, 2 bad input.

mod calibrate;
mod check;
mod checkpoint;
mod converge;
mod disk;
mod equation;
mod explain;
mod list;
mod measure;
mod merge;
mod output;
#[cfg(feature = "plot")]
mod plot;
mod processor_time;
mod repeat;
mod spectrum;
mod stability;
mod verify;

use std::io::Write;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// A virtual photometer: put a modelled instrument into a modelled scene and read it, with a stated uncertainty.
#[derive(Parser)]
#[command(name = "etendue", version, about, long_about = None, arg_required_else_help = true)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Responsivity curves from readings, with their uncertainty, and what the readings do not see.
    Calibrate(calibrate::Arguments),
    /// Every problem of a scene file, or "ok".
    Check(check::Arguments),
    /// What will be computed, what is left out, and why.
    Explain(explain::Arguments),
    /// Equations of the lecture: list them, or compute one from its inputs.
    Equation(equation::Arguments),
    /// True error and claimed uncertainty against run time.
    Converge(converge::Arguments),
    /// The curves of the library and the sensor files at hand, by name.
    List(list::Arguments),
    /// Read every instrument of a scene.
    Measure(measure::Arguments),
    /// Put the shares of a run together and read them as one.
    Merge(merge::Arguments),
    /// Measure again what a file of readings says, and tell whether the bits agree.
    Repeat(repeat::Arguments),
    /// Draw a picture: SVG or PNG, light or dark, for paper or slides.
    #[cfg(feature = "plot")]
    Plot(plot::Arguments),
    /// Every quantity of one spectrum.
    Spectrum(spectrum::Arguments),
    /// Compute every closed-form and reference case on this machine.
    Verify(verify::Arguments),
    /// Drive scenes to where they are stiff or extreme, and hold their readings against closed forms and laws.
    Stability(stability::Arguments),
}

/// Why a command ended early; what it has to say is on stderr already or is said here.
enum Failure {
    /// The input is bad: exit code 2.
    Input(String),
    /// Something failed that the input is not to blame for: exit code 1.
    Run(String),
}

fn main() -> ExitCode {
    let done = match Arguments::parse().command {
        Command::Calibrate(arguments) => calibrate::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Explain(arguments) => explain::run(&arguments),
        Command::Equation(arguments) => equation::run(&arguments),
        Command::Converge(arguments) => converge::run(&arguments),
        Command::List(arguments) => list::run(&arguments),
        Command::Measure(arguments) => measure::run(&arguments),
        Command::Merge(arguments) => merge::run(&arguments),
        Command::Repeat(arguments) => repeat::run(&arguments),
        #[cfg(feature = "plot")]
        Command::Plot(arguments) => plot::run(&arguments),
        Command::Spectrum(arguments) => spectrum::run(&arguments),
        Command::Verify(arguments) => verify::run(&arguments),
        Command::Stability(arguments) => stability::run(&arguments),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(Failure::Input(message)) => {
            complain(&message);
            ExitCode::from(2)
        }
        Err(Failure::Run(message)) => {
            complain(&message);
            ExitCode::FAILURE
        }
    }
}

/// Says on stderr what is wrong. If nobody can be told, the exit code still says it.
fn complain(message: &str) {
    let _ = writeln!(std::io::stderr(), "{}", message.trim_end());
}

/// Prints to stdout; a reader that has gone away (`| head`) is no failure.
fn print(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(e) if e.kind() != std::io::ErrorKind::BrokenPipe => Err(Failure::Run(format!("error: cannot write to stdout: {e}"))),
        _ => Ok(()),
    }
}
