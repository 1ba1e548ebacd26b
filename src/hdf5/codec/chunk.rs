//! One chunk through the filters that HDF5 undoes on reading: bit-rounding, shuffle, deflate.
//!
//! The deflate stream is ordinary zlib, but put together by us, because a general compressor
//! spends its time where nothing is won. The byte planes of shuffled floats differ: the low bytes
//! of a mantissa are noise and become stored blocks (copied), the middle ones have a skewed
//! distribution but no repeats and are coded byte by byte ([`super::literal`]), and only what
//! repeats goes through the compressor. That is several times faster at about the same size.

use crate::math::digits::round_mantissa;
use libdeflater::{CompressionLvl, Compressor, adler32};
use rayon::prelude::*;

/// Longest stored block of deflate (RFC 1951, 3.2.4).
const STORED_BLOCK: usize = 65_535;
/// A byte plane with more entropy than this many bits per byte is stored.
const NOISE_BITS: f64 = 7.8;
/// Bytes of a plane that are compressed on trial.
const TRIAL: usize = 8192;
/// The search for repeats pays where it saves this many bits per byte of a plane: at level 1, and
/// where time matters less. Half a bit is 1.6 % of a file.
const REPEATS_PAY_FAST: f64 = 0.5;
const REPEATS_PAY: f64 = 0.1;
/// Bytes per block of literals; each block has a code of its own (150 bytes).
const LITERAL_BLOCK: usize = 32_768;

/// How a byte plane is coded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Coding {
    Stored,
    Literals,
    Deflate,
}

/// Turns chunks of `f32` values or bytes into what is stored; keeps its buffers between chunks.
pub struct ChunkEncoder {
    compressor: Option<Compressor>,
    repeats_pay: f64,
    bit_round: Option<u8>,
    shuffled: Vec<u8>,
    /// The chunk to encode: filled by the caller.
    pub values: Vec<f32>,
    /// The same for a chunk of bytes.
    pub bytes: Vec<u8>,
    /// The encoded chunk.
    pub encoded: Vec<u8>,
}

impl ChunkEncoder {
    /// `level` 0 stores, 1 … 9 deflate; `bit_round` keeps that many bits of the mantissa.
    pub fn new(level: u8, bit_round: Option<u8>) -> ChunkEncoder {
        let repeats_pay = if level == 1 { REPEATS_PAY_FAST } else { REPEATS_PAY };
        let level = CompressionLvl::new(i32::from(level.min(9))).unwrap_or_default();
        let stored = i32::from(level) == 0;
        ChunkEncoder {
            compressor: (!stored).then(|| Compressor::new(level)),
            repeats_pay,
            bit_round,
            shuffled: Vec::new(),
            values: Vec::new(),
            bytes: Vec::new(),
            encoded: Vec::new(),
        }
    }

    /// Encode `values` (rounding them in place) into `encoded`.
    pub fn encode(&mut self) {
        if let Some(bits) = self.bit_round {
            self.values.iter_mut().for_each(|value| *value = round_mantissa(*value, bits));
        }
        self.encoded.clear();
        let Some(compressor) = &mut self.compressor else {
            self.encoded.resize(4 * self.values.len(), 0);
            for (bytes, value) in self.encoded.chunks_exact_mut(4).zip(&self.values) {
                bytes.copy_from_slice(&value.to_le_bytes());
            }
            return;
        };
        shuffle(&self.values, &mut self.shuffled);
        let count = self.values.len();
        let plane = |plane: usize| &self.shuffled[plane * count..][..count];
        let codings: Vec<Coding> = (0..4)
            .map(|p| coding(compressor, plane(p), self.repeats_pay, &mut self.encoded))
            .take_while(|coding| *coding != Coding::Deflate)
            .collect();
        self.encoded.clear();
        zlib(compressor, &self.shuffled, &codings, count, &mut self.encoded);
    }

    /// Encode `bytes` into `encoded`.
    pub fn encode_bytes(&mut self) {
        self.encoded.clear();
        match &mut self.compressor {
            Some(compressor) => zlib(compressor, &self.bytes, &[], 0, &mut self.encoded),
            None => self.encoded.extend_from_slice(&self.bytes),
        }
    }
}

