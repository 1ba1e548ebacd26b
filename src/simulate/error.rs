//! What can go wrong on the main path, and whose fault it is.

use crate::fault::{Blame, Fault};
use crate::medium::MediumError;
use crate::phase_table::InvalidTable;
use crate::plan::PlanError;
use crate::series::SeriesError;
use crate::series::mean::MeanError;
use crate::series::tmatrix::TMatrixError;

/// What can go wrong on the main path.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum SimulateError {
    #[error(transparent)]
    Plan(#[from] PlanError),
    #[error(transparent)]
    Medium(#[from] MediumError),
    #[error(transparent)]
    Series(#[from] SeriesError),
    #[error(transparent)]
    TMatrix(#[from] TMatrixError),
    #[error(transparent)]
    Mean(#[from] MeanError),
    #[error(
        "energy does not add up at {wavelength_nm} nm: {residual:e} of the light is unaccounted for"
    )]
    Energy { wavelength_nm: f64, residual: f64 },
    #[error(
        "energy does not add up at {wavelength_nm} nm: in units of the squared radius the amplitudes \
         scatter {power:.3}, while extinction less absorption is {left:.3}; rays do not serve a particle \
         as small, soft or deformed as this one"
    )]
    Imbalance { wavelength_nm: f64, power: f64, left: f64 },
    #[error("the table would be wrong: {0}")]
    Wrong(#[from] InvalidTable),
    #[error("the amplitudes would be wrong: {0}")]
    Amplitudes(InvalidTable),
}

impl Blame for SimulateError {
    fn fault(&self) -> Fault {
        match self {
            SimulateError::Plan(error) => error.fault(),
            SimulateError::Medium(error) => error.fault(),
            SimulateError::Series(error) => error.fault(),
            SimulateError::TMatrix(error) => error.fault(),
            SimulateError::Mean(error) => error.fault(),
            SimulateError::Energy { .. }
            | SimulateError::Wrong(_)
            | SimulateError::Imbalance { .. }
            | SimulateError::Amplitudes(_) => Fault::Run,
        }
    }
}
