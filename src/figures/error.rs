//! Why a figure cannot be made.

use crate::fault::{Blame, Fault};
use crate::lee::LeeError;
use crate::medium::MediumError;
use crate::plan::PlanError;
use crate::render::RenderError;
use crate::render::bow::BowError;
use crate::scatter::ScatterError;
use crate::scene::SceneError;
use crate::series::SeriesError;
use crate::shape::ShapeError;
use crate::simulate::SimulateError;

/// Why a figure cannot be made.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum FigureError {
    #[error("there is no figure {name}; {near}gonio figure --list shows all")]
    Unknown { name: String, near: String },
    /// A scene of a figure that is none, which a test of the program excludes.
    #[error("the scene {name} of a figure: {words}")]
    Scene { name: String, words: String },
    #[error(transparent)]
    Sky(#[from] BowError),
    #[error(transparent)]
    Lee(#[from] LeeError),
    #[error(transparent)]
    Medium(#[from] MediumError),
    #[error(transparent)]
    Plan(#[from] PlanError),
    #[error(transparent)]
    Render(#[from] RenderError),
    #[error(transparent)]
    Scatter(#[from] ScatterError),
    #[error(transparent)]
    Keys(#[from] SceneError),
    #[error(transparent)]
    Series(#[from] SeriesError),
    #[error(transparent)]
    Shape(#[from] ShapeError),
    #[error(transparent)]
    Simulate(#[from] SimulateError),
}

impl Blame for FigureError {
    fn fault(&self) -> Fault {
        match self {
            FigureError::Unknown { .. } => Fault::Input,
            // Whoever asks for a figure gives nothing but its name.
            _ => Fault::Run,
        }
    }
}
