//! The large variables of a file: the values and the caustic mask, written chunk by chunk.
//!
//! Chunks of a slab are rounded, shuffled and deflated on all cores and then handed to the library
//! in a fixed order, so that the file does not depend on which core was faster.

use crate::hdf5::codec::chunk::{ChunkEncoder, encode_and_write, encoders};
use crate::hdf5::file::created::{Chunking, NewDataset, NewFile};
use crate::hdf5::format::faces::{chunk_corners, chunk_shape};
use crate::hdf5::output::WriteOptions;
use crate::hdf5::{TableError, invalid};
use crate::phase_table::variables::Kind;
use crate::phase_table::variables::dimensions::Dimensions;
use crate::phase_table::variables::schema::values_name;
use crate::phase_table::variables::values::{CAUSTIC_ORDER, describe_caustic, describe_values};
use crate::phase_table::{Quantity, Slab, TableHeader};
use ndarray::{Array2, ArrayView2};

/// The values of a table or a sweep, being written.
pub struct Body {
    values: NewDataset,
    caustic: Option<NewDataset>,
    layout: Layout,
    encoders: Vec<ChunkEncoder>,
}

/// Sizes of a slab and its chunks.
#[derive(Clone, Debug)]
struct Layout {
    leading: Vec<u64>,
    wavelengths: usize,
    elements: usize,
    theta: usize,
    phi: usize,
    rows: usize,
    columns: usize,
    deflate: u8,
}

impl Body {
    /// Create `phase_function` or `mueller` with the leading dimensions of a sweep (none for a
    /// table).
    pub fn create(
        file: &NewFile,
        header: &TableHeader,
        dimensions: &Dimensions<NewDataset>,
        leading: &[(&NewDataset, u64)],
        options: &WriteOptions,
    ) -> Result<Body, TableError> {
        let axes = &header.axes;
        let (rows, columns) = chunk_shape(axes.theta.len(), axes.phi.len());
        let layout = Layout {
            leading: leading.iter().map(|(_, length)| *length).collect(),
            wavelengths: axes.wavelength.len(),
            elements: header.quantity.elements(),
            theta: axes.theta.len(),
            phi: axes.phi.len(),
            rows,
            columns,
            deflate: options.deflate.min(9),
        };
        let with_element = header.quantity == Quantity::Mueller;
        let (shape, chunking) = layout.shape(with_element);
        let values =
            file.dataset(values_name(header.quantity), Kind::F32, &shape, Some(&chunking))?;
        let leading: Vec<&NewDataset> = leading.iter().map(|(scale, _)| *scale).collect();
        describe_values(&values, dimensions, &leading, header.quantity, options.bit_round)?;
        let encoders = encoders(layout.deflate, options.bit_round);
        Ok(Body { values, caustic: None, layout, encoders })
    }

    /// Write one slab; its shape has been checked.
    pub fn write(
        &mut self,
        file: &NewFile,
        dimensions: &Dimensions<NewDataset>,
        scales: &[&NewDataset],
        position: &[u64],
        slab: &Slab,
    ) -> Result<(), TableError> {
        let Body { values, caustic, layout, encoders } = self;
        layout.write_values(encoders, values, position, slab)?;
        let Some(mask) = &slab.caustic_order else { return Ok(()) };
        let caustic = match caustic {
            Some(caustic) => caustic,
            None => caustic.insert(create_caustic(file, layout, dimensions, scales)?),
        };
        layout.write_mask(encoders, caustic, position, mask)
    }
}

fn create_caustic(
    file: &NewFile,
    layout: &Layout,
    dimensions: &Dimensions<NewDataset>,
    leading: &[&NewDataset],
) -> Result<NewDataset, TableError> {
    let (shape, chunking) = layout.shape(false);
    let data = file.dataset(CAUSTIC_ORDER, Kind::U8, &shape, Some(&chunking))?;
    describe_caustic(&data, dimensions, leading)?;
    Ok(data)
}

impl Layout {
    fn shape(&self, with_element: bool) -> (Vec<u64>, Chunking) {
        let mut shape = self.leading.clone();
        shape.push(self.wavelengths as u64);
        if with_element {
            shape.push(self.elements as u64);
        }
        let mut chunk = vec![1; shape.len()];
        shape.extend([self.theta as u64, self.phi as u64]);
        chunk.extend([self.rows as u64, self.columns as u64]);
        (shape, Chunking { shape: chunk, deflate: self.deflate })
    }