/// Encode `jobs` on all cores and write them in order. Memory is bounded by the encoders; while
/// one half of them is written, the other half encodes.
pub fn encode_and_write<J: Sync, E: Send>(
    encoders: &mut [ChunkEncoder],
    jobs: &[J],
    encode: impl Fn(&mut ChunkEncoder, &J) + Sync,
    mut write: impl FnMut(&J, &[u8]) -> Result<(), E> + Send,
) -> Result<(), E> {
    let half = encoders.len() / 2;
    let (mut working, mut waiting) = encoders.split_at_mut(half);
    let mut waiting_jobs: &[J] = &[];
    let mut rest = jobs;
    while !rest.is_empty() || !waiting_jobs.is_empty() {
        let (batch, later) = rest.split_at(working.len().min(rest.len()));
        let mut write_waiting = || {
            let done = waiting.iter().zip(waiting_jobs);
            done.filter(|(encoder, _)| !encoder.encoded.is_empty())
                .try_for_each(|(encoder, job)| write(job, &encoder.encoded))
        };
        let encode_batch = || {
            let pairs = working.par_iter_mut().zip(batch.par_iter());
            pairs.for_each(|(encoder, job)| encode(encoder, job));
        };
        rayon::join(&mut write_waiting, encode_batch).0?;
        std::mem::swap(&mut working, &mut waiting);
        (waiting_jobs, rest) = (batch, later);
    }
    Ok(())
}

/// Encoders for [`encode_and_write`], enough for all cores.
pub fn encoders(level: u8, bit_round: Option<u8>) -> Vec<ChunkEncoder> {
    let count = 4 * rayon::current_num_threads().max(1);
    (0..count).map(|_| ChunkEncoder::new(level, bit_round)).collect()
}

/// HDF5's shuffle filter: first all lowest bytes, last all highest bytes.
fn shuffle(values: &[f32], out: &mut Vec<u8>) {
    let count = values.len();
    out.resize(4 * count, 0);
    for (plane, bytes) in out.chunks_exact_mut(count.max(1)).enumerate() {
        for (byte, value) in bytes.iter_mut().zip(values) {
            *byte = (value.to_bits() >> (8 * plane)) as u8;
        }
    }
}

/// Entropy in bits per byte, from a sample of the bytes corrected for its finite size
/// (Miller 1955: the naive estimate is low by (m − 1)/2N ln 2).
fn entropy(bytes: &[u8]) -> f64 {
    const SAMPLE: usize = 8192;
    let step = (bytes.len() / SAMPLE).max(1);
    let mut counts = [0u32; 256];
    bytes.iter().step_by(step).for_each(|&byte| counts[usize::from(byte)] += 1);
    let total: f64 = counts.iter().map(|&count| f64::from(count)).sum();
    let used = counts.iter().filter(|&&count| count > 0);
    let plain: f64 = used
        .clone()
        .map(|&count| {
            let share = f64::from(count) / total;
            -share * share.log2()
        })
        .sum();
    plain + (used.count() as f64 - 1.0) / (2.0 * total * std::f64::consts::LN_2)
}

/// Choose a coding for a plane: compress a part from its middle on trial, compare with what
/// literals and runs alone take there.
fn coding(
    compressor: &mut Compressor,
    plane: &[u8],
    repeats_pay: f64,
    scratch: &mut Vec<u8>,
) -> Coding {
    let length = plane.len().min(TRIAL);
    let trial = &plane[(plane.len() - length) / 2..][..length];
    scratch.resize(compressor.deflate_compress_bound(length), 0);
    let compressed = compressor.deflate_compress(trial, scratch).unwrap_or(length);
    scratch.clear();
    super::literal::append_block(trial, scratch);
    let saved = scratch.len() as f64 - compressed as f64 - super::literal::HEADER_BYTES;
    if 8.0 * saved >= repeats_pay * length as f64 {
        Coding::Deflate
    } else if entropy(plane) > NOISE_BITS {
        Coding::Stored
    } else {
        Coding::Literals
    }
}

