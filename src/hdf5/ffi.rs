//! The calls of the HDF5 C library that the safe crate does not have, or has in a form that would do
//! harm here; nothing else in the program is `unsafe` towards the library.
//!
//! | call | why not the crate's |
//! |---|---|
//! | [`has_link`], [`has_attribute`] | `link_exists` answers no where the library fails, so that a variable of a damaged file would pass for an absent one; attributes have no such question |
//! | [`class_of`] | the crate's descriptors follow a type as deep as it is nested, and a damaged file nests it as deep as the stack |
//! | [`write_text`], [`read_text`] | fixed-length strings have their length in the Rust type and are padded with zeros; the files have them ended by a zero, which netCDF-C shows as text |
//! | [`write_chunk`] | chunks come compressed from all cores; the library's own filters run on one |
//! | [`make_scale`], [`attach_scale`] | dimension scales are of the high-level C library, which the crate does not wrap |
//!
//! Every identifier belongs to an object of the crate, which closes it; every status is checked, and
//! a refusal bears the library's stack of reasons. Each call holds the crate's global lock.

use hdf5::plist::CharEncoding;
use hdf5::sync::sync;
use hdf5::{Attribute, Dataset, Datatype, Group, Location, Result};
use hdf5_sys::h5::{herr_t, htri_t};
use hdf5_sys::h5i::hid_t;
use hdf5_sys::h5p::H5P_DEFAULT;
use hdf5_sys::{h5a, h5d, h5l, h5t};
use std::ffi::{CString, c_char, c_void};

unsafe extern "C" {
    // From the high-level library, which the sys crate links but does not declare.
    unsafe fn H5DSset_scale(dsid: hid_t, dimname: *const c_char) -> herr_t;
    unsafe fn H5DSattach_scale(did: hid_t, dsid: hid_t, index: u32) -> herr_t;
}

/// Longest text accepted, bytes.
const LONGEST_TEXT: usize = 64 << 20;

/// What a stored value is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Class {
    Number,
    Text,
    Other,
}

/// True where the group has a member of that name.
pub(super) fn has_link(group: &Group, name: &str) -> Result<bool> {
    let name = c_text(name)?;
    // SAFETY: an open group, a C string.
    sync(|| answer(unsafe { h5l::H5Lexists(group.id(), name.as_ptr(), H5P_DEFAULT) }))
}

/// True where the object has an attribute of that name.
pub(super) fn has_attribute(object: &Location, name: &str) -> Result<bool> {
    let name = c_text(name)?;
    // SAFETY: an open object, a C string.
    sync(|| answer(unsafe { h5a::H5Aexists(object.id(), name.as_ptr()) }))
}

/// What values of this type are.
pub(super) fn class_of(kind: &Datatype) -> Class {
    // SAFETY: an open type.
    match sync(|| unsafe { h5t::H5Tget_class(kind.id()) }) {
        h5t::H5T_class_t::H5T_INTEGER | h5t::H5T_class_t::H5T_FLOAT => Class::Number,
        h5t::H5T_class_t::H5T_STRING => Class::Text,
        _ => Class::Other,
    }
}

/// Write a text attribute: one string of fixed length, in UTF-8, with its final zero.
pub(super) fn write_text(object: &Location, name: &str, text: &str) -> Result<()> {
    let value = c_text(text)?;
    let bytes = value.as_bytes_with_nul();
    let kind = text_type(bytes.len())?;
    let builder = object.new_attr_builder().char_encoding(encoding(name)).empty_as(&kind);
    let attribute = builder.create(name)?;
    // SAFETY: the attribute has one value of `kind`, which is as long as the buffer.
    sync(|| done(unsafe { h5a::H5Awrite(attribute.id(), kind.id(), bytes.as_ptr().cast()) }))
}

/// The text of an attribute of one string of fixed length; `None` where it is something else.
pub(super) fn read_text(attribute: &Attribute) -> Result<Option<String>> {
    let (kind, space) = (attribute.dtype()?, attribute.space()?);
    let size = kind.size();
    // SAFETY: an open type.
    let is_fixed = sync(|| unsafe { h5t::H5Tis_variable_str(kind.id()) }) == 0;
    let is_text = class_of(&kind) == Class::Text && is_fixed && space.size() == 1;
    if !is_text || !(1..=LONGEST_TEXT).contains(&size) {
        return Ok(None);
    }
    let mut buffer = vec![0u8; size];
    // SAFETY: the attribute has one value of its own type, which is as long as the buffer.
    sync(|| done(unsafe { h5a::H5Aread(attribute.id(), kind.id(), buffer.as_mut_ptr().cast()) }))?;
    let end = buffer.iter().position(|&byte| byte == 0).unwrap_or(size);
    Ok(Some(String::from_utf8_lossy(&buffer[..end]).into_owned()))
}

/// Write one chunk as it is, already through the dataset's filters; `offset` is the place of its
/// first value.
pub(super) fn write_chunk(dataset: &Dataset, offset: &[u64], bytes: &[u8]) -> Result<()> {
    // The library takes a chunk just beyond the end for one inside.
    let shape = dataset.space()?.shape();
    let inside = offset.iter().zip(&shape).all(|(&at, &length)| at < length as u64);
    if offset.len() != shape.len() || !inside {
        return Err(format!("a chunk at {offset:?} of the shape {shape:?}").into());
    }
    let (data, size) = (bytes.as_ptr().cast::<c_void>(), bytes.len());
    sync(|| {
        // SAFETY: the offset has the dataset's rank, checked; the library copies `bytes`.
        done(unsafe {
            h5d::H5Dwrite_chunk(dataset.id(), H5P_DEFAULT, 0, offset.as_ptr(), size, data)
        })
    })
}

