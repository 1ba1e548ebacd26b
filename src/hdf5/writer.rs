//! Writing one table, wavelength by wavelength: memory does not grow with their number.

use super::body::Body;
use super::raw::{Kind, NewFile};
use super::record::{Record, write_records};
use super::schema::{Dimensions, FORMAT, degree, tidy, write_root};
use super::{TableError, available_bytes, estimate_bytes};
use crate::pending_file::PendingFile;
use crate::phase_table::{PhaseTable, Slab, TableHeader};
use std::fs::{self, File};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// How a table is stored.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WriteOptions {
    /// Bits of the mantissa to keep (1 … 23); the rest is rounded away and compresses. `None`
    /// keeps every value as computed.
    pub bit_round: Option<u8>,
    /// Replace a file of that name.
    pub overwrite: bool,
    /// Deflate level, 0 (store) … 9.
    pub deflate: u8,
    /// Record the time of creation. Files named by their content must not;
    /// `SOURCE_DATE_EPOCH` is recorded in any case.
    pub dated: bool,
    /// More root attributes.
    pub attributes: Vec<(String, String)>,
}

impl Default for WriteOptions {
    fn default() -> WriteOptions {
        WriteOptions {
            bit_round: None,
            overwrite: false,
            deflate: 1,
            dated: true,
            attributes: Vec::new(),
        }
    }
}

/// A table being written. Dropped before [`TableWriter::finish`] it leaves nothing behind.
pub struct TableWriter {
    // Closed before the pending file is removed: fields drop in this order.
    body: Body,
    dimensions: Dimensions,
    file: NewFile,
    output: Output,
    header: TableHeader,
    records: Vec<Option<Record>>,
}

impl std::fmt::Debug for TableWriter {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("TableWriter").field("output", &self.output).finish_non_exhaustive()
    }
}

impl TableWriter {
    /// Start the file of a table beside `path`.
    ///
    /// # Errors
    /// When `path` exists (and is not to be overwritten) or cannot be written, when the disk is
    /// too full for the table, when the header or the options are wrong.
    pub fn create(
        path: &Path,
        header: &TableHeader,
        options: WriteOptions,
    ) -> Result<TableWriter, TableError> {
        header.validate()?;
        let output = Output::start(path, estimate_bytes(header), &options)?;
        let file = NewFile::create(output.pending.path(), path)?;
        write_root(&file, header, FORMAT, &options)?;
        let dimensions = Dimensions::create(&file, &header.axes, header.quantity)?;
        dimensions.write_solid_angle(&file, &header.axes)?;
        write_circumstances(&file, header, |_| false)?;
        let body = Body::create(&file, header, &dimensions, &[], &options)?;
        let records = vec![None; header.axes.wavelength.len()];
        Ok(TableWriter { body, dimensions, file, output, header: header.clone(), records })
    }

    /// Write the slab of the wavelength number `index`, in any order, once each.
    ///
    /// # Errors
    /// When the slab does not belong there or has another shape; when the disk is full.
    pub fn write_slab(&mut self, index: usize, slab: &Slab) -> Result<(), TableError> {
        check_slab(&self.header, index, slab)?;
        if self.records[index].is_some() {
            return Err(invalid("slab", index, "each wavelength is written once"));
        }
        self.body.write(&self.file, &self.dimensions, &[], &[index as u64], slab)?;
        self.records[index] = Some(Record::from(slab));
        Ok(())
    }

    /// Complete the file and give it its name.
    ///
    /// # Errors
    /// When a slab is missing, the disk is full, or a file of that name has appeared meanwhile.
    pub fn finish(self) -> Result<(), TableError> {
        let TableWriter { body, dimensions, file, output, records, .. } = self;
        if let Some(missing) = records.iter().position(Option::is_none) {
            return Err(invalid(
                "slab",
                missing,
                "every wavelength must be written before the end",
            ));
        }
        write_records(&file, &records, &[&dimensions.wavelength], &[records.len() as u64])?;
        file.attribute_integer("complete", 1)?;
        drop((body, dimensions));
        file.close()?;
        output.publish()
    }
}

/// Write a whole table.
///
/// # Errors
/// As [`TableWriter`]; a table with a different number of slabs than wavelengths is refused.
pub fn write(path: &Path, table: &PhaseTable, options: WriteOptions) -> Result<(), TableError> {
    let mut writer = TableWriter::create(path, &table.header, options)?;
    for (index, slab) in table.slabs.iter().enumerate() {
        writer.write_slab(index, slab)?;
    }
    writer.finish()
}

/// The scalars of a table, radius and sun, without those that are `swept`.
pub(super) fn write_circumstances(
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

/// Refuse a slab that does not fit the header.
pub(super) fn check_slab(
    header: &TableHeader,
    index: usize,
    slab: &Slab,
) -> Result<(), TableError> {
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

pub(super) fn invalid(field: &str, value: impl ToString, accepted: &str) -> TableError {
    TableError::Invalid { field: field.into(), value: value.to_string(), accepted: accepted.into() }
}

/// A file on its way to its final name.
#[derive(Debug)]
pub(super) struct Output {
    pub pending: PendingFile,
    target: PathBuf,
    overwrite: bool,
}

impl Output {
    /// Check the name, the room on the disk and the options; reserve a name beside.
    pub fn start(target: &Path, bytes: u64, options: &WriteOptions) -> Result<Output, TableError> {
        if let Some(bits) = options.bit_round.filter(|bits| !(1..=23).contains(bits)) {
            return Err(invalid("bit_round", bits, "1 to 23 bits of the mantissa"));
        }
        if options.deflate > 9 {
            return Err(invalid("deflate", options.deflate, "0 (store) to 9 (smallest)"));
        }
        if !options.overwrite && target.exists() {
            return Err(TableError::Exists { path: target.to_path_buf() });
        }
        if let Some(available) = available_bytes(target.parent().unwrap_or(Path::new(".")))
            && bytes > available
        {
            return Err(TableError::NoSpace { path: target.into(), needed: bytes, available });
        }
        let pending = PendingFile::create(target).map_err(|source| io(target, source))?;
        Ok(Output { pending, target: target.to_path_buf(), overwrite: options.overwrite })
    }

    /// Flush to the disk and give the file its name. Without `overwrite` a file that appeared
    /// meanwhile wins: a hard link fails where a rename would replace.
    pub fn publish(self) -> Result<(), TableError> {
        let Output { pending, target, overwrite } = self;
        if !overwrite {
            let sync = File::open(pending.path()).and_then(|file| file.sync_all());
            sync.map_err(|source| io(&target, source))?;
            match fs::hard_link(pending.path(), &target) {
                Ok(()) => return Ok(()),
                Err(error) if error.kind() == ErrorKind::AlreadyExists => {
                    return Err(TableError::Exists { path: target });
                }
                // The disk knows no links; a look must do.
                Err(_) if target.exists() => return Err(TableError::Exists { path: target }),
                Err(_) => {}
            }
        }
        pending.commit().map_err(|source| io(&target, source))
    }
}

pub(super) fn io(path: &Path, source: std::io::Error) -> TableError {
    TableError::Io { path: path.to_path_buf(), source }
}
