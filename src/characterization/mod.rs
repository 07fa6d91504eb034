//! Quality indices of instruments, from their curves.
