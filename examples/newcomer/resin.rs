//! A medium: a clear resin whose index follows Cauchy's formula, with a little absorption in the blue.

use gonio::medium::{Medium, OwnMedium};
use num_complex::Complex64;

pub fn resin() -> Medium {
    Medium::Own(OwnMedium::new("resin", (380e-9, 780e-9), |wavelength| {
        let micrometres = wavelength * 1e6;
        let n = 1.505 + 0.0042 / micrometres.powi(2);
        let k = 2e-7 * (0.45 / micrometres).powi(4);
        Complex64::new(n, k)
    }))
}
