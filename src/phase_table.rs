//! `PhaseTable`: the narrow waist. Everything that computes scattering produces one, wavelength
//! slab by wavelength slab; everything else (HDF5, pictures, reports, exports) reads nothing but it.
//!
//! ```
//! use gonio::phase_table::Axes;
//!
//! let degrees = |values: &[f64]| values.iter().map(|v| v.to_radians()).collect::<Vec<_>>();
//! let axes = Axes {
//!     wavelength: vec![550e-9],
//!     theta: degrees(&[0.0, 45.0, 90.0, 135.0, 180.0]),
//!     phi: degrees(&[0.0, 120.0, 240.0]),
//! };
//! // the cells of the samples fill the sphere
//! assert!((axes.solid_angle().sum() - 4.0 * std::f64::consts::PI).abs() < 1e-12);
//! ```

mod averaging;
mod bodies;
mod bulk_optics;
mod invalid;
mod methods;
mod plain;
mod validate;
pub mod variables;

pub use averaging::{Averaging, DiscOfSun};
pub use bodies::Bodies;
pub use bulk_optics::BulkOptics;
pub use invalid::InvalidTable;
pub use methods::{FormulaPart, MethodPart, MethodRange};

use ndarray::{Array2, Array3};
use num_complex::Complex64;
use serde::Serialize;
use std::f64::consts::{PI, TAU};

/// Coordinates of a table. θ ascending in [0, π]; φ ascending in [0, 2π] (both ends may be there).
#[derive(Clone, Debug, PartialEq)]
pub struct Axes {
    /// Wavelengths in vacuum, metres, in the order of the scene.
    pub wavelength: Vec<f64>,
    /// Scattering angles, radians.
    pub theta: Vec<f64>,
    /// Azimuths, radians. A single value when the scattering has no azimuth dependence
    /// (`rotational_symmetry` in the header): the table then stands for all azimuths.
    pub phi: Vec<f64>,
}

/// What is tabulated per direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// The phase function of unpolarised light (element "11" alone), sr⁻¹.
    PhaseFunction,
    /// All 16 Mueller elements "11" … "44", row by row, scaled like the phase function, sr⁻¹.
    Mueller,
}

impl Quantity {
    /// The words of scenes and files.
    pub const WORDS: [(&str, Self); 2] =
        [(Self::PhaseFunction.word(), Self::PhaseFunction), (Self::Mueller.word(), Self::Mueller)];

    /// The word of scenes and files.
    pub const fn word(self) -> &'static str {
        match self {
            Self::PhaseFunction => "phase_function",
            Self::Mueller => "mueller",
        }
    }

    /// Number of values per direction.
    pub fn elements(self) -> usize {
        match self {
            Quantity::PhaseFunction => 1,
            Quantity::Mueller => 16,
        }
    }
}

/// How the forward diffraction peak, often narrower than a sample, enters the table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ForwardPeak {
    /// Where a cell is coarser than the peak its value is the mean over the cell: Σ P·ΔΩ = 1.
    #[default]
    CellAverage,
    /// The value at the sample's direction.
    Point,
    /// Diffraction left out; its share of the cross-section is recorded.
    Separate,
}

impl ForwardPeak {
    /// The words of scenes and files.
    pub const WORDS: [(&str, Self); 3] = [
        (Self::CellAverage.word(), Self::CellAverage),
        (Self::Point.word(), Self::Point),
        (Self::Separate.word(), Self::Separate),
    ];

    /// The word of scenes and files.
    pub const fn word(self) -> &'static str {
        match self {
            Self::CellAverage => "cell_average",
            Self::Point => "point",
            Self::Separate => "separate",
        }
    }
}

/// Where the light went that met the particle, as fractions of the power on its silhouette.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct EnergyBudget {
    /// Power that left after `p` chords, by order.
    pub left_by_order: Vec<f64>,
    /// Power absorbed along the chords.
    pub absorbed: f64,
    /// Power still inside after the last order because it was totally reflected.
    pub totally_reflected: f64,
    /// Power still inside after the last order otherwise.
    pub truncated: f64,
    /// What is missing to 1 (numerical; near zero).
    pub residual: f64,
}

