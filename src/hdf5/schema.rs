//! Names, units and words of the schema, and the coordinate variables that every file has.

use super::TableError;
use super::chunk::{ChunkEncoder, encode_and_write, encoders};
use super::circumstances::write_attributes;
use super::output::WriteOptions;
use super::raw_write::{Chunking, Kind, NewDataset, NewFile};
use crate::math::digits::{degree, nm};
use crate::phase_table::{Axes, ForwardPeak, Quantity, TableHeader};
use std::time::{SystemTime, UNIX_EPOCH};

/// Root attribute `format` of a table.
pub const FORMAT: &str = "gonio phase table";
/// Root attribute `format` of a merged sweep.
pub const SWEEP_FORMAT: &str = "gonio phase table sweep";
/// Root attribute `format_version`.
pub const FORMAT_VERSION: i32 = 1;

/// The conventions in words, in every file.
const CONVENTIONS_IN_WORDS: &str = "Time factor exp(-i omega t); refractive index n + ik, k >= 0 \
absorbs. theta: scattering angle, 0 is forward. phi: azimuth about the direction of the incident \
light, right-handed, 0 is the upper half of the vertical plane that holds the particle's axis. \
phase_function P = (1/C_sca) dC_sca/dOmega for unpolarised light in sr-1: its integral over the \
sphere is 1. Mueller elements have the same scaling, S11 = P; Stokes Q = I_parallel - \
I_perpendicular with respect to the scattering plane, so that the degree of linear polarisation is \
-S12/S11. Radii are those of the sphere of equal volume. Wavelengths are in vacuum.";

const LICENSE: &str = "CC0-1.0 (no rights reserved)";

/// Names of the Mueller elements, row by row.
pub(super) const ELEMENTS: [&str; 16] = [
    "11", "12", "13", "14", "21", "22", "23", "24", "31", "32", "33", "34", "41", "42", "43", "44",
];

/// Largest chunk, bytes of values: what the library's default cache holds.
const CHUNK_BYTES: usize = 1 << 20;

/// Name of the variable that holds the values.
pub(super) fn values_name(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::PhaseFunction => "phase_function",
        Quantity::Mueller => "mueller",
    }
}

pub(super) fn forward_peak_name(forward_peak: ForwardPeak) -> &'static str {
    match forward_peak {
        ForwardPeak::CellAverage => "cell_average",
        ForwardPeak::Point => "point",
        ForwardPeak::Separate => "separate",
    }
}

/// θ rows and φ columns of a chunk: as few equal parts as keep it within [`CHUNK_BYTES`].
pub(super) fn chunk_shape(theta: usize, phi: usize) -> (usize, usize) {
    let parts = |count: usize, most: usize| count.div_ceil(count.div_ceil(most.max(1)).max(1));
    let columns = parts(phi, CHUNK_BYTES / 4);
    let rows = parts(theta, CHUNK_BYTES / 4 / columns.max(1));
    (rows.max(1), columns.max(1))
}

/// First row and column of every chunk of a face of θ and φ.
pub(super) fn chunk_corners(
    (theta, phi): (usize, usize),
    (rows, columns): (usize, usize),
) -> Vec<(usize, usize)> {
    (0..theta)
        .step_by(rows)
        .flat_map(|row| (0..phi).step_by(columns).map(move |column| (row, column)))
        .collect()
}

/// The dimensions of a file and their coordinate variables.
#[derive(Debug)]
pub(super) struct Dimensions {
    pub wavelength: NewDataset,
    pub element: Option<NewDataset>,
    pub theta: NewDataset,
    pub phi: NewDataset,
}

impl Dimensions {
    pub fn create(
        file: &NewFile,
        axes: &Axes,
        quantity: Quantity,
    ) -> Result<Dimensions, TableError> {
        let nanometres: Vec<f64> = axes.wavelength.iter().map(|metres| nm(*metres)).collect();
        let degrees = |angles: &[f64]| angles.iter().map(|a| degree(*a)).collect::<Vec<_>>();
        let theta_degrees = degrees(&axes.theta);

        let wavelength = scale(file, "wavelength_nm", &nanometres, "nm")?;
        wavelength.attribute("standard_name", "radiation_wavelength")?;
        wavelength.attribute("long_name", "wavelength in vacuum")?;
        let theta = scale(file, "theta", &theta_degrees, "degree")?;
        theta.attribute("standard_name", "scattering_angle")?;
        theta.attribute("long_name", "scattering angle, 0 is forward")?;
        let phi = scale(file, "phi", &degrees(&axes.phi), "degree")?;
        phi.attribute("long_name", "azimuth about the incident light, 0 is the upper side")?;
        let element = match quantity {
            Quantity::PhaseFunction => None,
            Quantity::Mueller => {
                let element = file.dataset("mueller_element", Kind::Texts, &[16], None)?;
                element.write_texts(&ELEMENTS.map(String::from))?;
                element.attribute("long_name", "element of the Mueller matrix, row and column")?;
                element.make_scale("mueller_element")?;
                Some(element)
            }
        };

        let antisolar: Vec<f64> = theta_degrees.iter().map(|theta| 180.0 - theta).collect();
        let antisolar_data =
            file.dataset("angle_from_antisolar_point", Kind::F64, &[antisolar.len() as u64], None)?;
        antisolar_data.write(&antisolar)?;
        antisolar_data.attribute("units", "degree")?;
        antisolar_data.attribute("long_name", "angle from the antisolar point")?;
        antisolar_data.attach(&[&theta])?;
        Ok(Dimensions { wavelength, element, theta, phi })
    }

