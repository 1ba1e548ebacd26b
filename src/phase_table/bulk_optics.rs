//! What a slab says of the mean particle and of a volume, beside its values.
//!
//! ```
//! use gonio::phase_table::{Axes, Bodies, BulkOptics, Quantity, Slab, TableHeader};
//! # let theta = (0..=180).map(|i| f64::from(i).to_radians()).collect();
//! # let axes = Axes { wavelength: vec![5e-7], theta, phi: vec![0.0] };
//! let mut header = TableHeader::of_sphere(1e-5, axes, Quantity::PhaseFunction);
//! let bodies = Bodies { number_density: Some(1e8), ..Bodies::sphere(1e-5) };
//! header.bodies = Some(bodies.with_density(Some(1000.0), "water"));
//! # let values = ndarray::Array3::from_elem((1, 181, 1), 0.08f32);
//! let slab = Slab::plain((5e-7, 1.33.into()), values, [6e-10, 8e-10], 0.0);
//! let optics = BulkOptics::of(&header, &slab);
//! assert!((optics.albedo - 0.75).abs() < 1e-12);
//! assert!((optics.extinction_per_length.unwrap() - 0.08).abs() < 1e-12);
//! assert!((optics.scattering_per_length.unwrap() - 0.06).abs() < 1e-12);
//! assert!((optics.backscatter.unwrap() - 0.08 * 6e-10).abs() < 1e-17);
//! ```

use super::{Quantity, Slab, TableHeader};
use std::f64::consts::PI;

/// Of one wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BulkOptics {
    /// Scattering over extinction.
    pub albedo: f64,
    /// `dC/dΩ` straight back, mean over azimuth, m²/sr; `None` where the table does not reach there.
    pub backscatter: Option<f64>,
    /// Of light polarised in a plane, scattered straight back: what comes polarised across over what comes
    /// polarised along, `(S11 - S22)/(S11 + S22)`, mean over azimuth; `None` without a Mueller matrix.
    pub depolarisation: Option<f64>,
    /// Of the light that goes through a volume, 1/m; `None` where the number of particles is not known.
    pub extinction_per_length: Option<f64>,
    /// Of light that a volume scatters, 1/m; `None` likewise.
    pub scattering_per_length: Option<f64>,
    /// Of light that a volume scatters straight back, 1/(m sr); `None` likewise, or as the backscatter.
    pub backscatter_per_length: Option<f64>,
    /// m²/kg; `None` where the density is not known.
    pub extinction_per_mass: Option<f64>,
}

/// A table reaches straight back if it ends within this of it, radians.
const BACK: f64 = 1e-6;

impl BulkOptics {
    /// What a slab of a table says.
    pub fn of(header: &TableHeader, slab: &Slab) -> Self {
        let extinction = slab.extinction_cross_section;
        let last = header.axes.theta.len() - 1;
        let reaches = (header.axes.theta[last] - PI).abs() < BACK;
        let back = |element: usize| slab.azimuth_mean(&header.axes, element)[last];
        let bodies = header.bodies.as_ref();
        let polarised = reaches && header.quantity == Quantity::Mueller;
        let number = bodies.and_then(|bodies| bodies.number_density);
        let backscatter = reaches.then(|| slab.scattering_cross_section * back(0));
        Self {
            albedo: slab.scattering_cross_section / extinction,
            backscatter,
            depolarisation: polarised.then(|| {
                let (all, along) = (back(0), back(5));
                ((all - along) / (all + along)).max(0.0)
            }),
            extinction_per_length: number.map(|number| number * extinction),
            scattering_per_length: number.map(|number| number * slab.scattering_cross_section),
            backscatter_per_length: number.zip(backscatter).map(|(number, back)| number * back),
            extinction_per_mass: bodies
                .and_then(|bodies| bodies.mean_mass())
                .map(|mass| extinction / mass),
        }
    }
}
