//! Reading through the HDF5 C library, with every claim of the file checked before it is believed.

use super::heap::Heaps;
use super::raw_id::{Id, done, failure, owned};
use super::{TableError, damaged, foreign, raw_attribute};
use hdf5::globals::{H5P_FILE_ACCESS, H5T_NATIVE_DOUBLE, H5T_NATIVE_FLOAT, H5T_NATIVE_UINT8};
use hdf5::sync::sync;
use hdf5_sys::h5::HADDR_UNDEF;
use hdf5_sys::h5i::hid_t;
use hdf5_sys::{h5d, h5f, h5p, h5s, h5t};
use std::ffi::{CString, c_char, c_int, c_void};
use std::fs::File;
use std::path::{Path, PathBuf};
use std::ptr;

/// Deflate shortens nothing by more than this factor (zlib's technical notes).
const MOST_DEFLATED: u64 = 1032;

/// A file open for reading.
#[derive(Debug)]
pub(super) struct OpenFile {
    id: Id,
    pub path: PathBuf,
    /// Length in bytes.
    length: u64,
    heaps: Heaps,
}

/// A dataset of an open file; `shape` is what the file says.
#[derive(Debug)]
pub(super) struct OpenDataset {
    id: Id,
    path: PathBuf,
    name: String,
    pub shape: Vec<u64>,
    most_bytes: u64,
    heaps: Heaps,
}

