//! Reading attributes: numbers, and text of fixed or any length, by whichever program wrote them.

use super::failure::unreadable;
use crate::hdf5::ffi::{self, Class, class_of};
use crate::hdf5::guard::Heaps;
use crate::hdf5::{TableError, damaged};
use hdf5::types::{TypeDescriptor, VarLenAscii, VarLenUnicode};
use hdf5::{Attribute, Container, Location};
use std::path::Path;

/// The one number of an attribute; `None` where there is none.
pub fn number(path: &Path, object: &Location, name: &str) -> Result<Option<f64>, TableError> {
    let failed = |error| unreadable(path, &error);
    let bad = || damaged(path, &format!("attribute {name} is not one number"));
    let Some(attribute) = attribute(path, object, name)? else { return Ok(None) };
    let is_number = class_of(&attribute.dtype().map_err(failed)?) == Class::Number;
    if !is_number || attribute.space().map_err(failed)?.size() != 1 {
        return Err(bad());
    }
    attribute.read_raw::<f64>().map_err(failed)?.first().copied().ok_or_else(bad).map(Some)
}

/// Text of fixed or variable length; `None` where there is no such attribute.
pub fn text(
    path: &Path,
    heaps: &Heaps,
    object: &Location,
    name: &str,
) -> Result<Option<String>, TableError> {
    let failed = |error| unreadable(path, &error);
    let bad = || damaged(path, &format!("attribute {name} is not one text"));
    let Some(attribute) = attribute(path, object, name)? else { return Ok(None) };
    if attribute.space().map_err(failed)?.size() != 1 {
        return Err(bad());
    }
    if any_length(&attribute).map_err(failed)?.is_none() {
        return ffi::read_text(&attribute).map_err(failed)?.ok_or_else(bad).map(Some);
    }
    heaps.check(None).map_err(|message| damaged(path, &message))?;
    let texts = texts(&attribute).map_err(failed)?;
    texts.into_iter().next().flatten().ok_or_else(bad).map(Some)
}

/// The strings of any length of a dataset or an attribute whose heaps have been checked; `None` for
/// those that are not there.
pub fn texts(container: &Container) -> hdf5::Result<Vec<Option<String>>> {
    // Not all that is called UTF-8 in a file is.
    let copy = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    Ok(match any_length(container)? {
        // The library does not convert from one encoding to the other.
        Some(TypeDescriptor::VarLenAscii) => {
            let texts = container.read_raw::<VarLenAscii>()?;
            texts.iter().map(|t| (!t.as_ptr().is_null()).then(|| copy(t.as_bytes()))).collect()
        }
        _ => {
            let texts = container.read_raw::<VarLenUnicode>()?;
            texts.iter().map(|t| (!t.as_ptr().is_null()).then(|| copy(t.as_bytes()))).collect()
        }
    })
}

/// The type of strings of any length, `None` for any other.
pub fn any_length(container: &Container) -> hdf5::Result<Option<TypeDescriptor>> {
    let kind = container.dtype()?;
    if class_of(&kind) != Class::Text {
        return Ok(None);
    }
    let kind = kind.to_descriptor()?;
    let any_length = matches!(kind, TypeDescriptor::VarLenAscii | TypeDescriptor::VarLenUnicode);
    Ok(any_length.then_some(kind))
}

fn attribute(path: &Path, object: &Location, name: &str) -> Result<Option<Attribute>, TableError> {
    let failed = |error| unreadable(path, &error);
    if !ffi::has_attribute(object, name).map_err(failed)? {
        return Ok(None);
    }
    object.attr(name).map(Some).map_err(failed)
}
