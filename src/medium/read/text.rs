//! The text of a file of optical data, whatever its encoding and its line ends.
//!
//! UTF-8 and UTF-16 (with a byte order mark, or told by its zero bytes) are read as they are; other
//! bytes count as Latin-1 (Windows-1252), which is said. Line ends of Windows and of old Macs become
//! plain ones.

use crate::medium::error::{MediumError, file_error};
use std::path::Path;

/// Largest file of optical data that is read, bytes; the largest of the databases has 2 MB.
const LARGEST_FILE: u64 = 64 << 20;

/// A file's text with plain line ends, and what was converted.
#[derive(Debug)]
pub(in crate::medium) struct Text {
    pub text: String,
    pub note: Option<String>,
}

/// Reads a file.
pub(in crate::medium) fn read(path: &Path) -> Result<Text, MediumError> {
    let fail = |message: String| file_error(path, None, message);
    let data = std::fs::metadata(path).map_err(|e| fail(e.to_string()))?;
    // Opening a pipe would wait for its other end; a folder has no text.
    if !data.is_file() {
        return Err(fail("not a regular file".into()));
    }
    let size = data.len();
    if size > LARGEST_FILE {
        return Err(fail(format!("{size} bytes, at most {LARGEST_FILE} are read")));
    }
    decode(std::fs::read(path).map_err(|e| fail(e.to_string()))?)
        .map_err(|message| fail(message.into()))
}

/// The text of some bytes, or why they are none.
fn decode(bytes: Vec<u8>) -> Result<Text, &'static str> {
    let (text, note) = match utf16_order(&bytes) {
        Some((order, start)) => {
            let units = bytes[start..].chunks_exact(2).map(|pair| order([pair[0], pair[1]]));
            let text: String = char::decode_utf16(units)
                .collect::<Result<_, _>>()
                .map_err(|_| "broken UTF-16: save it as UTF-8")?;
            (text, Some("UTF-16 text, converted to UTF-8".to_string()))
        }
        None => match String::from_utf8(bytes) {
            Ok(text) => (text, None),
            Err(error) => {
                let bytes = error.into_bytes();
                if bytes.contains(&0) {
                    return Err("not a text file: bytes that are neither UTF-8 nor UTF-16");
                }
                let text = bytes.iter().map(|&b| windows_1252(b)).collect();
                (text, Some("not UTF-8: read as Latin-1 (Windows-1252)".to_string()))
            }
        },
    };
    let text = text.trim_start_matches('\u{feff}').replace("\r\n", "\n").replace('\r', "\n");
    Ok(Text { text, note })
}

type Order = fn([u8; 2]) -> u16;

/// The byte order of UTF-16 and where the text begins; `None` for anything else.
fn utf16_order(bytes: &[u8]) -> Option<(Order, usize)> {
    match bytes {
        [0xff, 0xfe, ..] => return Some((u16::from_le_bytes, 2)),
        [0xfe, 0xff, ..] => return Some((u16::from_be_bytes, 2)),
        _ => {}
    }
    // Numbers and Latin letters have a zero in every other byte.
    let head = &bytes[..bytes.len().min(512) & !1];
    let zeros = |parity: usize| head.iter().skip(parity).step_by(2).filter(|b| **b == 0).count();
    let (even, odd, most) = (zeros(0), zeros(1), head.len() * 9 / 20);
    match (even, odd) {
        _ if head.len() < 8 => None,
        (0, odd) if odd >= most => Some((u16::from_le_bytes, 0)),
        (even, 0) if even >= most => Some((u16::from_be_bytes, 0)),
        _ => None,
    }
}

/// Windows-1252: Latin-1 with a few signs in place of control codes.
fn windows_1252(byte: u8) -> char {
    match byte {
        0x80 => '€',
        0x91 | 0x92 => '\'',
        0x93 | 0x94 => '"',
        0x96 | 0x97 => '-',
        other => char::from(other),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "wavelength (µm),n\n0.4,1.5\n";

    #[test]
    fn encodings_and_line_ends() {
        let plain = |text: &str| text.as_bytes().to_vec();
        let marked = |mark: &[u8], bytes: Vec<u8>| [mark, &bytes].concat();
        let little = || TEXT.encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<u8>>();
        let big = || TEXT.encode_utf16().flat_map(u16::to_be_bytes).collect::<Vec<u8>>();
        let latin = TEXT.chars().map(|c| c as u32 as u8).collect::<Vec<u8>>();
        for (bytes, told) in [
            (plain(TEXT), ""),
            (plain(&TEXT.replace('\n', "\r\n")), ""),
            (plain(&TEXT.replace('\n', "\r")), ""),
            (marked(&[0xef, 0xbb, 0xbf], plain(TEXT)), ""),
            (marked(&[0xff, 0xfe], little()), "UTF-16"),
            (marked(&[0xfe, 0xff], big()), "UTF-16"),
            (little(), "UTF-16"),
            (big(), "UTF-16"),
            (latin, "Latin-1"),
        ] {
            let text = decode(bytes).unwrap();
            assert_eq!(text.text, TEXT);
            assert!(text.note.unwrap_or_default().contains(told));
        }
        assert!(decode(vec![0xff, 0xfe, 0x00, 0xd8]).unwrap_err().contains("UTF-16"));
        assert!(decode(vec![0xe9, 0, 0, 1]).unwrap_err().contains("not a text file"));
    }
}
