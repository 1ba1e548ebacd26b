//! What a file has once, read: see [`crate::phase_table::variables`] for how it is written.

use crate::hdf5::file::opened::OpenFile;
use crate::hdf5::{TableError, damaged};
use crate::phase_table::variables::circumstances::{MM_H, NUMBERS};
use crate::phase_table::{Averaging, Bodies, DiscOfSun};

/// Read bodies, averaging and tolerance of the table at `leading`, its place in a sweep (empty: a table).
pub fn read_numbers(
    file: &OpenFile,
    leading: &[u64],
) -> Result<(Option<Bodies>, Averaging, f64), TableError> {
    let mut values = [f64::NAN; NUMBERS.len()];
    for (value, (name, ..)) in values.iter_mut().zip(NUMBERS) {
        // Tables of older versions have none.
        let Some(data) = file.dataset(name)? else { continue };
        if data.shape.len() != leading.len() {
            let message = format!("{name} has shape {:?}", data.shape);
            return Err(damaged(&file.path, &message));
        }
        *value = if leading.is_empty() {
            data.read::<f64>()?.first().copied().unwrap_or(f64::NAN)
        } else {
            let ones = vec![1; leading.len()];
            data.read_block::<f64>(leading, &ones)?.first().copied().unwrap_or(f64::NAN)
        };
    }
    let [radius, variance, volume, area, density, bandwidth, filter, tolerance, number, rain] =
        values;
    let bodies = (!volume.is_nan()).then_some(Bodies {
        effective_radius: radius * 1e-6,
        effective_variance: variance,
        mean_volume: volume,
        mean_area: area,
        density: (!density.is_nan()).then_some(density),
        density_source: file.text("density_source")?.unwrap_or_default(),
        number_density: (!number.is_nan()).then_some(number),
        rain_rate: (!rain.is_nan()).then_some(rain / MM_H),
    });
    let disc = file.text("averaged_over_sun_disc")?;
    let disc_of = |name: &str| {
        let unknown = || damaged(&file.path, &format!("averaged_over_sun_disc = {name:?}"));
        DiscOfSun::from_name(name).ok_or_else(unknown)
    };
    let averaging = Averaging {
        sun_disc: disc.as_deref().map_or(Ok(DiscOfSun::None), disc_of)?,
        sizes: file.number("averaged_over_sizes")? == Some(1.0),
        bandwidth: if bandwidth.is_nan() { 0.0 } else { bandwidth * 1e-9 },
        filter: if filter.is_nan() { 0.0 } else { filter.to_radians() },
    };
    Ok((bodies, averaging, tolerance))
}
