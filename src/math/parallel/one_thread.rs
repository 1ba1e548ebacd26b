//! What the loops of this library use of rayon, in plain iterators. Where both have a word it means the same, but
//! for `fold`, which is not used, and `reduce`, for which [`reduced`] stands.

#![cfg_attr(test, allow(dead_code, reason = "tests run where there are threads"))]

use std::slice::{Chunks, ChunksMut, Iter, IterMut};

/// Threads that share a loop.
pub fn current_num_threads() -> usize {
    1
}

/// All items brought together, from the first to the last; `nothing` changes none.
pub fn reduced<T>(
    items: impl Iterator<Item = T>,
    nothing: impl Fn() -> T,
    both: impl Fn(T, T) -> T,
) -> T {
    items.fold(nothing(), both)
}

/// As rayon's of this name.
pub trait IntoParallelIterator: IntoIterator + Sized {
    /// All items, one after the other.
    fn into_par_iter(self) -> Self::IntoIter {
        self.into_iter()
    }
}

impl<I: IntoIterator> IntoParallelIterator for I {}

/// As rayon's traits of slices.
pub trait ParallelSlice<T> {
    /// All items, one after the other.
    fn par_iter(&self) -> Iter<'_, T>;
    /// The same, to be changed.
    fn par_iter_mut(&mut self) -> IterMut<'_, T>;
    /// Neighbours together.
    fn par_chunks(&self, size: usize) -> Chunks<'_, T>;
    /// The same, to be changed.
    fn par_chunks_mut(&mut self, size: usize) -> ChunksMut<'_, T>;
}

impl<T> ParallelSlice<T> for [T] {
    fn par_iter(&self) -> Iter<'_, T> {
        self.iter()
    }

    fn par_iter_mut(&mut self) -> IterMut<'_, T> {
        self.iter_mut()
    }

    fn par_chunks(&self, size: usize) -> Chunks<'_, T> {
        self.chunks(size)
    }

    fn par_chunks_mut(&mut self, size: usize) -> ChunksMut<'_, T> {
        self.chunks_mut(size)
    }
}

/// Words of rayon's iterators that plain ones lack.
pub trait ParallelIterator: Iterator + Sized {
    /// How far a loop may be split says nothing here.
    #[must_use]
    fn with_max_len(self, _: usize) -> Self {
        self
    }

    /// As [`ParallelIterator::with_max_len`].
    #[must_use]
    fn with_min_len(self, _: usize) -> Self {
        self
    }

    /// What `items` makes of each, one after the other.
    fn flat_map_iter<U: IntoIterator>(
        self,
        items: impl FnMut(Self::Item) -> U,
    ) -> impl Iterator<Item = U::Item> {
        self.flat_map(items)
    }
}

impl<I: Iterator> ParallelIterator for I {}

#[cfg(test)]
mod tests {
    macro_rules! looped {
        ($numbers:expr) => {
            $numbers
                .par_chunks(7)
                .with_max_len(1)
                .zip((0..15u32).into_par_iter())
                .flat_map_iter(|(chunk, k)| [chunk.iter().sum::<u32>() + k, k])
                .collect::<Vec<u32>>()
        };
    }

    mod here {
        use super::super::*;

        pub fn looped(numbers: &[u32]) -> (Vec<u32>, u32) {
            let largest = reduced(numbers.par_iter().map(|n| 3 * n), || 0, u32::max);
            (looped!(numbers), largest)
        }
    }

    mod there {
        use crate::math::parallel::*;

        pub fn looped(numbers: &[u32]) -> (Vec<u32>, u32) {
            let largest = reduced(numbers.par_iter().map(|n| 3 * n), || 0, u32::max);
            (looped!(numbers), largest)
        }
    }

    /// The words mean what rayon's mean.
    #[test]
    fn loops_are_those_of_threads() {
        let numbers: Vec<u32> = (0..100).collect();
        assert_eq!(here::looped(&numbers), there::looped(&numbers));
    }
}
