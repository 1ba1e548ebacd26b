//! A file open for reading, and its variables: every claim of the file is checked before it is
//! believed.

use super::attribute::{any_length, number, text, texts};
use super::failure::unreadable;
use crate::hdf5::ffi::{self, Class, class_of};
use crate::hdf5::guard::Heaps;
use crate::hdf5::{TableError, damaged, foreign};
use hdf5::{Dataset, H5Type, Hyperslab, SliceOrIndex};
use ndarray::IxDyn;
use std::fs::File;
use std::path::{Path, PathBuf};

/// Deflate shortens nothing by more than this factor (zlib's technical notes).
const MOST_DEFLATED: u64 = 1032;

/// A file open for reading.
#[derive(Debug)]
pub struct OpenFile {
    file: hdf5::File,
    pub path: PathBuf,
    /// Length in bytes.
    length: u64,
    heaps: Heaps,
}

/// A dataset of an open file; `shape` is what the file says.
#[derive(Debug)]
pub struct OpenDataset {
    dataset: Dataset,
    path: PathBuf,
    name: String,
    pub shape: Vec<u64>,
    most_bytes: u64,
    heaps: Heaps,
}

/// Types that values are read as.
pub trait Value: H5Type + Copy + Default {}
impl Value for f32 {}
impl Value for f64 {}
impl Value for u8 {}

impl OpenFile {
    /// Open `path`; a file that is no HDF5 is told from one that is missing or damaged.
    pub fn open(path: &Path) -> Result<OpenFile, TableError> {
        let io = |source| TableError::Io { path: path.to_path_buf(), source };
        // Looked at before it is opened: opening a pipe would wait for its other end.
        let data = std::fs::metadata(path).map_err(io)?;
        if !data.is_file() {
            let kind = if data.is_dir() { "a folder" } else { "no regular file" };
            return Err(foreign(path, &format!("it is {kind}")));
        }
        let file = File::open(path).map_err(io)?;
        check_signature(path, &file)?;
        if path.to_str().is_none() {
            return Err(foreign(path, "its name is not valid UTF-8"));
        }
        let heaps = Heaps::new(file);
        // A file under its final name is whole and stays as it is; locks, which network disks may
        // lack, are not needed.
        let mut options = hdf5::File::with_options();
        let file = options.with_fapl(|plist| plist.file_locking(false)).open(path);
        let file = file.map_err(|error| unreadable(path, &error))?;
        Ok(OpenFile { file, path: path.to_path_buf(), length: data.len(), heaps })
    }

    /// A text attribute of the file; `None` where there is none.
    pub fn text(&self, name: &str) -> Result<Option<String>, TableError> {
        text(&self.path, &self.heaps, &self.file, name)
    }

    /// A numeric attribute of the file; `None` where there is none.
    pub fn number(&self, name: &str) -> Result<Option<f64>, TableError> {
        number(&self.path, &self.file, name)
    }

    /// Open a dataset; `None` where there is none.
    pub fn dataset(&self, name: &str) -> Result<Option<OpenDataset>, TableError> {
        let failed = |error| unreadable(&self.path, &error);
        if !ffi::has_link(&self.file, name).map_err(failed)? {
            return Ok(None);
        }
        let dataset = self.file.dataset(name).map_err(failed)?;
        let shape = dataset.space().map_err(failed)?.shape();
        let shape = shape.into_iter().map(|length| length as u64).collect();
        let most_bytes = self.length.saturating_mul(MOST_DEFLATED).saturating_add(1 << 20);
        let (path, name, heaps) = (self.path.clone(), name.into(), self.heaps.clone());
        Ok(Some(OpenDataset { dataset, path, name, shape, most_bytes, heaps }))
    }

    /// Open a dataset that must be there.
    pub fn required(&self, name: &str) -> Result<OpenDataset, TableError> {
        let missing = || damaged(&self.path, &format!("variable {name} is missing"));
        self.dataset(name)?.ok_or_else(missing)
    }
}

impl OpenDataset {
    /// A text attribute of the dataset.
    pub fn text(&self, name: &str) -> Result<Option<String>, TableError> {
        text(&self.path, &self.heaps, &self.dataset, name)
    }

