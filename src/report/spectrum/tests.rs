//! The three forms of a sheet.
use super::*;
