//! A deflate block of literals and long runs: Huffman coding without the search for repeats.
//!
//! The middle byte plane of shuffled floats has a skewed distribution but no repeats, the highest
//! (the exponent) has long runs or flips between two values. A general compressor searches both
//! for repeats at some 10 ns per byte; coding bytes alone, and runs of 258 of the same byte, gives
//! nearly the same size at about 1 ns (RFC 1951, 3.2.5 and 3.2.7).

/// Longest code word of deflate.
const LONGEST: u32 = 15;
/// The symbol that ends a block.
const END: usize = 256;
/// The symbol of the longest match, and its length.
const RUN: usize = 285;
const RUN_LENGTH: usize = 258;
/// Number of symbols.
const SYMBOLS: usize = 286;
/// What a block takes beside its words, bytes.
pub const HEADER_BYTES: f64 = 158.0;
/// Order in which the lengths of the code-length code stand (RFC 1951, 3.2.7).
const LENGTH_ORDER: [u32; 19] = [16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15];

/// Append one non-final block with the bytes of `data`, then an empty stored block, so that the
/// stream goes on at a byte.
pub fn append_block(data: &[u8], out: &mut Vec<u8>) {
    let lengths = code_lengths(&histogram(data));
    let words = code_words(&lengths);
    let mut bits = BitWriter { buffer: 0, count: 0, out };

    // Header: dynamic codes, 286 literal symbols, one distance symbol, 19 code-length symbols.
    bits.put(0b100, 3);
    bits.put(SYMBOLS as u32 - 257, 5);
    bits.put(0, 5);
    bits.put(15, 4);
    // Every length 0 … 15 is a word of four bits; the repeat symbols are unused.
    LENGTH_ORDER.iter().for_each(|&symbol| bits.put(if symbol < 16 { 4 } else { 0 }, 3));
    let put_length = |bits: &mut BitWriter, length: u32| bits.put(reversed(length, 4), 4);
    lengths.iter().for_each(|&length| put_length(&mut bits, length));
    // The one distance, 1, has a word of one bit.
    put_length(&mut bits, 1);

    let (run_word, run_length) = words[RUN];
    for_each_part(data, |part| match part {
        Part::Run => bits.put(run_word, run_length + 1),
        Part::Literals(bytes) => {
            let mut triples = bytes.chunks_exact(3);
            for triple in &mut triples {
                for &byte in triple {
                    let (word, length) = words[usize::from(byte)];
                    bits.add(word, length);
                }
                bits.flush();
            }
            triples.remainder().iter().for_each(|&byte| {
                let (word, length) = words[usize::from(byte)];
                bits.put(word, length);
            });
        }
    });
    let (word, length) = words[END];
    bits.put(word, length);

    bits.put(0, 3);
    bits.align();
    out.extend_from_slice(&[0, 0, 0xff, 0xff]);
}

/// A piece of the data: bytes as they are, or [`RUN_LENGTH`] times the byte before it.
enum Part<'a> {
    Literals(&'a [u8]),
    Run,
}

fn for_each_part<'a>(data: &'a [u8], mut visit: impl FnMut(Part<'a>)) {
    let mut before = None;
    for piece in data.chunks(RUN_LENGTH) {
        let differs = |byte: u8| piece.iter().fold(0, |bits, other| bits | (other ^ byte)) != 0;
        let is_run = piece.len() == RUN_LENGTH && before.is_some_and(|byte| !differs(byte));
        visit(if is_run { Part::Run } else { Part::Literals(piece) });
        before = piece.last().copied();
    }
}

/// How often each symbol occurs; the end of the block once.
fn histogram(data: &[u8]) -> [u32; SYMBOLS] {
    // Four counters per byte, so that equal neighbours do not wait for each other.
    let mut lanes = [[0u32; 256]; 4];
    let mut counts = [0; SYMBOLS];
    for_each_part(data, |part| match part {
        Part::Run => counts[RUN] += 1,
        Part::Literals(bytes) => {
            let mut quads = bytes.chunks_exact(4);
            for quad in &mut quads {
                for (lane, &byte) in lanes.iter_mut().zip(quad) {
                    lane[usize::from(byte)] += 1;
                }
            }
            quads.remainder().iter().for_each(|&byte| lanes[0][usize::from(byte)] += 1);
        }
    });
    for (symbol, count) in counts.iter_mut().enumerate().take(256) {
        *count = lanes.iter().map(|lane| lane[symbol]).sum();
    }
    counts[END] = 1;
    counts
}

/// Lengths of a Huffman code of at most [`LONGEST`] bits: where the best code is longer, counts
/// are flattened until it is not.
fn code_lengths(counts: &[u32; SYMBOLS]) -> [u32; SYMBOLS] {
    let mut weights: [u64; SYMBOLS] = std::array::from_fn(|symbol| u64::from(counts[symbol]));
    loop {
        let lengths = huffman(&weights);
        if lengths.iter().all(|&length| length <= LONGEST) {
            return lengths;
        }
        weights
            .iter_mut()
            .filter(|weight| **weight > 0)
            .for_each(|weight| *weight = *weight / 4 + 1);
    }
}

