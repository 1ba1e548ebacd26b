//! Why a picture cannot be made.

use crate::color::ColorError;
use crate::fault::{Blame, Fault};
use crate::transfer::TransferError;
use std::path::PathBuf;

/// Why a picture cannot be made.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum RenderError {
    #[error(transparent)]
    Color(#[from] ColorError),
    #[error("{}: {source}", path.display())]
    Write { path: PathBuf, source: std::io::Error },
    #[error(transparent)]
    Transfer(#[from] TransferError),
    #[error("drawing failed: {0}")]
    Drawing(String),
    #[error("{field} = {value}: {accepted}")]
    Invalid { field: String, value: String, accepted: String },
}

impl Blame for RenderError {
    fn fault(&self) -> Fault {
        match self {
            RenderError::Color(_) | RenderError::Transfer(_) | RenderError::Invalid { .. } => {
                Fault::Input
            }
            RenderError::Write { .. } | RenderError::Drawing(_) => Fault::Run,
        }
    }
}

#[cfg(feature = "pictures")]
impl<E: std::error::Error + Send + Sync> From<plotters::drawing::DrawingAreaErrorKind<E>>
    for RenderError
{
    fn from(error: plotters::drawing::DrawingAreaErrorKind<E>) -> Self {
        RenderError::Drawing(error.to_string())
    }
}
