//! One particle in chosen directions: amplitude matrices, efficiencies and what is left out, by any
//! method.
//!
//! Where [`simulate`](crate::simulate) makes tables of a scene, this answers for single directions and
//! takes what it is told: an index, a size parameter, orders. [`lorenz_mie`] and [`debye`] serve spheres,
//! [`airy()`] their bows alone by the classical theory, [`layered`] those that vary along the radius, [`rays`] any shape, [`t_matrix`] bodies of revolution, [`facets()`] crystals. Efficiencies refer to the sphere of equal volume.
//!
//! ```
//! use gonio::scatter::{Request, lorenz_mie};
//!
//! let request = Request {
//!     size_parameter: 100.0,
//!     index: 1.333.into(),
//!     theta: vec![0.0, 2.4],
//!     azimuth: 0.0,
//!     tolerance: 0.01,
//! };
//! let seen = lorenz_mie(&request).unwrap();
//! let budget = seen.efficiencies;
//! assert!((budget.q_ext - budget.q_sca).abs() < 1e-10);
//! // Optical theorem, Q_ext = 4/x² Re S(0°)
//! assert!((4e-4 * seen.amplitudes[0].s1.re / budget.q_ext - 1.0).abs() < 1e-9);
//! ```

mod airy;
mod facets;
mod rays;
mod scene;
mod series;
mod size;
mod tmatrix;

pub use airy::airy;
pub use facets::facets;
pub use rays::{RayDiffraction, RayRequest, rays};
pub use scene::of_scene;
pub use series::{DebyeTerms, debye, layered, lorenz_mie};
pub use size::{Size, SizeConflict};
pub use tmatrix::t_matrix;

use crate::farfield::ErrorEstimate;
use crate::farfield::assignment::AiryRange;
use crate::fault::{Blame, Fault};
use crate::medium::MediumError;
use crate::optics::AmplitudeMatrix;
use crate::plan::PlanError;
use crate::series::tmatrix::TMatrixError;
use crate::series::{Efficiencies, SeriesError};
use crate::simulate::SimulateError;
use num_complex::Complex64;

/// Light of one wavelength on one particle, and where it is looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// `2πa/λ` of the sphere of equal volume, λ in the surroundings.
    pub size_parameter: f64,
    /// Index of the particle, relative to the surroundings.
    pub index: Complex64,
    /// Scattering angles, radians, in any order.
    pub theta: Vec<f64>,
    /// Of all directions, radians.
    pub azimuth: f64,
    /// Relative error asked of rays, of the number of Debye terms and of a T-matrix.
    pub tolerance: f64,
}

/// What one method gives.
#[derive(Clone, Debug)]
pub struct Scattering {
    /// In the order of the request's angles.
    pub amplitudes: Vec<AmplitudeMatrix>,
    /// Cross-sections over the shadow's area.
    pub efficiencies: Efficiencies,
    /// Whether forward diffraction is among the amplitudes.
    pub diffraction_included: bool,
    /// What a sum over Debye's terms from the first on leaves out.
    pub remainder: Option<Remainder>,
    /// How far intensities by rays or a T-matrix may be from the truth.
    pub worth: Option<ErrorEstimate>,
    /// Where Airy's theory stands for the bows of orders, and how far it may be off; empty for other methods.
    pub bows: Vec<AiryRange>,
}

/// What a sum over Debye's terms leaves out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Remainder {
    /// Of the largest coefficient.
    pub largest: f64,
    /// Of the amplitudes, root mean square, relative to Lorenz–Mie without diffraction.
    pub share: f64,
    /// The last order of the sum.
    pub last_order: u32,
    /// Whether the share is more than the tolerance, where the number of terms was this module's choice.
    pub not_converged: bool,
}

/// Why a particle cannot be answered for.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum ScatterError {
    #[error(transparent)]
    Plan(#[from] PlanError),
    #[error(transparent)]
    Series(#[from] SeriesError),
    #[error(transparent)]
    TMatrix(#[from] TMatrixError),
    #[error(transparent)]
    Simulate(#[from] SimulateError),
    #[error(transparent)]
    Medium(#[from] MediumError),
    #[error(
        "particle: amplitudes are those of one particle of one size that stands still: make a table of many"
    )]
    Several,
    #[error(
        "model.interference = false with diffraction = \"none\": rays of a crystal have powers and no amplitudes: make \
         a table, or leave both out"
    )]
    RaysAlone,
    /// Airy's theory of an order that has no bow, or is not served.
    #[error(
        "orders = {order}: Airy's theory is here for the bows of orders 2 and 3, where rays turn back; at an index of {index} \
         order {order} is none of them"
    )]
    NoBow { order: u32, index: f64 },
    /// Share of the light.
    #[error("energy does not add up: {0:e} of the light is unaccounted for")]
    Energy(f64),
}

impl Blame for ScatterError {
    fn fault(&self) -> Fault {
        match self {
            ScatterError::Plan(error) => error.fault(),
            ScatterError::Series(error) => error.fault(),
            ScatterError::TMatrix(error) => error.fault(),
            ScatterError::Simulate(error) => error.fault(),
            ScatterError::Medium(_)
            | ScatterError::Several
            | ScatterError::RaysAlone
            | ScatterError::NoBow { .. } => Fault::Input,
            ScatterError::Energy(_) => Fault::Run,
        }
    }
}
