//! A file being written, and its variables.
//!
//! Objects have no time stamps, so that equal input gives equal bytes; variables keep the order in
//! which they were written.

use super::failure::unwritable;
use crate::hdf5::{TableError, ffi};
use crate::phase_table::variables::{Kind, Store, Variable};
use hdf5::dataset::FillTime;
use hdf5::file::{FileCloseDegree, LibraryVersion, LinkCreationOrder};
use hdf5::types::VarLenUnicode;
use hdf5::{Dataset, File, H5Type, Location};
use std::path::{Path, PathBuf};

/// A file being written.
#[derive(Debug)]
pub struct NewFile {
    file: File,
    path: PathBuf,
}

/// A dataset being written.
#[derive(Debug)]
pub struct NewDataset {
    dataset: Dataset,
    path: PathBuf,
    shape: Vec<u64>,
}

/// Chunk shape and deflate level (0: neither shuffle nor deflate) of a chunked dataset.
#[derive(Clone, Debug)]
pub struct Chunking {
    pub shape: Vec<u64>,
    pub deflate: u8,
}

impl NewFile {
    /// Create (truncate) the file `temporary`; `path` is what messages name.
    pub fn create(temporary: &Path, path: &Path) -> Result<NewFile, TableError> {
        let mut options = File::with_options();
        options.with_fcpl(|plist| {
            plist.obj_track_times(false).link_creation_order(LinkCreationOrder::Indexed)
        });
        // Nobody else knows the temporary name: locks, which network disks may lack, are not needed.
        options.with_fapl(|plist| {
            let version = LibraryVersion::V110;
            let plist = plist.libver_bounds(version, version).file_locking(false);
            plist.fclose_degree(FileCloseDegree::Strong)
        });
        let file = options.create(temporary).map_err(|error| unwritable(path, &error))?;
        Ok(NewFile { file, path: path.to_path_buf() })
    }

    /// Create a dataset; chunked and compressed, or contiguous (a scalar when `shape` is empty).
    pub fn dataset(
        &self,
        name: &str,
        kind: Kind,
        shape: &[u64],
        chunking: Option<&Chunking>,
    ) -> Result<NewDataset, TableError> {
        let lengths = |shape: &[u64]| shape.iter().map(|&n| n as usize).collect::<Vec<usize>>();
        let file = &self.file;
        let mut builder = match kind {
            // What is not written is not there.
            Kind::F32 => file.new_dataset::<f32>().fill_value(f32::NAN),
            Kind::F64 => file.new_dataset::<f64>(),
            Kind::I32 => file.new_dataset::<i32>(),
            Kind::U8 => file.new_dataset::<u8>(),
            Kind::Texts => file.new_dataset::<VarLenUnicode>(),
        };
        if let Some(chunking) = chunking {
            builder = builder.chunk(lengths(&chunking.shape)).fill_time(FillTime::IfSet);
            if chunking.deflate > 0 {
                builder = builder.shuffle().deflate(chunking.deflate.min(9));
            }
        }
        let dataset = builder.shape(lengths(shape)).create(name);
        let dataset = dataset.map_err(|error| unwritable(&self.path, &error))?;
        Ok(NewDataset { dataset, path: self.path.clone(), shape: shape.to_vec() })
    }

    /// Flush and close; only after this is the file whole on disk.
    pub fn close(self) -> Result<(), TableError> {
        let NewFile { file, path } = self;
        file.flush().and_then(|()| file.close()).map_err(|error| unwritable(&path, &error))
    }
}

impl NewDataset {
    /// Write all values of a contiguous dataset.
    pub fn write<T: H5Type>(&self, values: &[T]) -> Result<(), TableError> {
        self.done(self.dataset.write_raw(values))
    }

    /// Length of a one-dimensional dataset.
    pub fn length(&self) -> u64 {
        self.shape.first().copied().unwrap_or(1)
    }

    /// Write one chunk as it is, already through the dataset's filters.
    pub fn write_chunk(&self, offset: &[u64], bytes: &[u8]) -> Result<(), TableError> {
        self.done(ffi::write_chunk(&self.dataset, offset, bytes))
    }

    fn done(&self, result: hdf5::Result<()>) -> Result<(), TableError> {
        result.map_err(|error| unwritable(&self.path, &error))
    }
}

impl Store for NewFile {
    type Variable = NewDataset;
    type Error = TableError;

    fn attribute(&self, name: &str, text: &str) -> Result<(), TableError> {
        text_attribute(&self.path, &self.file, name, text)
    }

    fn attribute_integer(&self, name: &str, value: i32) -> Result<(), TableError> {
        integer_attribute(&self.path, &self.file, name, value)
    }

    fn variable(&self, name: &str, kind: Kind, shape: &[u64]) -> Result<NewDataset, TableError> {
        self.dataset(name, kind, shape, None)
    }
}

impl Variable for NewDataset {
    type Error = TableError;

    fn write_numbers(&self, values: &[f64]) -> Result<(), TableError> {
        self.write(values)
    }

    fn write_integers(&self, values: &[i32]) -> Result<(), TableError> {
        self.write(values)
    }

    fn write_texts(&self, texts: &[String]) -> Result<(), TableError> {
        let stored = |text: &String| {
            let refused = |_| format!("a text with a zero byte cannot be stored: {text:?}").into();
            text.parse::<VarLenUnicode>().map_err(refused)
        };
        let texts = texts.iter().map(stored).collect::<hdf5::Result<Vec<_>>>();
        self.done(texts.and_then(|texts| self.dataset.write_raw(&texts)))
    }

    fn attribute(&self, name: &str, text: &str) -> Result<(), TableError> {
        text_attribute(&self.path, &self.dataset, name, text)
    }

    fn attribute_integer(&self, name: &str, value: i32) -> Result<(), TableError> {
        integer_attribute(&self.path, &self.dataset, name, value)
    }

    fn make_scale(&self, name: &str) -> Result<(), TableError> {
        self.done(ffi::make_scale(&self.dataset, name))
    }

    fn attach(&self, scales: &[&Self]) -> Result<(), TableError> {
        assert_eq!(scales.len(), self.shape.len(), "one scale per dimension");
        let mut numbered = (0..).zip(scales);
        let attach = |(index, scale): (u32, &&NewDataset)| {
            ffi::attach_scale(&self.dataset, &scale.dataset, index)
        };
        self.done(numbered.try_for_each(attach))
    }
}

fn integer_attribute(
    path: &Path,
    object: &Location,
    name: &str,
    value: i32,
) -> Result<(), TableError> {
    let builder = object.new_attr_builder().char_encoding(ffi::encoding(name)).empty::<i32>();
    let written = builder.create(name).and_then(|attribute| attribute.write_scalar(&value));
    written.map_err(|error| unwritable(path, &error))
}

fn text_attribute(
    path: &Path,
    object: &Location,
    name: &str,
    text: &str,
) -> Result<(), TableError> {
    ffi::write_text(object, name, text).map_err(|error| unwritable(path, &error))
}
