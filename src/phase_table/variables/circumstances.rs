//! What a table has once: radius and sun, the particles as bodies, what was averaged over, the error
//! asked for. Scalars in a table; in a sweep, along its axes, for each table has its own.

use super::{Kind, Store, Variable};
use crate::math::digits::{degree, tidy};
use crate::phase_table::{Bodies, TableHeader};

type Getter = fn(&TableHeader) -> f64;

/// Numbers of a header beside radius and sun: name, units, words, value (NaN: not known).
pub const NUMBERS: [(&str, &str, &str, Getter); 10] = [
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
pub const MM_H: f64 = 3.6e6;

fn body(header: &TableHeader, value: impl Fn(&Bodies) -> f64) -> f64 {
    header.bodies.as_ref().map_or(f64::NAN, value)
}

/// Root attributes of what is the same for all tables of a sweep.
pub fn write_attributes<S: Store>(file: &S, header: &TableHeader) -> Result<(), S::Error> {
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
pub fn write_scalars<S: Store>(
    file: &S,
    header: &TableHeader,
    swept: impl Fn(&str) -> bool,
) -> Result<(), S::Error> {
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
        let data = file.variable(name, Kind::F64, &[])?;
        data.write_numbers(&[value])?;
        data.attribute("units", units)?;
        data.attribute("long_name", words)?;
        if let Some(standard_name) = standard_name {
            data.attribute("standard_name", standard_name)?;
        }
    }
    Ok(())
}

/// The numbers of one table (no dimensions), or of all tables of a sweep: NaN where one is absent.
pub fn write_numbers<S: Store>(
    file: &S,
    headers: &[Option<TableHeader>],
    dimensions: &[&S::Variable],
    shape: &[u64],
) -> Result<(), S::Error> {
    for (name, units, words, value) in NUMBERS {
        let number = |header: &Option<TableHeader>| header.as_ref().map_or(f64::NAN, value);
        let values: Vec<f64> = headers.iter().map(number).map(tidy).collect();
        let data = file.variable(name, Kind::F64, shape)?;
        data.write_numbers(&values)?;
        data.attribute("units", units)?;
        data.attribute("long_name", words)?;
        data.attach(dimensions)?;
    }
    Ok(())
}
