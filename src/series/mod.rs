//! Exact series for spheres: Lorenz–Mie, its Debye expansion, and spheres that are not homogeneous.
//!
//! Both give partial-wave coefficients a_n, b_n ([`lorenz_mie`], [`debye`], [`layered`]); [`angular`] sums
//! them over the angles; [`mean`] averages over sizes and wavelengths. [`airy`] is no series: the classical theory of the
//! rainbow, to be compared with them.
//!
//! ```
//! use gonio::series::lorenz_mie::Sphere;
//!
//! // Bohren & Huffman 1983, appendix A: x = 3, m = 1.33 + 10⁻⁸i
//! let q = Sphere::new(3.0, num_complex::Complex64::new(1.33, 1e-8))?.efficiencies();
//! assert!((q.q_ext - q.q_sca - q.q_abs).abs() < 1e-12 && q.q_abs > 0.0);
//! # Ok::<(), gonio::series::SeriesError>(())
//! ```

pub mod airy;
pub mod angular;
mod behind;
mod curves;
pub mod debye;
mod debye_error;
pub(crate) mod even_angles;
pub(crate) mod lanes;
pub mod layered;
mod legendre;
pub mod lorenz_mie;
pub mod mean;
mod stretch;
pub mod table;
pub mod tmatrix;

use crate::fault::{Blame, Fault};
use num_complex::Complex64;

/// Smallest size parameter accepted: below it the squares of the Riccati–Bessel functions
/// overflow (and scattering is Rayleigh's to 50 digits).
pub const MIN_SIZE_PARAMETER: f64 = 1e-25;

/// Most terms of a series, and most steps of the downward recurrence: 1.3 GB of coefficients.
pub const MAX_TERMS: usize = 20_000_000;

/// What is wrong with the input of a series.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum SeriesError {
    #[error("size parameter = {0}: accepted are finite numbers of at least {MIN_SIZE_PARAMETER:e}")]
    SizeParameter(f64),
    #[error(
        "relative index = {0}: accepted are n + ik with finite n > 0 and k ≥ 0 (k > 0 absorbs)"
    )]
    Index(Complex64),
    #[error(
        "size parameter = {size_parameter} with index {index} needs {terms:e} terms: accepted are at most {MAX_TERMS} (1.3 GB)"
    )]
    TooManyTerms { size_parameter: f64, index: Complex64, terms: f64 },
    #[error("no memory for a series of {terms} terms")]
    OutOfMemory { terms: usize },
    #[error("{field} = {value}: accepted {accepted}")]
    Invalid { field: &'static str, value: String, accepted: &'static str },
}

impl Blame for SeriesError {
    fn fault(&self) -> Fault {
        match self {
            SeriesError::OutOfMemory { .. } => Fault::Run,
            _ => Fault::Input,
        }
    }
}

/// Efficiencies (cross-section over πa²) and the asymmetry parameter of a sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Efficiencies {
    /// Extinction over the shadow's area.
    pub q_ext: f64,
    /// Scattering over the shadow's area.
    pub q_sca: f64,
    /// Absorption over the shadow's area.
    pub q_abs: f64,
    /// Radar back-scattering efficiency `4 |S(180°)|²/x²`.
    pub q_back: f64,
    /// Mean cosine of the scattering angle.
    pub asymmetry: f64,
}

/// Number of terms after which a_n, b_n are below rounding: beyond the edge `n = x` they fall as
/// `exp(-(4√2/3) s^{3/2})` at `n = x + s x^{1/3}`, which is 7e-16 at s = 7.
fn term_count(size_parameter: f64) -> f64 {
    (size_parameter + 7.0 * size_parameter.cbrt() + 4.0).ceil()
}

/// Refuse what has no meaning or no room, else give the number of terms.
fn checked_term_count(size_parameter: f64, index: Complex64) -> Result<usize, SeriesError> {
    if !(size_parameter.is_finite() && size_parameter >= MIN_SIZE_PARAMETER) {
        return Err(SeriesError::SizeParameter(size_parameter));
    }
    if !(index.re.is_finite() && index.im.is_finite() && index.re > 0.0 && index.im >= 0.0) {
        return Err(SeriesError::Index(index));
    }
    crate::cancel::checkpoint();
    let terms = term_count(size_parameter).max(index.norm() * size_parameter);
    if terms > MAX_TERMS as f64 {
        return Err(SeriesError::TooManyTerms { size_parameter, index, terms });
    }
    let terms = term_count(size_parameter) as usize;
    let mut probe: Vec<Complex64> = Vec::new();
    probe.try_reserve_exact(4 * terms).map_err(|_| SeriesError::OutOfMemory { terms })?;
    Ok(terms)
}

/// S11, S12, S33, S34 of a sphere's amplitudes; `area` is the square of 1/k, m².
fn elements((s1, s2): (Complex64, Complex64), area: f64) -> [f64; 4] {
    let (perpendicular, parallel, cross) = (s1.norm_sqr(), s2.norm_sqr(), s1 * s2.conj());
    [
        0.5 * area * (parallel + perpendicular),
        0.5 * area * (parallel - perpendicular),
        area * cross.re,
        -area * cross.im,
    ]
}
