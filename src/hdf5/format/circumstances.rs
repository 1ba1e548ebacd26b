//! What a table has once: radius and sun, the particles as bodies, what was averaged over, the error
//! asked for. Scalars in a table; in a sweep, along its axes, for each table has its own.

use crate::hdf5::file::created::{Kind, NewDataset, NewFile};
use crate::hdf5::file::opened::OpenFile;
use crate::hdf5::{TableError, damaged};
use crate::math::digits::{degree, tidy};
use crate::phase_table::{Averaging, Bodies, DiscOfSun, TableHeader};

type Getter = fn(&TableHeader) -> f64;

/// Numbers of a header beside radius and sun: name, units, words, value (NaN: not known).
const NUMBERS: [(&str, &str, &str, Getter); 10] = [
    ("size_effective_radius", "um", "effective radius, 3/4 volume over projected area", |h| {
        body(h, |b| b.effective_radius * 1e6)
    }),
    ("size_effective_variance", "1", "effective variance of the sizes", |h| {
        body(h, |b| b.effective_variance)
    }),
    ("mean_volume", "m3", "mean volume of a particle", |h| body(h, |b| b.mean_volume)),
    ("mean_projected_area", "m2", "mean area of a particle towards the light", |h| {
        body(h, |b| b.mean_area)
    }),
    ("medium_density", "kg m-3", "density of the particles' medium, NaN where not known", |h| {
        body(h, |b| b.density.unwrap_or(f64::NAN))
    }),
    ("bandwidth_nm", "nm", "full width at half maximum of the band about each wavelength", |h| {
        h.averaging.bandwidth * 1e9
    }),
    (
        "filter_standard_deviation",
        "degree",
        "Gaussian filter that stands for diffraction, 0 where none does",
        |h| h.averaging.filter.to_degrees(),
    ),
    ("tolerance_asked", "1", "relative error that was asked for", |h| h.tolerance),
    ("number_density", "m-3", "particles per volume of air, NaN where not known", |h| {
        body(h, |b| b.number_density.unwrap_or(f64::NAN))
    }),
    (
        "rain_rate",
        "mm h-1",
        "volume of water that falls per area and time, NaN where not known",
        |h| body(h, |b| b.rain_rate.map_or(f64::NAN, |rate| rate * MM_H)),
    ),
];

/// mm/h in one m/s.
const MM_H: f64 = 3.6e6;

fn body(header: &TableHeader, value: impl Fn(&Bodies) -> f64) -> f64 {
    header.bodies.as_ref().map_or(f64::NAN, value)
}

/// Root attributes of what is the same for all tables of a sweep.
pub fn write_attributes(file: &NewFile, header: &TableHeader) -> Result<(), TableError> {
    file.attribute("averaged_over_sun_disc", header.averaging.sun_disc.name())?;
    file.attribute_integer("averaged_over_sizes", i32::from(header.averaging.sizes))?;
    match &header.bodies {
        Some(bodies) if !bodies.density_source.is_empty() => {
            file.attribute("density_source", &bodies.density_source)
        }
        _ => Ok(()),
    }
}

/// The scalars of a table; those of a sweep that are not `swept`, radius and sun.
pub fn write_scalars(
    file: &NewFile,
    header: &TableHeader,
    swept: impl Fn(&str) -> bool,
) -> Result<(), TableError> {
    let elevation = degree(header.sun_elevation);
    let scalars = [
        (
            "radius_um",
            tidy(header.radius * 1e6),
            "um",
            None,
            "radius of the sphere of equal volume",
        ),
        (
            "sun_elevation",
            elevation,
            "degree",
            Some("solar_elevation_angle"),
            "sun above the horizon",
        ),
        (
            "solar_zenith_angle",
            90.0 - elevation,
            "degree",
            Some("solar_zenith_angle"),
            "sun from the zenith",
        ),
    ];
    for (name, value, units, standard_name, words) in scalars {
        if swept(name) || (name == "solar_zenith_angle" && swept("sun_elevation")) {
            continue;
        }
        let data = file.dataset(name, Kind::F64, &[], None)?;
        data.write(&[value])?;
        data.attribute("units", units)?;
        data.attribute("long_name", words)?;
        if let Some(standard_name) = standard_name {
            data.attribute("standard_name", standard_name)?;
        }
    }
    Ok(())
}

/// The numbers of one table (no dimensions), or of all tables of a sweep: NaN where one is absent.
pub fn write_numbers(
    file: &NewFile,
    headers: &[Option<TableHeader>],
    dimensions: &[&NewDataset],
    shape: &[u64],
) -> Result<(), TableError> {
    for (name, units, words, value) in NUMBERS {
        let number = |header: &Option<TableHeader>| header.as_ref().map_or(f64::NAN, value);
        let values: Vec<f64> = headers.iter().map(number).map(tidy).collect();
        let data = file.dataset(name, Kind::F64, shape, None)?;
        data.write(&values)?;
        data.attribute("units", units)?;
        data.attribute("long_name", words)?;
        data.attach(dimensions)?;
    }
    Ok(())
}

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
