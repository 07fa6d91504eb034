//! Uncertainty in the words of the GUM (JCGM 100:2008).
//!
//! | word | meaning here |
//! |---|---|
//! | standard uncertainty `u` | standard deviation of what the value could be |
//! | type A, type B | evaluated from a spread of repetitions; by any other means |
//! | combined standard uncertainty `u_c` | root sum of squares of the rows of a budget |
//! | degrees of freedom `ν` | how well an uncertainty itself is known; infinite when it is taken as exact |
//! | coverage factor `k`, expanded uncertainty `U = k u_c` | half width of an interval with a stated coverage probability |
//!
//! | file | holds |
//! |---|---|
//! | [`moments`] | count, mean and spread that accumulate and merge |
//! | [`sum`] | a sum that keeps small terms |
//! | [`replicates`] | the type A evaluation of independent replicates |
//! | [`distribution`] | quantiles of the normal, Student's t and χ² distributions, the normal probability |
//! | [`budget`] | the uncertainty budget, effective degrees of freedom, coverage |
//! | [`rounding`] | value and uncertainty written with the same last place |

pub mod budget;
pub mod distribution;
pub mod moments;
pub mod replicates;
pub mod rounding;
pub mod sum;

pub use budget::{Budget, BudgetRow, EvaluationKind, Expanded};
pub use moments::Moments;
pub use replicates::Replicates;
pub use rounding::Rounded;
pub use sum::CompensatedSum;
