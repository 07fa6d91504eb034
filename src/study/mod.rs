//! Studies: scenes measured many times over, to find out what readings are worth.
//!
//! | module | what it asks |
//! |---|---|
//! | [`stability`] | do readings stay right where a scene is stiff or extreme |
//!
//! A study measures as a user would and looks only at readings; clocks are lent by the shell.

pub mod stability;