/// All that does not change from slab to slab.
#[derive(Clone, Debug, PartialEq)]
pub struct TableHeader {
    /// Where it is tabulated.
    pub axes: Axes,
    /// What is tabulated.
    pub quantity: Quantity,
    /// How the forward peak is in it.
    pub forward_peak: ForwardPeak,
    /// The scattering does not depend on azimuth; `axes.phi` has one value.
    pub rotational_symmetry: bool,
    /// `rays`, `mie`, `debye`, `tmatrix` or `facets`.
    pub method: String,
    /// `sphere`, `spheroid`, `raindrop`, `hexagonal-column` …: the scene's word.
    pub shape: String,
    /// Radius of the sphere of equal volume, metres.
    pub radius: f64,
    /// Sun's elevation above the horizon, radians.
    pub sun_elevation: f64,
    /// Volume, shadow and density of the particles; `None` where the table does not tell.
    pub bodies: Option<Bodies>,
    /// What the values are means over.
    pub averaging: Averaging,
    /// Relative error that was asked for; NaN where none was.
    pub tolerance: f64,
    /// The resolved scene as TOML.
    pub scene_toml: String,
    /// The command line that made the table (empty when made by the library).
    pub command_line: String,
}

/// One wavelength of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Slab {
    /// Wavelength in vacuum, metres.
    pub wavelength: f64,
    /// Index of the particle relative to what surrounds it.
    pub index: Complex64,
    /// Index of what surrounds it: 1 in vacuum.
    pub outside_index: f64,
    /// Values in sr⁻¹, shape (elements, θ, φ).
    pub values: Array3<f32>,
    /// Highest number of coalescing rays where the two-ray uniform formula does not hold
    /// (0: everywhere fine), shape (θ, φ); absent where the method has none.
    pub caustic_order: Option<Array2<u8>>,
    /// Cross-sections, m².
    pub scattering_cross_section: f64,
    /// Power taken from the light per irradiance, m².
    pub extinction_cross_section: f64,
    /// What is absorbed, counted apart from the two others, m².
    pub absorption_cross_section: f64,
    /// Extinction by the optical theorem, `2π/k² Re(S1 + S2)` of the amplitudes straight ahead, m²;
    /// absent where the table has no forward diffraction.
    pub forward_extinction: Option<f64>,
    /// Mean cosine of the scattering angle.
    pub asymmetry: f64,
    /// Absent for the exact series.
    pub energy: Option<EnergyBudget>,
    /// Σ P·ΔΩ over the samples before the forward peak was treated.
    pub sum_before_peak: f64,
    /// Share of the scattered power that is in the separated peak (`ForwardPeak::Separate`).
    pub peak_share: f64,
    /// The method's own estimate of the relative error of the intensity: weighted by intensity.
    pub error_estimate: f64,
    /// The same, root mean square over bands of a few degrees, each relative to its own intensity.
    pub error_by_band: f64,
    /// The error that was asked for is met, by the method's own estimate; `None` where that has none.
    pub tolerance_met: Option<bool>,
    /// The same by scattering angle: within 2° of each of [`error_theta`], over azimuth. NaN where not known.
    pub error_by_direction: [f64; ERROR_BANDS],
    /// Share of the scattered power in orders that a list left out; 0 where all that matter are in.
    pub left_out: f64,
    /// By which method each order was computed; empty where the table does not tell.
    pub methods: Vec<MethodPart>,
}

impl Slab {
    /// Circumference of a sphere of a radius (metres) over the wavelength in the surroundings.
    ///
    /// ```
    /// use gonio::phase_table::Slab;
    /// use ndarray::Array3;
    ///
    /// let slab = Slab::plain((500e-9, 1.2.into()), Array3::zeros((1, 1, 1)), [1e-12; 2], 0.0);
    /// let in_water = Slab { outside_index: 1.333, ..slab };
    /// assert!((in_water.size_parameter(1e-6) - 16.751).abs() < 1e-3);
    /// ```
    pub fn size_parameter(&self, radius: f64) -> f64 {
        TAU * radius * self.outside_index / self.wavelength
    }
}

/// Bands of scattering angle for which an error is stated.
pub const ERROR_BANDS: usize = 46;

