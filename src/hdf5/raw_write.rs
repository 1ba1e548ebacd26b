//! Writing through the HDF5 C library.
//!
//! What it does beyond the safe crate: objects without time stamps (so that equal input gives
//! equal bytes), attributes as fixed-length strings (netCDF-C reads no others as text), dimension
//! scales, and chunks written as they are, compressed by us. Each call holds the library's global
//! lock.

use super::TableError;
use super::raw_id::{Id, last_reason};
use hdf5::globals::{H5P_ATTRIBUTE_CREATE, H5P_DATASET_CREATE, H5P_FILE_ACCESS, H5P_FILE_CREATE};
use hdf5::globals::{H5T_C_S1, H5T_IEEE_F32LE, H5T_IEEE_F64LE, H5T_STD_I32LE, H5T_STD_U8LE};
use hdf5::sync::sync;
use hdf5_sys::h5::{herr_t, hsize_t};
use hdf5_sys::h5f::H5F_libver_t::H5F_LIBVER_V110;
use hdf5_sys::h5i::hid_t;
use hdf5_sys::{h5a, h5d, h5f, h5p, h5s, h5t};
use std::ffi::{CString, c_char, c_int, c_void};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::ptr;

unsafe extern "C" {
    // From the high-level library, which the sys crate links but does not declare.
    unsafe fn H5DSset_scale(dsid: hid_t, dimname: *const c_char) -> herr_t;
    unsafe fn H5DSattach_scale(did: hid_t, dsid: hid_t, index: u32) -> herr_t;
}

/// What the values of a dataset are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    F32,
    F64,
    I32,
    U8,
    /// Strings of this many bytes, padded with zeros.
    Text(usize),
    /// Strings of any length: what h5netcdf and netCDF-C both show as text in variables.
    Texts,
}

impl Kind {
    fn bytes(self) -> usize {
        match self {
            Kind::F32 | Kind::I32 => 4,
            Kind::F64 => 8,
            Kind::U8 => 1,
            Kind::Text(length) => length,
            Kind::Texts => size_of::<*const c_char>(),
        }
    }
}

/// A file being written.
#[derive(Debug)]
pub(super) struct NewFile {
    id: Id,
    path: PathBuf,
}

/// A dataset being written.
#[derive(Debug)]
pub(super) struct NewDataset {
    id: Id,
    path: PathBuf,
    kind: Kind,
    shape: Vec<u64>,
}

/// Chunk shape and deflate level (0: neither shuffle nor deflate) of a chunked dataset.
#[derive(Clone, Debug)]
pub(super) struct Chunking {
    pub shape: Vec<u64>,
    pub deflate: u8,
}

impl NewFile {
    /// Create (truncate) the file `temporary`; `path` is what messages name.
    pub fn create(temporary: &Path, path: &Path) -> Result<NewFile, TableError> {
        let name = path_text(temporary)?;
        sync(|| unsafe {
            // SAFETY: all identifiers come from the library and are checked; strings are C strings.
            let creation = property_list(path, *H5P_FILE_CREATE)?;
            let order = h5p::H5P_CRT_ORDER_TRACKED | h5p::H5P_CRT_ORDER_INDEXED;
            done(path, h5p::H5Pset_obj_track_times(creation.id, 0))?;
            done(path, h5p::H5Pset_link_creation_order(creation.id, order))?;
            let access = property_list(path, *H5P_FILE_ACCESS)?;
            done(path, h5p::H5Pset_libver_bounds(access.id, H5F_LIBVER_V110, H5F_LIBVER_V110))?;
            done(path, h5p::H5Pset_file_locking(access.id, 0, 1))?;
            let degree = h5f::H5F_close_degree_t::H5F_CLOSE_STRONG;
            done(path, h5p::H5Pset_fclose_degree(access.id, degree))?;
            let file = h5f::H5Fcreate(name.as_ptr(), h5f::H5F_ACC_TRUNC, creation.id, access.id);
            Ok(NewFile { id: owned(path, file, h5f::H5Fclose)?, path: path.to_path_buf() })
        })
    }

    /// Write a text attribute of the file.
    pub fn attribute(&self, name: &str, text: &str) -> Result<(), TableError> {
        text_attribute(&self.path, self.id.id, name, text)
    }

    /// Write an integer attribute of the file.
    pub fn attribute_integer(&self, name: &str, value: i32) -> Result<(), TableError> {
        integer_attribute(&self.path, self.id.id, name, value)
    }

