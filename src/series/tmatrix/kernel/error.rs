//! Why there is no T-matrix: what was asked for, and what would be accepted.

use super::range;
use crate::fault::{Blame, Fault};

/// Why there is no T-matrix.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum TMatrixError {
    #[error(
        "the body is not star-shaped: a ray at {angle_deg:.1}° from its axis meets the surface more \
         than once"
    )]
    NotStarShaped { angle_deg: f64 },
    #[error(
        "size parameter = {0}: the T-matrix accepts finite numbers of at least {least:e}",
        least = range::LEAST_SIZE
    )]
    Size(f64),
    #[error(
        "index = 1: a body that is as its surroundings scatters nothing; any other index is accepted"
    )]
    NoContrast,
    #[error(
        "size parameter {size_parameter}: its T-matrix needs {degrees} degrees, at most {} are accepted \
         (minutes of time, gigabytes of memory); method = \"rays\" serves such particles",
        range::MOST_DEGREES
    )]
    TooLarge { size_parameter: f64, degrees: usize },
    #[error(
        "size parameter {size_parameter}: the T-matrix of this body does not converge to tolerance \
         {tolerance:e}; the best reached has error {reached:.1e} with {degrees} degrees"
    )]
    NotConverged { size_parameter: f64, tolerance: f64, reached: f64, degrees: usize },
    #[error(transparent)]
    NoMean(#[from] NoMean),
    #[error("T-matrices were left out of this build: the feature \"tmatrix\" brings them")]
    LeftOut,
    #[error("size parameter {size_parameter}: the T-matrix of this body overflows")]
    Diverged { size_parameter: f64 },
}

/// Why there is no mean.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "size parameter {size_parameter}: the mean over orientations still changes by {change:.1e} between \
     {} and {nodes} angles to the axis; tolerance = {tolerance:e}", nodes / 2
)]
#[expect(missing_docs, reason = "the message says what each field is")]
pub struct NoMean {
    pub size_parameter: f64,
    pub change: f64,
    pub nodes: usize,
    pub tolerance: f64,
}

impl Blame for TMatrixError {
    fn fault(&self) -> Fault {
        match self {
            TMatrixError::NotStarShaped { .. }
            | TMatrixError::Size(_)
            | TMatrixError::NoContrast
            | TMatrixError::LeftOut
            | TMatrixError::TooLarge { .. } => Fault::Input,
            TMatrixError::NotConverged { .. }
            | TMatrixError::NoMean(_)
            | TMatrixError::Diverged { .. } => Fault::Run,
        }
    }
}
