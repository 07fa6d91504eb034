//! Runs that survive: a run that was cut off and resumed, or put together from shares, has the bits of one that was not; a file that
//! was spoilt is told and stays as it is.

#![allow(clippy::unwrap_used)]

#[path = "survival/bits.rs"]
mod bits;
mod disk;
#[path = "survival/files.rs"]
mod files;
#[path = "survival/kills.rs"]
mod kills;
#[path = "survival/program.rs"]
mod program;
#[path = "survival/repeats.rs"]
mod repeats;