/// A zlib stream (RFC 1950), appended to `out`: the first planes of `plane` bytes as `codings`
/// says, the rest deflated.
fn zlib(
    compressor: &mut Compressor,
    data: &[u8],
    codings: &[Coding],
    plane: usize,
    out: &mut Vec<u8>,
) {
    let (planes, rest) = data.split_at(codings.len() * plane);
    out.extend_from_slice(&[0x78, 0x01]);
    for (coding, bytes) in codings.iter().zip(planes.chunks(plane.max(1))) {
        match coding {
            Coding::Literals => {
                let blocks = bytes.chunks(LITERAL_BLOCK);
                blocks.for_each(|block| super::literal::append_block(block, out));
            }
            Coding::Stored | Coding::Deflate => append_stored(bytes, out),
        }
    }
    let start = out.len();
    out.resize(start + compressor.deflate_compress_bound(rest.len()), 0);
    match compressor.deflate_compress(rest, &mut out[start..]) {
        Ok(written) => out.truncate(start + written),
        // The bound is enough by the compressor's contract.
        Err(error) => unreachable!("deflate into its own bound: {error:?}"),
    }
    out.extend_from_slice(&adler32(data).to_be_bytes());
}

/// Stored blocks, not final (RFC 1951, 3.2.4).
fn append_stored(data: &[u8], out: &mut Vec<u8>) {
    for block in data.chunks(STORED_BLOCK) {
        let length = block.len() as u16;
        out.push(0);
        out.extend_from_slice(&length.to_le_bytes());
        out.extend_from_slice(&(!length).to_le_bytes());
        out.extend_from_slice(block);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use libdeflater::Decompressor;
    use proptest::prelude::*;

    fn encoded(values: &[f32], level: u8) -> Vec<u8> {
        let mut encoder = ChunkEncoder::new(level, None);
        encoder.values = values.to_vec();
        encoder.encode();
        encoder.encoded
    }

    fn decode(bytes: &[u8], count: usize) -> Vec<f32> {
        let mut planes = vec![0; 4 * count];
        let length = Decompressor::new().zlib_decompress(bytes, &mut planes).unwrap();
        assert_eq!(length, 4 * count);
        (0..count)
            .map(|i| f32::from_le_bytes(std::array::from_fn(|plane| planes[plane * count + i])))
            .collect()
    }

    proptest! {
        #[test]
        fn decodes_to_what_was_encoded(
            values in prop::collection::vec(any::<f32>(), 1..3000), level in 1u8..=9
        ) {
            let back = decode(&encoded(&values, level), values.len());
            prop_assert!(back.iter().zip(&values).all(|(a, b)| a.to_bits() == b.to_bits()));
        }

        #[test]
        fn rounding_errs_by_half_a_unit(value in 1e-30f32..1e30, bits in 1u8..=23) {
            let rounded = round_mantissa(value, bits);
            prop_assert!((rounded / value - 1.0).abs() <= 0.5f32.powi(i32::from(bits) + 1) * 1.0001);
            prop_assert_eq!(round_mantissa(rounded, bits), rounded);
        }
    }

    #[test]
    fn stored_planes_longer_than_one_block_decode() {
        let mut state = 1u32;
        let values: Vec<f32> = (0..200_000)
            .map(|i| {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                (1.0 + (i as f32 * 1e-4).sin().abs()) * (1.0 + (state >> 8) as f32 * 1e-12)
            })
            .collect();
        let encoded = encoded(&values, 1);
        assert!(encoded.len() < 4 * values.len());
        assert_eq!(decode(&encoded, values.len()), values);
    }

    #[test]
    fn jobs_are_written_in_order_once_each() {
        for count in [0, 1, 3, 4, 5, 8, 9, 100] {
            let jobs: Vec<u8> = (0..count).collect();
            let mut written = Vec::new();
            let encode = |encoder: &mut ChunkEncoder, job: &u8| {
                encoder.bytes = vec![*job];
                encoder.encode_bytes();
            };
            let mut encoders: Vec<_> = (0..8).map(|_| ChunkEncoder::new(0, None)).collect();
            encode_and_write(&mut encoders, &jobs, encode, |job, bytes| {
                assert_eq!(bytes, [*job]);
                written.push(*job);
                Ok::<(), ()>(())
            })
            .unwrap();
            assert_eq!(written, jobs);
        }
    }

    #[test]
    fn rounding_keeps_what_is_not_finite() {
        assert!(round_mantissa(f32::NAN, 5).is_nan());
        assert_eq!(round_mantissa(f32::NEG_INFINITY, 5), f32::NEG_INFINITY);
    }
}
