//! Does the computation of a table fit into this machine's memory?

use super::UsageError;
use gonio::scene::{Scene, TableSize, human_bytes};

/// Slabs alive at once: one being computed, one waiting, one being written.
const SLABS: u64 = 3;
/// Working memory per direction while a slab is computed: amplitudes of both polarisations (64),
/// sums over Mueller elements in f64, the mask.
const BYTES_PER_DIRECTION: u64 = 96;
/// Everything that does not grow with the table: rays, patches, the program itself.
const REST: u64 = 300 << 20;

/// Memory that a table needs while it is made, bytes; does not depend on the number of wavelengths.
pub fn needed(size: &TableSize) -> u64 {
    SLABS * size.slab_bytes + BYTES_PER_DIRECTION * size.directions + REST
}

/// Refuse a scene that would not fit.
pub fn check(scene: &Scene) -> Result<(), UsageError> {
    let size = scene.table_size();
    let needed = needed(&size);
    match available() {
        Some(available) if needed > available => Err(UsageError(format!(
            "table.theta_deg × table.azimuth_deg = {} × {}: a wavelength of {} needs about {} of \
             memory, {} are free here; take fewer angles",
            scene.theta.len(),
            scene.phi.len(),
            human_bytes(size.slab_bytes),
            human_bytes(needed),
            human_bytes(available)
        ))),
        _ => Ok(()),
    }
}

/// Memory that is free, bytes; `None` where the system does not say.
pub fn available() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes << 10)
}