    /// First row and column of every chunk of a slab's face.
    fn corners(&self) -> Vec<(usize, usize)> {
        chunk_corners((self.theta, self.phi), (self.rows, self.columns))
    }

    fn write_values(
        &self,
        encoders: &mut [ChunkEncoder],
        data: &NewDataset,
        position: &[u64],
        slab: &Slab,
    ) -> Result<(), TableError> {
        let corners = self.corners();
        let jobs: Vec<(usize, usize, usize)> = (0..self.elements)
            .flat_map(|element| corners.iter().map(move |&(row, column)| (element, row, column)))
            .collect();
        let encode = |encoder: &mut ChunkEncoder, &(element, row, column): &_| {
            encoder.values.clear();
            encoder.values.resize(self.rows * self.columns, 0.0);
            let face = slab.values.index_axis(ndarray::Axis(0), element);
            self.copy_chunk(&face, (row, column), &mut encoder.values);
            encoder.encode();
        };
        encode_and_write(encoders, &jobs, encode, |&(element, row, column), bytes| {
            let mut offset = position.to_vec();
            if self.elements > 1 {
                offset.push(element as u64);
            }
            offset.extend([row as u64, column as u64]);
            data.write_chunk(&offset, bytes)
        })
    }

    fn write_mask(
        &self,
        encoders: &mut [ChunkEncoder],
        data: &NewDataset,
        position: &[u64],
        mask: &Array2<u8>,
    ) -> Result<(), TableError> {
        let encode = |encoder: &mut ChunkEncoder, &corner: &(usize, usize)| {
            encoder.bytes.clear();
            encoder.bytes.resize(self.rows * self.columns, 0);
            self.copy_chunk(&mask.view(), corner, &mut encoder.bytes);
            // A chunk of zeros is the fill value: it need not be there.
            if encoder.bytes.iter().any(|&byte| byte > 0) {
                encoder.encode_bytes();
            } else {
                encoder.encoded.clear();
            }
        };
        encode_and_write(encoders, &self.corners(), encode, |&(row, column), bytes| {
            let mut offset = position.to_vec();
            offset.extend([row as u64, column as u64]);
            data.write_chunk(&offset, bytes)
        })
    }

    /// Copy the part of a face that a chunk covers; what reaches over the edge stays.
    fn copy_chunk<T: Copy>(
        &self,
        face: &ArrayView2<T>,
        (row, column): (usize, usize),
        chunk: &mut [T],
    ) {
        let width = self.columns.min(self.phi - column);
        for (i, line) in chunk.chunks_mut(self.columns).enumerate().take(self.theta - row) {
            let source = face.row(row + i);
            match source.as_slice() {
                Some(source) => line[..width].copy_from_slice(&source[column..column + width]),
                None => line.iter_mut().zip(source.iter().skip(column)).for_each(|(a, b)| *a = *b),
            }
        }
    }
}

/// Refuse a slab that does not fit the header.
pub fn check_slab(header: &TableHeader, index: usize, slab: &Slab) -> Result<(), TableError> {
    let axes = &header.axes;
    let Some(&wavelength) = axes.wavelength.get(index) else {
        let accepted = format!("the table has {} wavelengths", axes.wavelength.len());
        return Err(invalid("slab", index, &accepted));
    };
    if (slab.wavelength - wavelength).abs() > 1e-9 * wavelength {
        let accepted = format!("slab {index} is for {wavelength} m");
        return Err(invalid("wavelength", slab.wavelength, &accepted));
    }
    let face = (axes.theta.len(), axes.phi.len());
    let expected = (header.quantity.elements(), face.0, face.1);
    if slab.values.dim() != expected {
        let shape = format!("{:?}", slab.values.dim());
        return Err(invalid("slab shape", shape, &format!("{expected:?} (elements, theta, phi)")));
    }
    match &slab.caustic_order {
        Some(mask) if mask.dim() != face => {
            let shape = format!("{:?}", mask.dim());
            Err(invalid("caustic_order shape", shape, &format!("{face:?} (theta, phi)")))
        }
        _ => Ok(()),
    }
}
