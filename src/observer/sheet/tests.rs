//! Laws of the sheet.
use super::*;
