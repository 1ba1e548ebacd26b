//! An export: the mean over azimuth of each wavelength as columns of text, for gnuplot and the like.

use gonio::pending_file::write_whole;
use gonio::phase_table::PhaseTable;
use std::fmt::Write;
use std::path::Path;

/// Write the table; the file appears only when it is complete.
pub fn write(table: &PhaseTable, path: &Path) -> std::io::Result<()> {
    write_whole(path, text(table).as_bytes())
}

/// Angles in degrees, phase functions in sr⁻¹, one column per wavelength.
pub fn text(table: &PhaseTable) -> String {
    let axes = &table.header.axes;
    let mut text = format!("# {}: theta_deg", table.header.shape);
    for slab in &table.slabs {
        // writing to a string does not fail
        let _ = write!(text, " {:.1}nm", slab.wavelength * 1e9);
    }
    let means: Vec<_> = table.slabs.iter().map(|slab| slab.azimuth_mean(axes, 0)).collect();
    for (i, theta) in axes.theta.iter().enumerate() {
        let _ = write!(text, "\n{:.3}", theta.to_degrees());
        for mean in &means {
            let _ = write!(text, " {:.6e}", mean[i]);
        }
    }
    text + "\n"
}
