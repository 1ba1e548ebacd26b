//! Reading attributes: numbers, and text of fixed or any length, by whichever program wrote them.

use super::heap::Heaps;
use super::raw_id::{Id, done, failure, owned};
use super::{TableError, damaged};
use hdf5::globals::H5T_NATIVE_DOUBLE;
use hdf5::sync::sync;
use hdf5_sys::h5i::hid_t;
use hdf5_sys::{h5a, h5p, h5s, h5t};
use std::ffi::{CString, c_char, c_void};
use std::path::Path;
use std::ptr;

/// Longest text attribute accepted, bytes.
const LONGEST_TEXT: usize = 64 << 20;

/// The one number of an attribute; `None` where there is none.
pub(super) fn number(path: &Path, object: hid_t, name: &str) -> Result<Option<f64>, TableError> {
    let Some(attribute) = attribute(path, object, name)? else { return Ok(None) };
    sync(|| unsafe {
        // SAFETY: identifiers are checked; the attribute has one value, checked.
        let space = owned(path, h5a::H5Aget_space(attribute.id), h5s::H5Sclose)?;
        if h5s::H5Sget_simple_extent_npoints(space.id) != 1 {
            return Err(damaged(path, &format!("attribute {name} is not one number")));
        }
        let mut value = 0f64;
        let buffer = (&raw mut value).cast::<c_void>();
        done(path, h5a::H5Aread(attribute.id, *H5T_NATIVE_DOUBLE, buffer))?;
        Ok(Some(value))
    })
}

/// Text of fixed or variable length; `None` where there is no such attribute.
pub(super) fn text(
    path: &Path,
    heaps: &Heaps,
    object: hid_t,
    name: &str,
) -> Result<Option<String>, TableError> {
    let Some(attribute) = attribute(path, object, name)? else { return Ok(None) };
    let bad = || damaged(path, &format!("attribute {name} is not one text"));
    sync(|| unsafe {
        // SAFETY: the buffer has the size of the attribute's own type; the count is one, checked;
        // strings of variable length are copied and then given back to the library.
        let kind = owned(path, h5a::H5Aget_type(attribute.id), h5t::H5Tclose)?;
        let space = owned(path, h5a::H5Aget_space(attribute.id), h5s::H5Sclose)?;
        if h5s::H5Sget_simple_extent_npoints(space.id) != 1 {
            return Err(bad());
        }
        if h5t::H5Tis_variable_str(kind.id) > 0 {
            heaps.check(None).map_err(|message| damaged(path, &message))?;
            let mut text: *mut c_char = ptr::null_mut();
            done(path, h5a::H5Aread(attribute.id, kind.id, (&raw mut text).cast::<c_void>()))?;
            if text.is_null() {
                return Err(bad());
            }
            let copy = std::ffi::CStr::from_ptr(text).to_string_lossy().into_owned();
            hdf5_sys::h5::H5free_memory(text.cast::<c_void>());
            return Ok(Some(copy));
        }
        let size = fixed_text_size(&kind).ok_or_else(bad)?;
        let mut buffer = vec![0u8; size];
        done(path, h5a::H5Aread(attribute.id, kind.id, buffer.as_mut_ptr().cast::<c_void>()))?;
        Ok(Some(trimmed(&buffer)))
    })
}

fn attribute(path: &Path, object: hid_t, name: &str) -> Result<Option<Id>, TableError> {
    let c_name = CString::new(name).map_err(|_| damaged(path, "a name with a zero byte"))?;
    sync(|| unsafe {
        // SAFETY: C string, open object.
        match h5a::H5Aexists(object, c_name.as_ptr()) {
            0 => Ok(None),
            exists if exists < 0 => Err(failure(path)),
            _ => {
                let id = h5a::H5Aopen(object, c_name.as_ptr(), h5p::H5P_DEFAULT);
                owned(path, id, h5a::H5Aclose).map(Some)
            }
        }
    })
}

/// Bytes per string of a type of fixed-length strings. SAFETY: the lock is held.
unsafe fn fixed_text_size(kind: &Id) -> Option<usize> {
    unsafe {
        let is_text = h5t::H5Tget_class(kind.id) == h5t::H5T_class_t::H5T_STRING
            && h5t::H5Tis_variable_str(kind.id) == 0;
        let size = h5t::H5Tget_size(kind.id);
        (is_text && (1..=LONGEST_TEXT).contains(&size)).then_some(size)
    }
}

fn trimmed(bytes: &[u8]) -> String {
    let end = bytes.iter().position(|&byte| byte == 0).unwrap_or(bytes.len());
    String::from_utf8_lossy(&bytes[..end]).into_owned()
}
