//! Loops by rayon.

pub use rayon::{current_num_threads, prelude::*};

/// All items brought together two by two, in any order; `nothing` changes none.
pub fn reduced<T: Send>(
    items: impl ParallelIterator<Item = T>,
    nothing: impl Fn() -> T + Sync + Send,
    both: impl Fn(T, T) -> T + Sync + Send,
) -> T {
    items.reduce(nothing, both)
}
