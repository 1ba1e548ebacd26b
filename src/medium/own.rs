//! Media of one's own: an index by any function of the wavelength.
//!
//! ```
//! use gonio::medium::{Medium, OwnMedium};
//!
//! // A resin by Cauchy's formula, wavelengths in metres, good from 400 to 700 nm.
//! let resin = OwnMedium::new("resin", (400e-9, 700e-9), |wavelength| {
//!     let micrometres = wavelength * 1e6;
//!     (1.505 + 0.0042 / micrometres.powi(2)).into()
//! });
//! let resin = Medium::Own(resin);
//! assert!((resin.index(500e-9)?.re - 1.5218).abs() < 1e-12);
//! assert!(resin.index(800e-9).is_err());
//! # Ok::<(), gonio::medium::MediumError>(())
//! ```

use super::error::{MediumError, check_range};
use num_complex::Complex64;
use std::fmt;
use std::sync::Arc;

type Index = dyn Fn(f64) -> Complex64 + Send + Sync;

/// A medium whose index a function gives. Two are equal when they are copies of one.
#[derive(Clone)]
pub struct OwnMedium(Arc<Own>);

/// What a medium of one's own holds.
struct Own {
    name: String,
    range: (f64, f64),
    index: Box<Index>,
}

impl OwnMedium {
    /// A medium by its name, the wavelengths in vacuum (metres) for which the function holds, and the
    /// function itself: complex index `n + ik`, `k ≥ 0` absorbs, at a wavelength in vacuum (metres).
    pub fn new(
        name: &str,
        range: (f64, f64),
        index: impl Fn(f64) -> Complex64 + Send + Sync + 'static,
    ) -> Self {
        Self(Arc::new(Own { name: name.into(), range, index: Box::new(index) }))
    }

    pub(super) fn index(&self, wavelength: f64) -> Result<Complex64, MediumError> {
        check_range(&self.0.name, wavelength, self.0.range)?;
        Ok((self.0.index)(wavelength))
    }

    pub(super) fn name(&self) -> &str {
        &self.0.name
    }

    pub(super) fn range(&self) -> (f64, f64) {
        self.0.range
    }
}

impl PartialEq for OwnMedium {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl fmt::Debug for OwnMedium {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("OwnMedium")
            .field("name", &self.0.name)
            .field("range", &self.0.range)
            .finish()
    }
}
