//! The command line: arguments, files and screens around the library.
//!
//! | file | what |
//! |---|---|
//! | `main.rs` | arguments, exit codes |
//! | `disk.rs` | files on disk for the library, which opens none itself |
//! | `checkpoint.rs`, `output.rs`, `file_set.rs` | the files that runs write |
//! | `processor_time.rs` | the clock that the standard library lacks |
//! | every other file | a subcommand |
//!
//! Exit codes: 0 done, 1 failed, 2 bad input.

mod calibrate;
mod check;
mod checkpoint;
mod converge;
mod coverage;
mod datasheet;
mod disk;
mod equation;
mod explain;
#[cfg(feature = "image")]
mod expose;
mod file_set;
mod list;
mod measure;
mod merge;
mod output;
#[cfg(feature = "image")]
mod photon_transfer;
#[cfg(feature = "plot")]
mod plot;
mod processor_time;
mod repeat;
mod rules;
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
    /// Every problem of a file, or "ok": a scene, a sensor, a camera, a pixel, or a calibration.
    Check(check::Arguments),
    /// The data sheet of a sensor: every quality index computed from its curves and measured on a virtual bench.
    Datasheet(datasheet::Arguments),
    /// What will be computed, what is left out, and why.
    Explain(explain::Arguments),
    #[cfg(feature = "image")]
    /// Take the picture of a camera of a scene: expected electrons, raw frames, previews, regions.
    Expose(expose::Arguments),
    /// Equations of the lecture: list them, or compute one from its inputs.
    Equation(equation::Arguments),
    /// True error and claimed uncertainty against run time.
    Converge(converge::Arguments),
    /// How often the 95 % interval of each sampled reading covers the truth, over many seeds.
    Coverage(coverage::Arguments),
    /// The curves of the library and the sensor files at hand, by name.
    List(list::Arguments),
    /// Read every instrument of a scene.
    Measure(measure::Arguments),
    /// Put the shares of a run together and read them as one.
    Merge(merge::Arguments),
    /// Measure again what a file of readings says, and tell whether the bits agree.
    Repeat(repeat::Arguments),
    /// Take frames of a camera in a flat field, and measure the figures of EMVA 1288 from them.
    #[cfg(feature = "image")]
    PhotonTransfer(photon_transfer::Arguments),
    /// Draw a picture: SVG or PNG, light or dark, for paper or slides.
    #[cfg(feature = "plot")]
    Plot(plot::Arguments),
    /// What each rule of the plan saves, over the scenes at hand.
    Rules(rules::Arguments),
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
        Command::Datasheet(arguments) => datasheet::run(&arguments),
        Command::Explain(arguments) => explain::run(&arguments),
        #[cfg(feature = "image")]
        Command::Expose(arguments) => expose::run(&arguments),
        Command::Equation(arguments) => equation::run(&arguments),
        Command::Converge(arguments) => converge::run(&arguments),
        Command::Coverage(arguments) => coverage::run(&arguments),
        Command::List(arguments) => list::run(&arguments),
        Command::Measure(arguments) => measure::run(&arguments),
        Command::Merge(arguments) => merge::run(&arguments),
        Command::Repeat(arguments) => repeat::run(&arguments),
        #[cfg(feature = "image")]
        Command::PhotonTransfer(arguments) => photon_transfer::run(&arguments),
        #[cfg(feature = "plot")]
        Command::Plot(arguments) => plot::run(&arguments),
        Command::Rules(arguments) => rules::run(&arguments),
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
