//! Why a picture of a scene cannot be made.

use crate::color::ColorError;
use crate::fault::{Blame, Fault};
use crate::hdf5::TableError;
use crate::medium::MediumError;
use crate::plan::PlanError;
use crate::render::error::RenderError;
use crate::scene::SceneError;
use crate::series::SeriesError;
use crate::simulate::SimulateError;
use std::path::PathBuf;

/// Why a picture of a scene cannot be made.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum BowError {
    #[error("{}: {source}", path.display())]
    Read { path: PathBuf, source: std::io::Error },
    #[error("the scene of the picture cannot be read: {}: {source}", path.display())]
    Syntax { path: PathBuf, source: toml::de::Error },
    #[error(
        "{}: this is the scene of a table, which `gonio table` computes; that of a picture has [[drops]], [sun], [camera] \
         …, and --table TABLE.h5 draws a finished table",
        path.display()
    )]
    OfTable { path: PathBuf },
    /// Keys that are missing, contradict each other or have no such value.
    #[error("{0}")]
    Keys(String),
    #[error(transparent)]
    Color(#[from] ColorError),
    #[error(transparent)]
    Render(#[from] RenderError),
    #[error(transparent)]
    Table(#[from] TableError),
    #[error(transparent)]
    Medium(#[from] MediumError),
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error(transparent)]
    Plan(#[from] PlanError),
    #[error(transparent)]
    Series(#[from] SeriesError),
    #[error(transparent)]
    Simulate(#[from] SimulateError),
}

impl Blame for BowError {
    fn fault(&self) -> Fault {
        match self {
            BowError::Read { .. }
            | BowError::Syntax { .. }
            | BowError::OfTable { .. }
            | BowError::Keys(_)
            | BowError::Color(_)
            | BowError::Medium(_)
            | BowError::Scene(_)
            | BowError::Plan(_) => Fault::Input,
            BowError::Render(error) => error.fault(),
            BowError::Table(error) => error.fault(),
            BowError::Series(error) => error.fault(),
            BowError::Simulate(error) => error.fault(),
        }
    }
}
