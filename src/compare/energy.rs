//! Where the light went: cross-sections, and power by fate where rays were counted.

use super::curve::nearest;
use crate::phase_table::{EnergyBudget, PhaseTable};
use serde::Serialize;
use std::f64::consts::PI;

/// The energy budget at one wavelength.
#[derive(Clone, Debug, Serialize)]
pub struct EnergyReport {
    /// Wavelength in vacuum.
    pub wavelength_nm: f64,
    /// Cross-sections over that of the sphere of equal volume.
    pub q_sca: f64,
    /// Extinction over the shadow's area.
    pub q_ext: f64,
    /// Absorption over the shadow's area.
    pub q_abs: f64,
    /// Mean cosine of the scattering angle.
    pub asymmetry: f64,
    /// Rays: shares of the power that met the particle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fates: Option<EnergyBudget>,
}

impl EnergyReport {
    /// Of the wavelength nearest to `wavelength` (metres).
    pub fn of(table: &PhaseTable, wavelength: f64) -> Option<Self> {
        let slab = nearest(table, wavelength)?;
        let area = PI * table.header.radius.powi(2);
        Some(Self {
            wavelength_nm: slab.wavelength * 1e9,
            q_sca: slab.scattering_cross_section / area,
            q_ext: slab.extinction_cross_section / area,
            q_abs: (slab.extinction_cross_section - slab.scattering_cross_section) / area,
            asymmetry: slab.asymmetry,
            fates: slab.energy.clone(),
        })
    }
}
