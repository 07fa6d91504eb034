//! Studies of the program itself: whether its readings are right.
//!
//! | module | what it asks |
//! |---|---|
//! | [`verify`] | does every reference case come out, on this machine |

pub mod verify;