/// Types that values are read as.
pub(super) trait Value: Copy + Default {
    fn kind() -> hid_t;
}
impl Value for f32 {
    fn kind() -> hid_t {
        *H5T_NATIVE_FLOAT
    }
}
impl Value for f64 {
    fn kind() -> hid_t {
        *H5T_NATIVE_DOUBLE
    }
}
impl Value for u8 {
    fn kind() -> hid_t {
        *H5T_NATIVE_UINT8
    }
}

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
        let name = path.to_str().and_then(|text| CString::new(text).ok());
        let name = name.ok_or_else(|| foreign(path, "its name is not valid UTF-8"))?;
        let id = sync(|| unsafe {
            // SAFETY: a C string and a property list of our own. A file under its final name is
            // whole and stays as it is; locks, which network disks may lack, are not needed.
            let access = owned(path, h5p::H5Pcreate(*H5P_FILE_ACCESS), h5p::H5Pclose)?;
            done(path, h5p::H5Pset_file_locking(access.id, 0, 1))?;
            let id = h5f::H5Fopen(name.as_ptr(), h5f::H5F_ACC_RDONLY, access.id);
            owned(path, id, h5f::H5Fclose)
        })?;
        let heaps = Heaps::new(file);
        Ok(OpenFile { id, path: path.to_path_buf(), length: data.len(), heaps })
    }

    /// A text attribute of the file; `None` where there is none.
    pub fn text(&self, name: &str) -> Result<Option<String>, TableError> {
        raw_attribute::text(&self.path, &self.heaps, self.id.id, name)
    }

    /// A numeric attribute of the file; `None` where there is none.
    pub fn number(&self, name: &str) -> Result<Option<f64>, TableError> {
        raw_attribute::number(&self.path, self.id.id, name)
    }

    /// Open a dataset; `None` where there is none.
    pub fn dataset(&self, name: &str) -> Result<Option<OpenDataset>, TableError> {
        let path = &self.path;
        let c_name = CString::new(name).map_err(|_| damaged(path, "a name with a zero byte"))?;
        sync(|| unsafe {
            // SAFETY: C strings, checked identifiers, a buffer as long as the rank.
            let exists = hdf5_sys::h5l::H5Lexists(self.id.id, c_name.as_ptr(), h5p::H5P_DEFAULT);
            if exists < 0 {
                return Err(failure(path));
            }
            if exists == 0 {
                return Ok(None);
            }
            let id = h5d::H5Dopen2(self.id.id, c_name.as_ptr(), h5p::H5P_DEFAULT);
            let id = owned(path, id, h5d::H5Dclose)?;
            let shape = shape(path, &id)?;
            let most_bytes = self.length.saturating_mul(MOST_DEFLATED).saturating_add(1 << 20);
            let (path, name, heaps) = (path.clone(), name.into(), self.heaps.clone());
            Ok(Some(OpenDataset { id, path, name, shape, most_bytes, heaps }))
        })
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
        raw_attribute::text(&self.path, &self.heaps, self.id.id, name)
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
        let mut values = self.buffer::<T>(count)?;
        if values.is_empty() {
            return Ok(values);
        }
        sync(|| unsafe {
            // SAFETY: the selection holds exactly `values.len()` values, lies inside the dataset.
            let (file_space, memory_space) = if self.shape.is_empty() {
                (None, None)
            } else {
                let file = owned(&self.path, h5d::H5Dget_space(self.id.id), h5s::H5Sclose)?;
                let none = ptr::null();
                let select = h5s::H5S_seloper_t::H5S_SELECT_SET;
                let (start, size) = (start.as_ptr(), count.as_ptr());
                let status = h5s::H5Sselect_hyperslab(file.id, select, start, none, size, none);
                done(&self.path, status)?;
                let memory = h5s::H5Screate_simple(count.len() as c_int, size, none);
                (Some(file), Some(owned(&self.path, memory, h5s::H5Sclose)?))
            };
            let space = |id: &Option<Id>| id.as_ref().map_or(h5s::H5S_ALL, |id| id.id);
            let (memory, file) = (space(&memory_space), space(&file_space));
            let buffer = values.as_mut_ptr().cast::<c_void>();
            let status =
                h5d::H5Dread(self.id.id, T::kind(), memory, file, h5p::H5P_DEFAULT, buffer);
            done(&self.path, status)
        })?;
        Ok(values)
    }

    /// Read one-dimensional strings of any length.
    pub fn read_texts(&self) -> Result<Vec<String>, TableError> {
        let path = &self.path;
        let bad = || damaged(path, &format!("{} is not a list of strings", self.name));
        let count = self.shape.iter().try_fold(1u64, |product, &n| product.checked_mul(n));
        let count = count.filter(|&count| count <= self.most_bytes / 8).ok_or_else(bad)? as usize;
        sync(|| unsafe {
            // SAFETY: the type is that of strings of variable length, checked; the buffer has a
            // pointer for each; what the library allocated goes back to it after copying.
            let kind = owned(path, h5d::H5Dget_type(self.id.id), h5t::H5Tclose)?;
            if h5t::H5Tis_variable_str(kind.id) <= 0 {
                return Err(bad());
            }
            // Contiguous values have a place; others may lie anywhere.
            let place = h5d::H5Dget_offset(self.id.id);
            let bytes = h5d::H5Dget_storage_size(self.id.id);
            let place = (place != HADDR_UNDEF).then_some((place, bytes));
            self.heaps.check(place).map_err(|message| damaged(path, &message))?;
            let mut texts: Vec<*mut c_char> = vec![ptr::null_mut(); count];
            let (all, data) = (h5s::H5S_ALL, texts.as_mut_ptr().cast::<c_void>());
            let status = h5d::H5Dread(self.id.id, kind.id, all, all, h5p::H5P_DEFAULT, data);
            let copy = |text: *mut c_char| {
                if text.is_null() {
                    return String::new();
                }
                let copy = std::ffi::CStr::from_ptr(text).to_string_lossy().into_owned();
                hdf5_sys::h5::H5free_memory(text.cast::<c_void>());
                copy
            };
            let texts = texts.into_iter().map(copy).collect();
            done(path, status).map(|()| texts)
        })
    }

    /// Zeros for `count` values, refused where the file cannot hold as many.
    fn buffer<T: Value>(&self, count: &[u64]) -> Result<Vec<T>, TableError> {
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
        values.resize(total, T::default());
        Ok(values)
    }
}

/// SAFETY: the lock is held, `id` is a dataset.
unsafe fn shape(path: &Path, id: &Id) -> Result<Vec<u64>, TableError> {
    unsafe {
        let space = owned(path, h5d::H5Dget_space(id.id), h5s::H5Sclose)?;
        let rank = h5s::H5Sget_simple_extent_ndims(space.id);
        if rank < 0 {
            return Err(failure(path));
        }
        let mut shape = vec![0; rank as usize];
        if h5s::H5Sget_simple_extent_dims(space.id, shape.as_mut_ptr(), ptr::null_mut()) < 0 {
            return Err(failure(path));
        }
        Ok(shape)
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