    /// Create a dataset; chunked and compressed, or contiguous (a scalar when `shape` is empty).
    pub fn dataset(
        &self,
        name: &str,
        kind: Kind,
        shape: &[u64],
        chunking: Option<&Chunking>,
    ) -> Result<NewDataset, TableError> {
        let path = &self.path;
        let c_name = c_text(path, name)?;
        sync(|| unsafe {
            // SAFETY: identifiers are checked, shapes and chunk shapes have the same rank.
            let creation = property_list(path, *H5P_DATASET_CREATE)?;
            done(path, h5p::H5Pset_obj_track_times(creation.id, 0))?;
            if kind == Kind::F32 {
                let nothing = f32::NAN;
                let (kind, value) = (*H5T_IEEE_F32LE, (&raw const nothing).cast::<c_void>());
                done(path, h5p::H5Pset_fill_value(creation.id, kind, value))?;
            }
            if let Some(chunking) = chunking {
                let rank = shape.len() as c_int;
                done(path, h5p::H5Pset_chunk(creation.id, rank, chunking.shape.as_ptr()))?;
                if chunking.deflate > 0 {
                    done(path, h5p::H5Pset_shuffle(creation.id))?;
                    done(path, h5p::H5Pset_deflate(creation.id, chunking.deflate.min(9).into()))?;
                }
            }
            let space = dataspace(path, shape)?;
            let kind_id = datatype(path, kind)?;
            let id = h5d::H5Dcreate2(
                self.id.id,
                c_name.as_ptr(),
                kind_id.id,
                space.id,
                h5p::H5P_DEFAULT,
                creation.id,
                h5p::H5P_DEFAULT,
            );
            let id = owned(path, id, h5d::H5Dclose)?;
            Ok(NewDataset { id, path: path.clone(), kind, shape: shape.to_vec() })
        })
    }

    /// Flush and close; only after this is the file whole on disk.
    pub fn close(self) -> Result<(), TableError> {
        let NewFile { id, path } = self;
        sync(|| unsafe {
            // SAFETY: the identifier is valid; closing it twice is prevented by `forget`.
            done(&path, h5f::H5Fflush(id.id, h5f::H5F_scope_t::H5F_SCOPE_LOCAL))?;
            let status = h5f::H5Fclose(id.id);
            std::mem::forget(id);
            done(&path, status)
        })
    }
}

impl NewDataset {
    /// Write all values of a contiguous dataset.
    pub fn write<T: Copy>(&self, values: &[T]) -> Result<(), TableError> {
        let expected = self.shape.iter().product::<u64>() as usize * self.kind.bytes();
        assert_eq!(size_of_val(values), expected, "the values fill the dataset");
        sync(|| unsafe {
            // SAFETY: the buffer has exactly the size of the dataset, checked above.
            let kind = datatype(&self.path, self.kind)?;
            let buffer = values.as_ptr().cast::<c_void>();
            let all = h5s::H5S_ALL;
            let status = h5d::H5Dwrite(self.id.id, kind.id, all, all, h5p::H5P_DEFAULT, buffer);
            done(&self.path, status)
        })
    }

    /// Length of a one-dimensional dataset.
    pub fn length(&self) -> u64 {
        self.shape.first().copied().unwrap_or(1)
    }

    /// Write all strings of a dataset of [`Kind::Texts`].
    pub fn write_texts(&self, texts: &[String]) -> Result<(), TableError> {
        assert_eq!(self.kind, Kind::Texts, "a dataset of strings");
        let texts = texts.iter().map(|text| c_text(&self.path, text));
        let texts = texts.collect::<Result<Vec<CString>, _>>()?;
        self.write(&texts.iter().map(|text| text.as_ptr()).collect::<Vec<_>>())
    }

    /// Write one chunk as it is, already through the dataset's filters.
    pub fn write_chunk(&self, offset: &[u64], bytes: &[u8]) -> Result<(), TableError> {
        assert_eq!(offset.len(), self.shape.len(), "one offset per dimension");
        sync(|| unsafe {
            // SAFETY: the offset has the dataset's rank; the library copies `bytes`.
            let (data, size) = (bytes.as_ptr().cast::<c_void>(), bytes.len());
            let status =
                h5d::H5Dwrite_chunk(self.id.id, h5p::H5P_DEFAULT, 0, offset.as_ptr(), size, data);
            done(&self.path, status)
        })
    }

    /// Write a text attribute of the dataset.
    pub fn attribute(&self, name: &str, text: &str) -> Result<(), TableError> {
        text_attribute(&self.path, self.id.id, name, text)
    }

    /// Write an integer attribute of the dataset.
    pub fn attribute_integer(&self, name: &str, value: i32) -> Result<(), TableError> {
        integer_attribute(&self.path, self.id.id, name, value)
    }

    /// Make this dataset the coordinate of the dimension of the same name.
    pub fn make_scale(&self, name: &str) -> Result<(), TableError> {
        let name = c_text(&self.path, name)?;
        // SAFETY: valid identifier, C string.
        sync(|| unsafe { done(&self.path, H5DSset_scale(self.id.id, name.as_ptr())) })
    }

