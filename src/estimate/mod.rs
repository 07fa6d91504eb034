//! Numbers for the terms of a plan.

pub mod closed_form;
