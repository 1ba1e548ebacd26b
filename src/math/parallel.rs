//! Loops shared among all threads, by rayon; one after the other where a target has none.
//!
//! In a browser (`wasm32-unknown-unknown`) rayon itself falls back to the one thread there is, but every loop
//! brings its splitting and stealing along, which together were an eighth of the page's engine. There its words
//! are those of plain iterators.

#[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
mod threads;
#[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
pub use threads::*;

#[cfg(any(test, all(target_family = "wasm", target_os = "unknown")))]
mod one_thread;

#[cfg(all(target_family = "wasm", target_os = "unknown"))]
pub use one_thread::*;
