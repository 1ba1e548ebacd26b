//! The flag `--polarisation`: what an observer with or without a filter sees.

use clap::ValueEnum;
use gonio::optics::Polarisation;

#[derive(Clone, Copy, ValueEnum)]
pub enum PolarisationFlag {
    Total,
    Parallel,
    Perpendicular,
}

impl From<PolarisationFlag> for Polarisation {
    fn from(flag: PolarisationFlag) -> Self {
        match flag {
            PolarisationFlag::Total => Self::Total,
            PolarisationFlag::Parallel => Self::Parallel,
            PolarisationFlag::Perpendicular => Self::Perpendicular,
        }
    }
}
