//! Headers and slabs of which nothing is known but what they hold: for tables that no scene made.
//!
//! ```
//! use gonio::phase_table::{Axes, Quantity, Slab, TableHeader};
//! use num_complex::Complex64;
//! use std::f64::consts::PI;
//!
//! // a sphere that scatters a third of what it takes evenly into all directions
//! let theta = (0..=180).map(|i| PI * f64::from(i) / 180.0).collect();
//! let axes = Axes { wavelength: vec![5e-7], theta, phi: vec![0.0] };
//! let header = TableHeader::of_sphere(1e-6, axes, Quantity::PhaseFunction);
//! let values = ndarray::Array3::from_elem((1, 181, 1), (0.25 / PI) as f32);
//! let slab = Slab::plain((5e-7, Complex64::new(1.33, 0.01)), values, [1e-12, 3e-12], 0.0);
//! assert!(slab.validate(&header, 0.0).is_ok());
//! ```

use super::{Averaging, Axes, Bodies, ERROR_BANDS, ForwardPeak, Quantity, Slab, TableHeader};
use ndarray::Array3;
use num_complex::Complex64;

impl TableHeader {
    /// Of a sphere of a radius (metres) by its exact series: values at points, means over nothing.
    pub fn of_sphere(radius: f64, axes: Axes, quantity: Quantity) -> Self {
        Self {
            rotational_symmetry: axes.phi.len() == 1,
            axes,
            quantity,
            forward_peak: ForwardPeak::Point,
            method: "mie".into(),
            shape: "sphere".into(),
            radius,
            sun_elevation: 0.0,
            bodies: Some(Bodies::sphere(radius)),
            averaging: Averaging::default(),
            tolerance: f64::NAN,
            scene_toml: String::new(),
            command_line: String::new(),
        }
    }
}

impl Slab {
    /// Values at a wavelength (metres) and index, with the cross-sections of scattering and extinction (m²) and
    /// the asymmetry; errors are not known.
    pub fn plain(
        (wavelength, index): (f64, Complex64),
        values: Array3<f32>,
        [scattering, extinction]: [f64; 2],
        asymmetry: f64,
    ) -> Self {
        Self {
            wavelength,
            index,
            outside_index: 1.0,
            values,
            caustic_order: None,
            scattering_cross_section: scattering,
            extinction_cross_section: extinction,
            absorption_cross_section: extinction - scattering,
            forward_extinction: None,
            asymmetry,
            energy: None,
            sum_before_peak: f64::NAN,
            peak_share: 0.0,
            error_estimate: f64::NAN,
            error_by_band: f64::NAN,
            error_by_direction: [f64::NAN; ERROR_BANDS],
            tolerance_met: None,
            left_out: 0.0,
            methods: Vec::new(),
        }
    }

    /// The same with one error for all (relative).
    pub fn with_error(self, error: f64) -> Self {
        let error_by_direction = [error; ERROR_BANDS];
        Self { error_estimate: error, error_by_band: error, error_by_direction, ..self }
    }
}