/// Middle of a band of scattering angle for which an error is stated, radians: 0°, 4°, … 180°.
///
/// ```
/// use gonio::phase_table::{ERROR_BANDS, error_theta};
/// assert_eq!(error_theta(ERROR_BANDS - 1), std::f64::consts::PI);
/// ```
pub fn error_theta(band: usize) -> f64 {
    PI * band as f64 / (ERROR_BANDS - 1) as f64
}

/// A whole table in memory.
#[derive(Clone, Debug, PartialEq)]
pub struct PhaseTable {
    /// All that the slabs share.
    pub header: TableHeader,
    /// One per wavelength, in the order of `header.axes.wavelength`.
    pub slabs: Vec<Slab>,
}

impl Axes {
    /// Solid angle (sr) that each sample stands for, shape (θ, φ): cells bounded by the midpoints
    /// between samples, exact on the sphere; the outermost θ cells reach to the first and last
    /// sample only. A φ axis that closes (first + 2π = last) gives half cells to both ends; one
    /// that wraps (last + step = first + 2π) gives full cells; a single φ stands for 2π.
    pub fn solid_angle(&self) -> Array2<f64> {
        let (theta, phi) = self.solid_angle_factors();
        Array2::from_shape_fn((theta.len(), phi.len()), |(i, j)| theta[i] * phi[j])
    }

    /// The two factors of [`Axes::solid_angle`]: a weight per θ and a width (radians) per φ.
    pub fn solid_angle_factors(&self) -> (Vec<f64>, Vec<f64>) {
        (theta_weights(&self.theta), phi_weights(&self.phi))
    }

    /// True if the samples stand for all directions of the sphere.
    pub fn cover_sphere(&self) -> bool {
        let (theta, phi) = self.solid_angle_factors();
        let (theta, phi): (f64, f64) = (theta.iter().sum(), phi.iter().sum());
        (theta - 2.0).abs() < 1e-6 && (phi - TAU).abs() < 1e-6 * TAU
    }
}

/// `cos` of the cell's upper edge minus `cos` of its lower edge, per θ sample.
fn theta_weights(theta: &[f64]) -> Vec<f64> {
    let last = theta.len().saturating_sub(1);
    let edge = |i: usize| 0.5 * (theta[i] + theta[i + 1]);
    (0..theta.len())
        .map(|i| {
            let low = if i == 0 { theta[0] } else { edge(i - 1) };
            let high = if i == last { theta[last] } else { edge(i) };
            // cos low - cos high without cancellation
            2.0 * (0.5 * (low + high)).sin() * (0.5 * (high - low)).sin()
        })
        .collect()
}

/// Width in azimuth per φ sample.
fn phi_weights(phi: &[f64]) -> Vec<f64> {
    let count = phi.len();
    if count < 2 {
        return vec![TAU; count];
    }
    let span = phi[count - 1] - phi[0];
    let last_step = phi[count - 1] - phi[count - 2];
    let wraps = (span + last_step - TAU).abs() < 1e-9 * TAU;
    // From the last sample on to the first.
    let seam = if wraps { phi[0] + TAU - phi[count - 1] } else { 0.0 };
    (0..count)
        .map(|j| {
            let below = if j > 0 { phi[j] - phi[j - 1] } else { seam };
            let above = if j + 1 < count { phi[j + 1] - phi[j] } else { seam };
            0.5 * (below + above)
        })
        .collect()
}

impl Slab {
    /// Σ P·ΔΩ over the samples.
    pub fn sum(&self, axes: &Axes) -> f64 {
        let (theta, phi) = axes.solid_angle_factors();
        let face = self.values.index_axis(ndarray::Axis(0), 0);
        let rows = face.outer_iter().zip(theta);
        rows.map(|(row, height)| {
            let line: f64 = row.iter().zip(&phi).map(|(&value, w)| f64::from(value) * w).sum();
            line * height
        })
        .sum()
    }

    /// Mean over azimuth of one element at every θ, sr⁻¹.
    pub fn azimuth_mean(&self, axes: &Axes, element: usize) -> Vec<f64> {
        let (_, phi) = axes.solid_angle_factors();
        let total: f64 = phi.iter().sum();
        let face = self.values.index_axis(ndarray::Axis(0), element);
        face.outer_iter()
            .map(|row| row.iter().zip(&phi).map(|(&v, w)| f64::from(v) * w).sum::<f64>() / total)
            .collect()
    }
}
