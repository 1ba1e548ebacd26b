//! Chunks of a face of θ and φ, and the solid angles, which are one.

use crate::hdf5::TableError;
use crate::hdf5::codec::chunk::{ChunkEncoder, encode_and_write, encoders};
use crate::hdf5::file::created::{Chunking, NewDataset, NewFile};
use crate::phase_table::Axes;
use crate::phase_table::variables::Kind;
use crate::phase_table::variables::dimensions::Dimensions;
use crate::phase_table::variables::values::{SOLID_ANGLE, describe_solid_angle};

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

/// `solid_angle`, chunk by chunk so that it never is in memory as a whole.
pub fn write_solid_angle(
    file: &NewFile,
    dimensions: &Dimensions<NewDataset>,
    axes: &Axes,
) -> Result<(), TableError> {
    let (theta, phi) = axes.solid_angle_factors();
    let (rows, columns) = chunk_shape(theta.len(), phi.len());
    let shape = [theta.len() as u64, phi.len() as u64];
    let chunking = Chunking { shape: vec![rows as u64, columns as u64], deflate: 1 };
    let data = file.dataset(SOLID_ANGLE, Kind::F32, &shape, Some(&chunking))?;
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
    describe_solid_angle(&data, dimensions)
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
