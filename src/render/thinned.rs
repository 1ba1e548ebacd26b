//! As much of a table as a picture can show, so that memory does not grow with the table.

use crate::phase_table::{Axes, PhaseTable, Quantity, Slab, TableHeader};
use ndarray::s;

/// Values kept at most (64 Mi values of 4 bytes).
const MAX_VALUES: usize = 64 << 20;
/// Wavelengths kept at most: the eye's response needs no more.
const MAX_WAVELENGTHS: usize = 96;

/// Every so-manyth wavelength, scattering angle and azimuth of a table, element "11" alone.
pub struct Thinned {
    header: TableHeader,
    slabs: Vec<Slab>,
    wavelength_step: usize,
    theta_step: usize,
    phi_step: usize,
}

impl Thinned {
    /// For a table of this header.
    pub fn new(header: &TableHeader) -> Thinned {
        let axes = &header.axes;
        let wavelength_step = axes.wavelength.len().div_ceil(MAX_WAVELENGTHS).max(1);
        let kept = axes.wavelength.len().div_ceil(wavelength_step).max(1);
        let (mut theta_step, mut phi_step) = (1, 1);
        let count = |len: usize, step: usize| len.div_ceil(step);
        while kept * count(axes.theta.len(), theta_step) * count(axes.phi.len(), phi_step)
            > MAX_VALUES
        {
            // Supernumerary bows are finer in θ than anything is in φ.
            if count(axes.phi.len(), phi_step) > 181 { phi_step += 1 } else { theta_step += 1 }
        }
        let every = |axis: &[f64], step: usize| axis.iter().step_by(step).copied().collect();
        let thin = Axes {
            wavelength: every(&axes.wavelength, wavelength_step),
            theta: every(&axes.theta, theta_step),
            phi: every(&axes.phi, phi_step),
        };
        let header =
            TableHeader { axes: thin, quantity: Quantity::PhaseFunction, ..header.clone() };
        Thinned { header, slabs: vec![], wavelength_step, theta_step, phi_step }
    }

    /// Keep what is wanted of the slab of wavelength number `index`.
    pub fn add(&mut self, index: usize, slab: &Slab) {
        if !index.is_multiple_of(self.wavelength_step) {
            return;
        }
        let (theta, phi) = (self.theta_step, self.phi_step);
        let thin = Slab {
            values: slab.values.slice(s![..1, ..;theta, ..;phi]).to_owned(),
            caustic_order: None,
            energy: slab.energy.clone(),
            methods: slab.methods.clone(),
            ..*slab
        };
        self.slabs.push(thin);
    }

    /// The table of what was kept.
    pub fn into_table(self) -> PhaseTable {
        PhaseTable { header: self.header, slabs: self.slabs }
    }
}
