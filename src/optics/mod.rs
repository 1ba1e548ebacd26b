//! Optics of plane interfaces, polarisation, and **the conventions of this program**.
//!
//! # Conventions
//! - Time factor `exp(-iωt)`. A refractive index is `n + ik` with `k ≥ 0` for absorption. A path of
//!   optical length `L` adds the phase `+k₀ L`, with `k₀ = 2π/λ` and `λ` the wavelength in vacuum.
//!   The particle is in vacuum (air is taken as index 1); indices are relative to that.
//! - Lengths are metres and angles radians inside; units stand in names only at the border.
//! - The scattering angle θ ∈ [0, π] is 0 for forward scattering. The azimuth φ is measured about
//!   the direction of the incident light, right-handed, from the vertical plane (which holds the
//!   particle's axis); φ = 0 points to the upper side.
//! - In the frame of the light: `z` is the direction in which the light travels, `x` points to
//!   the upper side in the vertical plane, `y = z × x`. A scattered direction is
//!   `(sin θ cos φ, sin θ sin φ, cos θ)`.
//! - Amplitude matrix after Bohren & Huffman 1983, eq. 3.12:
//!   `(E∥s, E⊥s) = exp(ikr)/(-ikr) · [[S2, S3], [S4, S1]] (E∥i, E⊥i)`,
//!   `∥` and `⊥` with respect to the scattering plane, `ê⊥ × ê∥ = ê_direction`. Hence
//!   `ê∥s = ê_θ`, `ê⊥s = -ê_φ`, and for the incident light `ê∥i = (cos φ, sin φ, 0)`,
//!   `ê⊥i = (sin φ, -cos φ, 0)`.
//! - `dC_sca/dΩ = S11 / k²` for unpolarised light, `S11 = ½(|S1|²+|S2|²+|S3|²+|S4|²)`.
//!   `phase_function = (1/C_sca) dC_sca/dΩ` in sr⁻¹; its integral over the sphere is 1.
//! - Stokes `Q = I∥ - I⊥`, so `S12 = ½(|S2|² - |S1|² + |S4|² - |S3|²)` as in B&H eq. 3.16:
//!   negative in the rainbow, where the degree of linear polarisation `-S12/S11` is positive.
//! - **Order** `p` counts the chords inside the particle: 0 external reflection, 1 transmission,
//!   2 primary bow, 3 secondary bow. Forward diffraction is kept apart from `p = 0`.
//!
//! ```
//! use gonio::optics::fresnel;
//!
//! // Brewster's angle from vacuum into glass: nothing is reflected in the plane of incidence
//! let index = 1.5f64;
//! let cos = (1.0 / (1.0 + index * index)).sqrt();
//! let f = fresnel(cos, index.into());
//! assert!(f.r_parallel.norm() < 1e-15);
//! assert!((f.r_perpendicular.norm_sqr() + f.t_perpendicular.norm_sqr() - 1.0).abs() < 1e-14);
//! ```

mod amplitude;
mod descartes;
mod fresnel;
mod grazing;
mod polarisation;

pub use amplitude::{AmplitudeMatrix, mirror_sign};
pub use descartes::rainbow_angle;
pub use fresnel::{Fresnel, fresnel};
pub(crate) use fresnel::{curved_from_inside, curved_from_outside};
pub(crate) use grazing::Grazing;
pub use polarisation::Polarisation;
