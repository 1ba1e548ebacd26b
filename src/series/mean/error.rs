//! Why an average cannot be taken.

use super::nodes::ZoneError;
use crate::fault::{Blame, Fault};
use crate::medium::MediumError;
use crate::series::SeriesError;

/// Most spheres of one average.
pub(super) const MAX_STEPS: f64 = 1e7;

/// Why an average cannot be taken.
#[derive(Debug, thiserror::Error)]
pub enum MeanError {
    /// A size or an index that the series does not accept.
    #[error(transparent)]
    Series(#[from] SeriesError),
    /// A wavelength outside the data.
    #[error(transparent)]
    Medium(#[from] MediumError),
    /// More spheres than anybody would wait for.
    #[error(
        "the average over sizes or wavelengths from size parameter {from:.0} to {to:.0} needs \
         {steps:.1e} spheres: accepted are at most {MAX_STEPS:e}; take a narrower distribution, \
         smaller particles or a larger tolerance"
    )]
    TooLong {
        /// Least size parameter.
        from: f64,
        /// Largest size parameter.
        to: f64,
        /// Number of spheres.
        steps: f64,
    },
    /// The error asked for is out of reach.
    #[error(
        "the average over sizes or wavelengths did not converge: relative error {reached:.1e} with \
         {spheres} spheres, asked for {asked:e}; take a larger tolerance, or have \
         the table marked (model.allow_unmet_tolerance = true, --allow-unmet-tolerance)"
    )]
    NotMet {
        /// The tolerance.
        asked: f64,
        /// The least error that was reached.
        reached: f64,
        /// Spheres of the last attempt.
        spheres: usize,
    },
}

impl Blame for MeanError {
    fn fault(&self) -> Fault {
        match self {
            MeanError::Series(error) => error.fault(),
            MeanError::Medium(error) => error.fault(),
            MeanError::TooLong { .. } => Fault::Input,
            MeanError::NotMet { .. } => Fault::Run,
        }
    }
}

impl From<ZoneError> for MeanError {
    fn from(error: ZoneError) -> Self {
        match error {
            ZoneError::Series(error) => error.into(),
            ZoneError::Medium(error) => error.into(),
        }
    }
}
