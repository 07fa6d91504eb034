//! Tests of the closed forms: reference cases, and laws with free parameters.

#![allow(clippy::unwrap_used)]

mod composites;
mod laws;
mod reference;

/// Whether two values agree within a relative tolerance.
fn close(a: f64, b: f64, rel: f64) -> bool {
    (a - b).abs() <= rel * a.abs().max(b.abs())
}
