//! Uncertainty: accumulators, budgets, coverage.