    /// Read all values.
    pub fn read<T: Value>(&self) -> Result<Vec<T>, TableError> {
        let start = vec![0; self.shape.len()];
        self.read_block(&start, &self.shape)
    }

    /// Read the block of `count` values per dimension that begins at `start`.
    pub fn read_block<T: Value>(&self, start: &[u64], count: &[u64]) -> Result<Vec<T>, TableError> {
        let fits = start.len() == self.shape.len()
            && count.len() == self.shape.len()
            && start
                .iter()
                .zip(count)
                .zip(&self.shape)
                .all(|((s, c), n)| s.checked_add(*c).is_some_and(|end| end <= *n));
        if !fits {
            return Err(damaged(&self.path, &format!("{} has shape {:?}", self.name, self.shape)));
        }
        let failed = |error| unreadable(&self.path, &error);
        if class_of(&self.dataset.dtype().map_err(failed)?) != Class::Number {
            return Err(damaged(&self.path, &format!("{} does not hold numbers", self.name)));
        }
        let mut values = self.room::<T>(count)?;
        if count.contains(&0) {
            return Ok(values);
        }
        if count == self.shape {
            values.resize(count.iter().product::<u64>() as usize, T::default());
            self.dataset.as_reader().read_into_raw(&mut values).map_err(failed)?;
            return Ok(values);
        }
        // The reader takes room of its own, as much as has just been had.
        drop(values);
        let part = |(&start, &count): (&u64, &u64)| SliceOrIndex::SliceCount {
            start: start as usize,
            step: 1,
            count: count as usize,
            block: 1,
        };
        let block: Vec<SliceOrIndex> = start.iter().zip(count).map(part).collect();
        let values = self.dataset.read_slice::<T, _, IxDyn>(Hyperslab::from(block));
        Ok(values.map_err(failed)?.into_raw_vec_and_offset().0)
    }

    /// Read strings of any length.
    pub fn read_texts(&self) -> Result<Vec<String>, TableError> {
        let path = &self.path;
        let failed = |error| unreadable(path, &error);
        let bad = || damaged(path, &format!("{} is not a list of strings", self.name));
        if any_length(&self.dataset).map_err(failed)?.is_none() {
            return Err(bad());
        }
        drop(self.room::<u64>(&self.shape)?);
        // Contiguous values have a place; others may lie anywhere.
        let place = self.dataset.offset().map(|offset| (offset, self.dataset.storage_size()));
        self.heaps.check(place).map_err(|message| damaged(path, &message))?;
        let texts = texts(&self.dataset).map_err(failed)?;
        Ok(texts.into_iter().map(Option::unwrap_or_default).collect())
    }

    /// Room for `count` values, refused where the file cannot hold as many.
    fn room<T>(&self, count: &[u64]) -> Result<Vec<T>, TableError> {
        let total = count.iter().try_fold(1u64, |product, &n| product.checked_mul(n));
        let bytes = total.and_then(|total| total.checked_mul(size_of::<T>() as u64));
        let too_large = || {
            let message = format!("{} claims {count:?} values, more than fit the file", self.name);
            damaged(&self.path, &message)
        };
        let total = match (total, bytes) {
            (Some(total), Some(bytes)) if bytes <= self.most_bytes => total as usize,
            _ => return Err(too_large()),
        };
        let mut values = Vec::new();
        values.try_reserve_exact(total).map_err(|_| too_large())?;
        Ok(values)
    }
}

/// The eight bytes that every HDF5 file begins with.
fn check_signature(path: &Path, mut file: &File) -> Result<(), TableError> {
    use std::io::Read;
    let mut signature = [0u8; 8];
    match file.read_exact(&mut signature) {
        Ok(()) if &signature == b"\x89HDF\r\n\x1a\n" => Ok(()),
        Ok(()) => Err(foreign(path, "it is not an HDF5 file")),
        Err(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
            Err(foreign(path, "it is too short for an HDF5 file"))
        }
        Err(source) => Err(TableError::Io { path: path.to_path_buf(), source }),
    }
}
