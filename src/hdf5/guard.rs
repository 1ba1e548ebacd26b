//! Global heaps, checked before the library walks them.
//!
//! Strings of variable length lie in *global heap collections* (HDF5 File Format Specification,
//! III.E). They are the only structure of our files without a checksum, and the library (1.14,
//! `H5HG__cache_heap_deserialize`) never comes back from a collection that holds a free-space
//! object of length 0. So each collection is walked here first: every object must move on and end
//! inside the collection, the collection inside the file.

use std::fs::File;
use std::io::{Error, Read, Result, Seek, SeekFrom};
use std::sync::{Arc, OnceLock};

/// Signature and version of a collection.
const SIGNATURE: &[u8; 5] = b"GCOL\x01";
/// Bytes before the first object: signature, version, reserved, size.
const HEADER: u64 = 16;
/// Bytes before the content of an object: index, references, reserved, size.
const OBJECT_HEADER: u64 = 16;
/// Largest collection accepted. The library writes 4 kB and more only for longer objects.
const LARGEST: u64 = 64 << 20;
/// Bytes of the file that are looked through at once.
const PIECE: usize = 1 << 20;

/// The heaps of an open file.
#[derive(Clone, Debug)]
pub struct Heaps {
    file: Arc<File>,
    /// What a look through the whole file found, once it was needed.
    all: Arc<OnceLock<std::result::Result<(), String>>>,
}

impl Heaps {
    pub fn new(file: File) -> Heaps {
        Heaps { file: Arc::new(file), all: Arc::default() }
    }

    /// Check the heaps before strings are read; `references` says where (offset, bytes) the
    /// references to them lie in the file, if that is known.
    pub fn check(&self, references: Option<(u64, u64)>) -> std::result::Result<(), String> {
        match references {
            Some(place) => check_referenced(&self.file, place).map_err(|error| error.to_string()),
            None => {
                let look = || check_all(&self.file).map_err(|error| error.to_string());
                self.all.get_or_init(look).clone()
            }
        }
    }
}

/// Check the collections that the references of variable-length values point to: `references` is
/// where they lie in the file, each a length (4 bytes), an address (8), an index (4).
fn check_referenced(mut file: &File, references: (u64, u64)) -> Result<()> {
    let (start, bytes) = references;
    let length = lengths_of_eight(file)?;
    if start.checked_add(bytes).is_none_or(|end| end > length) {
        return Err(bad("references to strings lie outside the file"));
    }
    let mut raw = vec![0; usize::try_from(bytes).map_err(Error::other)?];
    file.seek(SeekFrom::Start(start))?;
    file.read_exact(&mut raw)?;
    let mut addresses: Vec<u64> = raw.chunks_exact(16).map(|entry| number(&entry[4..])).collect();
    addresses.sort_unstable();
    addresses.dedup();
    // An address of zeros or ones stands for an empty string.
    addresses.retain(|&address| address != 0 && address != u64::MAX);
    addresses.into_iter().try_for_each(|address| check_collection(file, address, length))
}

/// Check every collection of the file, wherever it lies: for files by other programs, whose
/// references are not known beforehand.
fn check_all(mut file: &File) -> Result<()> {
    let length = lengths_of_eight(file)?;
    let finder = memchr::memmem::Finder::new(SIGNATURE);
    let mut piece = vec![0; PIECE];
    let mut start = 0;
    while start + SIGNATURE.len() as u64 <= length {
        let size = usize::try_from(length - start).map_or(PIECE, |rest| rest.min(PIECE));
        file.seek(SeekFrom::Start(start))?;
        file.read_exact(&mut piece[..size])?;
        for at in finder.find_iter(&piece[..size]) {
            check_collection(file, start + at as u64, length)?;
        }
        // The next piece overlaps, for a signature that lies across the border.
        let step = size - (SIGNATURE.len() - 1);
        start += step as u64;
    }
    Ok(())
}

