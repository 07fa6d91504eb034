//! Tests of the closed forms: reference cases, and laws with free parameters.

mod laws;
mod reference;
