//! The dimensions that every file has: coordinate variables, solid angles, chunks of a face of θ and φ.

use super::schema::ELEMENTS;
use crate::hdf5::TableError;
use crate::hdf5::codec::chunk::{ChunkEncoder, encode_and_write, encoders};
use crate::hdf5::file::created::{Chunking, Kind, NewDataset, NewFile};
use crate::math::digits::{degree, nm};
use crate::phase_table::{Axes, Quantity};

/// Largest chunk, bytes of values: what the library's default cache holds.
const CHUNK_BYTES: usize = 1 << 20;

/// θ rows and φ columns of a chunk: as few equal parts as keep it within [`CHUNK_BYTES`].
pub fn chunk_shape(theta: usize, phi: usize) -> (usize, usize) {
    let parts = |count: usize, most: usize| count.div_ceil(count.div_ceil(most.max(1)).max(1));
    let columns = parts(phi, CHUNK_BYTES / 4);
    let rows = parts(theta, CHUNK_BYTES / 4 / columns.max(1));
    (rows.max(1), columns.max(1))
}

/// First row and column of every chunk of a face of θ and φ.
pub fn chunk_corners(
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
pub struct Dimensions {
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
pub fn scale(
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chunks_stay_within_the_cache() {
        for (theta, phi) in [(1, 1), (1801, 1), (1801, 361), (1800, 14_400), (3, 1_000_000)] {
            let (rows, columns) = chunk_shape(theta, phi);
            assert!(rows * columns * 4 <= CHUNK_BYTES && rows <= theta && columns <= phi);
        }
        assert_eq!(chunk_shape(1800, 14_400), (18, 14_400));
    }
}
