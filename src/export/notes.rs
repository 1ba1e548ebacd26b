//! What whoever uses an export must know of its table: an error that was asked for and not met, what
//! was averaged over, a density that is assumed, a particle that the format takes for another.

use super::average::{Averaged, average_departure};
use crate::phase_table::{PhaseTable, Quantity};

/// Everything to be told of a table, one sentence each, for the file and for people.
pub fn notes(table: &PhaseTable) -> Vec<String> {
    let mut notes = Vec::new();
    let missed = table.slabs.iter().filter(|slab| slab.tolerance_met == Some(false));
    let worst = missed.clone().map(|slab| slab.error_estimate).fold(0.0, f64::max);
    if worst > 0.0 {
        notes.push(format!(
            "the error asked for, {}, is not met at {} of {} wavelengths: {worst:.1e} at worst",
            table.header.tolerance,
            missed.count(),
            table.slabs.len()
        ));
    }
    let averaged = table.header.averaging.words();
    if !averaged.is_empty() {
        notes.push(format!("the values are means over {}", averaged.join(", ")));
    }
    notes
}

/// That a number of Legendre moments is too small: the scattering matrix of a sphere of size parameter x
/// has 2x of them and a few more; with fewer the series rings at the dark angles.
pub fn too_few_moments(tables: &[PhaseTable], moments: u16) -> Option<String> {
    let largest = |table: &PhaseTable| {
        let sizes = table.slabs.iter().map(|slab| slab.size_parameter(table.header.radius));
        sizes.fold(0.0, f64::max)
    };
    let size_parameter = tables.iter().map(largest).fold(0.0, f64::max);
    let whole = 2.0 * size_parameter + 16.0;
    (f64::from(moments) < whole).then(|| {
        format!(
            "{moments} Legendre moments; size parameter {size_parameter:.0} has about {whole:.0}. With \
             fewer the series is off by tens of per cent at the dark angles (--moments; with all of \
             them --cap-deg 0 is exact)"
        )
    })
}

/// What the density of a table is worth, where it is assumed.
pub fn density_note(table: &PhaseTable) -> Option<String> {
    let bodies = table.header.bodies.as_ref()?;
    let density = bodies.density?;
    bodies.density_source.starts_with("assumed").then(|| {
        format!(
            "density {density} kg/m³, {}; particle.density_kg_m3 or --density-kg-m3 gives another",
            bodies.density_source
        )
    })
}

/// What the mean over azimuth leaves out of a particle that is no sphere.
pub(super) fn shape_note(table: &PhaseTable, averaged: &Averaged) -> Option<String> {
    if averaged.spherical {
        return None;
    }
    let mut note = format!(
        "{}: mean over azimuth about the light, as if the particle were turned about it",
        table.header.shape
    );
    if table.header.quantity == Quantity::Mueller {
        let departure = average_departure(table);
        note += &format!(
            "; elements beside 11, 12, 22, 33, 34, 44 are left out: 21 - 12, 34 + 43 and the rest \
             reach {departure:.1e} of element 11"
        );
    }
    Some(note)
}
