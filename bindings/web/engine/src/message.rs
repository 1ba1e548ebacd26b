//! Messages: a length, a header of JSON, and blocks of numbers behind it.
//!
//! ```text
//! u64 length of the header | header, filled with spaces to a multiple of 8 | blocks, each filled likewise
//! ```
//! In a request all blocks are one array of f64. In a reply the header's `blocks` lists them as
//! `[name, "f64" | "u8", count]`; `error` is there where something was refused.

use serde::de::DeserializeOwned;
use serde_json::{Value, json};

/// What is asked.
#[derive(Debug)]
pub struct Request {
    /// Which question.
    pub op: String,
    header: Value,
    /// Numbers that came with it.
    pub numbers: Vec<f64>,
}

impl Request {
    /// A request of a header and numbers.
    pub fn new(header: Value, numbers: Vec<f64>) -> Self {
        let op = header.get("op").and_then(Value::as_str).unwrap_or_default().to_string();
        Self { op, header, numbers }
    }

    /// Read a message.
    ///
    /// # Errors
    /// Bytes that are no message.
    pub fn read(bytes: &[u8]) -> Result<Self, Trouble> {
        let broken = || Trouble::new("", "the message is broken".into());
        let (first, rest) = bytes.split_first_chunk::<8>().ok_or_else(broken)?;
        let length = usize::try_from(u64::from_le_bytes(*first)).map_err(|_| broken())?;
        let header = rest.get(..length).ok_or_else(broken)?;
        let header: Value = serde_json::from_slice(header).map_err(|_| broken())?;
        let (words, _) = rest[length..].as_chunks::<8>();
        Ok(Self::new(header, words.iter().map(|word| f64::from_le_bytes(*word)).collect()))
    }

    /// The message as bytes.
    pub fn write(&self) -> Vec<u8> {
        let mut bytes = opened(&self.header);
        bytes.extend(self.numbers.iter().flat_map(|v| v.to_le_bytes()));
        bytes
    }

    /// The header as what a question needs.
    ///
    /// # Errors
    /// The field that is missing or of another kind.
    pub fn parsed<T: DeserializeOwned>(&self) -> Result<T, Trouble> {
        T::deserialize(&self.header).map_err(|error| Trouble::new("", error.to_string()))
    }
}

/// The header's length, the header, and spaces up to a multiple of eight.
fn opened(header: &Value) -> Vec<u8> {
    let mut text = header.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(8), b' ');
    let mut bytes = (text.len() as u64).to_le_bytes().to_vec();
    bytes.append(&mut text);
    bytes
}

/// Numbers of an answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// Numbers.
    F64(Vec<f64>),
    /// Colours.
    U8(Vec<u8>),
}

/// An answer.
#[derive(Debug)]
pub struct Reply {
    header: Value,
    /// Numbers by name.
    pub blocks: Vec<(String, Block)>,
}

impl Reply {
    /// An answer of a header alone, which is an object.
    pub fn new(header: Value) -> Self {
        Self { header, blocks: Vec::new() }
    }

    /// With numbers.
    #[must_use]
    pub fn with(mut self, name: &str, values: Vec<f64>) -> Self {
        self.blocks.push((name.into(), Block::F64(values)));
        self
    }

    /// With colours.
    #[must_use]
    pub fn with_bytes(mut self, name: &str, values: Vec<u8>) -> Self {
        self.blocks.push((name.into(), Block::U8(values)));
        self
    }

    /// The message as bytes.
    pub fn write(mut self) -> Vec<u8> {
        let list: Vec<Value> = (self.blocks.iter())
            .map(|(name, block)| match block {
                Block::F64(values) => json!([name, "f64", values.len()]),
                Block::U8(values) => json!([name, "u8", values.len()]),
            })
            .collect();
        self.header["blocks"] = Value::Array(list);
        let mut bytes = opened(&self.header);
        for (_, block) in &self.blocks {
            match block {
                Block::F64(values) => bytes.extend(values.iter().flat_map(|v| v.to_le_bytes())),
                Block::U8(values) => {
                    bytes.extend(values);
                    bytes.resize(bytes.len().next_multiple_of(8), 0);
                }
            }
        }
        bytes
    }
}

/// Why a question is refused: the control it belongs to, if one does, and the library's words.
#[derive(Clone, Debug, PartialEq)]
pub struct Trouble {
    /// As the fields of [`crate::drop::Drop`].
    pub field: String,
    /// What is wrong and what is accepted.
    pub message: String,
}

impl Trouble {
    /// Of a field.
    pub fn new(field: &str, message: String) -> Self {
        Self { field: field.into(), message }
    }

    /// An error of the library, without a field of its own.
    pub fn of(error: &dyn std::error::Error) -> Self {
        Self::new("", error.to_string())
    }

    /// As an answer.
    pub fn reply(&self) -> Reply {
        Reply::new(json!({ "error": { "field": self.field, "message": self.message } }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is written is read again, and broken bytes are refused.
    #[test]
    fn messages_come_back() {
        let request = Request::new(json!({ "op": "sky", "x": 1.5 }), vec![1.0, -2.5]);
        let read = Request::read(&request.write()).unwrap();
        assert_eq!((read.op.as_str(), read.numbers), ("sky", vec![1.0, -2.5]));
        for broken in [&b""[..], b"12345678", &[255; 32], &request.write()[..12]] {
            assert!(Request::read(broken).is_err());
        }
    }
}
