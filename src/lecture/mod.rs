//! The equations of a lecture on radiometry and photometry, each by name: formula, inputs with units, result.
