//! Laws and published figures of the observers.