/// Make the dataset the coordinate of the dimension of this name.
pub(super) fn make_scale(dataset: &Dataset, name: &str) -> Result<()> {
    let name = c_text(name)?;
    // SAFETY: an open dataset, a C string.
    sync(|| done(unsafe { H5DSset_scale(dataset.id(), name.as_ptr()) }))
}

/// Attach the coordinate of the dimension number `index`.
pub(super) fn attach_scale(dataset: &Dataset, scale: &Dataset, index: u32) -> Result<()> {
    // SAFETY: open datasets; the library refuses an index that is no dimension.
    sync(|| done(unsafe { H5DSattach_scale(dataset.id(), scale.id(), index) }))
}

/// The encoding that an attribute's name is said to have: ASCII where it is, as other writers do.
pub(super) fn encoding(name: &str) -> CharEncoding {
    if name.is_ascii() { CharEncoding::Ascii } else { CharEncoding::Utf8 }
}

/// The type of strings of so many bytes, a final zero among them.
fn text_type(bytes: usize) -> Result<Datatype> {
    sync(|| {
        // SAFETY: the copy belongs to the object returned and to nothing else.
        let kind: Datatype = unsafe { hdf5::from_id(h5t::H5Tcopy(*hdf5::globals::H5T_C_S1))? };
        // SAFETY: an open type of our own.
        unsafe {
            done(h5t::H5Tset_size(kind.id(), bytes))?;
            done(h5t::H5Tset_cset(kind.id(), h5t::H5T_cset_t::H5T_CSET_UTF8))?;
        }
        Ok(kind)
    })
}

fn c_text(text: &str) -> Result<CString> {
    CString::new(text)
        .map_err(|_| format!("a text with a zero byte cannot be stored: {text:?}").into())
}

/// The library's reasons where it refused; the lock must be held since the call.
fn done(status: herr_t) -> Result<()> {
    if status < 0 { Err(reasons()) } else { Ok(()) }
}

/// Yes, no, or the library's reasons.
fn answer(status: htri_t) -> Result<bool> {
    if status < 0 { Err(reasons()) } else { Ok(status > 0) }
}

fn reasons() -> hdf5::Error {
    hdf5::Error::query().unwrap_or_else(|error| error)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file in memory.
    fn file() -> hdf5::File {
        let name = format!("gonio-ffi-{:?}", std::thread::current().id());
        let mut options = hdf5::File::with_options();
        options.with_fapl(|plist| plist.core_filebacked(false)).create(name).unwrap()
    }

    #[test]
    fn texts_come_back_as_they_went() {
        let file = file();
        for (name, text) in [("empty", ""), ("plain", "light"), ("größe", "θ = 42°")] {
            assert!(!has_attribute(&file, name).unwrap());
            write_text(&file, name, text).unwrap();
            assert!(has_attribute(&file, name).unwrap());
            let attribute = file.attr(name).unwrap();
            assert_eq!(attribute.dtype().unwrap().size(), text.len() + 1);
            assert_eq!(read_text(&attribute).unwrap().as_deref(), Some(text));
        }
        assert!(write_text(&file, "zero", "a\0b").is_err());
        assert!(write_text(&file, "plain", "twice").is_err());
    }

    #[test]
    fn what_is_no_text_is_none() {
        let file = file();
        let number = file.new_attr::<f64>().create("number").unwrap();
        let texts = file.new_attr::<hdf5::types::FixedAscii<4>>().shape(2).create("two").unwrap();
        for attribute in [number, texts] {
            assert_eq!(read_text(&attribute).unwrap(), None);
        }
    }

    #[test]
    fn classes_are_told_apart() {
        let class = |kind: hdf5::types::TypeDescriptor| {
            class_of(&Datatype::from_descriptor(&kind).unwrap())
        };
        use hdf5::types::{FloatSize, IntSize, TypeDescriptor::*};
        for number in [Float(FloatSize::U4), Float(FloatSize::U8), Unsigned(IntSize::U1)] {
            assert_eq!(class(number), Class::Number);
        }
        for text in [VarLenUnicode, VarLenAscii, FixedAscii(3)] {
            assert_eq!(class(text), Class::Text);
        }
        for other in [Boolean, VarLenArray(Box::new(Float(FloatSize::U8)))] {
            assert_eq!(class(other), Class::Other);
        }
    }

    #[test]
    fn chunks_and_scales_are_refused_where_they_do_not_fit() {
        let file = file();
        let builder = file.new_dataset::<f32>().chunk((2, 3)).shape((4, 6));
        let data = builder.create("values").unwrap();
        let chunk: Vec<u8> = (0..6).flat_map(|i| (i as f32).to_ne_bytes()).collect();
        write_chunk(&data, &[2, 3], &chunk).unwrap();
        assert_eq!(data.read_2d::<f32>().unwrap()[[3, 5]], 5.0);
        assert!(write_chunk(&data, &[2], &chunk).is_err(), "one index for two dimensions");
        assert!(write_chunk(&data, &[1, 3], &chunk).is_err(), "between two chunks");
        assert!(write_chunk(&data, &[4, 0], &chunk).is_err(), "outside");

        let scale = file.new_dataset::<f64>().shape(4).create("theta").unwrap();
        make_scale(&scale, "theta").unwrap();
        attach_scale(&data, &scale, 0).unwrap();
        assert!(attach_scale(&data, &scale, 2).is_err(), "no third dimension");
        assert!(has_link(&file, "theta").unwrap() && !has_link(&file, "phi").unwrap());
    }
}
