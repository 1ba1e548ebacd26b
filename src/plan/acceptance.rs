//! Which particles rays are accepted for, and what is said to those they are not.

use crate::facets::BodyError;
use crate::farfield::assignment::Thresholds;
use crate::fault::{Blame, Fault};
use crate::math::digits::to_digits;
use crate::medium::{Medium, MediumError};
use crate::series::tmatrix::TMatrixError;
use crate::shape::ShapeError;
use num_complex::Complex64;
use std::f64::consts::PI;

/// Why a scene cannot be planned.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum PlanError {
    #[error(transparent)]
    Shape(#[from] ShapeError),
    #[error(transparent)]
    Medium(#[from] MediumError),
    #[error(transparent)]
    TMatrix(#[from] TMatrixError),
    #[error(
        "method = \"facets\": it is for crystals and prisms, such as shape = \"hexagonal-column\""
    )]
    FacetsNeedCrystal,
    #[error("particle: {0}")]
    Crystal(#[from] BodyError),
    #[error(
        "index {index}{place}: a crystal is to be denser than what is around it (index above 1): rays that are \
         totally reflected outside are not followed"
    )]
    ThinnerBody { index: f64, place: String },
    #[error(
        "size parameter {size_parameter:.1}{place}, half the width between the nearest planes {half_width:.1} reduced \
         wavelengths: facets are accepted from {} and {} on (below, fields on a facet are no plane waves cut off \
         at its edges; intensities would be some {error:.0} % off, root mean square over directions)",
        limits[0],
        limits[1]
    )]
    SmallCrystal {
        size_parameter: f64,
        half_width: f64,
        place: String,
        limits: [f64; 2],
        error: f64,
    },
    #[error(
        "{facets} facets with a size parameter of {size_parameter:.1} on average{place} (circle of their area): from \
         {limit} on they are accepted; smaller ones scatter no plane waves, and a mesh of a smooth body is no smooth \
         body: shape = \"spheroid\", \"harmonics\" or \"superellipsoid\""
    )]
    SmallFacets { facets: usize, size_parameter: f64, place: String, limit: f64 },
    #[error(
        "method = \"{0}\": the exact series serve spheres only; accepted here: \"rays\", \"tmatrix\""
    )]
    SeriesNeedsSphere(&'static str),
    #[error(
        "index {index}{place} with size parameter {size_parameter:.0}: light loses more than the ray \
         picture can follow (k/n must stay below {limit}); use --method mie (method = \"mie\" in a scene) for a sphere"
    )]
    TooAbsorbing { index: String, place: String, size_parameter: f64, limit: f64 },
    #[error(
        "outside: k = {k:e}{place} takes {loss:.1e} of the light along the particle's \
         diameter: surroundings may take at most {OUTSIDE_LOSS:e}, for efficiencies in absorbing \
         surroundings depend on a convention and are not offered"
    )]
    AbsorbingOutside { k: f64, place: String, loss: f64 },
    #[error(
        "size parameter {size_parameter:.3e}{place}: rays are accepted from {} to {:e} (below, there \
         are no rays; above, phases lose their digits); use --method mie (method = \"mie\" in a scene) for a small sphere",
        limits[0],
        limits[1]
    )]
    Size { place: String, size_parameter: f64, limits: [f64; 2] },
    #[error(
        "index {index}{place} with size parameter {size_parameter:.4}: the phase shift through the \
         particle, 2x|n - 1| = {phase_shift:.3}, is too small for rays, which are accepted from \
         {limit} on (below, the light that passes and the light around the particle are \
         one wave: extinction by rays is {SOFT_MISS} off); use --method mie (method = \"mie\" in a scene) for a sphere"
    )]
    Soft { index: String, place: String, size_parameter: f64, phase_shift: f64, limit: f64 },
}

impl Blame for PlanError {
    fn fault(&self) -> Fault {
        Fault::Input
    }
}

const SOFT_MISS: &str = "13 % at 4, 87 % at 2";

/// Beyond this `k/n` the wave inside is too inhomogeneous for real rays.
pub const LARGEST_K_OVER_N: f64 = Thresholds::MEASURED.largest_k_over_n;

/// Phase shift below which a warning goes with rays.
pub const DOUBTFUL_PHASE_SHIFT: f64 = Thresholds::MEASURED.doubtful_phase_shift;

/// The phase shift of the central ray against light that passes the particle, radians.
///
/// ```
/// assert_eq!(gonio::plan::phase_shift(1.25.into(), 100.0), 50.0);
/// ```
pub fn phase_shift(index: Complex64, size_parameter: f64) -> f64 {
    2.0 * size_parameter * (index.re - 1.0).abs()
}

/// What light may lose in absorbing surroundings on the way along the particle's diameter.
pub const OUTSIDE_LOSS: f64 = Thresholds::MEASURED.most_lost_outside;

/// Refuses surroundings that take more than [`OUTSIDE_LOSS`] of a wavelength in vacuum over the diameter of a
/// radius (metres); below it their k is left out (amplitudes refer to light at the particle's centre, and
/// nothing is lost from there).
///
/// # Errors
/// Surroundings that absorb, or a wavelength outside their data.
pub fn check_outside(medium: &Medium, vacuum: f64, radius: f64) -> Result<(), PlanError> {
    let k = medium.outside_absorption(vacuum)?;
    let loss = 4.0 * PI * k / vacuum * 2.0 * radius;
    if loss <= OUTSIDE_LOSS {
        return Ok(());
    }
    let place = format!(" at {} nm", to_digits(vacuum * 1e9, 10));
    Err(PlanError::AbsorbingOutside { k, place, loss })
}

/// Whether rays can serve a particle of this index and size; `place` says where, for the message.
///
/// ```
/// use gonio::plan::check_rays;
/// assert!(check_rays(1.333.into(), 100.0, "").is_ok());
/// let error = check_rays(1.002.into(), 100.0, " at 550 nm").unwrap_err().to_string();
/// assert!(error.contains("at 550 nm") && error.contains("phase shift"), "{error}");
/// ```
///
/// # Errors
/// Too small or too large a particle, absorption beyond the ray picture, or an index so near 1 that
/// rays do not part from the light around the particle.
pub fn check_rays(index: Complex64, size_parameter: f64, place: &str) -> Result<(), PlanError> {
    accept(&Thresholds::MEASURED, index, size_parameter, place)
}

/// The same by given thresholds.
pub(super) fn accept(
    by: &Thresholds,
    index: Complex64,
    size_parameter: f64,
    place: &str,
) -> Result<(), PlanError> {
    let place = || place.to_string();
    let words = || {
        if index.im == 0.0 { index.re.to_string() } else { format!("{}+{}i", index.re, index.im) }
    };
    if index.im > by.largest_k_over_n * index.re {
        let limit = by.largest_k_over_n;
        return Err(PlanError::TooAbsorbing {
            index: words(),
            place: place(),
            size_parameter,
            limit,
        });
    }
    let [least, most] = by.ray_sizes;
    if !(least..=most).contains(&size_parameter) {
        return Err(PlanError::Size { place: place(), size_parameter, limits: by.ray_sizes });
    }
    let phase_shift = phase_shift(index, size_parameter);
    if phase_shift < by.least_phase_shift {
        return Err(PlanError::Soft {
            index: words(),
            place: place(),
            size_parameter,
            phase_shift,
            limit: by.least_phase_shift,
        });
    }
    Ok(())
}
