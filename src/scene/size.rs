//! How large the table of a scene is, before anything is computed.

use super::{Scene, SceneError};
use crate::math::bytes::human_bytes;

/// Largest slab (one wavelength) that is accepted. HDF5 allows no chunk over 4 GiB, and a slab
/// passes through memory several times over.
const MAX_SLAB_BYTES: u64 = 2 << 30;

/// Size of a table, uncompressed, in bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TableSize {
    /// Directions (θ × φ) per wavelength.
    pub directions: u64,
    /// One wavelength.
    pub slab_bytes: u64,
    /// All wavelengths.
    pub total_bytes: u64,
}

impl Scene {
    /// Size of the table. A scene without azimuth dependence takes less: one azimuth stands for
    /// all of them.
    pub fn table_size(&self) -> TableSize {
        let directions = self.theta.len() as u64 * self.phi.len() as u64;
        let value = size_of::<f32>() as u64 * self.quantity.elements() as u64;
        let slab_bytes = directions * value;
        TableSize {
            directions,
            slab_bytes,
            total_bytes: slab_bytes * self.wavelengths.len() as u64,
        }
    }

    /// Refuse a table that no machine of today would hold comfortably.
    pub(super) fn check_size(&self) -> Result<(), SceneError> {
        let size = self.table_size();
        if size.slab_bytes <= MAX_SLAB_BYTES {
            return Ok(());
        }
        Err(SceneError::invalid(
            "table.theta_deg",
            format!("{} angles × {} azimuths", self.theta.len(), self.phi.len()),
            format!(
                "that is {} per wavelength and {} for all {}; at most {} per wavelength are accepted",
                human_bytes(size.slab_bytes),
                human_bytes(size.total_bytes),
                self.wavelengths.len(),
                human_bytes(MAX_SLAB_BYTES)
            ),
        ))
    }
}