    /// Attach the coordinates of the dimensions, in order.
    pub fn attach(&self, scales: &[&NewDataset]) -> Result<(), TableError> {
        assert_eq!(scales.len(), self.shape.len(), "one scale per dimension");
        sync(|| {
            for (index, scale) in scales.iter().enumerate() {
                // SAFETY: valid identifiers, index below the rank.
                let status = unsafe { H5DSattach_scale(self.id.id, scale.id.id, index as u32) };
                done(&self.path, status)?;
            }
            Ok(())
        })
    }
}

fn integer_attribute(path: &Path, object: hid_t, name: &str, value: i32) -> Result<(), TableError> {
    write_attribute(path, object, name, Kind::I32, (&raw const value).cast())
}

fn text_attribute(path: &Path, object: hid_t, name: &str, text: &str) -> Result<(), TableError> {
    let value = c_text(path, text)?;
    let kind = Kind::Text(value.as_bytes_with_nul().len());
    write_attribute(path, object, name, kind, value.as_ptr().cast())
}

/// An attribute of one value; `value` points to one of `kind`.
fn write_attribute(
    path: &Path,
    object: hid_t,
    name: &str,
    kind: Kind,
    value: *const c_void,
) -> Result<(), TableError> {
    let name = c_text(path, name)?;
    sync(|| unsafe {
        // SAFETY: `value` points to one value of `kind`; identifiers are checked.
        let kind = datatype(path, kind)?;
        let space = dataspace(path, &[])?;
        let creation = property_list(path, *H5P_ATTRIBUTE_CREATE)?;
        let id = h5a::H5Acreate2(
            object,
            name.as_ptr(),
            kind.id,
            space.id,
            creation.id,
            h5p::H5P_DEFAULT,
        );
        let attribute = owned(path, id, h5a::H5Aclose)?;
        done(path, h5a::H5Awrite(attribute.id, kind.id, value))
    })
}

/// SAFETY: `class` is a property list class of the library; the lock is held.
unsafe fn property_list(path: &Path, class: hid_t) -> Result<Id, TableError> {
    owned(path, unsafe { h5p::H5Pcreate(class) }, h5p::H5Pclose)
}

/// SAFETY: the lock is held.
unsafe fn dataspace(path: &Path, shape: &[u64]) -> Result<Id, TableError> {
    let id = unsafe {
        if shape.is_empty() {
            h5s::H5Screate(h5s::H5S_class_t::H5S_SCALAR)
        } else {
            let dimensions: Vec<hsize_t> = shape.to_vec();
            h5s::H5Screate_simple(shape.len() as c_int, dimensions.as_ptr(), ptr::null())
        }
    };
    owned(path, id, h5s::H5Sclose)
}

/// SAFETY: the lock is held.
unsafe fn datatype(path: &Path, kind: Kind) -> Result<Id, TableError> {
    let base = match kind {
        Kind::F32 => *H5T_IEEE_F32LE,
        Kind::F64 => *H5T_IEEE_F64LE,
        Kind::I32 => *H5T_STD_I32LE,
        Kind::U8 => *H5T_STD_U8LE,
        Kind::Text(_) | Kind::Texts => *H5T_C_S1,
    };
    let id = owned(path, unsafe { h5t::H5Tcopy(base) }, h5t::H5Tclose)?;
    let size = match kind {
        Kind::Text(length) => Some(length.max(1)),
        Kind::Texts => Some(h5t::H5T_VARIABLE),
        _ => None,
    };
    if let Some(size) = size {
        unsafe {
            done(path, h5t::H5Tset_size(id.id, size))?;
            done(path, h5t::H5Tset_cset(id.id, h5t::H5T_cset_t::H5T_CSET_UTF8))?;
        }
    }
    Ok(id)
}

fn owned(
    path: &Path,
    id: hid_t,
    close: unsafe extern "C" fn(hid_t) -> herr_t,
) -> Result<Id, TableError> {
    Id::new(id, close).ok_or_else(|| failure(path))
}

fn done(path: &Path, status: herr_t) -> Result<(), TableError> {
    if status < 0 { Err(failure(path)) } else { Ok(()) }
}

fn failure(path: &Path) -> TableError {
    // The system's reason is still the one of the call that failed inside the library.
    let reason = std::io::Error::last_os_error().kind();
    let (path, message) = (path.to_path_buf(), last_reason());
    match reason {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => TableError::DiskFull { path, message },
        _ => TableError::Write { path, message },
    }
}

fn c_text(path: &Path, text: &str) -> Result<CString, TableError> {
    CString::new(text).map_err(|_| TableError::Write {
        path: path.to_path_buf(),
        message: format!("a text with a zero byte cannot be stored: {text:?}"),
    })
}

fn path_text(path: &Path) -> Result<CString, TableError> {
    let text = path.to_str().ok_or_else(|| TableError::Write {
        path: path.to_path_buf(),
        message: "the name is not valid UTF-8".into(),
    })?;
    c_text(path, text)
}