/// Lengths of the unrestricted Huffman code, by two queues: leaves by weight, and joined nodes,
/// which come out by weight anyway. A symbol alone gets one bit.
fn huffman(weights: &[u64; SYMBOLS]) -> [u32; SYMBOLS] {
    let mut leaves: Vec<usize> = (0..SYMBOLS).filter(|&symbol| weights[symbol] > 0).collect();
    leaves.sort_by_key(|&symbol| weights[symbol]);
    let mut lengths = [0; SYMBOLS];
    if let [single] = leaves[..] {
        lengths[single] = 1;
        return lengths;
    }
    // Nodes: first the leaves, then the joined ones; each learns its parent.
    let count = leaves.len();
    let mut node_weights: Vec<u64> = leaves.iter().map(|&symbol| weights[symbol]).collect();
    let mut parents = vec![0; 2 * count - 1];
    let (mut next_leaf, mut next_joined) = (0, count);
    for joined in count..2 * count - 1 {
        let mut lightest = || {
            let take_leaf = next_leaf < count
                && (next_joined >= node_weights.len()
                    || node_weights[next_leaf] <= node_weights[next_joined]);
            let taken = if take_leaf { &mut next_leaf } else { &mut next_joined };
            *taken += 1;
            *taken - 1
        };
        let (first, second) = (lightest(), lightest());
        (parents[first], parents[second]) = (joined, joined);
        node_weights.push(node_weights[first] + node_weights[second]);
    }
    let mut depths = vec![0; 2 * count - 1];
    for node in (0..2 * count - 2).rev() {
        depths[node] = depths[parents[node]] + 1;
    }
    leaves.iter().zip(&depths).for_each(|(&symbol, &depth)| lengths[symbol] = depth);
    lengths
}

/// The canonical code words of these lengths, bits reversed as the stream wants them.
fn code_words(lengths: &[u32; SYMBOLS]) -> [(u32, u32); SYMBOLS] {
    let mut next = [0u32; LONGEST as usize + 2];
    for &length in lengths.iter().filter(|&&length| length > 0) {
        next[length as usize + 1] += 1;
    }
    // next[l]: first word of length l = 2 (first of l − 1 + number of l − 1).
    let mut first = 0;
    for count in next.iter_mut().skip(1) {
        first = (first + *count) << 1;
        *count = first;
    }
    std::array::from_fn(|symbol| {
        let length = lengths[symbol];
        if length == 0 {
            return (0, 0);
        }
        let word = next[length as usize];
        next[length as usize] += 1;
        (reversed(word, length), length)
    })
}

fn reversed(word: u32, length: u32) -> u32 {
    word.reverse_bits() >> (32 - length)
}

/// Bits into bytes, lowest bit first.
struct BitWriter<'a> {
    buffer: u64,
    count: u32,
    out: &'a mut Vec<u8>,
}

impl BitWriter<'_> {
    /// Add up to 15 bits; three times before a flush.
    fn add(&mut self, bits: u32, count: u32) {
        self.buffer |= u64::from(bits) << self.count;
        self.count += count;
    }

    fn flush(&mut self) {
        let whole = self.count / 8;
        self.out.extend_from_slice(&self.buffer.to_le_bytes());
        self.out.truncate(self.out.len() - 8 + whole as usize);
        self.buffer >>= 8 * whole;
        self.count -= 8 * whole;
    }

    fn put(&mut self, bits: u32, count: u32) {
        self.add(bits, count);
        self.flush();
    }

    fn align(&mut self) {
        self.count = self.count.next_multiple_of(8);
        self.flush();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use libdeflater::Decompressor;
    use proptest::prelude::*;

    fn round_trip(data: &[u8]) -> usize {
        let mut out = Vec::new();
        append_block(data, &mut out);
        let length = out.len();
        out.extend_from_slice(&[3, 0]); // a final block of nothing
        let mut back = vec![0; data.len()];
        let count = Decompressor::new().deflate_decompress(&out, &mut back).unwrap();
        assert_eq!((count, back.as_slice()), (data.len(), data));
        length
    }

    proptest! {
        #[test]
        fn decodes(data in prop::collection::vec(any::<u8>(), 0..5000)) {
            round_trip(&data);
        }

        #[test]
        fn skewed_decodes(data in prop::collection::vec(0u8..3, 0..5000)) {
            round_trip(&data);
        }
    }

    #[test]
    fn runs_take_next_to_nothing() {
        let mut data = vec![7; 100_000];
        assert!(round_trip(&data) < 400);
        data[50_000] = 8;
        data.extend([9; 300]);
        round_trip(&data);
    }

    #[test]
    fn codes_longer_than_allowed_are_flattened() {
        // Fibonacci weights give the deepest Huffman tree.
        let (mut data, mut a, mut b) = (Vec::new(), 1usize, 1);
        for symbol in 0..24u8 {
            data.extend(std::iter::repeat_n(symbol, a));
            (a, b) = (b, a + b);
        }
        round_trip(&data);
    }

    #[test]
    fn size_is_near_the_entropy() {
        let data: Vec<u8> = (0..1u32 << 16)
            .map(|i| (i.wrapping_mul(2_654_435_761) >> 16).trailing_zeros().min(8) as u8)
            .collect();
        // Geometric distribution: two bits per byte.
        let bits = 8.0 * round_trip(&data) as f64 / data.len() as f64;
        assert!((1.9..2.05).contains(&bits), "{bits} bits per byte");
    }
}
