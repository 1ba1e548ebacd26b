//! What is looked at: Lee diagrams, pictures, comparisons and their reports. One module per subject:
//! `cargo test --release --test look look_bows::`.
#![cfg(all(feature = "cli", feature = "hdf5"))]

mod bows;
mod tables;

mod look_bows;
mod look_compare;
mod look_layer;
mod look_lee;
mod look_photo;
mod look_preview;
mod look_report;
mod look_sampling;
mod look_scenes;
mod look_twinned;

/// The program, ready for its arguments.
fn gonio() -> assert_cmd::Command {
    assert_cmd::Command::cargo_bin("gonio").unwrap()
}

/// The pixels of a PNG; what it tells of itself beside them differs from picture to picture.
fn pixels(png: &std::path::Path) -> Vec<u8> {
    decoded(&std::fs::read(png).unwrap()).1
}

/// Words and pixels of a PNG.
fn decoded(bytes: &[u8]) -> (Vec<(String, String)>, Vec<u8>) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    let words = &reader.info().utf8_text;
    let words = words.iter().map(|chunk| (chunk.keyword.clone(), chunk.get_text().unwrap()));
    (words.collect(), pixels)
}
