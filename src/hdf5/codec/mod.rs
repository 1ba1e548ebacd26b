//! Chunks through the filters that every reader of HDF5 undoes, on all cores.

pub mod chunk;
mod literal;