/// Walk one collection.
fn check_collection(mut file: &File, address: u64, length: u64) -> Result<()> {
    let rest = length.saturating_sub(address);
    let mut header = [0; HEADER as usize];
    if rest < HEADER {
        return Err(bad("a collection of strings lies outside the file"));
    }
    file.seek(SeekFrom::Start(address))?;
    file.read_exact(&mut header)?;
    let size = number(&header[8..]);
    if !header.starts_with(SIGNATURE) || size < HEADER || size > rest.min(LARGEST) {
        return Err(bad("a collection of strings has a wrong header"));
    }
    let mut objects = vec![0; (size - HEADER) as usize];
    file.read_exact(&mut objects)?;
    let mut rest = objects.as_slice();
    // A rest too short for an object is free space.
    while rest.len() as u64 >= OBJECT_HEADER {
        let index = u16::from_le_bytes([rest[0], rest[1]]);
        let content = number(&rest[8..]);
        let whole = match index {
            // Free space counts its own header.
            0 => Some(content).filter(|&whole| whole >= OBJECT_HEADER),
            _ => content.checked_next_multiple_of(8).and_then(|n| n.checked_add(OBJECT_HEADER)),
        };
        let inside = whole.filter(|&whole| whole <= rest.len() as u64);
        let Some(whole) = inside else { return Err(bad("a collection of strings is broken")) };
        rest = &rest[whole as usize..];
    }
    Ok(())
}

/// Length of the file; fails where its addresses and lengths are not of eight bytes, as those of
/// every file are that can be larger than 4 GB.
fn lengths_of_eight(mut file: &File) -> Result<u64> {
    let mut superblock = [0; 16];
    file.seek(SeekFrom::Start(0))?;
    file.read_exact(&mut superblock)?;
    let sizes = if superblock[8] < 2 { &superblock[13..15] } else { &superblock[9..11] };
    if sizes != [8, 8] {
        return Err(bad("its addresses are not of eight bytes"));
    }
    Ok(file.metadata()?.len())
}

fn number(bytes: &[u8]) -> u64 {
    let mut eight = [0; 8];
    eight.copy_from_slice(&bytes[..8]);
    u64::from_le_bytes(eight)
}

fn bad(message: &str) -> Error {
    Error::new(std::io::ErrorKind::InvalidData, message)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;

    /// Index, claimed size, bytes that are there.
    type Object = (u16, u64, usize);

    /// A file with one collection at 48.
    fn file_with(objects: &[Object]) -> File {
        let mut body = Vec::new();
        for &(index, size, there) in objects {
            body.extend(index.to_le_bytes());
            body.extend([0; 6]);
            body.extend(size.to_le_bytes());
            body.extend(vec![7; there]);
        }
        let mut bytes = b"\x89HDF\r\n\x1a\n\x03\x08\x08\x00".to_vec();
        bytes.resize(48, 0);
        bytes.extend(b"GCOL\x01\0\0\0");
        bytes.extend((16 + body.len() as u64).to_le_bytes());
        bytes.extend(body);
        let mut file = tempfile::tempfile().unwrap();
        file.write_all(&bytes).unwrap();
        file
    }

    #[test]
    fn whole_collections_pass() {
        for objects in [&[(1, 5, 8), (2, 8, 8), (0, 32, 16)][..], &[(1, 8, 8)], &[(0, 16, 0)]] {
            check_all(&file_with(objects)).unwrap();
        }
    }

    #[test]
    fn what_stops_the_library_is_refused() {
        let cases: [(&[Object], &str); 5] = [
            (&[(1, 8, 8), (0, 0, 16)], "free space of no length: the library's endless loop"),
            (&[(0, 8, 16)], "free space shorter than its header"),
            (&[(1, 4096, 8)], "an object that ends outside"),
            (&[(1, u64::MAX, 8)], "a length that overflows when it is padded"),
            (&[(3, u64::MAX - 7, 8)], "a length that overflows with its header"),
        ];
        for (objects, what) in cases {
            assert!(check_all(&file_with(objects)).is_err(), "{what}");
        }
    }

    #[test]
    fn references_are_followed() {
        let mut file = file_with(&[(1, 8, 8), (0, 16, 0)]);
        let end = file.seek(SeekFrom::End(0)).unwrap();
        let entry = |address: u64| {
            let mut entry = 8u32.to_le_bytes().to_vec();
            entry.extend(address.to_le_bytes());
            entry.extend(1u32.to_le_bytes());
            entry
        };
        for address in [48, 0, u64::MAX, 49, 1 << 40] {
            file.write_all(&entry(address)).unwrap();
        }
        for (number, whole) in [(0, true), (1, true), (2, true), (3, false), (4, false)] {
            assert_eq!(check_referenced(&file, (end + 16 * number, 16)).is_ok(), whole, "{number}");
        }
        assert!(check_referenced(&file, (end, 6 * 16)).is_err());
        assert!(check_referenced(&file, (u64::MAX - 4, 16)).is_err());
    }
}