    /// `solid_angle`, chunk by chunk so that it never is in memory as a whole.
    pub fn write_solid_angle(&self, file: &NewFile, axes: &Axes) -> Result<(), TableError> {
        let (theta, phi) = axes.solid_angle_factors();
        let (rows, columns) = chunk_shape(theta.len(), phi.len());
        let shape = [theta.len() as u64, phi.len() as u64];
        let chunking = Chunking { shape: vec![rows as u64, columns as u64], deflate: 1 };
        let data = file.dataset("solid_angle", Kind::F32, &shape, Some(&chunking))?;
        let corners = chunk_corners((theta.len(), phi.len()), (rows, columns));
        let encode = |encoder: &mut ChunkEncoder, &(row, column): &(usize, usize)| {
            encoder.values.clear();
            encoder.values.resize(rows * columns, 0.0);
            let lines = encoder.values.chunks_mut(columns).zip(&theta[row..]);
            for (line, weight) in lines {
                for (value, width) in line.iter_mut().zip(&phi[column..]) {
                    *value = (weight * width) as f32;
                }
            }
            encoder.encode();
        };
        encode_and_write(&mut encoders(1, None), &corners, encode, |&(row, column), bytes| {
            data.write_chunk(&[row as u64, column as u64], bytes)
        })?;
        data.attribute("units", "sr")?;
        data.attribute("long_name", "solid angle that a sample stands for")?;
        data.attach(&[&self.theta, &self.phi])
    }
}

/// A coordinate variable of numbers.
pub(super) fn scale(
    file: &NewFile,
    name: &str,
    values: &[f64],
    units: &str,
) -> Result<NewDataset, TableError> {
    let data = file.dataset(name, Kind::F64, &[values.len() as u64], None)?;
    data.write(values)?;
    data.attribute("units", units)?;
    data.make_scale(name)?;
    Ok(data)
}

/// Root attributes of tables and sweeps.
pub(super) fn write_root(
    file: &NewFile,
    header: &TableHeader,
    format: &str,
    options: &WriteOptions,
) -> Result<(), TableError> {
    let title = match header.quantity {
        Quantity::PhaseFunction => "Phase function of a single particle",
        Quantity::Mueller => "Scattering (Mueller) matrix of a single particle",
    };
    file.attribute("Conventions", "CF-1.11")?;
    file.attribute("title", title)?;
    file.attribute("format", format)?;
    file.attribute_integer("format_version", FORMAT_VERSION)?;
    file.attribute("program", env!("CARGO_PKG_NAME"))?;
    file.attribute("program_version", env!("CARGO_PKG_VERSION"))?;
    file.attribute("git_hash", env!("GONIO_GIT_HASH"))?;
    if let Some(date) = creation_date(options.dated) {
        file.attribute("date_created", &date)?;
    }
    file.attribute("scene", &header.scene_toml)?;
    file.attribute("command_line", &header.command_line)?;
    file.attribute("conventions", CONVENTIONS_IN_WORDS)?;
    file.attribute("license", LICENSE)?;
    file.attribute("quantity", values_name(header.quantity))?;
    file.attribute("method", &header.method)?;
    file.attribute("shape", &header.shape)?;
    file.attribute("forward_peak", forward_peak_name(header.forward_peak))?;
    file.attribute_integer("rotational_symmetry", i32::from(header.rotational_symmetry))?;
    if let Some(bits) = options.bit_round {
        file.attribute_integer("bit_round", i32::from(bits))?;
    }
    write_attributes(file, header)?;
    options.attributes.iter().try_for_each(|(name, text)| file.attribute(name, text))
}

/// ISO 8601 in UTC: `SOURCE_DATE_EPOCH` where set, else now where `dated`.
fn creation_date(dated: bool) -> Option<String> {
    let given = std::env::var("SOURCE_DATE_EPOCH").ok().and_then(|text| text.trim().parse().ok());
    let now = || SystemTime::now().duration_since(UNIX_EPOCH).ok().map(|time| time.as_secs());
    given.or_else(|| if dated { now() } else { None }).map(iso_date)
}

/// Seconds since 1970 as `2026-01-31T12:00:00Z` (Hinnant's civil-from-days algorithm).
fn iso_date(seconds: u64) -> String {
    let (days, rest) = (seconds / 86_400, seconds % 86_400);
    let days = days + 719_468;
    let (era, day_of_era) = (days / 146_097, days % 146_097);
    let year_of_era =
        (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let month_index = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * month_index + 2) / 5 + 1;
    let month = if month_index < 10 { month_index + 3 } else { month_index - 9 };
    let year = 400 * era + year_of_era + u64::from(month <= 2);
    let (hour, minute, second) = (rest / 3600, rest / 60 % 60, rest % 60);
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_civil() {
        assert_eq!(iso_date(0), "1970-01-01T00:00:00Z");
        assert_eq!(iso_date(951_782_400), "2000-02-29T00:00:00Z");
        assert_eq!(iso_date(1_769_860_799), "2026-01-31T11:59:59Z");
    }

    #[test]
    fn chunks_stay_within_the_cache() {
        for (theta, phi) in [(1, 1), (1801, 1), (1801, 361), (1800, 14_400), (3, 1_000_000)] {
            let (rows, columns) = chunk_shape(theta, phi);
            assert!(rows * columns * 4 <= CHUNK_BYTES && rows <= theta && columns <= phi);
        }
        assert_eq!(chunk_shape(1800, 14_400), (18, 14_400));
    }
}
