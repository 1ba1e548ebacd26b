//! What `gonio lee` is told.

use crate::cli::args::polarisation::PolarisationFlag;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Lee diagram: colour over scattering angle × drop radius, as PNG and HDF5
#[derive(Args)]
#[command(after_help = "Example: gonio lee -o lee.png --data lee.h5 --radius-mm 0.01:1:400")]
pub struct LeeArgs {
    /// Picture to write
    #[arg(short, long, value_name = "LEE.png")]
    pub(super) output: Option<PathBuf>,
    /// Numbers to write (HDF5)
    #[arg(long, value_name = "LEE.h5")]
    pub(super) data: Option<PathBuf>,
    /// Replace files of the same names
    #[arg(long)]
    pub(super) overwrite: bool,
    /// Spheres by Lorenz–Mie, raindrops by rays
    #[arg(long, value_enum, default_value = "sphere")]
    pub(super) shape: LeeShape,
    /// The exact series or rays by the shape, or Airy's theory of both bows (spheres)
    #[arg(long, value_enum, default_value = "auto")]
    pub(super) method: LeeMethod,
    /// Radii FROM:TO:COUNT, log-spaced, or FROM:TO:sSTEP, evenly
    #[arg(long, value_name = "MM", default_value = "0.01:1:400")]
    pub(super) radius_mm: String,
    /// Radii evenly spaced
    #[arg(long)]
    pub(super) linear: bool,
    /// Scattering angles FROM:TO:STEP or FROM:TO:nCOUNT
    #[arg(long, value_name = "DEG", default_value = "120:150:0.075")]
    pub(super) theta: String,
    /// Sun above the horizon (raindrops)
    #[arg(long, value_name = "DEG", default_value_t = 20.0, allow_negative_numbers = true)]
    pub(super) sun_elevation_deg: f64,
    /// Azimuth about the sun's rays of the light seen (raindrops): 180, light that goes down, is the
    /// top of the bow; 90 its side; 0 its lowest point
    #[arg(long, value_name = "DEG", default_value_t = 180.0, allow_negative_numbers = true)]
    pub(super) azimuth_deg: f64,
    /// Light seen through no filter, or one along or across the scattering plane
    #[arg(long, value_enum, default_value = "total")]
    pub(super) polarisation: PolarisationFlag,
    /// A point instead of the sun's disc of 0.53°
    #[arg(long)]
    pub(super) no_sun_disc: bool,
    /// Standard deviation of ln(radius) about each radius
    #[arg(long, value_name = "SPREAD", default_value_t = 0.0)]
    pub(super) size_spread: f64,
    /// Medium of the drops: a name, a .yml or .csv file, or a table in braces as in a scene
    #[arg(long, value_name = "MEDIUM", default_value = "water")]
    pub(super) medium: String,
    /// Light: D65, A, E, D50, 5778K, sun, sun-ground, sun@DEGREES
    #[arg(long, default_value = "D65")]
    pub(super) illuminant: String,
    /// Observer: 1931 or 2015
    #[arg(long, default_value = "1931")]
    pub(super) observer: String,
    /// Factor on the numbers of angles and wavelengths
    #[arg(long, default_value_t = 1.0)]
    pub(super) fineness: f64,
    /// Print seconds, radii, angles and colours
    #[arg(long)]
    pub(super) json: bool,
}

#[derive(Clone, Copy, ValueEnum)]
pub(super) enum LeeShape {
    Sphere,
    Raindrop,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum LeeMethod {
    Auto,
    /// Orders 2 and 3 alone, by the classical theory of the rainbow
    Airy,
}
