//! The engine without a browser: one request as bytes on standard input, its answer on standard output.
//! `tests/parity.mjs` compares it with the WebAssembly.

use std::io::{Read, Write};

fn main() -> std::io::Result<()> {
    let mut request = Vec::new();
    std::io::stdin().read_to_end(&mut request)?;
    std::io::stdout().write_all(&gonio_web::respond(&request))
}
