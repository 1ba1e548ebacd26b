//! How big a table will be, and whether the disk has room for it.

use crate::phase_table::TableHeader;
use std::path::Path;

/// What a file takes beyond its values: headers, coordinates, text.
const OVERHEAD: u64 = 64 * 1024;

/// Bytes that the file of such a table takes at most (values that no compressor shortens).
/// Saturates for absurd axes.
pub fn estimate_bytes(header: &TableHeader) -> u64 {
    let axes = &header.axes;
    let directions = (axes.theta.len() as u64).saturating_mul(axes.phi.len() as u64);
    let per_direction = 4 * header.quantity.elements() as u64;
    directions
        .saturating_mul(per_direction)
        .saturating_mul(axes.wavelength.len() as u64)
        .saturating_add(OVERHEAD + header.scene_toml.len() as u64)
}

/// Bytes free for this user on the disk that holds `folder`; `None` where the system does not say.
#[cfg(unix)]
pub fn available_bytes(folder: &Path) -> Option<u64> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let disk = rustix::fs::statvfs(folder).ok()?;
    Some(disk.f_bavail.saturating_mul(disk.f_frsize))
}

#[cfg(not(unix))]
pub fn available_bytes(_folder: &Path) -> Option<u64> {
    None
}
